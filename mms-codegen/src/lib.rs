//! Compiles a field file into differentiated, staged code. Text in, text out: no file system, no
//! clock, no environment.
//!
//! A displacement field u(X, t) and a strain-energy density W go in; everything that follows from
//! them (v, a, F, P, Div P, b, ...) comes out as a [`program::Program`], which the interpreter
//! evaluates and the emitters print. The phases, each a function from the last one's output, are
//! the body of [`compile()`].

pub mod accuracy;
pub mod certify;
pub mod compile;
pub mod culprit;
#[cfg(feature = "defects")]
pub mod defect;
#[cfg(not(feature = "defects"))]
mod defect;
pub mod diagnostic;
pub mod emit;
pub mod expr;
pub mod foreign;
pub mod mechanics;
pub mod operations;
pub mod pass;
pub mod period;
pub mod program;
pub mod quantity;
pub mod sample;
pub mod selection;
pub mod show;
pub mod simplify;
pub mod source;
pub mod spec;
pub mod suggest;
pub mod syntax;
pub mod twin;
pub mod units;
pub mod variation;
pub mod visibility;
pub mod work;

pub use compile::{Compiled, Options, compile, compile_with};
pub use selection::Selection;
