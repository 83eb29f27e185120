//! Python: a module of UFL expressions. Its printer is that of `python`.

use crate::target::Target;
use crate::python::{PythonForm, TARGET as PYTHON, bundle};

/// Python with UFL.
pub const TARGET: Target = Target {
    name: "ufl",
    alias: None,
    doc: "Python: UFL expressions for finite elements, and a check program",
    emit: |subject| bundle(subject, PythonForm::Ufl),
    words: PYTHON.words,
};
