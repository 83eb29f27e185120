//! The sign of an expression that must be positive, such as J = det F: a lower bound over the domain, or a point where it is
//! not.

use mms_math::Scalar as _;

use crate::bounds::chart::Chart;
use crate::bounds::enclosure::{Evaluation, Formulas};
use crate::bounds::search::{Measure, SearchResult, largest};
use crate::bounds::witness::Witness;
use mms_program::interval::Interval;
use mms_program::precise::Precise;

/// The distance of a bound from a value, relative to the value, that ends a search.
const SHARPNESS: f64 = 0.2;

/// The verdict about the sign of an expression that must be positive.
#[derive(Clone, Debug, PartialEq)]
pub enum Sign {
    /// The expression is positive everywhere, within these bounds.
    Positive([f64; 2]),
    /// The expression is not positive here, where it has this value.
    Refuted(Witness, f64),
    /// The expression is positive at all examined points, but not proved to be: near the place it may be as small as the value.
    Unproved(Witness, f64),
}

/// A formula that must be positive over a chart.
pub struct Positive<'a> {
    chart: &'a Chart,
    formula: &'a Formulas,
    /// The magnitude below which the sign of a value is computed in 77 digits.
    doubtful: f64,
}

impl<'a> Positive<'a> {
    /// J, whose values are about 1.
    pub fn jacobian(chart: &'a Chart, jacobian: &'a Formulas) -> Self {
        Positive { chart, formula: jacobian, doubtful: 1e-6 }
    }

    /// A formula of any size.
    pub fn new(chart: &'a Chart, formula: &'a Formulas) -> Self {
        Positive { chart, formula, doubtful: f64::INFINITY }
    }

    /// Bounds the formula from both sides, with at most `limit` cells each, and counts the cells.
    pub fn bound(&self, limit: usize) -> (Sign, usize) {
        let (sign, cells) = self.least(limit);
        let Sign::Positive([least, _]) = sign else { return (sign, cells) };
        let enough = |bound: f64, value: f64| bound - value <= SHARPNESS * value;
        let greatest = self.extremum(limit, 1.0, enough);
        (Sign::Positive([least, greatest.bound]), cells + greatest.cells)
    }

    /// Bounds the formula from below, until a value that is not positive is found or `limit` cells are examined, and counts the
    /// cells.
    pub fn least(&self, limit: usize) -> (Sign, usize) {
        let enough = |bound: f64, value: f64| {
            let (lower, value) = (-bound, -value);
            value <= 0.0 || (lower > 0.0 && value - lower <= SHARPNESS * value)
        };
        let least = self.extremum(limit, -1.0, enough);
        let (lower, value) = (-least.bound, -least.attained);
        let sign = if value <= 0.0 {
            Sign::Refuted(Witness::at(self.chart, &least.at).0, value)
        } else if lower > 0.0 {
            Sign::Positive([lower, f64::INFINITY])
        } else {
            Sign::Unproved(Witness::at(self.chart, &least.worst.centre()).0, lower)
        };
        (sign, least.cells)
    }

    /// A corner of the chart, moved along these variables alone, where the formula is not positive.
    pub fn at_corners(&self, variables: &[usize]) -> Option<Sign> {
        let mut values = self.values();
        (0..1_usize << variables.len()).find_map(|corner| {
            let mut at = vec![0.0; self.chart.variables().len()];
            for (place, variable) in variables.iter().enumerate() {
                at[*variable] = f64::from(u8::from(corner >> place & 1 == 1));
            }
            let value = values.at(&at).filter(|value| *value <= 0.0)?;
            Some(Sign::Refuted(Witness::at(self.chart, &at).0, value))
        })
    }

    fn values(&self) -> Values<'a> {
        let Positive { chart, formula, doubtful } = *self;
        Values { chart, double: formula.run(chart), precise: formula.run(chart), doubtful }
    }

    /// Bounds `sign` times the formula from above.
    fn extremum(&self, limit: usize, sign: f64, enough: impl Fn(f64, f64) -> bool) -> SearchResult {
        let Positive { chart, formula, .. } = *self;
        let (mut bounds, mut values) = (formula.run::<Interval>(chart), self.values());
        let signed = Interval::from_f64(sign);
        largest(chart.variables().len(), chart.limit(limit), enough, |cell| {
            let mut place = chart.place(&cell.0);
            let enclosure = bounds.enclose(&place);
            let split = cell.steepest(&chart.changes(cell, &place, &enclosure.slopes));
            let mut bound = upper(enclosure.values[0] * signed);
            // If the formula is monotonic in a variable, the extremum is at one end.
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
}

fn upper(value: Interval) -> f64 {
    if value.is_defined() { value.upper() } else { f64::INFINITY }
}

/// A formula at points.
struct Values<'a> {
    chart: &'a Chart,
    doubtful: f64,
    double: Evaluation<'a, f64>,
    precise: Evaluation<'a, Precise>,
}

impl Values<'_> {
    /// The value, with a certain sign; `None` if it does not exist.
    fn at(&mut self, fractions: &[f64]) -> Option<f64> {
        let value = self.double.values(&self.chart.place(fractions))[0];
        if value.is_finite() && value.abs() > self.doubtful {
            return Some(value);
        }
        let fractions: Vec<Precise> = fractions.iter().map(|it| Precise::from_f64(*it)).collect();
        let value = self.precise.values(&self.chart.place(&fractions)).swap_remove(0).to_f64();
        (!value.is_nan()).then_some(value)
    }
}
