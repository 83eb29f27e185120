//! Proves that a field stays within one analytic branch of every function that it uses.
//!
//! A derivative does not show a cut: if u jumps, all derivatives may be finite and J positive. The model therefore keeps the
//! formulas of a file as they are written (`mms-mechanics/src/model/written.rs`). For each node of their canonical form, the
//! limit of its function (`limits.rs`) is proved over the body, the time window and the ranges of parameters. The same is
//! proved for W at the strain of the field, the density, the moduli, the fibres and a rigid motion. A subexpression that
//! canonical form has cancelled, such as one of `sqrt(X)*sqrt(X)`, needs only a value, and so does one without variables. All
//! other quantities follow from these formulas by derivatives and whole powers, and are analytic if they are finite.
//!
//! If a sign differs at two points of a cell, a bisection in 77 digits finds where it changes: the message names that point,
//! at the call. A limit that is neither proved nor refuted is refused as unproved.

use std::cmp::Ordering;

use mms_math::Scalar as _;

use super::finite::corners;
use super::limits::{Limit, Must, limits, limits_of};
use super::motion::ChartMotion;
use crate::bounds::chart::Chart;
use crate::bounds::enclosure::{Evaluation, Formulas};
use crate::bounds::search::{Cell, Measure, largest};
use crate::bounds::witness::Witness;
use crate::compile::Compiled;
use mms_mechanics::invariant::{InvariantKind, VOLUME};
use mms_mechanics::kinematics::Strain;
use mms_mechanics::model::{Part, Written};
use mms_mechanics::tensor::Tensor;
use mms_program::interval::Interval;
use mms_program::precise::Precise;
use mms_spec::source::Span;
use mms_symbolic::expr::{Expr, Graph, Symbol};
use mms_symbolic::pass::relations::Relations;
use mms_symbolic::pass::substitute::substitute;
use mms_symbolic::sorted::{SortedMap, SortedSet};

/// The number of bisections between two points on different sides of a limit.
const HALVINGS: usize = 60;

/// The evaluations per cell: its bounds, the bounds at its middle, and its corners.
const OF_A_CELL: usize = 4;

/// An operation that is not proved to stay within one analytic branch over the domain.
#[derive(Clone, Debug, PartialEq)]
pub struct BranchViolation {
    /// The place of the operation.
    pub span: Span,
    /// The condition that does not hold.
    pub must: Must,
    /// A point at which the condition does not hold, or near which it is not proved.
    pub witness: Witness,
    /// True if an evaluation in 77 digits refutes the condition.
    pub is_certain: bool,
}

/// The condition of an operation, in the variables of a chart.
struct Condition {
    must: Must,
    operands: Vec<Expr>,
    /// The limit from which the condition follows.
    limit: Limit,
}

/// Returns the operations that are not proved to stay within one branch, and the number of cells that the proofs used: at
/// most `cells` for each, and at most `operations` evaluated instructions in total. `motion` is the motion of a field with
/// positive J; if it is `None`, W is not examined.
pub fn violations(
    graph: &mut Graph,
    chart: &Chart,
    compiled: &Compiled,
    motion: Option<&ChartMotion>,
    [cells, operations]: [usize; 2],
) -> (Vec<BranchViolation>, usize) {
    let Written { field, energy } = &compiled.model.written;
    let mut parts = vec![(Steps::new(graph, chart, field, &compiled.model.displacement), None)];
    if let Some(motion) = motion {
        let invariants = invariants(graph, chart, compiled, motion);
        parts.push((Steps::new(graph, chart, energy, &[compiled.model.energy]), Some(invariants)));
    }
    let (mut found, mut taken, mut left) = (Vec::new(), 0, operations);
    for (steps, invariants) in parts {
        for condition in steps.conditions(graph, chart, invariants.as_ref()) {
            let formulas = Formulas::new(graph, chart, &condition.operands);
            let cost = OF_A_CELL * formulas.size().max(1);
            let limit = (left / cost).clamp(1, cells);
            let (exit, count) = judge(chart, &formulas, condition.must, limit);
            let exit = exit.and_then(|(witness, is_certain)| {
                let span = steps.blame(graph, &condition.limit)?;
                Some(BranchViolation { span, must: condition.must, witness, is_certain })
            });
            found.extend(exit);
            taken += count;
            left = left.saturating_sub(count * cost);
        }
    }
    if graph.is_exhausted() {
        // Results from a full graph are meaningless: some limits that it reports do not exist, and others are missing. So
        // report one unproved operation.
        let witness = Witness::at(chart, &Cell::whole(chart.variables().len()).centre()).0;
        let formula = field.formulas.iter().map(|(_, span)| *span).next();
        let unknown =
            |span| BranchViolation { span, must: Must::NotVanish, witness, is_certain: false };
        found = formula.map(unknown).into_iter().collect();
    }
    (found, taken)
}

/// J in the symbols of W.
fn volume(graph: &mut Graph) -> Expr {
    let (one, change) = (graph.number(1), graph.symbol(VOLUME));
    graph.add(one, change)
}

