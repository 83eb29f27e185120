//! The tests of this crate, as one program, so that shared code is compiled and linked once.

mod coverage;
#[path = "../../tests/support/sampled.rs"]
mod sampled;
mod verdicts;
