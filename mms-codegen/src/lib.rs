//! Compiles a field file into differentiated, staged code. The compiler reads text and returns text: it uses no file system, no
//! clock and no environment.
//!
//! A displacement field u(X, t) and a strain-energy density W go in; everything that follows from them (v, a, F, P, Div P, b,
//! ...) comes out as a [`Program`](mms_mechanics::Program), which the interpreter evaluates and the emitters print.
//! [`compile`](mod@compile) reads, resolves, derives and schedules; [`certify`] proves what the file claims, over the
//! [`bounds`] of formulas; [`rust`] prints the module to which `field!` expands.
//!
//! # Bounds on the input
//!
//! An input beyond a bound is refused with a diagnostic. The bounds: a file of 1 MiB, 500 levels of nesting, 100,000 nodes per
//! formula, 1000 digits and a decimal exponent of 1000 per number, 100 characters per name, and 200,000 nodes and operands for
//! the whole derivation, which `--max-nodes` changes. The parser and all passes are loops, so no text overflows the stack. Work
//! is bounded, too: see [`mms_symbolic::work`].
//!
//! # Reproducibility
//!
//! A derivation contains no floating-point number: numbers are exact rationals until code is printed or interpreted. Programs
//! and generated text depend on the input alone. They contain no path, date or machine, and no loop runs over a hash map.
//! Generated code names the compiler's version, a hash of its input (set values included), and what was selected.

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
