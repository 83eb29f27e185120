//! Python: a module of SymPy expressions. Its printer is that of `python`.

use crate::target::Target;
use crate::python::{PythonForm, TARGET as PYTHON, bundle};

/// Python with SymPy.
pub const TARGET: Target = Target {
    name: "sympy",
    alias: None,
    doc: "Python: SymPy expressions with exact numbers, and a check program",
    emit: |subject| bundle(subject, PythonForm::SymPy),
    words: PYTHON.words,
};
