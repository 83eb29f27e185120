//! Staged straight-line programs over a small closed set of operations.
//!
//! Every value of a [`Program`] carries its [`Stage`]; the instructions stand in order of stage, operands first. The caller
//! names the outputs by keys of its own. [`schedule`] makes a program of expressions; [`interpret`] runs it at a point in
//! any [`Number`](interpret::Number), and [`block`] at many points. A program knows no mechanics and no target language.

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
pub use program::{Instr, Key, Op, Program, Value};
