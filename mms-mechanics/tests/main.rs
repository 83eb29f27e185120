//! The tests of this crate, as one program, so that what they share is compiled and linked once.

#[path = "../../tests/support/sampled.rs"]
mod sampled;
mod symbolic;
mod units;
