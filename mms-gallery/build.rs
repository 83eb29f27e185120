//! Compiles the field files into Rust modules.
//!
//! Each becomes a separate Rust file, which is written again only if its field or the compiler has changed: a new field causes
//! no work for other fields. Files are compiled in parallel.

use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::{env, fs, io, process, thread};

use mms_codegen::compile;
use mms_codegen::rust::module;
use mms_spec::{FieldFile, field_files};

fn main() -> io::Result<()> {
    let root = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").expect("set by Cargo"));
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("set by Cargo"));
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=fields");
    let files = field_files(&root.join("fields"))?;
    for path in files.iter().flat_map(FieldFile::files) {
        println!("cargo::rerun-if-changed={}", path.display());
    }
    let compiler = fs::read(env::current_exe()?)?;
    let mistakes = side_by_side(&files, |file| write_module(file, &compiler, &out));
    if !mistakes.is_empty() {
        // An error returned by `main` would be printed in Rust's debug format.
        eprintln!("{}", mistakes.join("\n"));
        process::exit(1);
    }
    fs::write(out.join("gallery.rs"), gallery(&files))
}

/// Processes the files in parallel, and collects the errors.
fn side_by_side(
    files: &[FieldFile],
    work: impl Fn(&FieldFile) -> Result<(), String> + Sync,
) -> Vec<String> {
    let next = AtomicUsize::new(0);
    let worker = || {
        let mine = std::iter::from_fn(|| files.get(next.fetch_add(1, Relaxed)));
        mine.filter_map(|file| work(file).err()).collect::<Vec<_>>()
    };
    let threads = thread::available_parallelism().map_or(1, usize::from);
    thread::scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(worker)).collect();
        workers.into_iter().flat_map(|it| it.join().expect("a compiler that ends")).collect()
    })
}

/// Writes the module of a field, unless it is up to date.
fn write_module(file: &FieldFile, compiler: &[u8], out: &Path) -> Result<(), String> {
    let material = file.material.as_ref().map(|_| file.load_material());
    let mut hasher = DefaultHasher::new();
    (&file.text, &material, compiler).hash(&mut hasher);
    let head = format!("// Made of {:016x}.\n", hasher.finish());
    let path = out.join(format!("{}.rs", file.name));
    if fs::read_to_string(&path).is_ok_and(|text| text.starts_with(&head)) {
        return Ok(());
    }
    let shown = format!("fields/{}.toml", file.name);
    let compiled = compile(&file.name, &shown, &file.text, &|_| file.load_material())
        .map_err(|failure| failure.to_string())?;
    let text = format!("{head}{}", module(&compiled));
    fs::write(&path, text).map_err(|error| format!("error: {}: {error}", path.display()))
}

/// One module per field, and their list. The feature `linked` determines where the listed code is compiled.
fn gallery(files: &[FieldFile]) -> String {
    let modules = files
        .iter()
        .map(|file| format!("include!(concat!(env!(\"OUT_DIR\"), \"/{}.rs\"));\n", file.name));
    let codes = files.iter().map(|file| format!("        mms_runtime::code!({}),\n", file.name));
    format!(
        "{}\n/// The compiled field of that name.\n#[cfg_attr(not(feature = \"linked\"), inline)]\n\
         pub fn find(name: &str) -> Option<Code> {{\n    [\n{}    ].into_iter().find(|code| code.name == name)\n}}\n",
        modules.collect::<String>(),
        codes.collect::<String>()
    )
}
