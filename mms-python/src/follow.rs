//! The progress of long work, for a function of Python, and the end of the work at an interrupt of Python.

use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use mms_judge::Follow;
use mms_lab::trial::Progress;
use mms_runtime::Division;
use mms_runtime::study::{Checkpoint, Observer};
use mms_symbolic::work::Stop;
use pyo3::prelude::*;

use crate::open::interruptible;

/// The least time between two lines about one run, or about mistakes that are tried.
const PAUSE: Duration = Duration::from_millis(100);

/// Follows work: gives lines to a function of Python, and ends the work on request.
pub struct Follower {
    /// The request to end the work.
    pub stop: Stop,
    /// The function that is called with a line.
    told: Option<Py<PyAny>>,
    /// The exception that it raised.
    raised: Mutex<Option<PyErr>>,
    /// The time of the last line about a mesh or a mistake.
    last: Mutex<Option<Instant>>,
}

impl Follower {
    /// Works without the lock of the interpreter until the work ends, Python has an interrupt, or `told` raises an exception.
    pub fn follow<R: Send>(
        py: Python<'_>,
        told: Option<Py<PyAny>>,
        work: impl FnOnce(&Follower) -> R + Send,
    ) -> PyResult<R> {
        let (stop, raised, last) = (Stop::default(), Mutex::default(), Mutex::default());
        let follower = Follower { stop, told, raised, last };
        let made = py.detach(|| interruptible(&follower.stop, || work(&follower)))?;
        match follower.raised.into_inner().unwrap_or_else(PoisonError::into_inner) {
            Some(raised) => Err(raised),
            None => Ok(made),
        }
    }

    fn tell(&self, line: &str) {
        let Some(told) = self.told.as_ref().filter(|_| !self.stop.is_asked()) else { return };
        if let Err(error) = Python::attach(|py| told.call1(py, (line,)).map(drop)) {
            *self.raised.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
            self.stop.ask();
        }
    }

    /// Whether the last line is old enough for another one, which is then taken as said.
    fn is_due(&self) -> bool {
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        let is_due = last.is_none_or(|last| last.elapsed() >= PAUSE);
        if is_due {
            *last = Some(Instant::now());
        }
        is_due
    }
}

impl Follow for Follower {
    fn is_stopped(&self) -> bool {
        self.stop.is_asked()
    }

    fn say(&self, line: &str) {
        if self.told.is_some() && self.is_due() {
            self.tell(line);
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
