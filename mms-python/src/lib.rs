//! The Python library `manufactured`: fields, their quantities over NumPy arrays, verdicts.
//!
//! `python/manufactured/` is the package, and this crate its module `_native`. A field is compiled and interpreted in blocks of
//! points, with the bits of `mms eval`. Contiguous arrays are not copied, and the GIL is released.
//!
//! | file | does |
//! |---|---|
//! | `mistake` | exceptions |
//! | `array` | the shape and the numbers of an argument, and the array that is returned |
//! | `evaluator` | one output at many points, by several threads |
//! | `follow` | the progress of long work, and its end at an interrupt |
//! | `open` | opens and compiles a field, and stops if Python receives an interrupt (Ctrl-C) |
//! | `opened` | a field with numbers for its parameters: all its outputs |
//! | `kept` | what X alone determines, kept for other times |
//! | `show` | the derivation, for people |
//! | `results` | results of a solver, from arrays or files |
//! | `verdict` | verdicts and diagnoses, to documents |
//! | `study` | studies with the solver of this project |
//! | `command` | the command `mms` |
//! | `field` | the classes, whose methods for quantities `build.rs` writes |

mod array;
mod command;
mod evaluator;
mod field;
mod follow;
mod kept;
mod mistake;
mod open;
mod opened;
mod results;
mod show;
mod study;
mod verdict;

use pyo3::prelude::*;

/// The module.
#[pymodule(gil_used = false)]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    mistake::add(module)?;
    field::add(module)?;
    verdict::add(module)?;
    study::add(module)?;
    command::add(module)?;
    module.add("__version__", env!("CARGO_PKG_VERSION"))
}
