//! Parses the text of a [`Formula`](crate::formula::Formula) to an [`Ast`].
//!
//! Numbers are exact decimals. `^` associates to the right and binds tighter than unary minus, so that `-x^2` is `-(x^2)`; its
//! right side may have a sign, as in `2^-3`. `*` and `/` come next, then `+` and `-`, all to the left. Names and functions are
//! not looked up here.
//!
//! No text can overflow the stack or exhaust memory: nothing recurses, and nesting, nodes and numbers are bounded
//! ([`MAX_DEPTH`], [`MAX_NODES`], [`MAX_DIGITS`], [`MAX_EXPONENT`]). An expression beyond a bound is refused with a diagnostic.

mod ast;
mod lexer;
mod number;
mod parser;

pub use ast::{Ast, Node, NodeKind, Operator};
pub use number::{MAX_DIGITS, MAX_EXPONENT};
pub use parser::{MAX_DEPTH, MAX_NODES, parse};

#[cfg(test)]
mod tests;
