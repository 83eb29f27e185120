//! The common parts of the tests of every field.

pub mod dual;
pub mod kernel;
