//! Bounds of x over body, window and ranges, which a background grid has to contain.

use mms_math::Scalar as _;

use crate::bounds::chart::Chart;
use crate::bounds::enclosure::Formulas;
use crate::bounds::search::{Measure, largest};
use crate::compile::Compiled;
use mms_program::interval::Interval;
use mms_spec::Space;
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::{Expr, Function, Graph, Rational};

/// The excess of a bound over a value that is sharp enough, as a part of the distance between both bounds.
const SHARPNESS: f64 = 0.01;

/// The largest number of cells of each bound: it is valid after any number of cells.
const CELLS: usize = 100;

/// The least and the greatest x by axis; infinite if no bound is found. For an axisymmetric field the axes are the distance
/// from the axis and the coordinate along it.
pub(super) fn bound(graph: &mut Graph, chart: &Chart, compiled: &Compiled) -> Vec<[f64; 2]> {
    let mut position = compiled.derived.quantities[&Quantity::Position].clone();
    if let (Space::Axisymmetric { swirl: true }, [radial, along, hoop]) =
        (compiled.field.space, position.as_slice())
    {
        let squares = [*radial, *hoop].map(|it| (graph.power(it, 2), Rational::ONE));
        let squares = graph.sum(squares);
        position = vec![graph.call(Function::Sqrt, &[squares]), *along];
    }
    let position = chart.pull_back(graph, &position);
    position.into_iter().map(|component| ends(graph, chart, component)).collect()
}

fn ends(graph: &mut Graph, chart: &Chart, component: Expr) -> [f64; 2] {
    let formulas = Formulas::new(graph, chart, &[component]);
    let anywhere = greatest(chart, &formulas, 1.0, f64::INFINITY)
        + greatest(chart, &formulas, -1.0, f64::INFINITY);
    let [upper, lower] =
        [1.0, -1.0].map(|sign| greatest(chart, &formulas, sign, SHARPNESS * anywhere));
    [-lower, upper]
}

/// A bound of a component times a sign, within an excess; if the excess is infinite, one cell is enough.
fn greatest(chart: &Chart, formulas: &Formulas, sign: f64, excess: f64) -> f64 {
    let mut bounds = formulas.run::<Interval>(chart);
    let mut values = formulas.run::<f64>(chart);
    let signed = Interval::from_f64(sign);
    let enough = |bound: f64, value: f64| excess.is_infinite() || bound - value <= excess;
    let found = largest(chart.variables().len(), chart.limit(CELLS), enough, |cell| {
        let place = chart.place(&cell.0);
        let enclosure = bounds.enclose(&place);
        let value = enclosure.values[0] * signed;
        let at = cell.centre();
        let attained = sign * values.values(&chart.place(&at))[0];
        Measure {
            bound: if value.is_defined() { value.upper() } else { f64::INFINITY },
            attained: if attained.is_nan() { f64::NEG_INFINITY } else { attained },
            split: cell.steepest(&chart.changes(cell, &place, &enclosure.slopes)),
            at,
        }
    });
    found.bound
}
