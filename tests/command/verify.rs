//! `mms verify`: its document and exit codes, and damage to its store.

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use serde_json::Value;

use super::mms::{Folder, keys, timeless};
use super::sampled::sampled_count;

/// Rows of runs of some milliseconds.
const ROWS: &str = "--row startup --row statics/column";

/// The document of these rows, with this store.
fn document(folder: &Folder, store: &str) -> Value {
    folder.mms(&format!("verify --json --store {store} {ROWS}")).exits(0).json()
}

/// The results in a folder.
fn results(folder: &Path) -> Vec<std::path::PathBuf> {
    let entries = fs::read_dir(folder).expect("a folder").map(|entry| entry.unwrap().path());
    let mut paths: Vec<_> =
        entries.filter(|path| path.extension().is_some_and(|end| end == "json")).collect();
    paths.sort();
    paths
}

#[test]
fn the_document_has_the_promised_keys_and_every_verdict_is_the_expected_one() {
    let document = document(&Folder::new(), "store");
    assert_eq!(keys(&document), ["matrix", "rows", "unexpected", "provenance"]);
    assert_eq!(document["matrix"], "full");
    assert_eq!(document["unexpected"], Value::Array(Vec::new()));
    let rows = document["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), 6);
    for row in rows {
        assert_eq!(
            keys(row),
            [
                "name",
                "study",
                "refined",
                "quantity",
                "formal_order",
                "tolerance",
                "theory",
                "levels",
                "observed_order",
                "error_constant",
                "expected_error_constant",
                "verdict",
                "expected_verdict",
                "reason",
                "seconds",
            ]
        );
        assert_eq!(row["verdict"], row["expected_verdict"]);
        assert_eq!(row["reason"], Value::Null);
    }
    let leapfrog = &rows.iter().find(|row| row["name"] == "startup/accelerated").expect("the row");
    let order = leapfrog["observed_order"].as_f64().expect("an order");
    assert!((order - 2.0).abs() < 0.02, "{order}");
    assert_eq!(
        keys(&leapfrog["levels"][0]),
        [
            "cells",
            "cell_size",
            "time_step",
            "steps",
            "particles",
            "l1",
            "l2",
            "linf",
            "order_l1",
            "order_l2",
            "order_linf",
            "seconds",
            "failure",
        ]
    );
}

/// A level equals the result of its command.
#[test]
fn a_level_is_that_of_the_study_that_the_row_names() {
    let folder = Folder::new();
    let verified = folder.mms("verify --json --row startup/accelerated").exits(0).json();
    let row = &verified["rows"][0];
    let study = format!("study {} --json", row["study"].as_str().expect("arguments"));
    let study = folder.mms(&study).exits(0).json();
    for (level, same) in
        row["levels"].as_array().unwrap().iter().zip(study["levels"].as_array().unwrap())
    {
        // A study has more keys for a level.
        for (key, value) in timeless(level).as_object().expect("an object") {
            assert_eq!(*value, same[key], "{key}");
        }
    }
}

#[test]
fn without_a_terminal_there_is_a_line_per_run_and_results_come_from_the_store_the_next_time() {
    let folder = Folder::new();
    let first = folder.mms("verify --row time/usl --threads 1000000000").exits(0);
    first.complains("5 of 5 runs").complains("mms run uniform_stretch");
    first.prints("\nthe verdict is as theory expects");
    assert_eq!(results(&folder.path("target/mms/verify")).len(), 5);
    let second = folder.mms("verify --row time/usl").exits(0);
    assert_eq!(second.stderr, "", "nothing was run");
    assert_eq!(second.stdout, first.stdout);
}

/// The program for users has no deliberate mistakes; the message says how to build a program that has them.
#[cfg(not(feature = "defects"))]
#[test]
fn defects_take_a_build_of_their_own() {
    let folder = Folder::new();
    for arguments in ["verify --defects", "verify --defects=force_sign --all-rows --quick"] {
        let run = folder.mms(arguments).exits(2);
        run.complains("`cargo run --release --features defects -- verify --defects`");
        assert_eq!(run.stdout, "");
    }
    assert!(!folder.path("target").exists(), "nothing is run or stored");
    let program = fs::read(env!("CARGO_BIN_EXE_mms")).expect("the program");
    let (program, what) = (String::from_utf8_lossy(&program), "before dt a_i is added");
    assert!(!program.contains(what), "the program contains the description of a defect");
    let list = include_str!("../../mms-runtime/src/defect.rs");
    assert!(list.contains(what), "no defect has this description any more");
    folder.mms("verify --all-rows").exits(2).complains("--defects");
}

/// `.ci/run` builds a program with some defects.
#[cfg(feature = "defects")]
#[test]
fn a_defect_is_caught_and_nothing_of_it_is_trusted() {
    let folder = Folder::new();
    let shown =
        "verify --defects=force_late,flip_fraction --row time/force_level --row transfer/flip_part";
    let run = folder.mms(&format!("{shown} --store store --json --output out")).exits(0);
    run.complains("2 of 2 defects");
    let document = run.json();
    assert_eq!(
        keys(&document),
        ["rows", "every_row", "defects", "uncaught", "missed", "idle", "provenance"]
    );
    let late = &document["defects"][0];
    assert_eq!(keys(late), ["name", "place", "what", "rows", "pseudo"]);
    assert_eq!(late["rows"][0]["name"], "time/force_level");
    assert_eq!(late["rows"][0]["caught"], true);
    // A run that is half as accurate as it should be looks as plausible.
    assert_eq!(late["pseudo"]["bounded"], false);
    assert_eq!(folder.read("out/defects.json").trim_end(), run.stdout.trim_end());
    folder.mms("report out").exits(0).prints("all 2 verdicts are as expected");

    assert!(results(&folder.path("store")).is_empty());
    let kept = results(&folder.path("store/defects"));
    assert!(!kept.is_empty());
    let again = folder.mms(&format!("{shown} --store store --json")).exits(0).json();
    assert_eq!(timeless(&again), timeless(&document));
    assert_eq!(results(&folder.path("store/defects")), kept);
    folder.mms("verify --quick --row time/force_level --store store").exits(0);

    let unseen = "verify --defects=flip_fraction --row statics/column --store store";
    folder.mms(unseen).exits(1).prints("flip_fraction is not caught");
    folder.mms("verify --defects=force_lat").exits(2).complains("did you mean `force_late`?");
    folder.mms("verify --defects --row particles/jitter").exits(2).complains("none of these rows");
}

#[test]
fn rows_are_listed_and_found_by_name_or_group() {
    let folder = Folder::new();
    let list = folder.mms("verify --list --row time").exits(0);
    list.prints("time/leapfrog: order 2; ").prints("mms study uniform_stretch");
    assert!(!list.stdout.contains("boundary/"));
    let json = folder.mms("verify --list --json").exits(0).json();
    assert!(json["rows"].as_array().is_some_and(|rows| rows.len() > 60));
    folder
        .mms("verify --row boundary/rollers")
        .exits(2)
        .complains("did you mean `boundary/roller`?");
    folder.mms("verify --row 12").exits(2).complains("`mms verify --list` lists them");
    folder.mms("verify --quick --row particles/jitter").exits(2).complains("leaves out all");
}

#[test]
fn a_store_that_cannot_be_is_bad_input() {
    let folder = Folder::new();
    folder.write("file", "");
    folder
        .mms("verify --row time/usl --store file")
        .exits(2)
        .complains("cannot make the folder `file`");
}

/// A process that computes the rows.
fn start(folder: &Folder) -> Child {
    Command::new(env!("CARGO_BIN_EXE_mms"))
        .args(["verify", "--json", "--store", "store", "--threads", "2"])
        .args(ROWS.split(' '))
        .current_dir(folder.path(""))
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts")
}

/// After a kill at any moment, stored results are whole, and the same command continues from them.
#[test]
fn killed_again_and_again_it_ends_with_the_same_numbers() {
    let undisturbed = timeless(&document(&Folder::new(), "store"));
    let mut random = 1_u64;
    for _ in 0..sampled_count(10, 5) {
        let folder = Folder::new();
        for _ in 0..10 {
            random = random.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            let mut process = start(&folder);
            std::thread::sleep(Duration::from_micros(random >> 48));
            process.kill().expect("it was started");
            process.wait().expect("it was killed");
        }
        let last = folder.mms(&format!("verify --json --store store {ROWS}")).exits(0);
        assert!(!last.stderr.contains("not trusted"), "{last}");
        assert_eq!(timeless(&last.json()), undisturbed);
    }
}

/// Two processes share the runs, and both have all results.
#[test]
fn two_processes_share_a_store() {
    let folder = Folder::new();
    let both = [start(&folder), start(&folder)].map(|process| {
        let output = process.wait_with_output().expect("it ends");
        assert_eq!(output.status.code(), Some(0));
        serde_json::from_slice::<Value>(&output.stdout).expect("a document")
    });
    assert_eq!(both[0], both[1], "times included");
    assert_eq!(both[0]["rows"], document(&folder, "store")["rows"]);
}

/// Truncated, changed and exchanged files are named, kept, and computed again.
#[test]
fn files_that_are_not_what_they_were_are_set_aside_and_computed_again() {
    let folder = Folder::new();
    let undisturbed = timeless(&document(&folder, "store"));
    let results = results(&folder.path("store"));
    let whole = results.iter().map(|path| fs::read(path).expect("a result")).collect::<Vec<_>>();
    fs::write(&results[0], &whole[0][..whole[0].len() - 20]).expect("written");
    let changed = String::from_utf8_lossy(&whole[1]).replace("\"steps\":", "\"steps\":1");
    fs::write(&results[1], changed).expect("written");
    fs::write(&results[2], &whole[3]).expect("written");
    fs::write(folder.path("store/other.json"), "{}").expect("written");
    let again = folder.mms(&format!("verify --json --store store {ROWS}")).exits(0);
    assert_eq!(timeless(&again.json()), undisturbed);
    for path in [&results[0], &results[1], &results[2]].map(|path| path.file_name().unwrap()) {
        again.complains(&format!("store/{}` is not trusted", path.to_string_lossy()));
        assert!(folder.path("store").join(path).with_extension("json.aside1").exists());
    }
    again.complains("store/other.json` is not trusted");
    assert_eq!(again.stderr.matches("done").count(), 3, "{again}");
}
