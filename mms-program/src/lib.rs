//! The staged, value-numbered form that is interpreted and emitted.
//!
//! A program is straight-line code over a small closed set of operations: `Constant`, `Pi`, `Input`, `Add`,
//! `Subtract`, `Multiply`, `Divide`, `Negate`, `Unary`, `Binary`. An operation on the same operands is one value.
//! A program knows no mechanics and no target language. The interpreter, and what prints an operation in a language, match on
//! operations without a wildcard.
//!
//! Every value has a [`Stage`] (its binding time), the earliest at which all it needs is known. Instructions stand
//! in order of stage, operands first, and a quantity computes only what it needs:
//!
//! | stage | needs | in generated Rust |
//! |---|---|---|
//! | `Parameter` | parameters | `prepare(&parameters)`, once |
//! | `Time` | and t | `.at_time(t)`, once per step |
//! | `Point` | parameters and X | with the next, in each function of a point |
//! | `PointTime` | X and t, or what a caller supplies at a point | `.body_force(x)`, ... |
//!
//! Values of the first two stages are kept in structs, run in `Scalar::Wide`, which has twice the digits, and are
//! rounded when they are done: that costs nothing per point. Values of the stage Point are computed with the last,
//! or kept too: `.at_point(x)` makes a `Point` of what X determines, and `.body_force_at(&point)` continues from
//! there, to the same bits.
//!
//! The interpreter and the emitted code run the same program and round constants in the same way: they agree bit
//! for bit, and a test holds them to it. The interpreter is generic in the scalar:
//!
//! | scalar | where | for |
//! |---|---|---|
//! | `f32`, `f64` | `interpret` | numbers |
//! | 256-bit binary floating point, or undefined | `precise` | closed forms, and the reference of tests |
//! | interval of `f64`, rounded outward, and whether it is defined on all of a box | `interval` | bounds over a box |
//! | dual number over any of them | `dual` | derivatives by a route without expressions |
//! | dual numbers of several directions, with one value, over bounds | `fan` | dP/dF of certificates |
//!
//! The caller names the outputs by keys of its own.

pub mod block;
pub mod computed;
pub mod dual;
mod effort;
pub mod fan;
pub mod fusion;
pub mod interpret;
pub mod interval;
pub mod loops;
pub mod precise;
pub mod precision;
mod program;
pub mod schedule;

pub use mms_symbolic::expr::Stage;
pub use program::{Instr, Key, Op, Program, Value, unary_name};
