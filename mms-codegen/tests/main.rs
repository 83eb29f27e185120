//! The tests of this crate, as one program, so that shared code is compiled and linked once.

mod arbitrary_text;
mod axisymmetric;
mod bodies;
mod branches;
mod certify;
mod diagnostics;
mod faces;
mod given;
mod growth;
mod language;
mod materials;
mod mechanics;
mod memory;
mod offset;
mod operations;
mod pass;
#[path = "../../tests/support/sampled.rs"]
mod sampled;
mod selection;
mod solid;
mod stable;
#[path = "support/survive.rs"]
mod survive;
mod work;
