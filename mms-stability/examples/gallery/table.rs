//! The page of the stability of the gallery.

use std::fs;
use std::path::{Path, PathBuf};

use mms_codegen::certify::certificate::certify;
use mms_codegen::certify::ellipticity::Ellipticity;
use mms_codegen::compile;
use mms_stability::warnings::warnings;
use mms_stability::{Stability, judge};

const HEAD: &str = "\
# Is the gallery fit to verify with?

A solver can follow a motion only if the motion is stable. This table has the results of `mms check` for each field, at the
defaults of its parameters; [Stability of a field](guide/stability.md) explains them. Moduli are relative to mu at rest. The
command is

```sh
cargo run -p mms-stability --example gallery > docs/stability.md
```

Acoustic tensors: the least eigenvalue of a sample, and whether all are proved to be positive. Impedance: its least
eigenvalue on the worst face that can move. Coercivity: at the worst corner of two such faces. Growth: the factor by which
a long wave grows over the time window, and the least w^2 in 1/s^2. The last column counts the warnings of `mms check`.

| field | acoustic tensors | impedance | coercivity | growth | least w^2 | warned of |
|---|---|---|---|---|---|---|
";

/// The whole page.
#[allow(dead_code)] // The test compares rows.
pub fn page() -> String {
    let mut rows: Vec<String> = files().iter().map(|path| row(path)).collect();
    rows.insert(0, HEAD.into());
    rows.concat()
}

/// The files of the gallery, in the order of their rows.
pub fn files() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fields");
    let entries = fs::read_dir(folder).expect("the gallery").map(|entry| entry.expect("an entry"));
    let mut paths: Vec<_> = entries.map(|entry| entry.path()).collect();
    paths.sort();
    paths
}

/// The row of a field.
pub fn row(path: &Path) -> String {
    let name = path.file_stem().expect("a name").to_string_lossy();
    let text = fs::read_to_string(path).expect("a field file");
    let compiled = compile(&name, &name, &text, &|_| Err("no other file".into()));
    let field = &compiled.unwrap_or_else(|failure| panic!("{failure}"));
    let (stability, ellipticity) = (judge(field), certify(field).ellipticity);
    let Stability { waves, surfaces, corners, growth, .. } = &stability;
    let proved = match ellipticity {
        Ellipticity::Strong(_) => "proved",
        Ellipticity::Lost(_) => "refuted",
        Ellipticity::Unproved => "not proved",
    };
    let acoustic = waves.as_ref().map(|waves| format!("{}, {proved}", short(waves.least)));
    let faces = surfaces.iter().map(|surface| (surface.least, surface.face.name().to_string()));
    let corners = corners.iter().map(|corner| {
        let [first, second] = corner.faces.map(|face| face.name());
        (corner.coercivity, format!("{first}, {second}"))
    });
    let factor = growth.as_ref().map(|growth| short(growth.factor));
    let least = growth.as_ref().map(|growth| short(growth.least));
    let warned = warnings(field, &stability, None).len();
    let cells = [acoustic, worst(faces), worst(corners), factor, least]
        .map(|cell| cell.unwrap_or_else(|| "-".into()));
    let warned = if warned == 0 { String::new() } else { format!("{warned} of these") };
    format!("| {name} | {} | {warned} |\n", cells.join(" | "))
}

/// The least value, with the description of its subject.
fn worst(values: impl Iterator<Item = (f64, String)>) -> Option<String> {
    let (value, of) = values.min_by(|(one, _), (other, _)| one.total_cmp(other))?;
    Some(format!("{} ({of})", short(value)))
}

/// A number in three digits: further digits depend on the sample, and on the functions of a system.
fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.2e}").parse().unwrap_or(value);
    let is_plain = rounded == 0.0 || (1e-2..1e6).contains(&rounded.abs());
    if is_plain { rounded.to_string() } else { format!("{rounded:e}") }
}
