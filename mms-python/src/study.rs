//! Studies with the solver of this project, to the document of `mms study`.

use anyhow::bail;
use mms_command::studies;
use pyo3::prelude::*;

use crate::field::Field;
use crate::follow::Follower;
use crate::mistake::mistake;
use crate::verdict::Views;

/// Studies a field with the options of `mms study`; see `study` of the package.
#[pyfunction]
fn study(
    py: Python<'_>,
    field: &Field,
    options: Vec<String>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Views> {
    let source = field.opened.input.source();
    let set = field.opened.arguments().into_iter().map(|it| format!("--set={it}"));
    let mut words = vec!["study".to_owned(), source.given().to_owned()];
    words.extend(set.chain(options));
    let work = |follower: &Follower| {
        let report = studies(&words, &|_| Ok(source.clone()), follower, follower)?;
        let [alone] = report.studies.as_slice() else {
            bail!("a study has one method: call `study` once for each")
        };
        match alone.levels.first() {
            Some(Err(refused)) if !alone.is_started() => {
                bail!("{} cells: {refused}", refused.cells)
            }
            _ => Views::of(&report, Some(alone.figure().svg())),
        }
    };
    let made = Follower::follow(py, progress, work)?;
    made.map_err(|error| mistake(without_usage(&format!("{error:#}"))))
}

/// The message about a command line without what only helps in a terminal.
fn without_usage(message: &str) -> String {
    let message = message.strip_prefix("error: ").unwrap_or(message);
    let message = message.split("\n\nUsage:").next().unwrap_or(message);
    message.split("\n\nFor more information").next().unwrap_or(message).trim_end().to_owned()
}

/// Adds the function to the module.
pub fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(study, module)?)
}
