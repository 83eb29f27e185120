//! What the tests of every field share.

pub mod dual;
pub mod kernel;
