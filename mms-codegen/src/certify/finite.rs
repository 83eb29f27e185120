//! Whether every quantity has a finite value everywhere, its derivatives included.

use super::motion::{ChartMotion, without_volume};
use crate::bounds::chart::{Chart, Spot};
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

/// What is known of the values of all quantities.
#[derive(Clone, Debug, PartialEq)]
pub enum Finite {
    /// All exist everywhere.
    Proved,
    /// This one has no value here.
    Undefined(Quantity, Witness),
    /// All that were evaluated exist, but near here this one is not proved to.
    Unproved(Quantity, Witness),
}

/// Proves that all quantities exist where J lies within bounds, with at most `limit` cells, and says
/// how many there were.
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
    // A singularity often lies where a body or its time window ends, or in the middle.
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
        // What there was no budget left to compute is no value that does not exist.
        if chart.work().is_over() {
            break;
        }
        if let Some(quantity) = quantity.filter(|_| spot.is_known()) {
            return (Finite::Undefined(quantity, witness), found.cells);
        }
    }
    // The culprit is named even if the budget is spent.
    let quantity = chart.work().aside(STEPS, || gap(&found.worst));
    let witness = Witness::at(chart, &found.worst.centre()).0;
    (Finite::Unproved(quantity.unwrap_or(Quantity::Displacement), witness), found.cells)
}

fn is_bounded(value: &Interval) -> bool {
    value.is_defined() && value.farthest().is_finite()
}

/// The variable across which to split a cell: one whose width alone keeps it from being `well`, else
/// the widest.
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
    // Beyond a few parameters with a range their corners are too many to look at.
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

/// All quantities, with J taken out of them: interval arithmetic alone would not know that it is
/// positive where it is small.
struct Quantities<'a> {
    work: &'a Work,
    /// In the order of derivation.
    quantities: Vec<Quantity>,
    program: Program,
    /// The same with J in place.
    whole: Program,
}

impl<'a> Quantities<'a> {
    fn new(graph: &mut Graph, compiled: &Compiled, work: &'a Work) -> Self {
        let mut outputs = SortedMap::new();
        for (quantity, components) in &compiled.derived.quantities {
            let mut components = components.clone();
            // As finite as the tensor or the vector, whatever N is.
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

    /// A quantity that is not proved to be bounded in a cell. With J in place of what it is made of
    /// its other parts may be bounded less well: either way will do.
    fn unbounded(&self, spot: &Spot<Interval>, jacobian: Interval) -> Option<Quantity> {
        let gap = self.without_value(spot, Some(jacobian), is_bounded)?;
        self.without_value(spot, None, is_bounded).map(|_| gap)
    }

    /// The first quantity that is not `well` at a spot, in the order of derivation.
    fn without_value<T: Number>(
        &self,
        spot: &Spot<T>,
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