/// Some formulas and their steps, for the parameters of a chart.
struct Steps<'a> {
    part: &'a Part,
    formulas: Vec<Expr>,
    /// The formulas that are quantities of the field; whether they are finite is proved elsewhere.
    quantities: Vec<Expr>,
    values: Vec<Expr>,
    limits: Vec<Vec<Limit>>,
}

impl<'a> Steps<'a> {
    fn new(graph: &mut Graph, chart: &Chart, part: &'a Part, quantities: &[Expr]) -> Self {
        let formulas: Vec<Expr> = part.formulas.iter().map(|(formula, _)| *formula).collect();
        let formulas = chart.fix(graph, &formulas);
        let quantities = chart.fix(graph, quantities);
        let values: Vec<Expr> = part.steps.iter().map(|step| step.made(graph)).collect();
        let values = chart.fix(graph, &values);
        let limits = values.iter().map(|value| limits_of(graph, *value)).collect();
        Steps { part, formulas, quantities, values, limits }
    }

    /// Lists the conditions of all steps, each once. `invariants` are the arguments of W; J > 0 is proved already.
    fn conditions(
        &self,
        graph: &mut Graph,
        chart: &Chart,
        invariants: Option<&SortedMap<Symbol, Expr>>,
    ) -> Vec<Condition> {
        let left = limits(graph, &self.formulas);
        let key = |limit: &Limit| (limit.analytic, limit.operands.clone());
        let known: SortedSet<_> = left.iter().map(key).collect();
        // At a pole a quantity is not finite; a pole of a formula may cancel in all quantities.
        let finite: SortedSet<_> = limits(graph, &self.quantities).iter().map(key).collect();
        let strict = left.into_iter().filter(|it| !(it.is_pole && finite.contains(&key(it))));
        let strict = strict.map(|limit| (Some(limit.analytic), limit));
        // A step that canonical form has cancelled only needs a value.
        let cancelled = self.limits.iter().flatten().filter(|limit| !known.contains(&key(limit)));
        let cancelled = cancelled.map(|limit| (limit.defined, limit.clone()));
        let volume = invariants.map(|_| volume(graph));
        let (mut found, mut seen) = (Vec::new(), SortedSet::new());
        for (must, limit) in strict.chain(cancelled) {
            if volume.is_some_and(|volume| limit.operands == [volume]) {
                continue;
            }
            // The invariants are functions of the chart's variables already.
            let mut operands = chart.pull_back(graph, &limit.operands);
            if let Some(invariants) = invariants {
                operands = substitute(graph, &operands, invariants);
            }
            let varies = operands.iter().any(|operand| {
                graph.symbols(*operand).iter().any(|symbol| chart.variables().contains(symbol))
            });
            // An operand that does not vary needs no derivative.
            let Some(must) = (if varies { must } else { limit.defined }) else { continue };
            if seen.insert((must, operands.clone())) {
                found.push(Condition { must, operands, limit });
            }
        }
        found
    }

    /// The place of a limit: the step that has it, else the first step whose limits concern its operand, else the formula.
    fn blame(&self, graph: &Graph, limit: &Limit) -> Option<Span> {
        let operand = limit.operands[0];
        let uses = |expr: Expr| graph.reachable(&[expr]).contains(&operand);
        let is_it = |it: &Limit| (it.is_pole, &it.operands) == (limit.is_pole, &limit.operands);
        let has_it = |limits: &Vec<Limit>| limits.iter().any(is_it);
        let is_about = |index: &usize| !self.limits[*index].is_empty() && uses(self.values[*index]);
        let step = self.limits.iter().position(has_it);
        let step = step.or_else(|| (0..self.values.len()).find(is_about));
        let formula = || self.formulas.iter().position(|it| uses(*it)).unwrap_or(0);
        match step {
            Some(step) => Some(self.part.steps[step].span),
            None => self.part.formulas.get(formula()).map(|(_, span)| *span),
        }
    }
}

/// The invariants on which W depends, in the variables of a chart.
fn invariants(
    graph: &mut Graph,
    chart: &Chart,
    compiled: &Compiled,
    motion: &ChartMotion,
) -> SortedMap<Symbol, Expr> {
    let kind = match &compiled.model.kind {
        InvariantKind::Fibrous(direction) => {
            InvariantKind::Fibrous(chart.pull_back(graph, direction))
        }
        other => other.clone(),
    };
    let gradient = motion.oriented.as_ref().unwrap_or(&motion.gradient);
    let tensor = Tensor::from_components(motion.dimension(), gradient.clone());
    Strain::new(graph, tensor, &kind, &Relations::default()).invariants
}

