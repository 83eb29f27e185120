//! What is generated from the 1D bar, as text to review: a change of it is seen in a difference.
//!
//! After a deliberate change, `INSTA_UPDATE=always cargo test --test snapshots` writes the files in
//! `snapshots/` anew; read the difference before it is committed.

use std::process::Command;

use mms_codegen::{Compiled, compile, emit};

fn bar() -> Compiled {
    let entry = mms::gallery::find("bar_1d").expect("the bar is in the gallery");
    let load = |path: &str| Err(format!("{path}: not in the gallery"));
    compile(entry.name, entry.path, entry.text, &load).expect("the gallery compiles")
}

#[test]
fn the_generated_rust_of_the_bar_is_as_reviewed() {
    insta::assert_snapshot!("bar_1d_rust", emit::rust::text(&bar()));
}

#[test]
fn the_program_of_the_bar_is_as_reviewed() {
    insta::assert_snapshot!("bar_1d_program", bar().program);
}

#[test]
fn the_derivation_that_show_prints_is_as_reviewed() {
    let show = Command::new(env!("CARGO_BIN_EXE_mms"))
        .args(["show", "bar_1d"])
        .output()
        .expect("the program starts");
    let text = String::from_utf8(show.stdout).expect("UTF-8");
    insta::assert_snapshot!("bar_1d_show", text);
}
