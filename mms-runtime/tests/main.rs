//! The tests of this crate, as one program, so that what they share is compiled and linked once.

mod axisymmetric;
mod bodies;
mod boundaries;
mod common;
mod convergence;
mod dimensions;
mod failures;
mod integrators;
mod motions;
mod reference_bar;
mod reference_step;
mod relaxation;
mod restart;
#[path = "../../tests/support/sampled.rs"]
mod sampled;
mod shapes;
mod studies;
mod sums;
mod threads;
