//! Builds the tree from tokens, by operator precedence.
//!
//! The parser alternates between two states: before an operand, and after one. Operators wait on an explicit stack until one
//! that binds less tightly follows, so no text can overflow the machine's stack.

use std::iter::Peekable;
use std::ops::Range;
use std::slice;

use super::ast::{Ast, Node, NodeKind, Operator};
use super::lexer::{Token, TokenKind, tokens};
use crate::diagnostic::{Diagnostic, quoted};
use crate::formula::Formula;
use crate::language::power_of_function;
use crate::source::{Span, Spanned};

/// The largest number of parentheses, calls and operators that may be open at once.
pub const MAX_DEPTH: usize = 500;

/// The largest number of nodes of an expression.
pub const MAX_NODES: usize = 100_000;

/// Parses a formula. Reports mistakes and returns `None` if there is one; for a formula whose mistake has been reported it
/// returns `None` and reports nothing.
pub fn parse(formula: &Formula, diagnostics: &mut Vec<Diagnostic>) -> Option<Ast> {
    if formula.is_reported() {
        return None;
    }
    let tokens = tokens(formula, diagnostics)?;
    let mut parser =
        Parser { formula, nodes: Vec::new(), operands: Vec::new(), waiting: Vec::new() };
    match parser.run(&tokens) {
        Ok(()) => Some(Ast { nodes: parser.nodes }),
        Err(diagnostic) => {
            diagnostics.push(*diagnostic);
            None
        }
    }
}

/// A mistake ends the parse: interpreting the text after it would be guesswork.
type ParseResult<T = ()> = Result<T, Box<Diagnostic>>;

/// The tokens ahead.
type Rest<'a> = Peekable<slice::Iter<'a, Token>>;

/// A finished part of the expression.
#[derive(Clone)]
struct Operand {
    node: usize,
    /// The bytes of its text, parentheses included.
    range: Range<usize>,
}

/// An operator or parenthesis that waits for its right side or its end.
enum Waiting {
    /// A minus sign at this byte.
    Negate(usize),
    Binary(Operator),
    /// A `(` of a group.
    Group(Range<usize>),
    /// A function's name and its `(`; the arguments are the operands from `first` on.
    Call {
        name: Range<usize>,
        open: Range<usize>,
        first: usize,
    },
}

impl Waiting {
    /// The precedence; no operator takes an operand out of a parenthesis.
    fn strength(&self) -> u8 {
        match self {
            Waiting::Group(_) | Waiting::Call { .. } => 0,
            Waiting::Binary(operator) => strength(*operator),
            Waiting::Negate(_) => 3,
        }
    }
}

fn strength(operator: Operator) -> u8 {
    match operator {
        Operator::Add | Operator::Subtract => 1,
        Operator::Multiply | Operator::Divide => 2,
        Operator::Power => 4,
    }
}

struct Parser<'a> {
    formula: &'a Formula,
    nodes: Vec<Node>,
    operands: Vec<Operand>,
    waiting: Vec<Waiting>,
}

