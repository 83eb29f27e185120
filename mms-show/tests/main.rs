//! The tests of this crate, as one program, so that their common parts are compiled and linked once.

mod language;
#[path = "../../tests/support/sampled.rs"]
mod sampled;
mod show;
