//! Runs that are killed, interrupted or cannot write, and continue.

use std::fs;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value;

use super::sampled::sampled_count;
use crate::mms::Folder;

/// A run of some hundred steps that writes everything except checkpoints.
const RUN: &str = "run bar_1d --cells 64 --history run.csv --vtk states --frames 5 --json";

/// The options for checkpoints.
const KEEPING: &str = "--checkpoint run.checkpoint --every 20";

/// A document without timings and without its command.
fn timeless(mut document: Value) -> Value {
    let run = document.as_object_mut().expect("an object");
    for key in ["seconds", "ns_per_particle_step", "provenance"] {
        run.remove(key).expect(key);
    }
    document
}

/// The files that a run writes, byte by byte: the history, the list of states, and the states.
fn written(folder: &Folder) -> Vec<(String, String)> {
    let mut names = vec!["run.csv".to_owned()];
    let states = fs::read_dir(folder.path("states")).expect("a folder");
    let name = |entry: std::io::Result<fs::DirEntry>| {
        format!("states/{}", entry.expect("an entry").file_name().to_string_lossy())
    };
    names.extend(states.map(name));
    names.sort();
    names.into_iter().map(|name| (name.clone(), folder.read(&name))).collect()
}

/// The results of an undisturbed run.
fn undisturbed() -> (Value, Vec<(String, String)>) {
    let folder = Folder::new();
    let document = timeless(folder.mms(RUN).exits(0).json());
    (document, written(&folder))
}

/// The arguments of the run, which continues if there is a checkpoint.
fn arguments(folder: &Folder) -> String {
    let resume =
        if folder.path("run.checkpoint").exists() { "--resume run.checkpoint" } else { "" };
    format!("{RUN} {KEEPING} {resume}")
}

fn spawn(folder: &Folder, arguments: &str) -> Child {
    Command::new(env!("CARGO_BIN_EXE_mms"))
        .args(arguments.split_whitespace())
        .current_dir(folder.path(""))
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts")
}

/// The run is killed at a hundred random instants.
#[test]
fn killed_again_and_again_it_ends_with_the_same_bytes() {
    let start_of_one = Instant::now();
    let (document, files) = undisturbed();
    let whole = start_of_one.elapsed();
    let (mut kills, mut resumed, mut random) = (0, 0, 1_u64);
    while kills < sampled_count(100, 4) {
        let folder = Folder::new();
        // Each attempt is shorter than the whole run, so that the run takes several.
        for _ in 0..8 {
            random = random.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            resumed += usize::from(folder.path("run.checkpoint").exists());
            let mut process = spawn(&folder, &arguments(&folder));
            let part = f64::from((random >> 48) as u16) / f64::from(u16::MAX);
            std::thread::sleep(Duration::from_secs_f64(whole.as_secs_f64() * part));
            process.kill().expect("it was started");
            process.wait().expect("it was killed");
            kills += 1;
        }
        let last = folder.mms(&arguments(&folder)).exits(0);
        assert_eq!(timeless(last.json()), document);
        assert_eq!(written(&folder), files);
        // No other file exists: files that were half written are gone.
        let mut left = fs::read_dir(folder.path("")).expect("a folder");
        let is_ours = |name: &str| ["run.csv", "states", "run.checkpoint"].contains(&name);
        assert!(left.all(|it| is_ours(&it.expect("an entry").file_name().to_string_lossy())));
    }
    assert!(10 * resumed > kills, "{resumed} of {kills} went on from a checkpoint");
}

/// Runs a command until it has written a state, then types Ctrl-C. Returns its message and the step of the checkpoint.
#[cfg(unix)]
fn interrupt(folder: &Folder, arguments: &str, state: &str) -> (String, u64) {
    let process = spawn(folder, arguments);
    while !folder.path(state).exists() {
        std::thread::sleep(Duration::from_millis(1));
    }
    let signal = Command::new("kill").args(["-INT", &process.id().to_string()]).status();
    assert!(signal.expect("a signal").success());
    let output = process.wait_with_output().expect("it ends");
    let said = String::from_utf8(output.stderr).expect("a text");
    assert_eq!(output.status.code(), Some(3), "{said}");
    let kept = fs::read(folder.path("kept")).expect("a checkpoint");
    let line = kept.split(|&byte| byte == b'\n').next().expect("a line");
    let head: Value = serde_json::from_slice(line).expect("JSON");
    (said, head["step"].as_u64().expect("a number"))
}

/// After Ctrl-C in a run that would take hours, the message names the command that continues it.
#[test]
#[cfg(unix)]
fn an_interrupted_run_says_how_to_go_on() {
    let folder = Folder::new();
    let run =
        "run bar_1d --cells 16 --courant 1e-6 --vtk states --frames 1000000 --checkpoint kept";
    let (said, first) = interrupt(&folder, run, "states/bar_1d_0001.vtu");
    assert!(said.contains("interrupted"), "{said}");
    let command = said.split('`').nth(1).expect("a command");
    assert_eq!(command, format!("mms {run} --resume kept"), "{said}");
    let later = format!("states/bar_1d_{:04}.vtu", first / 16 + 10);
    let again = command.strip_prefix("mms ").expect("the program");
    let (said, second) = interrupt(&folder, again, &later);
    assert!(second > first, "{first}, then {second}");
    assert!(said.contains(&format!("`{command}`")), "the same command goes on: {said}");
}

