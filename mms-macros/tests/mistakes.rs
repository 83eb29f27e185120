//! What the macro refuses: each program in `ui/fail` with the text in its `.stderr`. A test of the
//! command line compares those texts with what `mms check` says.
//!
//! After a deliberate change, `TRYBUILD=overwrite cargo test -p mms-macros --test mistakes` writes
//! the `.stderr` files anew; read the difference before it is committed.

use std::fs;
use std::path::Path;

/// The folders of field files that the programs name, and where they are. The macro finds a file
/// relative to the manifest of the crate that uses it, which is one that `trybuild` writes.
const INPUTS: [[&str; 2]; 4] = [
    ["fields", "../fields"],
    ["examples/fields", "../examples/fields"],
    ["tests/ui/fail", "tests/ui/fail"],
    ["tests/ui/fail/materials", "tests/ui/fail/materials"],
];

/// Copies the field files to where they are looked for.
fn copy_inputs() {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).parent().expect("the target folder");
    let manifest = target.join("tests/trybuild").join(env!("CARGO_PKG_NAME"));
    for [to, from] in INPUTS {
        let to = manifest.join(to);
        let _ = fs::remove_dir_all(&to);
        fs::create_dir_all(&to).expect("a folder");
        for entry in fs::read_dir(package.join(from)).expect("a folder") {
            let file = entry.expect("an entry").path();
            if file.extension().is_some_and(|extension| extension == "toml") {
                fs::copy(&file, to.join(file.file_name().expect("a name"))).expect("a copy");
            }
        }
    }
}

#[test]
fn wrong_files_and_options_are_refused_with_their_mistakes() {
    copy_inputs();
    trybuild::TestCases::new().compile_fail("tests/ui/fail/*.rs");
}
