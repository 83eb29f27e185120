//! Multiplies out: a (x + y) = a x + a y, so that terms cancel in exact numbers before they are rounded.

use crate::expr::{Expr, Graph, Node, Rational, Symbol};

/// The largest number of terms; a longer sum stays as it is.
const MAX_TERMS: usize = 200;

/// Multiplies out the products in roots, if a factor is a sum that depends on one of `symbols`. Expressions inside functions,
/// roots and divisors stay as they are.
pub fn expand(graph: &mut Graph, roots: &[Expr], symbols: &[Symbol]) -> Vec<Expr> {
    roots.iter().map(|root| expanded(graph, *root, symbols).unwrap_or(*root)).collect()
}

/// Multiplies out one root; `None` if there would be too many terms.
fn expanded(graph: &mut Graph, root: Expr, symbols: &[Symbol]) -> Option<Expr> {
    let mut open = vec![(root, Rational::ONE)];
    let mut terms = Vec::new();
    while let Some((expr, coefficient)) = open.pop() {
        if open.len() + terms.len() > MAX_TERMS {
            return None;
        }
        match graph.node(expr).clone() {
            Node::Sum(constant, parts) => {
                terms.push((graph.number(constant), coefficient.clone()));
                open.extend(parts.into_iter().map(|(part, factor)| (part, factor * &coefficient)));
            }
            Node::Product(factors) => match sum_among(graph, &factors, symbols) {
                Some(position) => {
                    let parts = split(graph, factors, position);
                    open.extend(parts.into_iter().map(|(part, own)| (part, own * &coefficient)));
                }
                None => terms.push((expr, coefficient)),
            },
            _ => terms.push((expr, coefficient)),
        }
    }
    Some(graph.sum(terms))
}

/// The position of a factor that is a sum to a whole positive power: the last one, since it may be made of the others, so that
/// their powers are collected.
fn sum_among(graph: &Graph, factors: &[(Expr, Rational)], symbols: &[Symbol]) -> Option<usize> {
    factors.iter().rposition(|(base, exponent)| {
        let is_sum = matches!(graph.node(*base), Node::Sum(..));
        let is_whole = exponent.is_int() && *exponent > Rational::ZERO;
        is_sum && is_whole && symbols.iter().any(|symbol| graph.symbols(*base).contains(symbol))
    })
}

/// The terms of a product after one power of that factor is multiplied out.
fn split(
    graph: &mut Graph,
    mut factors: Vec<(Expr, Rational)>,
    position: usize,
) -> Vec<(Expr, Rational)> {
    let Node::Sum(constant, parts) = graph.node(factors[position].0).clone() else {
        return vec![(graph.product(factors), Rational::ONE)];
    };
    factors[position].1 -= Rational::ONE;
    let rest = graph.product(factors);
    let mut terms = vec![(rest, constant)];
    terms.extend(parts.into_iter().map(|(part, factor)| (graph.mul(rest, part), factor)));
    terms
}
