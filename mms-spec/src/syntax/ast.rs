//! The tree of an expression, flat.

use dashu_ratio::RBig;

use crate::source::{Span, Spanned};

/// An expression in postfix order: every node follows its operands, and the root is last. Without boxes there is no deep tree
/// to walk or to drop.
#[derive(Clone, Debug)]
pub struct Ast {
    /// The nodes; never empty.
    pub nodes: Vec<Node>,
}

/// A part of an expression, and its place.
#[derive(Clone, Debug)]
pub struct Node {
    /// The kind of the node.
    pub kind: NodeKind,
    /// The place, from its first to its last character, without parentheses around it.
    pub span: Span,
}

/// The kind of a node; operands are indices into [`Ast::nodes`].
#[derive(Clone, Debug, PartialEq)]
pub enum NodeKind {
    /// An exact number.
    Number(RBig),
    /// A name, not yet looked up.
    Name(String),
    /// The negative of an operand.
    Negate(usize),
    /// An operator between two operands.
    Binary(Operator, usize, usize),
    /// A function of its arguments, not yet looked up.
    Call {
        /// The function.
        name: Spanned<String>,
        /// The arguments, in order.
        arguments: Vec<usize>,
    },
}

/// The operators with two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Operator {
    /// `+`
    Add,
    /// `-`
    Subtract,
    /// `*`
    Multiply,
    /// `/`
    Divide,
    /// `^`
    Power,
}
