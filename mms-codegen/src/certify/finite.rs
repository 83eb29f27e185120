//! Whether every quantity has a finite value everywhere, its derivatives included.

use super::motion::{ChartMotion, without_volume};
use crate::bounds::chart::{Chart, ChartPoint};
use crate::bounds::enclosure::Formulas;
use crate::bounds::search::{Cell, Measure, largest};
use crate::bounds::witness::{STEPS, Witness};
use crate::compile::Compiled;
use mms_mechanics::invariant::SUPPLIED_VOLUME;
use mms_mechanics::{Output, Program};
use mms_program::interpret::{Interpreter, Number};
use mms_program::interval::Interval;
use mms_program::precise::Precise;
use mms_program::schedule::schedule_plainly;
use mms_spec::own::Part;
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::{Graph, Symbol};
use mms_symbolic::pass::substitute::replace;
use mms_symbolic::sorted::SortedMap;
use mms_symbolic::work::Work;

/// The verdict about the values of all quantities.
#[derive(Clone, Debug, PartialEq)]
pub enum Finite {
    /// All quantities exist everywhere.
    Proved,
    /// A quantity has no value at this place.
    Undefined(Quantity, Witness),
    /// All evaluated quantities exist, but near here this one is not proved to.
    Unproved(Quantity, Witness),
}

/// Proves that all quantities exist where J lies within bounds, with at most `limit` cells, and counts the cells.
pub fn bound(
    graph: &mut Graph,
    chart: &Chart,
    compiled: &Compiled,
    motion: &ChartMotion,
    least_jacobian: f64,
    limit: usize,
) -> (Finite, usize) {
    let jacobian = Formulas::new(graph, chart, &[motion.jacobian]);
    let quantities = Quantities::new(graph, compiled, chart.work());
    let positive = Interval::new(least_jacobian.max(0.0), f64::INFINITY);
    let dimension = chart.variables().len();
    // A singularity often lies at an end of a body or of its time window, or in the middle.
    let mut candidates: Vec<Vec<f64>> = corners(&Cell::whole(dimension));
    let mut ratios = jacobian.run::<Interval>(chart);
    let mut spots = chart.points::<Interval>();
    let mut doubles = chart.points::<f64>();
    let mut suspicious = |fractions: &[f64]| {
        let spot = doubles.point(&chart.place(fractions));
        quantities.without_value(&spot, None, |value: &f64| value.is_finite()).is_some()
    };
    candidates.retain(|fractions| suspicious(fractions));
    let mut gap = |cell: &Cell| {
        let place = chart.place(&cell.0);
        let jacobian = ratios.enclose(&place).values[0].meet(positive);
        let spot = spots.point(&place);
        quantities.unbounded(&spot, jacobian)
    };
    let found = largest(
        dimension,
        chart.limit(limit),
        |bound, _| bound <= 0.0,
        |cell| {
            let at = cell.centre();
            if gap(cell).is_none() {
                return Measure { bound: 0.0, attained: 0.0, at, split: 0 };
            }
            if suspicious(&at) {
                candidates.push(at.clone());
            }
            let split = blame(cell, |thin| gap(thin).is_none());
            Measure { bound: f64::INFINITY, attained: 0.0, at, split }
        },
    );
    if found.bound <= 0.0 {
        return (Finite::Proved, found.cells);
    }
    candidates.extend(corners(&found.worst));
    for fractions in candidates {
        let (witness, spot) = Witness::at(chart, &fractions);
        let quantity = quantities.without_value(&spot, None, Precise::is_defined);
        // A value that the spent budget left uncomputed is no missing value.
        if chart.work().is_over() {
            break;
        }
        if let Some(quantity) = quantity.filter(|_| spot.is_known()) {
            return (Finite::Undefined(quantity, witness), found.cells);
        }
    }
    // The culprit is named even if the budget is spent.
    let quantity = chart.work().with_own_budget(STEPS, || gap(&found.worst));
    let witness = Witness::at(chart, &found.worst.centre()).0;
    (Finite::Unproved(quantity.unwrap_or(Quantity::Displacement), witness), found.cells)
}

fn is_bounded(value: &Interval) -> bool {
    value.is_defined() && value.farthest().is_finite()
}

