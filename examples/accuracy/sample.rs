//! Measurements of the page and its test.

use std::path::{Path, PathBuf};

use mms_analysis::accuracy::{Accuracy, AccuracyRow, Request, measure};
use mms_codegen::compile::compile_unproved;
use mms_program::precision::Precision;
use mms_spec::Form;

/// The paths of the gallery's files, in order of their names.
pub fn files() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fields");
    let entries = std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{folder:?}: {error}"));
    let mut files: Vec<PathBuf> =
        entries.flatten().map(|entry| entry.path()).filter(|path| is_field(path)).collect();
    files.sort();
    files
}

fn is_field(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "toml")
}

/// The name of a field.
pub fn stem(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

/// Measures the requested errors of a field.
pub fn measured(path: &Path, request: &Request) -> Accuracy {
    let (name, shown) = (stem(path), path.display().to_string());
    let text = std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{shown}: {error}"));
    let load = |file: &str| {
        let path = path.with_file_name(file);
        std::fs::read_to_string(path).map_err(|error| error.to_string())
    };
    let compile = |options: &_| compile_unproved(&name, &shown, &text, &load, options);
    measure(&compile, request, |_| {}).unwrap_or_else(|failure| panic!("{failure}"))
}

/// The precisions and forms of the columns.
pub fn columns() -> impl Iterator<Item = (Precision, Form)> {
    let forms = |precision| Form::ALL.map(|form| (precision, form));
    Precision::ALL.into_iter().flat_map(forms)
}

/// The names of the regimes that were measured, in order.
pub fn regimes(accuracy: &Accuracy) -> Vec<String> {
    let mut regimes: Vec<String> = Vec::new();
    for row in &accuracy.rows {
        if !regimes.iter().any(|known| row.regime == *known) {
            regimes.push(row.regime.shown());
        }
    }
    regimes
}

/// The quantity with the largest error, and the number of components lost in all quantities.
pub fn worst<'a>(
    accuracy: &'a Accuracy,
    regime: &str,
    (precision, form): (Precision, Form),
) -> Option<(&'a AccuracyRow, usize)> {
    let rows = accuracy
        .rows
        .iter()
        .filter(|row| row.regime == regime && row.precision == precision && row.form == form);
    let lost = rows.clone().map(|row| row.errors.not_finite - row.errors.overflowed).sum();
    let worst = rows.max_by(|a, b| a.errors.max_scaled_eps.total_cmp(&b.errors.max_scaled_eps));
    worst.map(|row| (row, lost))
}
