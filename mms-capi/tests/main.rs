//! The tests of this crate, as one program, so that shared code is compiled and linked once.

mod header;
mod programs;
#[path = "../../tests/support/sampled.rs"]
mod sampled;
