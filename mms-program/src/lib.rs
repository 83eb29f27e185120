//! The staged, value-numbered form that is interpreted and emitted.
//!
//! A program is straight-line code over a small closed set of operations: `Constant`, `Pi`, `Input`, `Add`, `Subtract`,
//! `Multiply`, `Divide`, `Negate`, `Unary`, `Binary`. An operation on the same operands is one value. A program does not depend
//! on mechanics or a target language. The interpreter, and the printers of operations in a language, match on operations
//! without a wildcard.
//!
//! Every value has a [`Stage`] (its binding time), the earliest at which all its inputs are known. Instructions are in order of
//! stage, operands first, and a quantity runs only the instructions that it needs:
//!
//! | stage | needs | in generated Rust |
//! |---|---|---|
//! | `Parameter` | parameters | `prepare(&parameters)`, once |
//! | `Time` | and t | `.at_time(t)`, once per step |
//! | `Point` | parameters and X | computed together with `PointTime`, in each function of a point |
//! | `PointTime` | X and t, or inputs that a caller supplies at a point | `.body_force(x)`, ... |
//!
//! Values of the first two stages are stored in structs, computed in `Scalar::Wide`, which has twice the digits, and rounded at
//! the end: that costs nothing per point. Values of the stage Point are computed with the last stage, or stored too:
//! `.at_point(x)` makes a `Point` of the values that X determines, and `.body_force_at(&point)` continues from there, with the
//! same bits.
//!
//! The interpreter and the emitted code run the same program and round constants in the same way: they agree bit for bit, and a
//! test checks that. The interpreter is generic in the scalar:
//!
//! | scalar | where | for |
//! |---|---|---|
//! | `f32`, `f64` | `interpret` | numbers |
//! | 256-bit binary floating point, or undefined | `precise` | closed forms, and the reference of tests |
//! | interval of `f64`, rounded outward, and whether it is defined on all of a box | `interval` | bounds over a box |
//! | dual number over any of them | `dual` | derivatives without expressions |
//! | dual numbers of several directions, with one value, over bounds | `multi_dual` | dP/dF of certificates |
//!
//! | module | contents |
//! |---|---|
//! | `program`, `schedule` | the instructions; expressions to instructions |
//! | `interpret`, `block` | the reference interpreter, one point at a time; programs over blocks of points |
//! | `fusion`, `loops` | the products to fuse, and the loops over points; the same decisions for interpreted and emitted code |
//! | `computed`, `precision` | bounds of rounding errors of a program; the precisions that code is generated for |
//! | `operation_cost` | the number of steps that an operation subtracts from a budget |
//!
//! The caller defines the keys of the outputs.

pub mod block;
pub mod computed;
pub mod dual;
pub mod fusion;
pub mod interpret;
pub mod interval;
pub mod loops;
pub mod multi_dual;
mod operation_cost;
pub mod precise;
pub mod precision;
mod program;
pub mod schedule;

pub use mms_symbolic::expr::Stage;
pub use program::{Instr, Key, Op, Program, Value, unary_name};
