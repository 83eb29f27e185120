//! Finds the sines and cosines whose angle is proved to be less than a quarter turn, so that they need no range reduction
//! (`sin_near_zero`, `cos_near_zero`), and those whose angle is at most 1, or a little more, so that fewer terms are enough
//! (`sin_within_one`, `cos_within_one`).
//!
//! The proof is for the body, the time window and the ranges of parameters, with the box, the bounds and the search of
//! certificates, in at most 128 cells and 50,000 operations. For other angles these functions are right too, only slower
//! (`mms_math::batch`). An angle that depends on a parameter without a range is left as it is, since a user may set that
//! parameter to any number; `freeze` replaces such a parameter by a number. Ports call the plain functions.

use super::chart::Chart;
use super::enclosure::Formulas;
use super::search::{Measure, largest};
use mms_mechanics::Output;
use mms_mechanics::model::Model;
use mms_program::Stage;
use mms_program::interval::Interval;
use mms_spec::FieldSpec;
use mms_symbolic::expr::{Expr, Function, Graph, Node, Small, Symbol};
use mms_symbolic::pass::substitute::rebuild;
use mms_symbolic::sorted::{SortedMap, SortedSet};

/// The magnitude that must be proved of an angle for each kind of small angle. Each is less than the limit of the functions
/// themselves (`mms_math::WITHIN_ONE` and `mms_math::NEAR_ZERO`), since a computed angle has errors.
const LIMITS: [(f64, Small); 2] = [(1.0 + 1.0 / 32.0, Small::WithinOne), (1.5, Small::NearZero)];

/// The cells that one proof may use.
const CELLS: usize = 128;
/// The operations that one proof may use.
const OPERATIONS: usize = 50_000;

/// Marks the angles of sines and cosines that are proved to be small.
pub fn near_zero(
    graph: &mut Graph,
    field: &FieldSpec,
    model: &Model,
    outputs: &mut SortedMap<Output, Vec<Expr>>,
) {
    let roots: Vec<Expr> = outputs.values().flatten().copied().collect();
    let candidates = candidates(graph, model, &roots);
    // No angle is bounded without a body.
    if candidates.is_empty() || field.domain.body.is_nothing() {
        return;
    }
    let proved: SortedMap<Expr, Small> = graph.with_temporary_nodes(|graph| {
        let chart = Chart::new(graph, field, model, None);
        let proved = |angle| Some((angle, proved(graph, &chart, angle)?));
        candidates.into_iter().filter_map(proved).collect()
    });
    for components in outputs.values_mut() {
        *components = rebuild(graph, components, |graph, node| {
            if let Node::Call(function @ (Function::Sin | Function::Cos), angle) = &node
                && let Some(small) = proved.get(&angle[0])
            {
                let angle = graph.small(*small, angle[0]);
                return graph.call(*function, &[angle]);
            }
            graph.remake(node)
        });
    }
}

/// The angles at points of the body that depend only on bounded variables.
fn candidates(graph: &Graph, model: &Model, roots: &[Expr]) -> SortedSet<Expr> {
    let is_bounded = |expr: Expr| is_bounded(graph, model, expr);
    let mut bounds = model.domain.body.values().into_iter();
    if !bounds.all(is_bounded) || !model.domain.time.into_iter().all(is_bounded) {
        return SortedSet::new();
    }
    let angle = |expr: Expr| match graph.node(expr) {
        Node::Call(Function::Sin | Function::Cos, angle) => Some(angle[0]),
        _ => None,
    };
    let at_points = |angle: &Expr| graph.stage(*angle) >= Stage::Point;
    let angles = graph.reachable(roots).into_iter().filter_map(angle);
    let may_be_asked = |_: &Expr| !graph.work().is_over();
    angles.filter(at_points).filter(may_be_asked).filter(|angle| is_bounded(*angle)).collect()
}

/// Whether the domain and the ranges of parameters bound everything that an expression depends on.
fn is_bounded(graph: &Graph, model: &Model, expr: Expr) -> bool {
    graph.symbols(expr).into_iter().all(|symbol| match symbol {
        Symbol::Parameter(index) => model.parameters[index]
            .range
            .is_some_and(|range| range.into_iter().all(|bound| is_bounded(graph, model, bound))),
        Symbol::Time | Symbol::Coordinate(_) => true,
        Symbol::Normal(_) | Symbol::Gradient(..) | Symbol::Invariant(_) | Symbol::Local(_) => false,
    })
}

/// The narrowest kind of small angle that is proved for an angle.
fn proved(graph: &mut Graph, chart: &Chart, angle: Expr) -> Option<Small> {
    let angle = chart.pull_back(graph, &[angle]);
    let formulas = Formulas::new(graph, chart, &angle);
    let (mut bounds, mut values) = (formulas.run::<Interval>(chart), formulas.run::<f64>(chart));
    let limit = (OPERATIONS / formulas.size()).min(CELLS);
    // The smallest limit that is not refuted is proved.
    let enough = |bound: f64, attained: f64| {
        LIMITS.iter().find(|(limit, _)| attained <= *limit).is_none_or(|(limit, _)| bound <= *limit)
    };
    let found = largest(chart.variables().len(), chart.limit(limit), enough, |cell| {
        let place = chart.place(&cell.0);
        let enclosure = bounds.enclose(&place);
        let angle = enclosure.values[0];
        let at = cell.centre();
        let attained = values.values(&chart.place(&at))[0].abs();
        Measure {
            bound: if angle.is_defined() { angle.farthest() } else { f64::INFINITY },
            attained: if attained.is_nan() { f64::INFINITY } else { attained },
            split: cell.steepest(&chart.changes(cell, &place, &enclosure.slopes)),
            at,
        }
    });
    LIMITS.into_iter().find_map(|(limit, small)| (found.bound <= limit).then_some(small))
}
