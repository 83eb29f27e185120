//! J > 0: a lower bound of det F over the domain, or a point where it is not positive.

use mms_math::Scalar as _;

use crate::bounds::chart::Chart;
use crate::bounds::enclosure::{Evaluation, Formulas};
use crate::bounds::search::{Found, Measure, largest};
use crate::bounds::witness::Witness;
use mms_program::interval::Interval;
use mms_program::precise::Precise;

/// How near a bound of J must be to a value of J, relative to that.
const SHARPNESS: f64 = 0.2;

/// Where J is so small, its sign is taken from 77 digits.
const DOUBTFUL: f64 = 1e-6;

/// What is known of J = det F.
#[derive(Clone, Debug, PartialEq)]
pub enum Jacobian {
    /// It is positive everywhere, within these bounds.
    Positive([f64; 2]),
    /// It is not positive here, where it has this value.
    Inverted(Witness, f64),
    /// No point was found where it is not positive, and it is not proved to be: it may be as small
    /// as the value, near the place.
    Unproved(Witness, f64),
}

/// Bounds J from both sides, with at most `limit` cells each, and says how many there were.
pub fn bound(chart: &Chart, jacobian: &Formulas, limit: usize) -> (Jacobian, usize) {
    let least = least(chart, jacobian, limit);
    let (verdict, cells) = (judge(chart, &least), least.cells);
    if !matches!(verdict, Jacobian::Positive(_)) {
        return (verdict, cells);
    }
    let enough = |bound: f64, value: f64| bound - value <= SHARPNESS * value;
    let greatest = extremum(chart, jacobian, limit, 1.0, enough);
    (Jacobian::Positive([-least.bound, greatest.bound]), cells + greatest.cells)
}

/// A point where J is not positive, if one is found within `limit` cells.
pub fn inversion(chart: &Chart, jacobian: &Formulas, limit: usize) -> Option<(Witness, f64)> {
    match judge(chart, &least(chart, jacobian, limit)) {
        Jacobian::Inverted(witness, value) => Some((witness, value)),
        Jacobian::Positive(_) | Jacobian::Unproved(..) => None,
    }
}

/// The search for the least J, which ends where J is found not to be positive.
fn least(chart: &Chart, jacobian: &Formulas, limit: usize) -> Found {
    let enough = |bound: f64, value: f64| {
        let (lower, value) = (-bound, -value);
        value <= 0.0 || (lower > 0.0 && value - lower <= SHARPNESS * value)
    };
    extremum(chart, jacobian, limit, -1.0, enough)
}

fn judge(chart: &Chart, least: &Found) -> Jacobian {
    if -least.attained <= 0.0 {
        return Jacobian::Inverted(Witness::at(chart, &least.at).0, -least.attained);
    }
    if least.bound < 0.0 {
        return Jacobian::Positive([-least.bound, f64::INFINITY]);
    }
    Jacobian::Unproved(Witness::at(chart, &least.worst.centre()).0, -least.bound)
}

/// Bounds `sign * J` from above.
fn extremum(
    chart: &Chart,
    jacobian: &Formulas,
    limit: usize,
    sign: f64,
    enough: impl Fn(f64, f64) -> bool,
) -> Found {
    let mut bounds = jacobian.run::<Interval>(chart);
    let mut values = Values { chart, double: jacobian.run(chart), precise: jacobian.run(chart) };
    let signed = Interval::from_f64(sign);
    largest(chart.variables().len(), chart.limit(limit), enough, |cell| {
        let mut place = chart.place(&cell.0);
        let enclosure = bounds.enclose(&place);
        let split = cell.steepest(&chart.changes(cell, &place, &enclosure.slopes));
        let mut bound = upper(enclosure.values[0] * signed);
        // Where J only grows or only falls along a variable, the extremum is at one end.
        let mut at = cell.centre();
        let mut ends = false;
        for (variable, slopes) in enclosure.slopes.iter().enumerate() {
            let slope = slopes[0] * signed;
            let (side, fraction) = (place[variable], cell.0[variable]);
            let end = if slope.is_defined() && slope.lower() >= 0.0 {
                (side.upper(), fraction.upper())
            } else if slope.is_defined() && slope.upper() <= 0.0 {
                (side.lower(), fraction.lower())
            } else {
                continue;
            };
            (place[variable], at[variable], ends) = (Interval::from_f64(end.0), end.1, true);
        }
        if ends && enclosure.values[0].is_defined() {
            bound = bound.min(upper(bounds.enclose(&place).values[0] * signed));
        }
        let attained = values.at(&at).map_or(f64::NEG_INFINITY, |value| sign * value);
        Measure { bound, attained, at, split }
    })
}

fn upper(value: Interval) -> f64 {
    if value.is_defined() { value.upper() } else { f64::INFINITY }
}

/// J at points.
struct Values<'a> {
    chart: &'a Chart,
    double: Evaluation<'a, f64>,
    precise: Evaluation<'a, Precise>,
}

impl Values<'_> {
    /// The value, of certain sign; `None` where there is none.
    fn at(&mut self, fractions: &[f64]) -> Option<f64> {
        let value = self.double.values(&self.chart.place(fractions))[0];
        if value.is_finite() && value.abs() > DOUBTFUL {
            return Some(value);
        }
        let fractions: Vec<Precise> = fractions.iter().map(|it| Precise::from_f64(*it)).collect();
        let value = self.precise.values(&self.chart.place(&fractions)).swap_remove(0).to_f64();
        (!value.is_nan()).then_some(value)
    }
}
