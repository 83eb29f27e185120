//! Emitted files, built with every warning an error and run: the check program of each port tests it.

mod axisymmetric;
mod build;
mod coverage;
mod faces;
mod fuzz;
mod gallery;
mod given;
mod literals;
mod motion;
mod names;
mod page;
#[path = "../../../tests/support/sampled.rs"]
mod sampled;
mod strict;
