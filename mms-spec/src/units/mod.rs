//! Units of measurement: reads them, and checks that formulas agree with them.
//!
//! Units are optional. A written unit must be valid ([`Unit::parse`]); it is parsed like a formula, to the exponents of the
//! seven base dimensions and the size of each symbol, a power of 10 times one of 60. If all parameters of a file have a unit,
//! the units must belong to one system ([`system`]), and dimensions are inferred through every operation of its formulas
//! ([`Formulas`]), from the text as written: so a message can underline the very term that is wrong.
//!
//! No value is changed. A unit defines the meaning of a number; numbers are used as written, so a file may use metres or
//! millimetres, but not both.

mod check;
mod dimension;
mod infer;
mod known;
mod message;
mod parse;
pub mod system;

pub use check::check;
pub use dimension::{BASE, Dimension};
pub use infer::{ExpectedDimension, Formulas, Measure};
pub use parse::{Symbol, Unit};
