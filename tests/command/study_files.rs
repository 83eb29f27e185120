//! `mms study`: the files that it writes.

use serde_json::Value;

use super::mms::{Folder, Run};

const SMALL: &str = "study bar_1d --cells 4,8,16";
const DYING: &str = "study bar_1d --cells 8,32 --courant 0.8";

fn written(folder: &Folder, extension: &str) -> String {
    folder.read(&format!("target/mms/bar_1d/convergence.{extension}"))
}

#[test]
fn the_json_file_is_the_document_on_stdout() {
    let folder = Folder::new();
    for command in [SMALL, DYING] {
        let run = folder.mms(&format!("{command} --json"));
        let file: Value = serde_json::from_str(&written(&folder, "json")).expect("JSON");
        assert_eq!(file, run.json());
    }
}

#[test]
fn the_rows_of_the_csv_file_are_the_levels_of_the_document() {
    let folder = Folder::new();
    for command in [SMALL, DYING] {
        let document = folder.mms(&format!("{command} --json")).json();
        let text = written(&folder, "csv");
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let names = reader.headers().expect("a header").clone();
        let levels = document["levels"].as_array().expect("levels");
        let rows: Vec<_> = reader.records().map(|row| row.expect("a row")).collect();
        assert_eq!(rows.len(), levels.len());
        for (row, level) in rows.iter().zip(levels) {
            assert_eq!(names.len(), level.as_object().expect("an object").len());
            for (name, cell) in names.iter().zip(row) {
                assert_same(cell, &level[name]);
            }
        }
    }
}

/// Asserts that a cell of a CSV file is a member of a JSON document.
fn assert_same(cell: &str, value: &Value) {
    match value {
        Value::Null => assert_eq!(cell, ""),
        Value::Number(number) => assert_eq!(cell.parse().ok(), number.as_f64()),
        Value::String(text) => assert_eq!(cell, text),
        other => panic!("{other} in a level"),
    }
}

#[test]
fn the_picture_is_xml_with_the_norms_and_the_expected_slope() {
    let folder = Folder::new();
    for (command, slope) in [(SMALL, "2"), (DYING, "stopped")] {
        folder.mms(command);
        let svg = written(&folder, "svg");
        let document = roxmltree::Document::parse(&svg).expect("XML");
        assert_eq!(document.root_element().tag_name().name(), "svg");
        let texts = document.descendants().filter_map(|node| node.text());
        let texts: Vec<_> = texts.map(str::trim).collect();
        for label in ["l1", "l2", "linf", slope, "cell size h (m)"] {
            // The legend adds the observed order to the name of a norm.
            let is_it =
                |text: &&str| *text == label || text.starts_with(&format!("{label}, order "));
            assert!(texts.iter().any(is_it), "{command}: `{label}` is not among {texts:?}");
        }
    }
}

#[test]
fn the_picture_of_a_study_without_errors_is_xml_all_the_same() {
    let folder = Folder::new();
    folder.mms("study bar_1d --cells 8,16 --courant 3").exits(1);
    let svg = written(&folder, "svg");
    let document = roxmltree::Document::parse(&svg).expect("XML");
    let texts = document.descendants().filter_map(|node| node.text());
    assert!(texts.map(str::trim).all(|text| !text.starts_with("slope")), "{svg}");
}

#[test]
fn the_folder_may_be_chosen_and_is_named_at_the_end() {
    let folder = Folder::new();
    let run = folder.mms(&format!("{SMALL} --output some/where")).exits(0);
    for extension in ["svg", "csv", "json"] {
        let path = format!("some/where/convergence.{extension}");
        run.prints(&path);
        assert!(!folder.read(&path).is_empty(), "{path}");
    }
    assert!(!folder.path("target").exists(), "nothing is written elsewhere");
}

#[test]
fn a_folder_that_cannot_be_made_exits_2() {
    let folder = Folder::new();
    folder.write("file", "");
    let run: Run = folder.mms(&format!("{SMALL} --output file/below")).exits(2);
    run.complains("cannot make the folder `file/below`");
}

#[cfg(unix)]
#[test]
fn others_may_read_the_files_that_a_folder_lets_them_read() {
    use std::os::unix::fs::PermissionsExt as _;
    let folder = Folder::new();
    folder.mms(SMALL).exits(0);
    folder.write("plain", "");
    let mode = |name: &str| folder.path(name).metadata().expect("a file").permissions().mode();
    for extension in ["svg", "csv", "json"] {
        let name = format!("target/mms/bar_1d/convergence.{extension}");
        assert_eq!(mode(&name), mode("plain"), "{name}");
    }
}

/// Results of the same field and command are replaced without a word; others are named.
#[test]
fn results_of_another_field_or_command_are_not_replaced_without_a_word() {
    let folder = Folder::new();
    let run = |command: &str| folder.mms(&format!("{command} --output out")).exits(0);
    run("study bar_1d --cells 8,16");
    let again = run("study bar_1d --cells 16,32");
    assert!(!again.stderr.contains("is replaced"), "{again}");
    let other = run("study periodic_bar --cells 16,32,64");
    other
        .complains("`out/convergence.json` held results of `mms study` of bar_1d, and is replaced");
    folder.write("errors.csv", "h,l2\n0.1,1e-2\n0.05,2.5e-3\n0.025,6.25e-4\n");
    let judged = run("judge --errors errors.csv");
    judged.complains("held results of `mms study` of periodic_bar, and is replaced");
}
