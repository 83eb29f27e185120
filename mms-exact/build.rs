//! Lists the texts of `fields/*.toml` for `src/gallery.rs`: the folder is the list of the gallery.

use std::fmt::Write as _;
use std::path::PathBuf;
use std::{env, fs, io};

use mms_spec::field_files;

fn main() -> io::Result<()> {
    let root = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").expect("set by Cargo"));
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("set by Cargo"));
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=fields");
    let mut list = String::from("&[\n");
    for file in field_files(&root.join("fields"))? {
        file.files().for_each(|path| println!("cargo::rerun-if-changed={}", path.display()));
        let (name, [field, material]) = (&file.name, file.included());
        let path = format!("fields/{name}.toml");
        let entry = format!("name: {name:?}, path: {path:?}, text: {field}, material: {material}");
        writeln!(list, "    Entry {{ {entry} }},").expect("writing to a string");
    }
    list.push(']');
    fs::write(out.join("fields.rs"), list)
}