/// A checkpoint from the middle of a short run.
fn kept(folder: &Folder) -> Vec<u8> {
    folder.mms("run bar_1d --cells 8 --checkpoint kept --every 7").exits(0);
    fs::read(folder.path("kept")).expect("a checkpoint")
}

#[test]
fn a_damaged_checkpoint_is_refused_and_stays_as_it_is() {
    let folder = Folder::new();
    let whole = kept(&folder);
    let mut damaged: Vec<(Vec<u8>, &str)> = Vec::new();
    for part in 0..12 {
        damaged.push((whole[..whole.len() * part / 12].to_vec(), "no whole checkpoint"));
        let mut changed = whole.clone();
        changed[whole.len() * part / 12] ^= 1 << (part % 8);
        damaged.push((changed, "its checksum does not fit its content"));
    }
    damaged.push((b"step,time\n1,0.1\n".to_vec(), "no whole checkpoint"));
    for (content, complaint) in damaged {
        fs::write(folder.path("kept"), &content).expect("written");
        folder.mms("run bar_1d --cells 8 --resume kept").exits(2).complains(complaint);
        assert_eq!(fs::read(folder.path("kept")).expect("still there"), content);
    }
}

#[test]
fn a_checkpoint_of_another_run_is_refused_by_the_command_that_wrote_it() {
    let folder = Folder::new();
    kept(&folder);
    for other in [
        "run bar_1d --cells 9",
        "run bar_1d --cells 8 --courant 0.3",
        "run bar_1d --cells 8 --precision f32",
        "run bar_1d --cells 8 --form fast",
        "run bar_1d --cells 8 --set young=2e6",
        "run periodic_bar --cells 8",
    ] {
        folder
            .mms(&format!("{other} --resume kept"))
            .exits(2)
            .complains("`mms run bar_1d --cells 8 --checkpoint kept --every 7`");
    }
    // Neither the threads nor the outputs belong to the identity of a run.
    folder.mms("run bar_1d --cells 8 --resume kept --threads 2 --output out").exits(0);
    folder.mms("run bar_1d --cells 8 --resume missing").exits(2).complains("missing");
    folder.mms("run bar_1d --cells 8 --every 3").exits(2);
}

/// Runs in single precision continue, too.
#[test]
fn a_run_in_single_precision_goes_on_to_the_bit() {
    let folder = Folder::new();
    let run = "run bar_1d --cells 8 --precision f32 --json";
    let whole = folder.mms(&format!("{run} --checkpoint kept --every 7")).exits(0).json();
    let rest = folder.mms(&format!("{run} --resume kept")).exits(0).json();
    assert_eq!(timeless(rest), timeless(whole));
}

/// The refusal comes before any work is done.
#[test]
fn what_cannot_be_written_is_refused_at_once() {
    let folder = Folder::new();
    folder.write("file", "");
    for option in ["--checkpoint file/kept", "--history file/run.csv"] {
        folder.mms(&format!("run bar_1d --cells 8 {option}")).exits(2).complains(option);
    }
    folder.mms("run bar_1d --cells 8 --checkpoint .").exits(2).complains("it is a folder");
    let wrong = "run bar_1d --cells 8 --resume kept --history file";
    kept(&folder);
    folder.mms(wrong).exits(2).complains("does not hold the");
    assert_eq!(folder.read("file"), "", "left as it was");
}

/// Rows after the checkpoint are written anew; rows before it record what the run did, and must not change.
#[test]
fn a_history_that_was_changed_before_the_checkpoint_is_refused() {
    let folder = Folder::new();
    let run = "run bar_1d --cells 8 --history run.csv";
    folder.mms(&format!("{run} --checkpoint kept --every 7")).exits(0);
    let whole = folder.read("run.csv");
    let resumed = format!("{run} --resume kept");
    let lines: Vec<&str> = whole.lines().collect();
    let with = |at: usize, line: &str| {
        let mut lines = lines.clone();
        lines[at] = line;
        lines.join("\n") + "\n"
    };
    let digit = lines[20].replacen('1', "2", 1);
    for changed in [with(20, &digit), with(0, "time,step"), whole.replacen("\n2,", "\n02,", 1)] {
        assert_ne!(changed, whole);
        folder.write("run.csv", &changed);
        let said = "`--history run.csv`: its rows up to step 35 are not those that were written";
        folder.mms(&resumed).exits(2).complains(said);
        assert_eq!(folder.read("run.csv"), changed, "left as it was");
    }
    folder.write("run.csv", &lines[..20].join("\n"));
    folder.mms(&resumed).exits(2).complains("does not hold the 35 steps before the checkpoint");
    for kept in [whole.clone(), with(39, "rubbish"), lines[..36].join("\n") + "\n"] {
        folder.write("run.csv", &kept);
        folder.mms(&resumed).exits(0);
        assert_eq!(folder.read("run.csv"), whole);
    }
}

