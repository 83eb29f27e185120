//! Studies with the solver of this project, to the document of `mms study`.

use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use anyhow::bail;
use mms_command::studies;
use mms_lab::trial::Progress;
use mms_runtime::Division;
use mms_runtime::study::{Checkpoint, Observer};
use mms_symbolic::work::Stop;
use pyo3::prelude::*;

use crate::field::Field;
use crate::mistake::mistake;
use crate::open::interruptible;
use crate::verdict::Views;

/// The time between two reports of progress to Python.
const PAUSE: Duration = Duration::from_millis(100);

/// Follows runs: reports their progress to a function of Python, and ends them if a stop is requested.
struct Follower {
    stop: Stop,
    /// Takes a line.
    told: Option<Py<PyAny>>,
    /// The exception that it raised.
    raised: Mutex<Option<PyErr>>,
}

impl Follower {
    fn tell(&self, line: &str) {
        let Some(told) = self.told.as_ref().filter(|_| !self.stop.is_asked()) else { return };
        if let Err(error) = Python::attach(|py| told.call1(py, (line,)).map(drop)) {
            *self.raised.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
            self.stop.ask();
        }
    }
}

impl Progress for Follower {
    fn of(&self, cells: Division) -> Box<dyn Observer + '_> {
        Box::new(OfRun { follower: self, cells, last: None })
    }

    fn say(&self, line: &str) {
        self.tell(line);
    }

    fn finish(&self) {}
}

/// Follows one run.
struct OfRun<'a> {
    follower: &'a Follower,
    cells: Division,
    last: Option<Instant>,
}

impl Observer for OfRun<'_> {
    fn step(&mut self, step: usize, steps: usize) {
        if step == steps || self.last.is_none_or(|last| last.elapsed() >= PAUSE) {
            self.follower.tell(&format!("{} cells: step {step} of {steps}", self.cells));
            self.last = Some(Instant::now());
        }
    }

    fn keeps(&self, _: usize, _: usize) -> bool {
        self.follower.stop.is_asked()
    }

    fn keep(&mut self, _: &dyn Checkpoint) -> Result<(), String> {
        Err("interrupted".into())
    }
}

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
    let follower = Follower { stop: Stop::default(), told: progress, raised: Mutex::default() };
    let work = || {
        let report = studies(&words, &|_| Ok(source.clone()), &follower)?;
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
    let made = py.detach(|| interruptible(&follower.stop, work))?;
    match follower.raised.into_inner().unwrap_or_else(PoisonError::into_inner) {
        Some(raised) => Err(raised),
        None => made.map_err(|error| mistake(without_usage(&format!("{error:#}")))),
    }
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
