//! Lists the sources of `mms-math` for the workbench; none in a package, which lacks them.

use std::fmt::Write as _;
use std::path::PathBuf;
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let root = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").expect("set by Cargo"));
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("set by Cargo"));
    println!("cargo::rerun-if-changed=build.rs");
    let folder = root.join("../mms-math/src");
    let (mut folders, mut files) = (vec![folder.clone()], Vec::new());
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
    let mut list = String::from("&[\n");
    for path in &files {
        let below = path.strip_prefix(&folder).unwrap_or(path).components();
        let below: Vec<_> = below.map(|part| part.as_os_str().to_string_lossy()).collect();
        writeln!(list, "    ({:?}, include_str!({path:?})),", below.join("/"))
            .expect("writing to a string");
    }
    list.push_str("]\n");
    fs::write(out.join("math.rs"), list)
}
