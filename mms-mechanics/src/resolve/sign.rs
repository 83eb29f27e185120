//! The sign of an expression as far as its form shows it, for defaults of parameters.

use super::Scope;
use mms_symbolic::expr::{Expr, Function, Graph, Node, Rational};
use mms_symbolic::sorted::SortedMap;

/// The sign that the form of an expression shows, where its value is defined.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Sign {
    Unknown,
    NotNegative,
    Positive,
}

impl Scope {
    /// Whether the form of an expression shows that it is positive wherever it is defined.
    pub fn is_positive(&self, graph: &Graph, root: Expr) -> bool {
        let mut signs = SortedMap::new();
        for expr in graph.reachable(&[root]) {
            let sign = self.sign(graph.node(expr), &signs);
            signs.insert(expr, sign);
        }
        signs[&root] == Sign::Positive
    }

    fn sign(&self, node: &Node, signs: &SortedMap<Expr, Sign>) -> Sign {
        match node {
            Node::Number(number) => sign_of_number(number),
            Node::Symbol(symbol) if self.positive.contains(symbol) => Sign::Positive,
            Node::Pi => Sign::Positive,
            Node::Symbol(_) => Sign::Unknown,
            Node::Sum(constant, terms) => {
                let term = |(term, coefficient): &(Expr, Rational)| match coefficient {
                    negative if *negative < Rational::ZERO => Sign::Unknown,
                    _ => signs[term],
                };
                let parts = terms.iter().map(term).chain([sign_of_number(constant)]);
                let parts: Vec<_> = parts.collect();
                match parts.contains(&Sign::Unknown) {
                    true => Sign::Unknown,
                    false => parts.into_iter().max().unwrap_or(Sign::Unknown),
                }
            }
            Node::Product(factors) => {
                let factor = |(base, exponent): &(Expr, Rational)| {
                    let is_even = exponent.is_int() && exponent.numerator() % 2i8 == 0i8;
                    // The base of a root is not negative, and neither is the root.
                    let is_root = exponent.denominator() % 2u8 == 0u8;
                    match signs[base] {
                        Sign::Positive => Sign::Positive,
                        _ if is_even || is_root => Sign::NotNegative,
                        other => other,
                    }
                };
                factors.iter().map(factor).min().unwrap_or(Sign::Unknown)
            }
            Node::Call(Function::Exp | Function::Cosh | Function::Powf, _) => Sign::Positive,
            Node::Call(Function::Sqrt | Function::Acos, _) => Sign::NotNegative,
            Node::Call(..) | Node::Offset(_) => Sign::Unknown,
            Node::Small(_, angle) => signs[angle],
        }
    }
}

fn sign_of_number(number: &Rational) -> Sign {
    if *number > Rational::ZERO {
        Sign::Positive
    } else if number.is_zero() {
        Sign::NotNegative
    } else {
        Sign::Unknown
    }
}
