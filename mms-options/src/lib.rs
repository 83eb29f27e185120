//! Options of the command as values.
//!
//! [`field`] opens the field that a user names, in a variant; [`method`] reads a method of the solver, and [`Study`] the words
//! of a study. Commands flatten these into their own options; suites of runs read them from the words of their rows.

pub mod field;
pub mod method;
mod study;

pub use study::{Study, arguments};
