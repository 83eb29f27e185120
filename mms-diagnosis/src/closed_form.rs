//! Diagnosis of a closed form from paper that differs from the derived one: finds the mistake that gives such a formula.
//!
//! A stress is diagnosed like the stress of a law. For b, a mistake in b changes the formula itself, and a mistake in the
//! stress changes Div P, which is computed by central differences of fourth order.

use mms_runtime::body::{Filling, bounding_box};
use mms_runtime::{Fill, Matrix, Vector};

use crate::answer::{Diagnosis, DiagnosisFinding, Ranked};
use crate::exact::{Exact, numbers};
use crate::hypothesis::{Change, Given, Hypothesis, OfForce, OfStress};
use crate::smooth::{less, size};
use crate::table::{self, ARITHMETIC, Measure, StressTable, to_round_off};

/// The quantity of a closed form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClosedForm {
    /// b.
    BodyForce,
    /// A stress.
    Stress(Measure),
}

/// The values of a closed form at a time and at X, point by point.
pub type Values<'a> = dyn Fn(f64, &[f64]) -> Vec<f64> + 'a;

/// The times at which a closed form is evaluated, as parts of the time window.
const TIMES: [f64; 3] = [0.23, 0.57, 0.91];
/// The numbers of points along an axis at which a closed form is evaluated, in one to three dimensions.
const POINTS: [f64; 3] = [16.0, 5.0, 3.0];
/// The step of differences, relative to the size of the body.
const STEP: f64 = 1e-3;

/// A closed form at points and at some times.
struct Sampled<'a, const D: usize> {
    exact: &'a Exact<'a, D>,
    points: Vec<Vector<f64, D>>,
    times: [f64; 3],
    /// The values, time by time.
    values: Vec<f64>,
    /// The step of differences.
    step: f64,
}

/// The mistake that gives a closed form; `None` if no hypothesis gives it.
pub fn diagnose<const D: usize>(
    exact: &Exact<'_, D>,
    of: ClosedForm,
    values: &Values<'_>,
    hypotheses: Vec<Hypothesis<D>>,
) -> Option<Ranked> {
    let [lower, upper] = bounding_box(&exact.domain.body).ok()?;
    let spacing = (upper - lower) / POINTS[D - 1];
    let points = Filling::new(&exact.domain.body, Fill::Fitted, &spacing).ok()?.position;
    let flat: Vec<f64> = points.iter().flat_map(|x| x.iter().copied()).collect();
    let [start, end] = exact.domain.time;
    let times = TIMES.map(|part| start + part * (end - start));
    let values = times.iter().flat_map(|time| values(*time, &flat)).collect();
    let sampled = Sampled { exact, points, times, values, step: STEP * (upper - lower).max() };
    let found = match of {
        ClosedForm::Stress(measure) => table::diagnose(exact, &sampled.table(measure), hypotheses)?,
        ClosedForm::BodyForce => sampled.force(hypotheses)?,
    };
    let is_named = found.finding == DiagnosisFinding::Named;
    found.ranked.into_iter().next().filter(|_| is_named)
}

