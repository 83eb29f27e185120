//! Every field of the gallery, every function of it, in every language.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::sync::{LazyLock, Mutex};

use mms_codegen::{Compiled, Options, Selection, compile_with};
use mms_emit::{Subject, Target};
use mms_spec::quantity::Quantity;

use super::build::{can_prove, in_pairs, ports, prove, quick};
use super::sampled::sampled;

/// The fields of the gallery, compiled.
pub static GALLERY: LazyLock<Vec<Compiled>> = LazyLock::new(|| {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fields");
    let files = fs::read_dir(folder).expect("the gallery");
    let mut paths: Vec<_> = files.map(|file| file.expect("a file").path()).collect();
    paths.sort();
    let fields = paths.iter().filter(|path| path.extension().is_some_and(|it| it == "toml"));
    fields.map(|path| compiled(path)).collect()
});

/// A field of the gallery, compiled.
pub fn field(name: &str) -> Compiled {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fields");
    compiled(&folder.join(format!("{name}.toml")))
}

/// The body force alone of a field of the gallery.
pub fn body_force(name: &str) -> Compiled {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fields");
    let quantities = Some([Quantity::BodyForce].into());
    let selection = Selection { quantities, ..Selection::default() };
    with_options(&folder.join(format!("{name}.toml")), &Options { selection, ..Options::default() })
}

fn compiled(path: &Path) -> Compiled {
    with_options(path, &Options::default())
}

fn with_options(path: &Path, options: &Options) -> Compiled {
    let text = fs::read_to_string(path).expect("a field file");
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let load = |material: &str| {
        fs::read_to_string(path.with_file_name(material)).map_err(|error| error.to_string())
    };
    compile_with(&stem, &path.to_string_lossy(), &text, &load, options)
        .unwrap_or_else(|failure| panic!("{failure}"))
}

/// Languages that compute in one precision lose digits of the large angles of some fields.
const ONE_PRECISION: [&str; 3] = ["ufl", "moose", "karamelo"];

#[test]
fn waves_after_many_periods_prove_themselves_in_every_language_of_two_precisions() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../mms-codegen/tests/data/late");
    for name in ["wave_in_radians", "wave_in_half_turns"] {
        let field = compiled(&folder.join(format!("{name}.toml")));
        let subject = Subject::new(&field);
        let is_meant = |target: &&'static Target| !ONE_PRECISION.contains(&target.name);
        let targets = ports().filter(|target| can_prove(target)).filter(is_meant);
        for target in sampled(targets, 6) {
            let error = prove(target, &subject, &format!("late/{name}"), quick);
            println!("{} {name}: {error} eps", target.name);
        }
    }
}

#[test]
fn every_field_proves_itself_in_every_language() {
    let fields = &*GALLERY;
    let targets: Vec<_> = ports().filter(|target| can_prove(target)).collect();
    let pairs =
        (0..targets.len()).flat_map(|target| (0..fields.len()).map(move |field| (field, target)));
    let pairs = sampled(pairs, 120);
    let worst = Mutex::new(BTreeMap::new());
    in_pairs(&pairs, |(field, target)| {
        let (name, target) = (fields[*field].field.name.raw(), targets[*target]);
        let error =
            prove(target, &Subject::new(&fields[*field]), &format!("gallery/{name}"), quick);
        let mut worst = worst.lock().expect("no panic while it is held");
        let most = worst.entry(target.name).or_insert((0.0, String::new()));
        if error > most.0 {
            *most = (error, name.to_string());
        }
    });
    for (target, (error, name)) in worst.into_inner().expect("no panic") {
        println!("{target}: at most {error} eps, {name}");
    }
}
