//! The sign of an expression that must be positive, such as J = det F: a lower bound over the domain, or a point where it fails.

use mms_math::Scalar as _;

use crate::bounds::chart::Chart;
use crate::bounds::enclosure::{Evaluation, Formulas};
use crate::bounds::search::{Found, Measure, largest};
use crate::bounds::witness::Witness;
use mms_program::interval::Interval;
use mms_program::precise::Precise;

/// How near a bound must be to a value, relative to that.
const SHARPNESS: f64 = 0.2;

/// The sign of an expression that must be positive, as far as it is known.
#[derive(Clone, Debug, PartialEq)]
pub enum Sign {
    /// It is positive everywhere, within these bounds.
    Positive([f64; 2]),
    /// It is not positive here, where it has this value.
    Refuted(Witness, f64),
    /// No point was found where it is not positive, and it is not proved to be: it may be as small
    /// as the value, near the place.
    Unproved(Witness, f64),
}

/// A formula that must be positive over a chart.
pub struct Positive<'a> {
    chart: &'a Chart,
    formula: &'a Formulas,
    /// The sign of a value of a smaller magnitude is taken from 77 digits.
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

    /// Bounds it from both sides, with at most `limit` cells each, and says how many there were.
    pub fn bound(&self, limit: usize) -> (Sign, usize) {
        let (sign, cells) = self.least(limit);
        let Sign::Positive([least, _]) = sign else { return (sign, cells) };
        let enough = |bound: f64, value: f64| bound - value <= SHARPNESS * value;
        let greatest = self.extremum(limit, 1.0, enough);
        (Sign::Positive([least, greatest.bound]), cells + greatest.cells)
    }

    /// Bounds it from below, until it is found not to be positive or `limit` cells have been looked at; and how many were.
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

    /// Where it is not positive at a corner of the chart, moved along these variables alone.
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

    /// Bounds `sign` times its values from above.
    fn extremum(&self, limit: usize, sign: f64, enough: impl Fn(f64, f64) -> bool) -> Found {
        let Positive { chart, formula, .. } = *self;
        let (mut bounds, mut values) = (formula.run::<Interval>(chart), self.values());
        let signed = Interval::from_f64(sign);
        largest(chart.variables().len(), chart.limit(limit), enough, |cell| {
            let mut place = chart.place(&cell.0);
            let enclosure = bounds.enclose(&place);
            let split = cell.steepest(&chart.changes(cell, &place, &enclosure.slopes));
            let mut bound = upper(enclosure.values[0] * signed);
            // Where it only grows or only falls along a variable, the extremum is at one end.
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
    /// The value, of certain sign; `None` where there is none.
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