impl<const D: usize> Sampled<'_, D> {
    /// The values as stresses of a law.
    fn table(&self, measure: Measure) -> StressTable<D> {
        let gradients = self.times.iter().flat_map(|time| self.exact.gradient(*time, &self.points));
        StressTable {
            rounding_of_gradient: 0.0,
            reference: self.times.iter().flat_map(|_| self.points.iter().copied()).collect(),
            gradient: gradients.collect(),
            measure,
            stress: self.values.chunks_exact(D * D).map(Matrix::from_row_slice).collect(),
            rounding: 0.0,
        }
    }

    /// The diagnosis of the values as b. `None` if an exact value is not finite.
    fn force(&self, mut hypotheses: Vec<Hypothesis<D>>) -> Option<Diagnosis> {
        hypotheses.retain(|it| matches!(it.change, Change::Force(_) | Change::Stress(..)));
        let beside = self.beside();
        let (right, by_differences) = (self.forces(None), self.balanced(&beside, None));
        let scale = size(&right).max(f64::MIN_POSITIVE);
        let off = less(&by_differences, 1.0, &right);
        if !off.iter().all(|it| it.is_finite()) {
            return None;
        }
        let wrong = |hypothesis: &Hypothesis<D>, at: &[f64]| {
            let added = match hypothesis.change {
                Change::Force(change) => less(&self.forces(Some((change, at))), 1.0, &right),
                Change::Stress(_, change) => {
                    less(&self.balanced(&beside, Some((change, at))), 1.0, &by_differences)
                }
                _ => vec![0.0; right.len()],
            };
            over(&added, scale)
        };
        let all = over(&less(&self.values, 1.0, &right), scale);
        let floor = (MARGIN * size(&off)).max(ARITHMETIC * scale) / scale;
        Some(to_round_off(self.exact, &hypotheses, all, floor, &wrong))
    }

    /// b, with a mistake in it.
    fn forces(&self, mistake: Option<(OfForce<D>, &[f64])>) -> Vec<f64> {
        let at = |time: &f64| {
            let mut b = self.exact.body_force(*time, &self.points);
            if let Some((change, size)) = mistake {
                let reference = &self.points;
                change(
                    &Given { exact: self.exact, size, time: *time, reference, gradient: &[] },
                    &mut b,
                );
            }
            numbers(&b)
        };
        self.times.iter().flat_map(at).collect()
    }

    /// The exact stresses beside the points from which differences give Div P.
    fn beside(&self) -> Vec<Beside<D>> {
        let mut all = Vec::new();
        for time in self.times {
            for axis in 0..D {
                for (steps, weight) in SLOPE {
                    let mut points = self.points.clone();
                    points.iter_mut().for_each(|x| x[axis] += steps * self.step);
                    let gradient = self.exact.gradient(time, &points);
                    let stress = self.exact.stress(time, &points, &gradient);
                    let weight = weight / self.step;
                    all.push(Beside { time, axis, weight, points, gradient, stress });
                }
            }
        }
        all
    }

    /// a - Div P/rho0 by differences, with a mistake in the stress.
    fn balanced(&self, beside: &[Beside<D>], mistake: Option<(OfStress<D>, &[f64])>) -> Vec<f64> {
        let density = self.exact.density(&self.points);
        let at = |time: f64| {
            let mut b = self.exact.acceleration(time, &self.points);
            for it in beside.iter().filter(|it| it.time == time) {
                let mut tau = it.stress.clone();
                if let Some((change, size)) = mistake {
                    let (reference, gradient) = (&it.points, &it.gradient);
                    change(&Given { exact: self.exact, size, time, reference, gradient }, &mut tau);
                }
                for (((b, tau), h), density) in
                    b.iter_mut().zip(&tau).zip(&it.gradient).zip(&density)
                {
                    let p = Measure::FirstPiola.of(&(h + Matrix::identity()), tau);
                    *b -= p.column(it.axis) * (it.weight / density);
                }
            }
            numbers(&b)
        };
        self.times.into_iter().flat_map(at).collect()
    }
}

/// tau at points shifted by a step along an axis, and its weight in Div P.
struct Beside<const D: usize> {
    time: f64,
    axis: usize,
    weight: f64,
    points: Vec<Vector<f64, D>>,
    gradient: Vec<Matrix<f64, D>>,
    stress: Vec<Matrix<f64, D>>,
}

/// Steps and weights of the first derivative by differences of fourth order.
const SLOPE: [(f64, f64); 4] =
    [(-2.0, 1.0 / 12.0), (-1.0, -8.0 / 12.0), (1.0, 8.0 / 12.0), (2.0, -1.0 / 12.0)];
/// The largest accepted ratio of the error of b by differences to the error that differences make in the right b.
const MARGIN: f64 = 10.0;

fn over(values: &[f64], scale: f64) -> Vec<f64> {
    values.iter().map(|it| it / scale).collect()
}
