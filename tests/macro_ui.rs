//! The macro as a crate meets it that uses it: each program in `ui/pass` compiles and runs, and each
//! in `ui/fail` is refused with the text in its `.stderr`.
//!
//! After a deliberate change, `TRYBUILD=overwrite cargo test --test macro_ui` writes the `.stderr`
//! files anew; read the difference before it is committed.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What the programs need beside them: the macro finds a file relative to the manifest of the crate
/// that uses it, which is one that `trybuild` writes.
const INPUTS: [&str; 6] = [
    "fields",
    "examples/fields",
    "tests/ui/pass",
    "tests/ui/pass/materials",
    "tests/ui/fail",
    "tests/ui/fail/materials",
];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The files of a folder with one extension, in the order of their names.
fn files(folder: &str, extension: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(root().join(folder)).expect("a folder");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let mut files: Vec<_> =
        paths.filter(|path| path.extension().is_some_and(|found| found == extension)).collect();
    files.sort();
    files
}

/// The folder of the manifest of the crate that `trybuild` writes.
fn manifest() -> PathBuf {
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).parent().expect("the target folder");
    target.join("tests/trybuild").join(env!("CARGO_PKG_NAME"))
}

/// Copies the field files to where they are looked for.
fn copy_inputs() {
    let manifest = manifest();
    for folder in INPUTS {
        let _ = fs::remove_dir_all(manifest.join(folder));
        fs::create_dir_all(manifest.join(folder)).expect("a folder");
        for file in files(folder, "toml") {
            let name = file.file_name().expect("a name");
            fs::copy(&file, manifest.join(folder).join(name)).expect("a copy");
        }
    }
}

/// Emits the files that `ui/pass/emitted.rs` includes, as a user does.
fn emit_files() {
    let folder = manifest().join("emitted");
    let _ = fs::remove_dir_all(&folder);
    let emit = |field: &str, to: &str, options: &[&str]| {
        let to = folder.join(to);
        let output = ["emit", field, "--target", "rust", "-o"].map(OsStr::new);
        let emit = Command::new(env!("CARGO_BIN_EXE_mms"))
            .args(output.into_iter().chain([to.as_os_str()]))
            .args(options)
            .current_dir(root())
            .output()
            .expect("the program starts");
        assert!(emit.status.success(), "{}", String::from_utf8_lossy(&emit.stderr));
    };
    emit("bar_1d", "all", &[]);
    emit("tests/ui/pass/odd_names.toml", "all", &[]);
    emit("tests/ui/pass/plain.toml", "all", &[]);
    let part = ["--quantity", "body_force,velocity", "--set", "lambda=0", "--freeze"];
    emit("examples/fields/standing_wave_3d.toml", "part", &part);
}

#[test]
fn right_files_compile_and_wrong_ones_are_refused_with_their_mistakes() {
    copy_inputs();
    emit_files();
    let tests = trybuild::TestCases::new();
    tests.pass("tests/ui/pass/*.rs");
    tests.compile_fail("tests/ui/fail/*.rs");
}

/// The lines of a text without their indentation, which the compiler changes.
fn lines(text: &str) -> Vec<&str> {
    text.lines().map(str::trim).filter(|line| !line.is_empty()).collect()
}

/// The message of the macro in what the compiler prints: all above the place of the macro.
fn message(stderr: &str) -> Vec<&str> {
    let end = stderr.rfind("\n --> ").expect("the place of the macro");
    lines(&stderr[..end])
}

#[test]
fn a_compile_error_is_the_text_of_the_check_command() {
    let inputs = files("tests/ui/fail", "toml");
    assert!(!inputs.is_empty());
    for input in inputs {
        let shown = input.strip_prefix(root()).expect("a file of the package");
        let check = Command::new(env!("CARGO_BIN_EXE_mms"))
            .args([Path::new("check"), shown])
            .current_dir(root())
            .output()
            .expect("the program starts");
        assert_eq!(check.status.code(), Some(2), "{}", shown.display());
        let stderr = fs::read_to_string(input.with_extension("stderr")).expect("a .stderr file");
        let expected = String::from_utf8(check.stderr).expect("UTF-8");
        assert_eq!(message(&stderr), lines(&expected), "{}", shown.display());
    }
}
