//! The tests of this crate, as one program, so that their common parts are compiled and linked once.

mod accuracy;
mod allocations;
mod audit;
mod batch;
mod datum;
mod emitted;
mod gallery;
mod judging;
mod layers;
mod matrix;
mod operation_counts;
mod plane;
pub mod programs;
mod rigid;
#[path = "support/sampled.rs"]
mod sampled;
mod scene;
mod schema;
mod snapshots;
mod template;
mod words;
