//! Distributes constant factors: multiplies values that parameters determine into sums whose terms have such factors already.
//!
//! If a, b and c depend on parameters only, a (b + c s) becomes a b + (a c) s, whose products are computed once and not at
//! every point. Factors that t determines stay outside: they differ between components, which would then share less.

use super::substitute::rebuild;
use crate::expr::{Expr, Graph, Node, Rational, Stage};

/// The number of rounds: a factor that went into a sum may go on into the sums of its terms.
const DEPTH: usize = 4;

/// Multiplies the factors in `roots` that are known early into the sums beside them.
pub fn distribute(graph: &mut Graph, roots: &[Expr]) -> Vec<Expr> {
    let mut roots = roots.to_vec();
    for _ in 0..DEPTH {
        roots = rebuild(graph, &roots, |graph, node| match node {
            Node::Product(factors) => absorbed(graph, factors),
            other => graph.remake(other),
        });
    }
    roots
}

/// A product whose early factors are multiplied into the first of its sums where that costs nothing.
fn absorbed(graph: &mut Graph, factors: Vec<(Expr, Rational)>) -> Expr {
    let product = graph.product(factors);
    // A normalised sum puts a number in front of the product.
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

/// Whether an early factor costs nothing in a sum that is known late: at most one term would need another multiplication if the
/// sum has an early term, else none.
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
