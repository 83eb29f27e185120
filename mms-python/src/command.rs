//! The command `mms`, which the script of the wheel calls.

use std::ffi::OsString;
use std::path::PathBuf;

use mms_files::program::{self, Program};
use peak_alloc::PeakAlloc;
use pyo3::prelude::*;

/// Counts what is allocated, so that a run can say what it takes.
#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

/// Runs `mms` with arguments, once in a process, and returns its exit code. `file` is the path of this module, and `words`
/// start the same command in another process.
#[pyfunction]
fn command(py: Python<'_>, file: PathBuf, words: Vec<OsString>, arguments: Vec<OsString>) -> u8 {
    program::set(Program { file, words, arguments });
    py.detach(mms_command::run)
}

/// Adds the function to the module.
pub fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(command, module)?)
}