/// A checkpoint of another version is not reported as damaged.
#[test]
fn an_older_checkpoint_is_refused_by_its_format() {
    let folder = Folder::new();
    let whole = kept(&folder);
    let end = whole.len() - 4;
    let at = whole.windows(16).position(|it| it == b"mms checkpoint 2").expect("its format");
    let mut older = whole[..end].to_vec();
    older[at + 15] = b'1';
    let sum = crc32fast::hash(&older);
    older.extend(sum.to_le_bytes());
    fs::write(folder.path("kept"), &older).expect("written");
    let said = "its format is `mms checkpoint 1`, and this version reads `mms checkpoint 2`";
    folder.mms("run bar_1d --cells 8 --resume kept").exits(2).complains(said);
}

/// A list of only the states after the checkpoint would look like a list of the whole run.
#[test]
fn states_go_on_only_where_those_before_are() {
    let folder = Folder::new();
    kept(&folder);
    let resumed = "run bar_1d --cells 8 --resume kept --vtk";
    let lacks = "does not hold the states before the checkpoint";
    folder.mms(&format!("{resumed} states")).exits(2).complains(lacks);
    assert!(!folder.path("states").exists());
    folder.mms("run bar_1d --cells 8 --checkpoint kept --every 7 --vtk states").exits(0);
    folder.mms(&format!("{resumed} others")).exits(2).complains(lacks);
    let list = folder.read("states/bar_1d.pvd");
    folder.mms(&format!("{resumed} states")).exits(0);
    assert_eq!(folder.read("states/bar_1d.pvd"), list);
}

/// As on a full disk: the run names the file that it could not write, and the last checkpoint stays.
#[test]
#[cfg(unix)]
fn a_disk_that_fills_up_loses_nothing() {
    let folder = Folder::new();
    let before = kept(&folder);
    let limited = |arguments: &str| {
        let script = format!(
            "trap '' XFSZ; ulimit -f 1; exec {} run bar_1d {arguments}",
            env!("CARGO_BIN_EXE_mms")
        );
        let output = Command::new("sh")
            .args(["-c", &script])
            .current_dir(folder.path(""))
            .output()
            .expect("a shell");
        (output.status.code(), String::from_utf8(output.stderr).expect("a text"))
    };
    let (code, said) = limited("--cells 64 --checkpoint kept --every 7");
    assert_eq!(code, Some(3), "{said}");
    assert!(said.contains("cannot write `kept`"), "{said}");
    assert_eq!(fs::read(folder.path("kept")).expect("the one before"), before);
    let (code, said) = limited("--cells 64 --history run.csv");
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("cannot write `run.csv`"), "{said}");
    let names: Vec<_> = fs::read_dir(folder.path(""))
        .expect("a folder")
        .map(|entry| entry.expect("an entry").file_name().into_string().expect("a name"))
        .collect();
    assert!(names.iter().all(|name| name == "kept" || name == "run.csv"), "{names:?}");
}

/// The history has one row per step; the last one has the numbers that the run itself reports.
#[test]
fn the_history_closes_with_the_numbers_of_the_run() {
    let folder = Folder::new();
    let run = folder.mms("run bar_1d --cells 16 --history run.csv --json").exits(0).json();
    let text = folder.read("run.csv");
    let mut rows = csv::Reader::from_reader(text.as_bytes());
    let names = rows.headers().expect("names").clone();
    let rows: Vec<_> = rows.records().map(|row| row.expect("a row")).collect();
    assert_eq!(rows.len() as u64, run["steps"].as_u64().expect("a number"));
    let last = |name: &str| -> f64 {
        let column = names.iter().position(|it| it == name).expect(name);
        rows.last().expect("a step")[column].parse().expect("a number")
    };
    let balance = &run["diagnostics"]["balance"];
    for (name, value) in [
        ("displacement_l2", &run["errors"]["displacement"]["at_end"]["l2"]),
        ("mass", &run["diagnostics"]["mass"]),
        ("momentum_x", &run["diagnostics"]["momentum"][0]),
        ("jacobian_least", &run["diagnostics"]["jacobian"][0]),
        ("time_of_energies", &balance["time"]),
        ("kinetic_energy", &balance["kinetic_energy"]),
        ("strain_energy", &balance["strain_energy"]),
        ("body_work", &balance["body_work"]),
        ("energy_residual", &balance["energy_residual"]),
        ("surface_force_x", &balance["surface_force"][0]),
    ] {
        assert_eq!(Some(last(name)), value.as_f64(), "{name}");
    }
}
