//! Every field of the gallery, every function of it, in every language.

use std::fs;
use std::path::Path;

use mms_codegen::{Compiled, Options, compile_with};

use super::build::{can_build, in_pairs, ports, prove, quick};

/// The fields of the gallery, compiled.
fn gallery() -> Vec<Compiled> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fields");
    let files = fs::read_dir(folder).expect("the gallery");
    let mut paths: Vec<_> = files.map(|file| file.expect("a file").path()).collect();
    paths.sort();
    let fields = paths.iter().filter(|path| path.extension().is_some_and(|it| it == "toml"));
    fields.map(|path| compiled(path)).collect()
}

fn compiled(path: &Path) -> Compiled {
    let text = fs::read_to_string(path).expect("a field file");
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let load = |material: &str| {
        fs::read_to_string(path.with_file_name(material)).map_err(|error| error.to_string())
    };
    compile_with(&stem, &path.to_string_lossy(), &text, &load, &Options::default())
        .unwrap_or_else(|failure| panic!("{failure}"))
}

#[test]
fn every_field_proves_itself_in_every_language() {
    let fields = gallery();
    for target in ports().filter(|target| can_build(target)) {
        let start = std::time::Instant::now();
        let worst = std::sync::Mutex::new((0.0, String::new()));
        in_pairs(&fields, |field| {
            let name = &field.field.name;
            let error = prove(target, field, &format!("gallery/{name}"), quick);
            let mut worst = worst.lock().expect("no panic while it is held");
            if error > worst.0 {
                *worst = (error, name.clone());
            }
        });
        let (error, name) = worst.into_inner().expect("no panic");
        println!("{}: at most {error} eps, {name}, {:.0?}", target.name, start.elapsed());
    }
}
