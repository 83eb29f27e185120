//! Counterexamples: a point of the domain where something was found, which a message can name.

use super::chart::{Chart, ChartPoint};
use mms_math::Scalar as _;
use mms_program::precise::Precise;

/// The budget of finding a place or a culprit after a search, in the steps of [`mms_symbolic::work`].
pub const STEPS: u64 = 10_000_000;

/// A place, a time, and the values of the parameters that have a range.
#[derive(Clone, Debug, PartialEq)]
pub struct Witness {
    /// X.
    pub coordinates: Vec<f64>,
    /// t.
    pub time: f64,
    /// The parameters that vary, by position.
    pub parameters: Vec<(usize, f64)>,
}

impl Witness {
    /// The witness at fractions of the edges of a chart, and its chart point in 77 digits.
    pub fn at(chart: &Chart, fractions: &[f64]) -> (Witness, ChartPoint<Precise>) {
        let fractions: Vec<Precise> = fractions.iter().map(|it| Precise::from_f64(*it)).collect();
        Self::at_precise(chart, &fractions)
    }

    /// The witness at fractions of 77 digits, and its chart point.
    pub fn at_precise(chart: &Chart, fractions: &[Precise]) -> (Witness, ChartPoint<Precise>) {
        // The place where a search ended is reported even if its budget is spent.
        let place = || chart.points().point(&chart.place(fractions));
        let point = chart.work().with_own_budget(STEPS, place);
        let value = |index: usize| (index, point.parameters[index].to_f64());
        let witness = Witness {
            coordinates: point.coordinates.iter().map(Precise::to_f64).collect(),
            time: point.time.to_f64(),
            parameters: chart.varying_parameters().map(value).collect(),
        };
        (witness, point)
    }

    /// `X = 1, Y = 0, t = 0.5, amplitude = 0.3`, with these names of the coordinates and of the parameters.
    pub fn describe(&self, axes: &[&str], names: &[String]) -> String {
        if self.time.is_nan() || self.coordinates.iter().any(|it| it.is_nan()) {
            return "a place that takes too long to compute".into();
        }
        let axes = axes.iter().zip(&self.coordinates).map(|(axis, x)| (axis.to_string(), *x));
        let parameters = self.parameters.iter().map(|(index, x)| (names[*index].clone(), *x));
        let all = axes.chain([("t".to_string(), self.time)]).chain(parameters);
        all.map(|(name, value)| format!("{name} = {}", digits(value)))
            .collect::<Vec<_>>()
            .join(", ")
    }
}

/// Formats a number of any size for a message, in few digits.
pub fn digits(value: f64) -> String {
    let plain = value == 0.0 || (1e-4..1e7).contains(&value.abs());
    if plain { value.to_string() } else { format!("{value:e}") }
}
