//! Python: a module of UFL expressions, printed by `python`.

use crate::python::{Library, TARGET as PYTHON, bundle};
use crate::target::Target;

/// Python with UFL.
pub const TARGET: Target = Target {
    name: "ufl",
    alias: None,
    doc: "Python: UFL expressions for finite elements, and a check program",
    emit: |subject| bundle(subject, Library::Ufl),
    words: PYTHON.words,
};
