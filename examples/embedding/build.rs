//! Compiles a field to a file of Rust, which `src/main.rs` includes. Use this instead of the macro for a
//! field that the build chooses or writes.

use std::path::{Path, PathBuf};
use std::{env, fs, process};

use mms_codegen::Quantity;
use mms_codegen::rust::file;
use mms_codegen::selection::Freeze;
use mms_codegen::{Options, Selection, compile_with};

const FIELD: &str = "fields/spring_1d.toml";

fn main() -> std::io::Result<()> {
    println!("cargo::rerun-if-changed={FIELD}");
    let text = fs::read_to_string(FIELD)?;
    // Loads a material file that the field names, as in `model = "./mine.toml"`.
    let load = |material: &str| {
        let path = Path::new("fields").join(material);
        println!("cargo::rerun-if-changed={}", path.display());
        fs::read_to_string(path).map_err(|error| error.to_string())
    };
    let selection = Selection {
        quantities: Some([Quantity::BodyForce, Quantity::Displacement].into()),
        freeze: Freeze::Everything,
        ..Selection::default()
    };
    let compiled = compile_with("spring_1d", FIELD, &text, &load, &Options::from(selection));
    let compiled = compiled.unwrap_or_else(|failure| {
        // Prints every mistake with its line and column.
        eprintln!("{failure}");
        process::exit(1);
    });
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("set by Cargo"));
    fs::write(out.join("spring_1d.rs"), file(&compiled).text)
}
