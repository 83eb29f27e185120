//! Takes out common factors of all terms of a sum: a x + a y = a (x + y).
//!
//! The rule saves multiplications, unless it splits a product that is needed elsewhere as a whole; `simplify`, in mechanics,
//! only uses its result if it costs no more. It also merges the remaining terms, so that (1 + j) (m/(1 + j) + l/(1 + j))
//! becomes m + l.

use super::substitute::rebuild;
use crate::expr::{Expr, Graph, Node, Rational, is_negative};
use crate::sorted::SortedMap;

/// Bases with their exponents.
type Powers = Vec<(Expr, Rational)>;

/// The largest number of times that common factors are taken out of one sum: terms may merge after each time, and have common
/// factors again. Further common factors stay in the sum.
const DEPTH: usize = 64;

/// `roots` with common factors taken out of every sum below them.
pub fn factor(graph: &mut Graph, roots: &[Expr]) -> Vec<Expr> {
    rebuild(graph, roots, |graph, node| {
        let made = graph.remake(node);
        factor_sum(graph, made)
    })
}

fn factor_sum(graph: &mut Graph, expr: Expr) -> Expr {
    let mut outer = Vec::new();
    let mut inner = expr;
    // Separate terms may merge inside, and have common factors again.
    for _ in 0..DEPTH {
        let Some((common, rest)) = take_common(graph, inner) else { break };
        outer.extend(common);
        inner = rest;
    }
    if outer.is_empty() {
        return expr;
    }
    outer.push((inner, Rational::ONE));
    graph.product(outer)
}

/// The sum of terms, with common factors taken out before the terms can merge: where d = R - 1 is
/// a sum, a d + b d^3 is d (a + b d^2) and not a R - a + b d^3.
pub(super) fn factored_sum(graph: &mut Graph, terms: Vec<(Expr, Rational)>) -> Expr {
    let primitive = terms
        .into_iter()
        .map(|(term, coefficient)| {
            let (content, primitive) = graph.split_content(term);
            (primitive, content * coefficient)
        })
        .collect();
    match take_common_of(graph, primitive) {
        Ok((mut factors, rest)) => {
            factors.push((rest, Rational::ONE));
            graph.product(factors)
        }
        Err(terms) => graph.sum(terms),
    }
}

/// The powers that every term of a sum has, and the sum without them.
fn take_common(graph: &mut Graph, expr: Expr) -> Option<(Powers, Expr)> {
    let Node::Sum(constant, terms) = graph.node(expr) else { return None };
    if !constant.is_zero() {
        return None;
    }
    let terms = terms.clone();
    take_common_of(graph, terms).ok()
}

/// The powers that all of `terms` have, and their sum without them, or the unchanged terms.
fn take_common_of(
    graph: &mut Graph,
    terms: Vec<(Expr, Rational)>,
) -> Result<(Powers, Expr), Vec<(Expr, Rational)>> {
    if terms.len() < 2 {
        return Err(terms);
    }
    let mut common = powers(graph, terms[0].0);
    for (term, _) in &terms[1..] {
        let other = powers(graph, *term);
        common = common
            .into_iter()
            .filter_map(|(base, exponent)| {
                let exponent = shared(&exponent, other.get(&base)?)?;
                Some((base, exponent))
            })
            .collect();
    }
    if common.is_empty() {
        return Err(terms);
    }
    let divisor: Vec<_> = common.iter().map(|(base, power)| (*base, -power.clone())).collect();
    let mut rest = Vec::new();
    for (term, coefficient) in terms {
        let mut factors = divisor.clone();
        factors.push((term, Rational::ONE));
        rest.push((graph.product(factors), coefficient));
    }
    let rest = graph.sum(rest);
    Ok((common.into_iter().collect(), rest))
}

/// The powers that can be taken out of a term. A base that is 0 cannot.
fn powers(graph: &Graph, term: Expr) -> SortedMap<Expr, Rational> {
    match graph.node(term) {
        Node::Product(factors) => {
            factors.iter().filter(|(base, _)| !graph.is_zero(*base)).cloned().collect()
        }
        _ => SortedMap::from([(term, Rational::ONE)]),
    }
}

/// The common part of two powers of one base. Powers of opposite sign have none.
fn shared(a: &Rational, b: &Rational) -> Option<Rational> {
    let same_sign = is_negative(a) == is_negative(b);
    same_sign.then(|| a.min(b).clone())
}
