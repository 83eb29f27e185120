//! The tests of this crate, as one program, so that shared code is compiled and linked once.

mod block;
mod double;
mod dual;
mod functions;
mod interval;
mod multi_dual;
mod precise;
#[path = "../../tests/support/sampled.rs"]
mod sampled;
mod schedule;