impl Parser<'_> {
    fn run(&mut self, tokens: &[Token]) -> ParseResult {
        let mut rest = tokens.iter().peekable();
        let mut needs_operand = true;
        while let Some(token) = rest.next() {
            needs_operand =
                if needs_operand { self.operand(token, &mut rest)? } else { self.operator(token)? };
        }
        Ok(())
    }

    /// Reads a token where an operand must begin. Returns whether one must still begin.
    fn operand(&mut self, token: &Token, rest: &mut Rest<'_>) -> ParseResult<bool> {
        let range = token.range.clone();
        match &token.kind {
            TokenKind::Number(value) => {
                self.leaf(NodeKind::Number(value.clone()), range).map(|()| false)
            }
            TokenKind::Name => match rest.next_if(|next| next.kind == TokenKind::Open) {
                Some(open) => {
                    let (open, first) = (open.range.clone(), self.operands.len());
                    self.wait(Waiting::Call { name: range, open, first }).map(|()| true)
                }
                None => self.leaf(NodeKind::Name(self.text(range.clone())), range).map(|()| false),
            },
            TokenKind::Operator(Operator::Subtract) => {
                self.wait(Waiting::Negate(range.start)).map(|()| true)
            }
            TokenKind::Open => self.wait(Waiting::Group(range)).map(|()| true),
            TokenKind::Close if self.is_empty_call() => self.close(range).map(|()| false),
            _ => Err(self.expected_operand(token)),
        }
    }

    /// Reads a token after an operand. Returns whether an operand must follow it.
    fn operator(&mut self, token: &Token) -> ParseResult<bool> {
        let range = token.range.clone();
        match &token.kind {
            TokenKind::Operator(operator) => {
                // Power associates to the right: an equally strong one stays on the stack.
                let least = strength(*operator) + u8::from(*operator == Operator::Power);
                self.reduce(least)?;
                self.wait(Waiting::Binary(*operator)).map(|()| true)
            }
            TokenKind::Close => self.close(range).map(|()| false),
            TokenKind::Comma => self.comma(range).map(|()| true),
            TokenKind::End => self.end().map(|()| false),
            _ => Err(self.expected_operator(token)),
        }
    }

    fn text(&self, range: Range<usize>) -> String {
        self.formula.text[range].into()
    }

    fn error(&self, range: Range<usize>, message: impl Into<String>) -> Diagnostic {
        Diagnostic::error(self.formula.span_of(range), message)
    }

    fn leaf(&mut self, kind: NodeKind, range: Range<usize>) -> ParseResult {
        let span = self.formula.span_of(range.clone());
        self.push(kind, span, range)
    }

    /// Adds a node as an operand. `range` is the text of the operand, parentheses included.
    fn push(&mut self, kind: NodeKind, span: Span, range: Range<usize>) -> ParseResult {
        if self.nodes.len() >= MAX_NODES {
            let message = format!("this expression has more than {MAX_NODES} terms");
            return Err(Box::new(
                self.error(range, message)
                    .label("the limit is reached here")
                    .help("give names to its parts in [let]"),
            ));
        }
        self.operands.push(Operand { node: self.nodes.len(), range });
        self.nodes.push(Node { kind, span });
        Ok(())
    }

    fn wait(&mut self, waiting: Waiting) -> ParseResult {
        if self.waiting.len() < MAX_DEPTH {
            self.waiting.push(waiting);
            return Ok(());
        }
        let range = match waiting {
            Waiting::Negate(start) => start..start + 1,
            Waiting::Group(open) | Waiting::Call { name: open, .. } => open,
            Waiting::Binary(_) => {
                self.operands.last().map_or(0..0, |operand| operand.range.clone())
            }
        };
        let message = format!("this expression is nested more than {MAX_DEPTH} deep");
        Err(Box::new(
            self.error(range, message)
                .label("the limit is reached here")
                .help("give names to its parts in [let]"),
        ))
    }

    /// Builds the nodes of all operators on top of the stack that bind at least this tightly.
    fn reduce(&mut self, least: u8) -> ParseResult {
        while let Some(waiting) = self.waiting.pop_if(|waiting| waiting.strength() >= least) {
            let Some(right) = self.operands.pop() else { break };
            let (kind, range) = match waiting {
                Waiting::Negate(start) => (NodeKind::Negate(right.node), start..right.range.end),
                Waiting::Binary(operator) => {
                    let Some(left) = self.operands.pop() else { break };
                    let kind = NodeKind::Binary(operator, left.node, right.node);
                    (kind, left.range.start..right.range.end)
                }
                Waiting::Group(_) | Waiting::Call { .. } => break,
            };
            self.leaf(kind, range)?;
        }
        Ok(())
    }

    /// Whether a `)` here ends a call without arguments.
    fn is_empty_call(&self) -> bool {
        let Some(Waiting::Call { first, .. }) = self.waiting.last() else { return false };
        *first == self.operands.len()
    }

    fn close(&mut self, range: Range<usize>) -> ParseResult {
        self.reduce(1)?;
        match self.waiting.pop() {
            Some(Waiting::Group(open)) => {
                if let Some(operand) = self.operands.last_mut() {
                    operand.range = open.start..range.end;
                }
                Ok(())
            }
            Some(Waiting::Call { name, first, .. }) => {
                let arguments = self.operands.drain(first..).map(|operand| operand.node).collect();
                let span = self.formula.span_of(name.clone());
                let called = Spanned { value: self.text(name.clone()), span };
                self.leaf(NodeKind::Call { name: called, arguments }, name.start..range.end)
            }
            _ => Err(Box::new(
                self.error(range, "this `)` closes nothing").label("there is no `(` for it"),
            )),
        }
    }

    fn comma(&mut self, range: Range<usize>) -> ParseResult {
        self.reduce(1)?;
        match self.waiting.last() {
            Some(Waiting::Call { .. }) => Ok(()),
            _ => Err(Box::new(
                self.error(range, "unexpected `,`")
                    .label("only the arguments of a function are separated by commas")
                    .help("a decimal number has a point: `0.5`"),
            )),
        }
    }

    fn end(&mut self) -> ParseResult {
        self.reduce(1)?;
        match self.waiting.last() {
            Some(Waiting::Group(open) | Waiting::Call { open, .. }) => Err(Box::new(
                self.error(open.clone(), "this `(` is never closed")
                    .label("there is no `)` for it"),
            )),
            _ => Ok(()),
        }
    }

    fn expected_operand(&self, token: &Token) -> Box<Diagnostic> {
        let is_empty = self.operands.is_empty() && self.waiting.is_empty();
        if token.kind == TokenKind::End && is_empty {
            let diagnostic = Diagnostic::error(self.formula.span, "this formula is empty");
            return Box::new(diagnostic.label("expected an expression").help("zero is `\"0\"`"));
        }
        let found = self.found(token);
        let diagnostic = self
            .error(token.range.clone(), format!("expected a number, a name or `(`, found {found}"));
        Box::new(match token.kind {
            TokenKind::Operator(Operator::Add) => {
                diagnostic.label("a `+` needs something to its left")
            }
            TokenKind::Operator(_) => diagnostic.label("this operator needs something to its left"),
            TokenKind::Close | TokenKind::Comma | TokenKind::End => {
                diagnostic.label("something is missing before this")
            }
            _ => diagnostic,
        })
    }

    fn expected_operator(&self, token: &Token) -> Box<Diagnostic> {
        let found = self.found(token);
        let before = self.formula.text.get(..token.range.start);
        let help = before.and_then(power_of_function);
        let help =
            help.unwrap_or_else(|| "a product needs its sign: `2*X`, not `2 X` or `2X`".into());
        Box::new(
            self.error(token.range.clone(), format!("expected an operator before {found}"))
                .label("not connected to what is before it")
                .help(help),
        )
    }

    fn found(&self, token: &Token) -> String {
        match token.kind {
            TokenKind::End => "the end of the formula".into(),
            _ => quoted(&self.formula.text[token.range.clone()]),
        }
    }
}
