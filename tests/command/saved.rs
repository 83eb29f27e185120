//! `mms study --study FILE`: a saved scene.

use std::io::Write as _;
use std::process::{Command, Stdio};

use serde_json::Value;

use super::mms::Folder;

const SCENE: &str = "field = \"bar_1d\"\nformulation = \"total\"\nshape = \"linear\"\n\
                     cells = [8, 16]\ncourant = 0.2\nset = { young = 1e3, length = 2 }\n\
                     jitter = 0.0\njson = true\n";

#[test]
fn a_saved_scene_is_the_command_with_its_options() {
    let folder = Folder::new();
    folder.write("scene.toml", SCENE);
    let strip = |command: &str| {
        let mut document = folder.mms(command).exits(0).json();
        for level in document["levels"].as_array_mut().expect("levels") {
            level["seconds"].take();
        }
        // The same options and settings in another order.
        document["provenance"].take();
        document
    };
    let saved = strip("study --study scene.toml");
    let options = "--formulation total --shape linear --courant 0.2 --set young=1e3 --set length=2";
    assert_eq!(saved, strip(&format!("study bar_1d --cells 8,16 {options} --json")));
    assert_eq!(saved, strip("study --study=scene.toml"));
    // The command line goes first, in any order of options.
    for command in
        ["study --cells 16,32 --study scene.toml", "study --study scene.toml --cells=16,32"]
    {
        assert_eq!(strip(command)["levels"][0]["cells"], 16);
    }
}

/// A pipe can be read once.
#[test]
#[cfg(unix)]
fn a_scene_from_a_pipe_stands_in_the_recorded_command() {
    let mut program = Command::new(env!("CARGO_BIN_EXE_mms"));
    let folder = Folder::new();
    let program = program.args(["study", "--study", "/dev/stdin"]).current_dir(folder.path("."));
    let mut program =
        program.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("a start");
    let mut stdin = program.stdin.take().expect("a pipe");
    stdin.write_all(SCENE.as_bytes()).expect("a reader");
    drop(stdin);
    let output = program.wait_with_output().expect("an end");
    let document: Value = serde_json::from_slice(&output.stdout).expect("a document");
    let command = document["provenance"]["command"].as_str().expect("a command");
    for word in ["bar_1d", "--formulation=total", "--set=young=1e3"] {
        assert!(command.contains(word), "`{word}` is missing: {command}");
    }
}

#[test]
fn mistakes_of_a_study_file_are_named_at_their_places() {
    let cases = [
        ("feild = \"bar_1d\"", "scene.toml:1:1", "did you mean `field`?"),
        ("field = \"bar_1d\"\ncells = { a = 1 }", "scene.toml:2:9", "expected a number, or a word"),
        ("field = \"bar_1d\"\nset = 3", "scene.toml:2:7", "expected a table"),
        ("field = 1", "scene.toml:1:9", "the name of a field"),
        ("study = \"other.toml\"", "scene.toml:1:1", "no option of a study"),
        ("field = \"bar_1d\"\nshape = ", "scene.toml:2", "mistakes"),
        ("jitter = 0.1\ncells = [8, \"x\"]", "scene.toml:2:9", "expected a number from 1"),
        ("field = \"bar_1d\"\njitter = -1", "scene.toml:2:10", "expected a number from 0 to 1"),
        ("field = \"bar_1d\"\nprecision = \"f16\"", "scene.toml:2:13", "possible values: f32, f64"),
        ("field = \"bar_1d\"\nshape = \"cpgmp\"", "scene.toml:2:9", "known are: linear"),
        ("field = \"bar_1d\"\njson = 3", "scene.toml:2:8", "unexpected value '3'"),
    ];
    for (text, place, message) in cases {
        let folder = Folder::new();
        folder.write("scene.toml", text);
        let run = folder.mms("study --study scene.toml").exits(2);
        run.complains(place).complains(message).prints_nothing();
    }
}

/// Also for options that exclude or override options of the file.
#[test]
fn the_command_line_goes_first() {
    let folder = Folder::new();
    let scene = "field = \"bar_1d\"\ncells = [8, 16]\ntime_step = 1e-4\njson = true\noutput = \"a\"\n\
                 set = { young = 1e3, length = 2 }\n";
    folder.write("scene.toml", scene);
    let own = "study --study scene.toml --courant 0.25 --set young=2e3 --set=amplitude=0.1 -o b";
    let found = folder.mms(own).exits(0).json();
    let command = "study bar_1d --cells 8,16 --json --courant 0.25 --set young=2e3 --set length=2 --set amplitude=0.1";
    let expected = folder.mms(command).exits(0).json();
    for key in ["method", "levels"] {
        let strip = |document: &serde_json::Value| {
            let mut part = document[key].clone();
            for level in part.as_array_mut().into_iter().flatten() {
                level["seconds"].take();
            }
            part
        };
        assert_eq!(strip(&found), strip(&expected), "{key}");
    }
    assert!(folder.path("b/convergence.json").is_file() && !folder.path("a").exists());
}

#[test]
fn a_study_file_that_is_not_there_or_lacks_a_field_exits_2() {
    let folder = Folder::new();
    folder.mms("study --study none.toml").exits(2).complains("cannot read `none.toml`");
    folder.mms("study --study").exits(2).complains("expected the path");
    folder.write("scene.toml", "cells = [8, 16]\n");
    folder.mms("study --study scene.toml").exits(2).complains("<FIELD>");
    folder.mms("study bar_1d --study scene.toml").exits(0);
    folder.write("scene.toml", "cells = [8, \"x\"]\n");
    folder.mms("study bar_1d --study scene.toml").exits(2).complains("scene.toml:1:9");
}
