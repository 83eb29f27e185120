//! Lists the field files for the tests: one set of tests per file for `tests/fields.rs`.
//!
//! Refuses names that no module can have (`mms-spec/src/field_name.rs`), and files that are not fields: a mistake in one of
//! them breaks the build at its position. `mms-gallery` finds mistakes that only derivatives show. Cargo runs this again if the
//! folder or a file in it changes: `fields/` is its own list.

use std::path::PathBuf;
use std::{env, fs, io, process};

use mms_codegen::Options;
use mms_codegen::compile::compile_unproved;
use mms_codegen::selection::Selection;
use mms_spec::field_name::validate;
use mms_spec::quantity::Quantity;
use mms_spec::{FieldFile, field_files};

/// Modules other than the modules of fields, and crates that these files use by name.
const TAKEN: &[&str] = &[
    "core",
    "current",
    "mms_bar",
    "mms_codegen",
    "mms_exact",
    "mms_gallery",
    "mms_interpreted",
    "mms_macros",
    "mms_math",
    "mms_runtime",
    "std",
    "support",
];

fn main() -> io::Result<()> {
    let root = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").expect("set by Cargo"));
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("set by Cargo"));
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=fields");
    let files = field_files(&root.join("fields"))?;
    for file in &files {
        file.files().for_each(|path| println!("cargo::rerun-if-changed={}", path.display()));
        if let Err(mistake) = name(&file.name).and_then(|()| read(file)) {
            // An error that `main` returned would be shown as Rust writes values down.
            eprintln!("{mistake}");
            process::exit(1);
        }
    }
    fs::write(out.join("field_tests.rs"), field_tests(&files))
}

/// Refuses what cannot be the name of a module in `mms-gallery/src/lib.rs` and `tests/fields.rs`.
fn name(stem: &str) -> Result<(), String> {
    let taken = format!("`{stem}` is the name of a module that others use: try `{stem}_field`");
    let name = if TAKEN.contains(&stem) { Err(taken) } else { validate(stem) };
    name.map_err(|mistake| format!("error: fields/{stem}.toml: {mistake}"))
}

/// Refuses what is no field. Only the displacement is compiled.
fn read(file: &FieldFile) -> Result<(), String> {
    let quantities = Some([Quantity::Displacement].into());
    let options = Options::from(Selection { quantities, ..Selection::default() });
    let path = format!("fields/{}.toml", file.name);
    compile_unproved(&file.name, &path, &file.text, &|_| file.load_material(), &options)
        .map(drop)
        .map_err(|failure| failure.to_string())
}

/// The properties that hold for every field, once per field.
fn field_tests(files: &[FieldFile]) -> String {
    files.iter().map(|file| format!("field_tests!({});\n", file.name)).collect()
}
