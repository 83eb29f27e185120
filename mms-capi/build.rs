//! Embeds `fields/*.toml`, so that the folder is the list of the gallery, and sets the name of the shared library.

use std::fmt::Write as _;
use std::path::PathBuf;
use std::{env, fs, io};

use mms_spec::field_files;

fn main() -> io::Result<()> {
    let folder =
        PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").expect("set by Cargo")).join("fields");
    println!("cargo::rerun-if-changed={}", folder.display());
    let mut list = String::from("&[\n");
    for file in field_files(&folder)? {
        file.files().for_each(|path| println!("cargo::rerun-if-changed={}", path.display()));
        let [field, material] = file.included();
        writeln!(list, "    (c{:?}, {field}, {material}),", file.name)
            .expect("writing to a string");
    }
    list.push(']');
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("set by Cargo"));
    fs::write(out.join("gallery.rs"), list)?;
    name_the_library();
    Ok(())
}

/// Sets the name by which linked programs search for the library at their start, independent of where it was built.
fn name_the_library() {
    let name = match env::var("CARGO_CFG_TARGET_OS").as_deref() {
        Ok("linux") => "-soname,libmms_capi.so",
        Ok("macos") => "-install_name,@rpath/libmms_capi.dylib",
        _ => return,
    };
    println!("cargo::rustc-cdylib-link-arg=-Wl,{name}");
}
