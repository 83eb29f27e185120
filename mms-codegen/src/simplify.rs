//! Simplification: of several expressions of the same value, the cheapest to compute.
//!
//! No way of writing a quantity is best for all. So several are made, each by passes that keep the
//! value, and every quantity takes the one that costs least. What is declared as cost thus never
//! grows.

use std::collections::BTreeMap;

use crate::expr::{Expr, Graph};
use crate::mechanics::rigid::RigidMotion;
use crate::mechanics::{Derivation, Model, derive};
use crate::pass::nest::nest;
use crate::pass::reduce::reduce;
use crate::pass::relations::{Relations, lateness};
use crate::program::schedule::{Cost, cost};
use crate::quantity::Quantity;

/// Simplifies those quantities of a derivation without relations that are wanted, and its
/// responses; other quantities stay as they are.
pub fn simplify(
    graph: &mut Graph,
    model: &Model,
    plain: &Derivation,
    wanted: impl Fn(Quantity) -> bool,
) -> Derivation {
    let relations = Relations::find(graph, &model.displacement);
    let of_wanted = |mut quantities: BTreeMap<Quantity, Vec<Expr>>| {
        quantities.retain(|quantity, _| wanted(*quantity));
        quantities
    };
    let mut forms = vec![of_wanted(plain.quantities.clone())];
    if !relations.is_empty() {
        // Relations that are used early keep the motion short, and all that follows from it.
        let reduced = graph.attempt(|graph| derive(graph, model, &relations));
        forms.extend(reduced.and_then(Result::ok).map(|reduced| of_wanted(reduced.quantities)));
    }
    let mut quantities = plain.quantities.clone();
    quantities.extend(cheapest(graph, forms, &relations));
    Derivation {
        quantities,
        responses: cheapest(graph, vec![plain.responses.clone()], &Relations::default()),
    }
}

/// The rigid twins of a derivation without relations and of its simplified form, the second one no
/// dearer than the first.
pub fn twins(
    graph: &mut Graph,
    rigid: &RigidMotion,
    [plain, simplified]: [&Derivation; 2],
) -> (Derivation, Derivation) {
    let [plain, simplified] = [plain, simplified].map(|inner| rigid.compose(graph, inner));
    let forms = vec![plain.quantities.clone(), simplified.quantities];
    let quantities = cheapest(graph, forms, &Relations::default());
    (plain, Derivation { quantities, responses: simplified.responses })
}

/// The cheapest components for every key, of which some forms are known; of equals, the first.
fn cheapest<K: Ord>(
    graph: &mut Graph,
    forms: Vec<BTreeMap<K, Vec<Expr>>>,
    relations: &Relations,
) -> BTreeMap<K, Vec<Expr>> {
    let mut written = Vec::new();
    for form in &forms {
        let components: Vec<Expr> = form.values().flatten().copied().collect();
        written.extend(ways(graph, components, relations));
    }
    let mut position = 0;
    let mut best = BTreeMap::new();
    for (key, components) in forms.into_iter().next().unwrap_or_default() {
        let range = position..position + components.len();
        position = range.end;
        let mut costs = BTreeMap::<&[Expr], Cost>::new();
        let cheapest = written
            .iter()
            .map(|way| &way[range.clone()])
            .min_by_key(|way| *costs.entry(way).or_insert_with(|| cost(graph, way)));
        best.insert(key, cheapest.map(<[Expr]>::to_vec).unwrap_or(components));
    }
    best
}

/// Expressions as they are, and rewritten; what would outgrow the graph is left out.
///
/// They are rewritten together, since what they have in common is then rewritten once.
pub fn ways(graph: &mut Graph, components: Vec<Expr>, relations: &Relations) -> Vec<Vec<Expr>> {
    let mut ways = vec![components.clone()];
    ways.extend(graph.attempt(|graph| nest(graph, &components, &lateness)));
    let among = Relations::find(graph, &components).at_points(graph);
    let all = [Some(relations.clone()), relations.thorough(), Some(among)];
    for relations in all.into_iter().flatten().filter(|relations| !relations.is_empty()) {
        ways.extend(graph.attempt(|graph| reduce(graph, &components, &relations)));
    }
    ways
}
