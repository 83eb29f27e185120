//! Finds the field files, and lists them for the command, for the tests and for the crate of the compiled
//! gallery, which has a link to this script; and the sources of `mms-math` for the workbench. Discovers only: the
//! files are compiled and reported by others, but for the name of a material that one brings along.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

use mms_codegen::spec::field_name::validate;
use mms_codegen::spec::own_material;

/// Modules beside those of the fields, and crates that these files use by name.
const TAKEN: &[&str] = &[
    "core",
    "current",
    "mms",
    "mms_codegen",
    "mms_gallery",
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
        if let Err(mistake) = name(stem) {
            // An error that `main` returned would be shown as Rust writes values down.
            eprintln!("error: fields/{stem}.toml: {mistake}");
            std::process::exit(1);
        }
    }
    if env::var("CARGO_PKG_NAME").as_deref() == Ok("mms-gallery") {
        return fs::write(out.join("gallery.rs"), gallery(&stems));
    }
    fs::write(out.join("fields.rs"), fields(&root.join("fields"), &stems)?)?;
    fs::write(out.join("math.rs"), sources(&root.join("mms-math").join("src"))?)?;
    fs::write(out.join("field_tests.rs"), field_tests(&stems))
}

/// Refuses what cannot be the name of a module in `mms-gallery/src/lib.rs` and `tests/fields.rs`.
fn name(stem: &str) -> Result<(), String> {
    if TAKEN.contains(&stem) {
        return Err(format!(
            "`{stem}` is the name of a module that others use: try `{stem}_field`"
        ));
    }
    validate(stem)
}

/// Name, path and text of each field, and the text of a material that it brings along.
fn fields(folder: &Path, stems: &[String]) -> io::Result<String> {
    let mut text = String::from("&[\n");
    for stem in stems {
        let file = folder.join(format!("{stem}.toml"));
        let material = own_material(&fs::read_to_string(&file)?).map(|path| {
            let path = file.with_file_name(path);
            println!("cargo::rerun-if-changed={}", path.display());
            format!("include_str!({path:?})")
        });
        let material = material.map_or("None".into(), |text| format!("Some({text})"));
        writeln!(
            text,
            "    Entry {{ name: {stem:?}, path: \"fields/{stem}.toml\", text: include_str!({file:?}), \
             material: {material} }},"
        )
        .expect("writing to a string");
    }
    text.push(']');
    Ok(text)
}

/// One module per field, and the list of them.
fn gallery(stems: &[String]) -> String {
    let mut text = String::new();
    for stem in stems {
        writeln!(text, "mms_macros::field!(\"fields/{stem}.toml\");").expect("writing to a string");
    }
    text.push_str(
        "\n/// The compiled fields, in the order of their names.\npub const FIELDS: &[Code] = &[\n",
    );
    for stem in stems {
        writeln!(text, "    mms_runtime::code!({stem}),").expect("writing to a string");
    }
    text.push_str("];\n");
    text
}

/// Paths and texts of the Rust files below a folder; none where there is no such folder, as in a
/// package.
fn sources(folder: &Path) -> io::Result<String> {
    let (mut folders, mut files) = (vec![folder.to_path_buf()], Vec::new());
    while let Some(folder) = folders.pop().filter(|folder| folder.is_dir()) {
        println!("cargo::rerun-if-changed={}", folder.display());
        for entry in fs::read_dir(folder)? {
            let path = entry?.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                files.push(path);
            }
        }
    }
    files.sort();
    let mut text = String::from("&[\n");
    for path in &files {
        let below = path.strip_prefix(folder).unwrap_or(path).components();
        let below: Vec<_> = below.map(|part| part.as_os_str().to_string_lossy()).collect();
        writeln!(text, "    ({:?}, include_str!({path:?})),", below.join("/"))
            .expect("writing to a string");
    }
    text.push_str("]\n");
    Ok(text)
}

/// The properties that hold for every field, once per field.
fn field_tests(stems: &[String]) -> String {
    stems.iter().map(|stem| format!("field_tests!({stem});\n")).collect()
}
