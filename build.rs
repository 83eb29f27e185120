//! Finds the field files and lists them for the gallery and for the tests. Discovers only: the
//! files are read, compiled and reported by the macro.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let root = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").expect("set by Cargo"));
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("set by Cargo"));
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=fields");
    let mut stems = Vec::new();
    for entry in fs::read_dir(root.join("fields"))? {
        let path = entry?.path();
        if path.extension().is_some_and(|extension| extension == "toml") {
            println!("cargo::rerun-if-changed={}", path.display());
            stems.push(path.file_stem().unwrap_or_default().to_string_lossy().into_owned());
        }
    }
    stems.sort();
    for stem in &stems {
        let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
        if !stem.starts_with(|c: char| c.is_ascii_lowercase()) || !stem.chars().all(plain) {
            return Err(io::Error::other(format!(
                "fields/{stem}.toml: the name of a field file is a module name: lower-case letters, digits and underscores, a letter first"
            )));
        }
    }
    fs::write(out.join("gallery.rs"), gallery(&root, &stems))?;
    fs::write(out.join("field_tests.rs"), field_tests(&stems))
}

/// One module per field, and the catalogue.
fn gallery(root: &Path, stems: &[String]) -> String {
    let mut text = String::new();
    for stem in stems {
        writeln!(text, "mms_macros::field!(\"fields/{stem}.toml\");").expect("writing to a string");
    }
    text.push_str("\n/// The compiled fields, by name.\npub const FIELDS: &[Entry] = &[\n");
    for stem in stems {
        let path = root.join("fields").join(format!("{stem}.toml"));
        writeln!(text, "    entry!({stem}, {stem:?}, {path:?}),").expect("writing to a string");
    }
    text.push_str("];\n");
    text
}

/// The properties that hold for every field, once per field.
fn field_tests(stems: &[String]) -> String {
    stems.iter().map(|stem| format!("field_tests!({stem});\n")).collect()
}
