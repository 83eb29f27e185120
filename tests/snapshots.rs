//! Generated code and text of the 1D bar, for review: a change shows as a difference.
//!
//! After a deliberate change, `INSTA_UPDATE=always cargo test --test suite snapshots` writes the files in
//! `snapshots/` anew; read the difference before it is committed.

use std::process::Command;

use mms_codegen::{Compiled, compile};

fn bar() -> Compiled {
    let entry = mms_exact::gallery::find("bar_1d").expect("the bar is in the gallery");
    let load = |path: &str| Err(format!("{path}: not in the gallery"));
    compile(entry.name, entry.path, entry.text, &load).expect("the gallery compiles")
}

#[test]
fn the_generated_rust_of_the_bar_is_as_reviewed() {
    insta::assert_snapshot!("bar_1d_rust", mms_codegen::rust::text(&bar()));
}

#[test]
fn the_program_of_the_bar_is_as_reviewed() {
    insta::assert_snapshot!("bar_1d_program", bar().program);
}

/// The output of `mms show bar_1d` with one more argument.
fn shown(argument: &str) -> String {
    let show = Command::new(env!("CARGO_BIN_EXE_mms"))
        .args(["show", "bar_1d", argument])
        .output()
        .expect("the program starts");
    assert!(show.status.success(), "{}", String::from_utf8_lossy(&show.stderr));
    String::from_utf8(show.stdout).expect("UTF-8")
}

#[test]
fn the_derivation_as_text_is_as_reviewed() {
    insta::assert_snapshot!("bar_1d_show", shown("--format=text"));
}

#[test]
fn the_derivation_as_latex_is_as_reviewed() {
    insta::assert_snapshot!("bar_1d_show_latex", shown("--format=latex"));
}

#[test]
fn the_derivation_as_mathml_is_as_reviewed() {
    insta::assert_snapshot!("bar_1d_show_mathml", shown("--format=mathml"));
}
