//! The tests of this crate, as one program, so that shared code is compiled and linked once.

#[path = "../../tests/support/sampled.rs"]
mod sampled;
mod symbolic;
mod units;
