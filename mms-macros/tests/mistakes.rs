//! Calls that the macro refuses: each program in `ui/fail` with the text in its `.stderr`, which is the compiler's complete
//! output. A test of the command line compares those texts with the output of `mms check`.
//!
//! After a deliberate change, `MMS_BLESS=1 cargo test -p mms-macros --test mistakes` writes the
//! `.stderr` files anew; read the difference before it is committed.

use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The folders of field files that the programs name, and their places. The macro finds a file relative to the manifest of the
/// crate that uses it.
const INPUTS: [[&str; 2]; 4] = [
    ["fields", "../fields"],
    ["examples/fields", "../examples/fields"],
    ["tests/ui/fail", "tests/ui/fail"],
    ["tests/ui/fail/materials", "tests/ui/fail/materials"],
];

/// The files of a folder of this package with that extension, in order of their names.
fn files(folder: &str, extension: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap_or_else(|error| panic!("{folder}: {error}"));
    let files = entries.map(|entry| entry.expect("an entry").path());
    let mut files: Vec<_> =
        files.filter(|file| file.extension().is_some_and(|it| it == extension)).collect();
    files.sort();
    files
}

/// A folder with the field files at the expected place.
fn manifest() -> PathBuf {
    let manifest = Path::new(env!("CARGO_TARGET_TMPDIR")).join("mistakes");
    let _ = fs::remove_dir_all(&manifest);
    for [to, from] in INPUTS {
        fs::create_dir_all(manifest.join(to)).expect("a folder");
        for file in files(from, "toml") {
            let name = file.file_name().expect("a name");
            fs::copy(&file, manifest.join(to).join(name)).expect("a copy");
        }
    }
    manifest
}

/// The macro, as Cargo has built it for this test: the newest file of several.
fn library() -> PathBuf {
    let program = std::env::current_exe().expect("the path of the test");
    let beside = fs::read_dir(program.parent().expect("a folder")).expect("a folder");
    let is_macro = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        name.starts_with(&format!("{DLL_PREFIX}mms_macros-")) && name.ends_with(DLL_SUFFIX)
    };
    let built = beside.map(|entry| entry.expect("an entry").path()).filter(is_macro);
    let time = |path: &PathBuf| fs::metadata(path).and_then(|it| it.modified()).expect("a time");
    built.max_by_key(time).expect("the library of this package")
}

#[test]
fn wrong_files_and_options_are_refused_with_their_mistakes() {
    let (manifest, library) = (manifest(), library());
    let programs = files("tests/ui/fail", "rs");
    assert!(!programs.is_empty());
    for program in programs {
        let run = Command::new("rustc")
            .args(["--edition", "2024", "--emit", "metadata", "--color", "never", "--extern"])
            .arg(format!("mms_macros={}", library.display()))
            .args(["-o".as_ref(), manifest.join("program").as_os_str(), program.as_os_str()])
            .env("CARGO_MANIFEST_DIR", &manifest)
            .output()
            .expect("the compiler starts");
        assert!(!run.status.success(), "{} is not refused", program.display());
        let found = String::from_utf8(run.stderr).expect("UTF-8");
        let expected = program.with_extension("stderr");
        if std::env::var_os("MMS_BLESS").is_some() {
            fs::write(&expected, &found).expect("a written file");
        }
        let expected = fs::read_to_string(expected).unwrap_or_default();
        assert_eq!(found, expected, "{}; if that is right, set MMS_BLESS=1", program.display());
    }
}
