//! Simplification: cheaper expressions of the same value. What is declared as their cost never
//! grows.

use std::collections::BTreeMap;

use crate::expr::{Expr, Graph};
use crate::mechanics::Derivation;
use crate::pass::factor::factor;
use crate::program::schedule::schedule;
use crate::program::{Output, Stage};

/// Simplifies the components of every quantity and response.
pub fn simplify(graph: &mut Graph, derivation: Derivation) -> Derivation {
    Derivation {
        quantities: simplify_each(graph, derivation.quantities),
        responses: simplify_each(graph, derivation.responses),
    }
}

fn simplify_each<K: Ord>(
    graph: &mut Graph,
    outputs: BTreeMap<K, Vec<Expr>>,
) -> BTreeMap<K, Vec<Expr>> {
    outputs.into_iter().map(|(key, plain)| (key, cheaper(graph, plain))).collect()
}

/// The components with common factors taken out, or as they are where that costs no more.
pub fn cheaper(graph: &mut Graph, plain: Vec<Expr>) -> Vec<Expr> {
    let factored = factor(graph, &plain);
    if graph.is_exhausted() {
        return plain;
    }
    if cost(graph, &factored) <= cost(graph, &plain) { factored } else { plain }
}

/// What components cost together: operations that depend on X first, since they are done at every
/// point, then all operations.
pub fn cost(graph: &Graph, components: &[Expr]) -> (usize, usize) {
    // The name of the output does not matter for its cost.
    let output = Output::Expected(0);
    let program = schedule(graph, &BTreeMap::from([(output, components.to_vec())]));
    let counts = program.operations(&[output]);
    (counts[&Stage::Point] + counts[&Stage::PointTime], counts.values().sum())
}
