//! Python: a module of SymPy expressions, printed by `python`.

use crate::python::{Library, TARGET as PYTHON, bundle};
use crate::target::Target;

/// Python with SymPy.
pub const TARGET: Target = Target {
    name: "sympy",
    alias: None,
    doc: "Python: SymPy expressions with exact numbers, and a check program",
    emit: |subject| bundle(subject, Library::SymPy),
    words: PYTHON.words,
};