/// Proves a condition on formulas, or returns a point where it does not hold and whether that is certain; second, the number
/// of cells used.
fn judge(
    chart: &Chart,
    formulas: &Formulas,
    must: Must,
    limit: usize,
) -> (Option<(Witness, bool)>, usize) {
    let mut bounds = formulas.run::<Interval>(chart);
    let mut hunter =
        PointSearch { chart, must, doubles: formulas.run(chart), precise: formulas.run(chart) };
    let mut exit = None;
    let enough = |bound: f64, attained: f64| bound <= 0.0 || attained > 0.0;
    let found = largest(chart.variables().len(), chart.limit(limit), enough, |cell| {
        let place = chart.place(&cell.0);
        let enclosure = bounds.enclose(&place);
        let at = cell.centre();
        if holds(must, &enclosure.values) {
            return Measure { bound: 0.0, attained: 0.0, at, split: 0 };
        }
        exit = exit.take().or_else(|| hunter.hunt(cell));
        let attained = if exit.is_some() { 1.0 } else { 0.0 };
        let split = cell.steepest(&chart.changes(cell, &place, &enclosure.slopes));
        Measure { bound: f64::INFINITY, attained, at, split }
    });
    if found.bound <= 0.0 {
        return (None, found.cells);
    }
    let is_certain = exit.is_some();
    let witness = exit.unwrap_or_else(|| Witness::at(chart, &found.worst.centre()).0);
    (Some((witness, is_certain)), found.cells)
}

/// Whether a condition holds everywhere within the bounds of its operands.
fn holds(must: Must, values: &[Interval]) -> bool {
    let is_not_zero = |value: &Interval| !value.contains(0.0);
    values.iter().all(|value| value.is_defined())
        && match (must, values) {
            (Must::BePositive, [x]) => x.lower() > 0.0,
            (Must::NotBeNegative, [x]) => x.lower() >= 0.0,
            (Must::KeepOffCut, [y, x]) => is_not_zero(y) || x.lower() > 0.0,
            _ => values.iter().any(is_not_zero),
        }
}

/// Searches for a point that violates the condition.
struct PointSearch<'a> {
    chart: &'a Chart,
    must: Must,
    doubles: Evaluation<'a, f64>,
    precise: Evaluation<'a, Precise>,
}

/// The side of a limit on which a point lies.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Side {
    Below,
    Beyond,
    Above,
}

/// The side of a point by the signs of the operands; `None` if the limit is not near.
fn side(must: Must, signs: &[Option<Ordering>]) -> Option<Side> {
    use Ordering::{Equal, Greater, Less};
    let all = signs.iter().copied().collect::<Option<Vec<_>>>()?;
    match (must, all.as_slice()) {
        (Must::BePositive, [Less | Equal]) | (Must::NotBeNegative, [Less]) => Some(Side::Beyond),
        (Must::BePositive | Must::NotBeNegative, _) => None,
        (Must::KeepOffCut, [_, Greater]) => None,
        (Must::KeepOffOrigin, [Equal, Equal]) => Some(Side::Beyond),
        (Must::KeepOffOrigin, _) => None,
        (Must::NotVanish | Must::KeepOffCut, [Equal, ..]) => Some(Side::Beyond),
        (Must::NotVanish | Must::KeepOffCut, [Less, ..]) => Some(Side::Below),
        (Must::NotVanish | Must::KeepOffCut, _) => Some(Side::Above),
    }
}

fn sign(value: &Precise) -> Option<Ordering> {
    let zero = Precise::from_f64(0.0);
    match (value.at_most(&zero), zero.at_most(value)) {
        (true, true) => Some(Ordering::Equal),
        (true, false) => Some(Ordering::Less),
        (false, true) => Some(Ordering::Greater),
        (false, false) => None,
    }
}

impl PointSearch<'_> {
    /// Searches the middle and the corners of a cell, and the segment between two of them on different sides of the limit:
    /// on it the operand, which is continuous, is 0 somewhere.
    fn hunt(&mut self, cell: &Cell) -> Option<Witness> {
        let mut points = corners(cell);
        points.push(cell.centre());
        let [mut below, mut above] = [None, None];
        for point in points {
            let values = self.doubles.values(&self.chart.place(&point));
            let signs: Vec<_> = values.iter().map(|value| value.partial_cmp(&0.0)).collect();
            match side(self.must, &signs) {
                Some(Side::Beyond) if self.side(&point) == Some(Side::Beyond) => {
                    return Some(Witness::at(self.chart, &point).0);
                }
                Some(Side::Below) => below = Some(point),
                Some(Side::Above) => above = Some(point),
                _ => {}
            }
        }
        self.between(below?, above?)
    }

    /// The point between two others at which the operand reaches the limit.
    fn between(&mut self, mut below: Vec<f64>, mut above: Vec<f64>) -> Option<Witness> {
        if [&below, &above].map(|end| self.side(end)) != [Some(Side::Below), Some(Side::Above)] {
            return None;
        }
        for _ in 0..HALVINGS {
            let middle: Vec<f64> = below.iter().zip(&above).map(|(a, b)| (a + b) / 2.0).collect();
            match self.side(&middle)? {
                Side::Below => below = middle,
                Side::Above => above = middle,
                Side::Beyond => return Some(Witness::at(self.chart, &middle).0),
            }
        }
        Some(Witness::at(self.chart, &above).0)
    }

    fn side(&mut self, fractions: &[f64]) -> Option<Side> {
        let fractions: Vec<Precise> = fractions.iter().map(|it| Precise::from_f64(*it)).collect();
        let values = self.precise.values(&self.chart.place(&fractions));
        side(self.must, &values.iter().map(sign).collect::<Vec<_>>())
    }
}
