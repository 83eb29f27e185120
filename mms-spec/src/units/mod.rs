//! Units of measurement: what a file says about them, and whether its formulas agree.
//!
//! Units are optional. A unit that is written must be one ([`Unit::parse`]); it is parsed as a formula is, to the
//! exponents of the seven base dimensions and the size of each symbol, a power of 10 times one of 60. Where all
//! parameters of a file have a unit, the units must belong to one system ([`system`]), and dimensions are inferred
//! through every operation of its formulas ([`Formulas`]), from the text as it stands: a message can so underline
//! the very term that is wrong.
//!
//! Nothing here changes a value. A unit says what a number means; numbers are computed with as they are written,
//! so a file may use metres or millimetres, but not both.

mod check;
mod dimension;
mod infer;
mod known;
mod message;
mod parse;
pub mod system;

pub use check::check;
pub use dimension::{BASE, Dimension};
pub use infer::{Expected, Formulas, Measure};
pub use parse::{Symbol, Unit};
