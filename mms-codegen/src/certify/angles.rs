//! Sines and cosines whose angle is proved to be less than a quarter turn: nothing need be taken off it.
//!
//! The proof is for the body, the time window and the ranges of parameters. Elsewhere the functions are right
//! too, only slower (`mms_math::batch`), so an angle that depends on a parameter without a range, which may be
//! set to anything, is left as it is.

use std::collections::{BTreeMap, BTreeSet};

use super::chart::Chart;
use super::enclosure::Formulas;
use super::search::{Measure, largest};
use crate::expr::{Expr, Function, Graph, Node, Symbol};
use crate::mechanics::face;
use crate::mechanics::model::Model;
use crate::pass::substitute::rebuild;
use crate::program::interval::Interval;
use crate::program::{Output, Stage};
use crate::spec::FieldSpec;

/// What is proved of the magnitude of an angle: less than `mms_math::NEAR_ZERO`, since a computed angle has
/// errors.
const LIMIT: f64 = 1.5;

/// How many cells and operations a proof may take.
const CELLS: usize = 128;
const OPERATIONS: usize = 50_000;

/// Sines and cosines for angles near zero in place of those whose angles are proved to be.
pub fn near_zero(
    graph: &mut Graph,
    field: &FieldSpec,
    model: &Model,
    outputs: &mut BTreeMap<Output, Vec<Expr>>,
) {
    let roots: Vec<Expr> = outputs.values().flatten().copied().collect();
    let candidates = candidates(graph, model, &roots);
    if candidates.is_empty() {
        return;
    }
    let small: BTreeSet<Expr> = graph.aside(|graph| {
        let chart = Chart::new(graph, field, model, None);
        candidates.into_iter().filter(|angle| is_small(graph, &chart, *angle)).collect()
    });
    for components in outputs.values_mut() {
        *components = rebuild(graph, components, |graph, node| match node {
            Node::Call(Function::Sin, angle) if small.contains(&angle[0]) => {
                graph.call(Function::SinNearZero, &angle)
            }
            Node::Call(Function::Cos, angle) if small.contains(&angle[0]) => {
                graph.call(Function::CosNearZero, &angle)
            }
            other => graph.remake(other),
        });
    }
}

/// The angles at points of the body that depend on nothing without bounds.
fn candidates(graph: &Graph, model: &Model, roots: &[Expr]) -> BTreeSet<Expr> {
    let is_bounded = |expr: Expr| is_bounded(graph, model, expr);
    let mut bounds = face::bounds(&model.domain.body).into_iter().flatten();
    if !bounds.all(is_bounded) || !model.domain.time.into_iter().all(is_bounded) {
        return BTreeSet::new();
    }
    let angle = |expr: Expr| match graph.node(expr) {
        Node::Call(Function::Sin | Function::Cos, angle) => Some(angle[0]),
        _ => None,
    };
    let at_points = |angle: &Expr| graph.stage(*angle) >= Stage::Point;
    let angles = graph.reachable(roots).into_iter().filter_map(angle);
    angles.filter(at_points).filter(|angle| is_bounded(*angle)).collect()
}

/// Whether the domain and the ranges of parameters bound everything that an expression depends on.
fn is_bounded(graph: &Graph, model: &Model, expr: Expr) -> bool {
    graph.symbols(expr).into_iter().all(|symbol| match symbol {
        Symbol::Parameter(index) => model.parameters[index]
            .range
            .is_some_and(|range| range.into_iter().all(|bound| is_bounded(graph, model, bound))),
        Symbol::Time | Symbol::Coordinate(_) => true,
        Symbol::Normal(_) | Symbol::Gradient(..) | Symbol::Invariant(_) => false,
    })
}

fn is_small(graph: &mut Graph, chart: &Chart, angle: Expr) -> bool {
    let angle = chart.pull_back(graph, &[angle]);
    let formulas = Formulas::new(graph, chart, &angle);
    let (mut bounds, mut values) = (formulas.run::<Interval>(chart), formulas.run::<f64>(chart));
    let limit = (OPERATIONS / formulas.size()).min(CELLS);
    let enough = |bound: f64, attained: f64| bound <= LIMIT || attained > LIMIT;
    let found = largest(chart.variables().len(), limit, enough, |cell| {
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
    found.bound <= LIMIT
}
