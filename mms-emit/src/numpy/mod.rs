//! Python: a module over NumPy arrays of any shape, printed by `python`.

use crate::python::{Library, TARGET as PYTHON, bundle};
use crate::target::Target;

/// Python with NumPy.
pub const TARGET: Target = Target {
    name: "numpy",
    alias: None,
    doc: "Python: a module over NumPy arrays, which broadcasts, and a check program",
    emit: |subject| bundle(subject, Library::NumPy),
    words: PYTHON.words,
};
