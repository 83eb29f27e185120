//! Python: a module over NumPy arrays of any shape. Its printer is that of `python`.

use crate::python::{PythonForm, TARGET as PYTHON, bundle};
use crate::target::Target;

/// Python with NumPy.
pub const TARGET: Target = Target {
    name: "numpy",
    alias: None,
    doc: "Python: a module over NumPy arrays, which broadcasts, and a check program",
    emit: |subject| bundle(subject, PythonForm::NumPy),
    words: PYTHON.words,
};
