//! A time or a parameter of the field, near the stated one, that fits results much better.
//!
//! A right solver fails if its results are compared with the field at another time than theirs, as with a time that a file
//! prints in three digits, or with another value of a parameter, as after a forgotten `--set`.

use std::cmp::Ordering;

use mms_exact::Exact;
use mms_results::motion::Motion;
use mms_spec::number::short;
use mms_spec::quantity::Quantity;

use super::times::{digits, half_unit};

/// Displacements of some points of a mesh at one time.
#[derive(Clone, Debug)]
pub struct Sample {
    time: f64,
    /// Whether the time counts as exact.
    is_exact: bool,
    /// X of the points.
    places: Vec<f64>,
    /// u of the points.
    displacement: Vec<f64>,
}

/// A better value: the factor by which it decreases the error, and the question that it raises.
struct Better {
    times: f64,
    question: String,
}

/// The most points that are compared.
const POINTS: usize = 2000;
/// The most digits of a time that may have been rounded for printing.
const DIGITS: i32 = 6;
/// The digits of a fitted time beyond the digits of the stated one.
const MORE: i32 = 2;
/// The least shift of a time, in half units of its last digit: results of an exact time have a smaller one.
const LEAST: f64 = 0.05;
/// The factors by which the error must decrease: for a shift of the time within its rounding, and for a parameter.
const BETTER: [f64; 2] = [3.0, 10.0];
/// The largest factor that is printed.
const MOST: f64 = 1e6;
/// The relative step of differences by a parameter.
const STEP: f64 = 1e-6;
/// The most steps of Gauss and Newton.
const STEPS: usize = 16;
/// The longest step, divided by the value.
const LONGEST: f64 = 0.5;
/// The shortest step that is followed by another one, divided by the value.
const SHORTEST: f64 = 1e-9;

impl Sample {
    /// Some points of a motion at a time with this rounding; `None` without displacements.
    pub fn of(motion: &Motion<'_>, time: f64, rounding: f64, exact: &Exact) -> Option<Self> {
        let (x, u) = (&motion.reference.numbers, &motion.displacement.as_ref()?.numbers);
        let is_exact = rounding == 0.0 && !exact.input().is_static();
        Some(Sample { is_exact, ..Self::of_points(time, x, u, exact) })
    }

    /// Some of these points, for questions about parameters alone.
    pub fn of_points(time: f64, reference: &[f64], displacement: &[f64], exact: &Exact) -> Self {
        let components = exact.components(Quantity::Displacement);
        let step = (displacement.len() / components / POINTS) | 1;
        let some = |numbers: &[f64], width: usize| -> Vec<f64> {
            numbers.chunks_exact(width).step_by(step).flatten().copied().collect()
        };
        Sample {
            time,
            is_exact: false,
            places: some(reference, exact.dimension),
            displacement: some(displacement, components),
        }
    }

    /// Asks about a time or a parameter with which the results fit much better.
    ///
    /// # Errors
    /// A quantity that is too large to derive.
    pub fn question(&self, exact: &Exact) -> anyhow::Result<Option<String>> {
        if let Some(found) = self.shifted(exact)? {
            return Ok(Some(found.question));
        }
        let mut best: Option<Better> = None;
        for at in 0..exact.input().compiled.model.parameters.len() {
            let found = self.with_parameter(exact, at)?;
            let is_better = |it: &Better| best.as_ref().is_none_or(|best| it.times > best.times);
            best = found.filter(is_better).or(best);
        }
        Ok(best.map(|it| it.question))
    }

    /// The error of u.
    fn error(&self, exact: &mut Exact) -> anyhow::Result<Vec<f64>> {
        let right = exact.values(Quantity::Displacement, self.time, &self.places)?;
        Ok(self.displacement.iter().zip(right).map(|(u, right)| u - right).collect())
    }

    /// A time within the rounding of the last digit: the projection of the error of u on v.
    fn shifted(&self, exact: &Exact) -> anyhow::Result<Option<Better>> {
        let (count, decimals) = digits(self.time);
        if !self.is_exact || count > DIGITS {
            return Ok(None);
        }
        let mut exact = exact.unprepared();
        let error = self.error(&mut exact)?;
        let v = exact.values(Quantity::Velocity, self.time, &self.places)?;
        let by = along(&error, &v);
        let left: Vec<f64> = error.iter().zip(&v).map(|(e, v)| e - by * v).collect();
        let (times, half) = (square(&error).sqrt() / square(&left).sqrt(), half_unit(decimals));
        let is_rounding = (LEAST * half..=half).contains(&by.abs()) && times >= BETTER[0];
        let question = || {
            format!(
                "is t = {:?} rounded? At t = {:.*e} the error of u is {} times smaller; give the exact time with `--time`",
                self.time,
                (count + MORE) as usize,
                self.time + by,
                short(times.min(MOST))
            )
        };
        Ok(is_rounding.then(|| Better { times, question: question() }))
    }

    /// A value of a parameter, by the method of Gauss and Newton.
    fn with_parameter(&self, exact: &Exact, at: usize) -> anyhow::Result<Option<Better>> {
        let stated = exact.parameters()[at];
        if !stated.is_finite() {
            return Ok(None);
        }
        let error_of = |value: f64| match exact.with_parameter(at, value) {
            Some(mut varied) => self.error(&mut varied),
            None => Ok(vec![f64::NAN]),
        };
        let first = error_of(stated)?;
        let (mut value, mut error) = (stated, first.clone());
        for _ in 0..STEPS {
            let step = STEP * value;
            let slope: Vec<f64> = error_of(value + step)?
                .iter()
                .zip(&error)
                .map(|(there, here)| (here - there) / step)
                .collect();
            let longest = LONGEST * value.abs();
            let by = along(&error, &slope).clamp(-longest, longest);
            let next = error_of(value + by)?;
            // NaN for a parameter that does not change u.
            if square(&next).partial_cmp(&square(&error)) != Some(Ordering::Less) {
                break;
            }
            (value, error) = (value + by, next);
            if by.abs() < SHORTEST * value.abs() {
                break;
            }
        }
        let times = (square(&first) / square(&error)).sqrt();
        let name = &exact.input().compiled.model.parameters[at].name;
        let setting = format!("{name}={}", short(value));
        let is_better =
            times >= BETTER[1] && exact.input().settings(std::slice::from_ref(&setting)).is_ok();
        let question = || {
            format!(
                "did your solver use another {name} than {}? With `--set {setting}` the error of u is {} times smaller",
                short(stated),
                short(times.min(MOST)),
            )
        };
        Ok(is_better.then(|| Better { times, question: question() }))
    }
}

/// The component of a vector along another one.
fn along(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>() / square(b)
}

fn square(all: &[f64]) -> f64 {
    all.iter().map(|it| it * it).sum()
}
