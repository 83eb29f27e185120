//! Distributes constant factors: multiplies what parameters determine into sums whose terms have such factors
//! already.
//!
//! With a, b and c of parameters, a (b + c s) becomes a b + (a c) s, whose products are formed once and not at
//! every point. What t determines is left where it is: it tells components apart, which then share less.

use super::substitute::rebuild;
use crate::expr::{Expr, Graph, Node, Rational, Stage};

/// How often it is tried: a factor that went into a sum may go on into the sums of its terms.
const DEPTH: usize = 4;

/// `roots` with factors that are known early taken into the sums they multiply.
pub fn absorb(graph: &mut Graph, roots: &[Expr]) -> Vec<Expr> {
    let mut roots = roots.to_vec();
    for _ in 0..DEPTH {
        roots = rebuild(graph, &roots, |graph, node| match node {
            Node::Product(factors) => absorbed(graph, factors),
            other => graph.remake(other),
        });
    }
    roots
}

/// A product, its early factors in the first of its sums that can take them at no cost.
fn absorbed(graph: &mut Graph, factors: Vec<(Expr, Rational)>) -> Expr {
    let product = graph.product(factors);
    // Sums put a number in front of a product that they normalise.
    let (coefficient, bare) = match graph.node(product).clone() {
        Node::Sum(constant, terms) if constant.is_zero() && terms.len() == 1 => {
            (terms[0].1.clone(), terms[0].0)
        }
        _ => (Rational::ONE, product),
    };
    let Node::Product(factors) = graph.node(bare).clone() else { return product };
    let (early, mut late): (Vec<_>, Vec<_>) =
        factors.into_iter().partition(|(factor, _)| is_early(graph, *factor));
    let taker = late.iter().position(|(base, power)| power.is_one() && takes(graph, *base));
    let (Some(taker), false) = (taker, early.is_empty()) else { return product };
    let (sum, _) = late.remove(taker);
    let Node::Sum(constant, terms) = graph.node(sum).clone() else { return product };
    let early = graph.product(early);
    let mut taken = vec![(early, constant)];
    taken.extend(terms.into_iter().map(|(term, own)| (graph.mul(early, term), own)));
    let sum = graph.sum(taken);
    late.push((sum, Rational::ONE));
    let product = graph.product(late);
    graph.scale(product, coefficient)
}

/// Whether a sum that is known late has at most one term that would need a multiplication more,
/// beside an early one, or none at all.
fn takes(graph: &Graph, sum: Expr) -> bool {
    let Node::Sum(constant, terms) = graph.node(sum) else { return false };
    let has_early_factor = |term: Expr| match graph.node(term) {
        Node::Product(factors) => factors.iter().any(|(factor, _)| is_early(graph, *factor)),
        _ => is_early(graph, term),
    };
    let early = !constant.is_zero() || terms.iter().any(|(term, _)| is_early(graph, *term));
    let bare = terms.iter().filter(|(term, _)| !has_early_factor(*term)).count();
    bare <= usize::from(early)
}

fn is_early(graph: &Graph, expr: Expr) -> bool {
    graph.stage(expr) == Stage::Parameter
}
