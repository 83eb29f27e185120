//! Candidates: the derived components as each rewriting writes them, and the choice among them.
//!
//! | candidate | is made by |
//! |---|---|
//! | `Derived` | nothing: as it was derived |
//! | `Nested` | `horner`: a nested form, early values innermost |
//! | `Absorbed` | `factor`, then `distribute`: common factors out, and early ones into sums |
//! | `Factored` | `factor`: common factors out |
//! | `Reduced` | `reduce`: the normal form by the identities of the motion |
//! | `ReducedThoroughly` | `reduce` with every identity of its circular functions, if there are more |
//! | `ReducedAtPoints` | `reduce` by the identities of the components' own sub-expressions, at points |
//!
//! `choose` computes the cost of each from its schedule, prefers candidates that keep their digits at a small amplitude, and
//! returns the cheapest whose bound of the rounding error is small ([`Rounding::first`]).

use crate::amplitude::Amplitude;
use crate::rounding::Rounding;
use mms_program::schedule::{Cost, cost};
use mms_symbolic::expr::{Expr, Graph};
use mms_symbolic::pass::distribute::distribute;
use mms_symbolic::pass::factor::factor;
use mms_symbolic::pass::horner::horner;
use mms_symbolic::pass::reduce::reduce;
use mms_symbolic::pass::relations::{Relations, latest_stage};
use mms_symbolic::sorted::SortedMap;

/// The largest number of operations at a point of an accurate candidate, as a multiple of the cheapest candidate's.
const MAX_COST_RATIO: usize = 2;

/// The components for each key.
pub(super) type Components<K> = SortedMap<K, Vec<Expr>>;

/// The origin of a candidate; see the table of the module.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the table of the module has them")]
pub enum Rewriting {
    Derived,
    Nested,
    Absorbed,
    Factored,
    Reduced,
    ReducedThoroughly,
    ReducedAtPoints,
}

/// All derived components, as one rewriting writes them.
#[derive(Clone, Debug)]
pub struct Candidate<K> {
    /// The rewriting that made the components.
    pub rewriting: Rewriting,
    /// The components of each key.
    pub components: SortedMap<K, Vec<Expr>>,
}

impl<K: Ord + Copy> Candidate<K> {
    /// The candidate that a pass makes of all components together, so that common parts are rewritten once; `None` if it
    /// outgrows the graph.
    fn by(
        graph: &mut Graph,
        rewriting: Rewriting,
        derived: &Components<K>,
        pass: impl FnOnce(&mut Graph, &[Expr]) -> Vec<Expr>,
    ) -> Option<Self> {
        let mut all = graph.attempt(|graph| pass(graph, &flat(derived)))?.into_iter();
        let own = |of: &Vec<Expr>, all: &mut std::vec::IntoIter<Expr>| all.take(of.len()).collect();
        let components = derived.iter().map(|(key, of)| (*key, own(of, &mut all))).collect();
        Some(Candidate { rewriting, components })
    }
}

fn flat<K>(components: &Components<K>) -> Vec<Expr> {
    components.values().flatten().copied().collect()
}

/// The candidates in which no sum is multiplied out.
pub(super) fn unexpanded<K: Ord + Copy>(
    graph: &mut Graph,
    derived: &Components<K>,
) -> Vec<Candidate<K>> {
    let mut all = vec![Candidate { rewriting: Rewriting::Derived, components: derived.clone() }];
    all.extend(Candidate::by(graph, Rewriting::Nested, derived, |graph, components| {
        horner(graph, components, &latest_stage)
    }));
    all.extend(Candidate::by(graph, Rewriting::Absorbed, derived, |graph, components| {
        let factored = factor(graph, components);
        distribute(graph, &factored)
    }));
    all.extend(Candidate::by(graph, Rewriting::Factored, derived, factor));
    all
}

/// The normal form by some identities, if there are any; `None` without identities.
pub(super) fn reduced<K: Ord + Copy>(
    graph: &mut Graph,
    rewriting: Rewriting,
    derived: &Components<K>,
    relations: &Relations,
) -> Option<Candidate<K>> {
    if relations.is_empty() {
        return None;
    }
    Candidate::by(graph, rewriting, derived, |graph, components| {
        reduce(graph, components, relations)
    })
}

/// Every candidate, given the identities of the motion.
pub fn candidates<K: Ord + Copy>(
    graph: &mut Graph,
    derived: &SortedMap<K, Vec<Expr>>,
    relations: &Relations,
) -> Vec<Candidate<K>> {
    let mut all = unexpanded(graph, derived);
    let own = Relations::find(graph, &flat(derived)).at_points(graph);
    let thorough = relations.thorough();
    all.extend(reduced(graph, Rewriting::Reduced, derived, relations));
    all.extend(thorough.and_then(|it| reduced(graph, Rewriting::ReducedThoroughly, derived, &it)));
    all.extend(reduced(graph, Rewriting::ReducedAtPoints, derived, &own));
    all
}

/// The required accuracy of a candidate.
#[derive(Clone, Copy)]
pub(super) struct RequiredAccuracy<'a> {
    /// The parameter with which the motion vanishes, if digits must be kept at small values of it.
    pub amplitude: Option<&'a Amplitude>,
    /// The places where bounds of the rounding error are compared; none if only the cost counts.
    pub rounding: &'a Rounding,
}

impl RequiredAccuracy<'_> {
    /// Whether components keep their digits at small amplitudes.
    pub fn is_kept(self, graph: &Graph, components: &[Expr]) -> bool {
        self.amplitude.is_none_or(|amplitude| amplitude.keeps(graph, components))
    }

    /// Whether `after` is about as accurate as `before`, which has the same values.
    pub fn allows(self, graph: &Graph, before: &[Expr], after: &[Expr]) -> bool {
        self.is_kept(graph, after) && self.rounding.allows(graph, before, after)
    }
}

/// The chosen candidate for each key; if the budget is spent, the derived components.
pub(super) fn choose_all<K: Ord + Copy>(
    graph: &Graph,
    derived: &Components<K>,
    candidates: &[Candidate<K>],
    accuracy: RequiredAccuracy<'_>,
) -> Components<K> {
    let chosen = |(key, own): (&K, &Vec<Expr>)| {
        let ways = candidates.iter().filter_map(|it| it.components.get(key));
        let chosen = match graph.work().is_over() {
            true => None,
            false => choose(graph, ways.map(Vec::as_slice).collect(), accuracy),
        };
        (*key, chosen.map_or_else(|| own.clone(), <[Expr]>::to_vec))
    };
    derived.iter().map(chosen).collect()
}

/// The cheapest accurate one of several forms of the same values; of equals, the first.
fn choose<'a>(
    graph: &Graph,
    mut ways: Vec<&'a [Expr]>,
    accuracy: RequiredAccuracy<'_>,
) -> Option<&'a [Expr]> {
    let mut costs = SortedMap::<&[Expr], Cost>::new();
    for way in &ways {
        costs.get_or_insert_with(way, || cost(graph, way));
    }
    ways.sort_by_key(|way| costs[way]);
    ways.dedup();
    let is_kept = |way: &&[Expr]| accuracy.is_kept(graph, way);
    if ways.iter().any(&is_kept) {
        ways.retain(is_kept);
    }
    let least = costs[ways.first()?].per_point;
    ways.retain(|way| costs[way].per_point <= MAX_COST_RATIO * least);
    accuracy.rounding.first(graph, &ways)
}
