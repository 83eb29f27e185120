//! Opens and compiles a field, and stops where Python has an interrupt.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use mms_codegen::Options;
use mms_exact::{Input, Mistaken, Source, gallery};
use mms_files::read::{self, FileKind};
use mms_spec::foreign::shown;
use mms_spec::suggest::advice;
use mms_symbolic::work::Stop;
use pyo3::exceptions::{PyFileNotFoundError, PyOSError};
use pyo3::prelude::*;

use crate::mistake::{failure, mistake};

/// The stack size for such work, as large as for a main thread: a thread of Python may have a small one.
const STACK: usize = 8 << 20;

/// The time between two polls for an interrupt of Python.
const PAUSE: Duration = Duration::from_millis(50);

/// The text of a field of the gallery.
pub fn shipped(name: &str) -> PyResult<Source> {
    if let Some(entry) = gallery::find(name) {
        return Ok(Source::shipped(entry, None));
    }
    let names = gallery::FIELDS.iter().map(|entry| entry.name);
    let advice = advice(name, names, |all| {
        format!("it holds {all}; `load` takes the path of a file of your own")
    });
    Err(mistake(format!("no field `{}` in the gallery; {advice}", shown(name))))
}

/// The text of a field file.
pub fn file(path: &Path) -> PyResult<Source> {
    let unread = |error: anyhow::Error| match path.exists() {
        true => PyOSError::new_err(format!("{error:#}")),
        false => PyFileNotFoundError::new_err(format!("{error:#}")),
    };
    let text = read::text(path, FileKind::Field).map_err(unread)?;
    let folder = path.parent().unwrap_or(Path::new(".")).to_path_buf();
    Ok(Source::file(path.to_path_buf(), text, move |material| {
        let text = read::text(&folder.join(material), FileKind::Field);
        text.map_err(|error| error.root_cause().to_string())
    }))
}

/// A text from Python, and the text of its material if it has its own.
pub fn text(name: &str, text: &str, material: Option<String>) -> Source {
    let path = PathBuf::from(format!("{name}.toml"));
    Source::file(path, text.into(), move |_| {
        material
            .clone()
            .ok_or_else(|| "its text was not given; `loads` takes it as `material`".into())
    })
}

/// Compiles a field. Tests of the gallery check the claims of its fields, so only the claims of a file are checked here.
pub fn compile(py: Python<'_>, source: Source, is_shipped: bool) -> PyResult<Input> {
    let options = Options::default();
    let stop = options.stop.clone();
    let make = if is_shipped { Input::interpreted } else { Input::new };
    let made = py.detach(|| interruptible(&stop, || make(source, &options)));
    made?.map_err(|error| match error.downcast_ref::<Mistaken>() {
        Some(mistaken) => failure(py, &error.to_string(), &mistaken.failure),
        None => mistake(format!("{error:#}")),
    })
}

/// Runs work on a thread of its own, until it ends or an interrupt of Python has stopped it.
pub fn interruptible<R: Send>(stop: &Stop, work: impl FnOnce() -> R + Send) -> PyResult<R> {
    let (ended, ends) = channel::<()>();
    thread::scope(|scope| {
        let work = move || {
            let _ended = ended;
            work()
        };
        let thread = thread::Builder::new().stack_size(STACK).spawn_scoped(scope, work)?;
        let mut interrupt = Ok(());
        while interrupt.is_ok() && ends.recv_timeout(PAUSE) == Err(RecvTimeoutError::Timeout) {
            interrupt = Python::attach(|py| py.check_signals());
        }
        if interrupt.is_err() {
            stop.ask();
        }
        let result = thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        interrupt.map(|()| result)
    })
}
