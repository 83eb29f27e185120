//! Compiles a field file into differentiated, staged code. Text in, text out: no file system, no
//! clock, no environment.
//!
//! A displacement field u(X, t) and a strain-energy density W go in; everything that follows from
//! them (v, a, F, P, Div P, b, ...) comes out as a [`Program`](mms_mechanics::Program), which the interpreter
//! evaluates and the emitters print. [`compile`] reads, resolves, derives and schedules; [`certify`] proves what the
//! file claims, over the [`bounds`] of formulas; [`rust`] prints the module that `field!` is.

pub mod bounds;
pub mod certify;
pub mod compile;
pub mod culprit;
pub mod declared;
mod driver;
pub mod liveness;
pub mod materials;
pub mod rust;
pub mod selection;
pub mod variation;

pub use compile::{Compiled, Options};
pub use driver::{compile, compile_with};
pub use mms_spec::quantity::Quantity;
pub use selection::Selection;