/// The variable along which to split a cell: the first variable without whose width the cell would satisfy `well`, or else the
/// widest one.
pub(super) fn blame(cell: &Cell, mut well: impl FnMut(&Cell) -> bool) -> usize {
    let is_to_blame = |variable: &usize| {
        let mut thin = cell.clone();
        let middle = thin.0[*variable].middle();
        thin.0[*variable] = Interval::new(middle, middle);
        well(&thin)
    };
    (0..cell.0.len()).find(is_to_blame).unwrap_or_else(|| cell.widest())
}

/// The corners of a cell.
pub(super) fn corners(cell: &Cell) -> Vec<Vec<f64>> {
    let sides = &cell.0;
    // With more than six variables the corners are too many to examine.
    let count = sides.len().min(6);
    (0..1usize << count)
        .map(|corner| {
            let end =
                |(axis, side): (usize, &Interval)| match axis < count && corner >> axis & 1 == 1 {
                    false => side.lower(),
                    true => side.upper(),
                };
            sides.iter().enumerate().map(end).collect()
        })
        .collect()
}

/// All quantities, with J replaced by a symbol: interval arithmetic alone would not know that J is positive where it is small.
struct Quantities<'a> {
    work: &'a Work,
    /// The quantities in the order of derivation.
    quantities: Vec<Quantity>,
    program: Program,
    /// The program with J not replaced.
    whole: Program,
}

impl<'a> Quantities<'a> {
    fn new(graph: &mut Graph, compiled: &Compiled, work: &'a Work) -> Self {
        let mut outputs = SortedMap::new();
        for (quantity, components) in &compiled.derived.quantities {
            let mut components = components.clone();
            // The traction and the normal flux are finite for every N if the stress and the flux are.
            match quantity {
                Quantity::Traction => {
                    let stress = &compiled.derived.quantities[&Quantity::FirstPiolaKirchhoff];
                    components = stress.clone();
                }
                Quantity::Own(own) if own.part == Part::NormalFlux => continue,
                _ => {}
            }
            outputs.insert(Output::Quantity(*quantity), components);
        }
        let whole = schedule_plainly(graph, &outputs);
        let jacobian = compiled.derived.quantities[&Quantity::Jacobian][0];
        let values = without_volume(graph, jacobian);
        for (output, components) in outputs.iter_mut() {
            if *output != Output::Quantity(Quantity::Jacobian) {
                *components = replace(graph, components, &values);
            }
        }
        let has = |quantity: &Quantity| outputs.contains_key(&Output::Quantity(*quantity));
        let quantities = compiled.quantities().filter(has).collect();
        Quantities { work, quantities, program: schedule_plainly(graph, &outputs), whole }
    }

    /// A quantity that is not proved to be bounded in a cell. With J replaced, the other parts of a quantity may be bounded
    /// less well, so a bound by either program will do.
    fn unbounded(&self, spot: &ChartPoint<Interval>, jacobian: Interval) -> Option<Quantity> {
        let gap = self.without_value(spot, Some(jacobian), is_bounded)?;
        self.without_value(spot, None, is_bounded).map(|_| gap)
    }

    /// The first quantity that is not `well` at a chart point, in the order of derivation.
    fn without_value<T: Number>(
        &self,
        spot: &ChartPoint<T>,
        jacobian: Option<T>,
        well: impl Fn(&T) -> bool,
    ) -> Option<Quantity> {
        let program = if jacobian.is_some() { &self.program } else { &self.whole };
        let mut interpreter = Interpreter::within(self.work, program, &spot.parameters);
        interpreter.set_time(&spot.time);
        let volume = jacobian.map(|jacobian| jacobian - T::from_f64(1.0));
        let all = vec![true; program.instrs.len()];
        interpreter.set_leaves(&all, &|symbol| match (symbol, &volume) {
            (Symbol::Coordinate(axis), _) => spot.coordinates[axis].clone(),
            (SUPPLIED_VOLUME, Some(volume)) => volume.clone(),
            _ => unreachable!("quantities are of a position and a time"),
        });
        let lacks = |quantity: &Quantity| {
            !interpreter.output(Output::Quantity(*quantity)).iter().all(&well)
        };
        self.quantities.iter().copied().find(lacks)
    }
}
