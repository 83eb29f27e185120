//! Exceptions: each is a `ValueError` with the message that the command prints.

use mms_codegen::compile::Failure;
use pyo3::create_exception;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

create_exception!(
    manufactured,
    MmsError,
    PyValueError,
    "An argument that a field does not take, and why."
);
create_exception!(
    manufactured,
    FieldError,
    MmsError,
    "A field file with mistakes, or a parameter that it does not allow. The message shows each mistake in its line; `places` has \
     (path, line, column, message) of each."
);

/// An exception with a message.
pub fn mistake(message: impl ToString) -> PyErr {
    MmsError::new_err(message.to_string())
}

/// The exception of a text that does not compile, with the message that says so.
pub fn failure(py: Python<'_>, message: &str, failure: &Failure) -> PyErr {
    let places: Vec<_> = failure
        .diagnostics
        .iter()
        .map(|it| {
            let (line, column) = failure.sources.location(it.span);
            let path = failure.sources.get(it.span.source).path.raw().to_string();
            (path, line, column, it.message.clone())
        })
        .collect();
    let error = FieldError::new_err(message.to_string());
    match error.value(py).setattr("places", places) {
        Ok(()) => error,
        Err(other) => other,
    }
}

/// Adds the exceptions to the module.
pub fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("MmsError", module.py().get_type::<MmsError>())?;
    module.add("FieldError", module.py().get_type::<FieldError>())
}
