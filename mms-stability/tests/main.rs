//! The tests of this crate, as one program, so that shared code is compiled and linked once.

mod corners;
mod fibres;
mod growth;
mod impedance;
mod page;
mod pencil;
#[path = "../../tests/support/sampled.rs"]
mod sampled;
mod states;
mod support;
mod waves;
