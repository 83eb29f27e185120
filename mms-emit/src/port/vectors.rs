//! Test vectors: inputs of a port's functions, and the expected outputs.
//!
//! Inputs are 16 points of the body, and its corners at the first and the last time, for the default parameters, for
//! others, for an amplitude smaller by 2^-30, and for the field's own extremes. All sets of parameters have the same number of
//! points: a point where a function has no value is replaced by another one, and a set without any is left out. Inputs are
//! exact in single precision, so that both precisions get the same ones. Expected values are computed by the program in 77
//! digits at these very numbers, and rounded to double precision.

use mms_math::Scalar as _;

use super::Port;
use mms_analysis::accuracy::probe::Amplitude;
use mms_codegen::compile::{Compiled, constant};
use mms_mechanics::Output;
use mms_mechanics::extent::halton;
use mms_mechanics::sample::domain;
use mms_program::interpret::{Interpreter, Point};
use mms_program::precise::Precise;
use mms_program::precision::Digits;
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::{Rational, Symbol};
use mms_symbolic::sorted::SortedMap;

/// The largest error of a function that a check program accepts, in eps of the largest magnitude of its values over the points
/// of one set of parameters. The stable form guarantees it.
pub const TOLERANCE: u32 = 64;

/// If the program itself has more than half of `TOLERANCE` as error in double precision, as fast forms do, a port may have this
/// many times the error of the program.
const MARGIN: f64 = 4.0;

/// The number of points inside the body at which each set of parameters is evaluated.
const POINTS: usize = 16;

/// The number of parameters among which an amplitude is searched.
const CANDIDATES: usize = 16;

/// The factor that reduces an amplitude, as a negative power of two.
const REDUCED: i32 = 30;

/// Inputs and expected outputs.
#[derive(Clone, Debug, PartialEq)]
pub struct Vectors {
    /// The names of the functions.
    pub names: Vec<String>,
    /// The defaults of the parameters that are not frozen.
    pub defaults: Vec<f64>,
    /// Sets of values for the parameters that are not frozen: the defaults, others, and extremes.
    pub sets: Vec<Vec<f64>>,
    /// The samples at which functions are evaluated, equally many for each set of parameters.
    pub samples: Vec<Sample>,
    /// The components that each function must return: at each sample, or for each set if it is a function of no point.
    pub expected: Vec<Vec<Vec<f64>>>,
    /// The accepted error of each function, in eps of its largest magnitude.
    pub accepted: Vec<u32>,
    /// The accepted error of each function in single precision; `None` if its range is too small for the field.
    pub accepted_in_single: Option<Vec<u32>>,
}

impl Vectors {
    /// The explanation of the numbers in a check program.
    pub fn meaning(&self) -> String {
        let mut text = format!(
            "Inputs are exact in single precision, and expected values were computed in 77 digits. Errors are in eps of the largest magnitude of a function's values over the points of one set of parameters; {TOLERANCE} eps are accepted, as the formulas promise"
        );
        let single = self.accepted_in_single.iter().flatten();
        if self.accepted.iter().chain(single).any(|accepted| *accepted != TOLERANCE) {
            text += ", and more only where they lose more by themselves";
        }
        text + "."
    }
}

/// A point and a time.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// The index of the set of parameters.
    pub set: usize,
    /// t.
    pub time: f64,
    /// X.
    pub coordinates: Vec<f64>,
    /// N, a unit vector up to rounding.
    pub normal: Vec<f64>,
    /// H, row-major.
    pub gradient: Vec<f64>,
}

impl Sample {
    /// t, X, N and H.
    pub fn numbers(&self) -> Vec<f64> {
        let arrays = [&self.coordinates, &self.normal, &self.gradient];
        std::iter::once(self.time).chain(arrays.into_iter().flatten().copied()).collect()
    }

    /// The value of an input of a function.
    pub fn input(&self, symbol: Symbol) -> f64 {
        match symbol {
            Symbol::Coordinate(axis) => self.coordinates[axis],
            Symbol::Time => self.time,
            Symbol::Normal(axis) => self.normal[axis],
            Symbol::Gradient(row, column) => {
                self.gradient[row * self.gradient.len().isqrt() + column]
            }
            Symbol::Parameter(_) | Symbol::Invariant(_) | Symbol::Local(_) => {
                unreachable!("no function takes one at a point")
            }
        }
    }
}

impl Port<'_> {
    /// The test vectors of the functions.
    pub(crate) fn compute_vectors(&self) -> Vectors {
        let compiled = self.compiled;
        let left = |values: &[f64]| self.parameters.keys().map(|index| values[*index]).collect();
        let mut vectors = Vectors {
            names: self.callables.iter().map(|callable| callable.name.clone()).collect(),
            defaults: left(&compiled.parameters(&SortedMap::new())),
            sets: Vec::new(),
            samples: Vec::new(),
            expected: vec![Vec::new(); self.callables.len()],
            accepted: vec![TOLERANCE; self.callables.len()],
            accepted_in_single: Some(vec![TOLERANCE; self.callables.len()]),
        };
        for set in self.sets() {
            let rounded: Vec<f64> =
                compiled.parameters::<f64>(&set).into_iter().map(single_parameter).collect();
            let values: Vec<f64> = left(&rounded);
            if vectors.sets.contains(&values) {
                continue;
            }
            let fixed = self.parameters.keys().map(|index| (*index, exact(rounded[*index])));
            let fixed = fixed.collect();
            let before = vectors.clone();
            self.sample(&compiled.parameters(&fixed), &mut vectors);
            let parameters = compiled.parameters::<f64>(&fixed);
            let set = vectors.sets.len();
            let errors = self.own_errors::<f64>(&parameters, &vectors, set);
            let is_lost =
                errors.iter().any(is_lost) || vectors.samples.len() == before.samples.len();
            if is_lost && set > 0 {
                // No port can keep digits that the formulas lose, or compute a value that does not exist.
                vectors = before;
                continue;
            }
            accept(&mut vectors.accepted, &errors);
            let errors = self.own_errors::<f32>(&parameters, &vectors, set);
            if errors.iter().all(has_digits) {
                vectors.accepted_in_single.iter_mut().for_each(|it| accept(it, &errors));
            } else {
                vectors.accepted_in_single = None;
            }
            vectors.sets.push(values);
        }
        vectors
    }

    /// The accepted error of each function if everything is computed once, in this precision; `None` if no digit is right, or
    /// if the values are out of range.
    pub fn accepted_once<T: Digits>(&self) -> Vec<Option<u32>> {
        let vectors = self.subject.vectors();
        let mut accepted = vec![TOLERANCE; self.callables.len()];
        let mut has_some = vec![true; self.callables.len()];
        for (set, values) in vectors.sets.iter().enumerate() {
            let fixed = self.parameters.keys().copied().zip(values.iter().copied().map(exact));
            let parameters = self.compiled.parameters::<f64>(&fixed.collect());
            let errors = self.own_errors::<T>(&parameters, vectors, set);
            has_some.iter_mut().zip(&errors).for_each(|(some, error)| *some &= has_digits(error));
            accept(&mut accepted, &errors);
        }
        accepted
            .into_iter()
            .zip(has_some)
            .map(|(accepted, some)| some.then_some(accepted))
            .collect()
    }

    /// The errors of each function in a precision with a set of parameters, in eps of its largest magnitude; infinite if
    /// values are out of range.
    fn own_errors<T: Digits>(&self, parameters: &[f64], vectors: &Vectors, set: usize) -> Vec<f64> {
        let in_precision =
            |values: &[f64]| -> Vec<T> { values.iter().map(|value| T::from_f64(*value)).collect() };
        let mut interpreter = Interpreter::new(self.program(), &in_precision(parameters));
        let outputs: Vec<Output> = self.callables.iter().map(|callable| callable.output).collect();
        let plan = interpreter.plan(&outputs);
        let least = T::PRECISION.least();
        let mut worst = vec![[0.0_f64, least]; outputs.len()];
        for (index, sample) in vectors.samples.iter().enumerate() {
            if sample.set != set {
                continue;
            }
            interpreter.set_time(&T::from_f64(sample.time));
            let [coordinates, normal, gradient] =
                [&sample.coordinates, &sample.normal, &sample.gradient].map(|it| in_precision(it));
            let point = Point { coordinates: &coordinates, normal: &normal, gradient: &gradient };
            interpreter.set_point(&plan, point);
            for (place, callable) in self.callables.iter().enumerate() {
                if !callable.is_of_points() {
                    continue;
                }
                let [error, magnitude] = &mut worst[place];
                let found = interpreter.output(callable.output);
                for (found, expected) in found.into_iter().zip(&vectors.expected[place][index]) {
                    let difference = (found.parts().0 - expected).abs();
                    *error =
                        error.max(if difference.is_nan() { f64::INFINITY } else { difference });
                    *magnitude = magnitude.max(expected.abs());
                }
            }
        }
        worst.iter().map(|[error, magnitude]| error / magnitude / T::PRECISION.eps()).collect()
    }

    /// Values of parameters, by position; dependent parameters follow.
    fn sets(&self) -> Vec<SortedMap<usize, Rational>> {
        let mut sets = vec![SortedMap::new(), self.changed()];
        let first = self.parameters.keys().take(CANDIDATES);
        let mut amplitudes = first.filter_map(|index| Amplitude::of(self.compiled, *index));
        if let Some(amplitude) = amplitudes.next() {
            let value = single_parameter(amplitude.value * 2f64.powi(-REDUCED));
            sets.push([(amplitude.parameter, exact(value))].into());
        }
        let position = |name: &str| {
            self.parameters
                .keys()
                .copied()
                .find(|index| self.compiled.model.parameters[*index].name == name)
        };
        sets.extend(self.compiled.field.extremes.iter().filter_map(|extreme| {
            let values = extreme.set.iter();
            values
                .map(|(name, value)| position(&name.value).zip(constant(&value.text).ok()))
                .collect()
        }));
        sets
    }

    /// Numerical parameters, each changed by 1/16: all of them, or the ones that the file allows to change.
    fn changed(&self) -> SortedMap<usize, Rational> {
        let changed = |index: &usize, sixteenths: u8| {
            let default = self.compiled.model.parameters[*index].default;
            let number = self.compiled.graph.as_number(default)?;
            Some((*index, number * Rational::from_parts(sixteenths.into(), 16_u8.into())))
        };
        let all = self.parameters.keys().filter_map(|index| changed(index, 17)).collect();
        if self.compiled.accepts(&all).is_ok() {
            return all;
        }
        let mut set = SortedMap::new();
        for index in self.parameters.keys() {
            for sixteenths in [17, 15] {
                set.extend(changed(index, sixteenths));
                if self.compiled.accepts(&set).is_ok() {
                    break;
                }
                set.remove(index);
            }
        }
        set
    }

    /// Adds the results of the functions with these parameters, at points where all functions have a value. These points are
    /// repeated in place of the others.
    fn sample(&self, parameters: &[Precise], vectors: &mut Vectors) {
        let set = vectors.sets.len();
        let outputs: Vec<Output> = self.callables.iter().map(|callable| callable.output).collect();
        let mut interpreter = Interpreter::new(self.program(), parameters);
        let gradient_plan = interpreter.plan(&[GRADIENT]);
        let plan = interpreter.plan(&outputs);
        for (callable, expected) in self.callables.iter().zip(&mut vectors.expected) {
            if !callable.is_of_points() {
                expected.push(rounded(interpreter.output(callable.output)));
            }
        }
        let points = points(self.compiled, parameters, set);
        let count = vectors.samples.len().checked_div(set).unwrap_or(points.len());
        let mut valued = Vec::new();
        for mut sample in points {
            let coordinates: Vec<Precise> = precise(&sample.coordinates);
            interpreter.set_time(&Precise::from_f64(sample.time));
            if self.values(GRADIENT).is_empty() {
                sample.gradient = vec![0.0; coordinates.len() * coordinates.len()];
            } else {
                interpreter.set_point(&gradient_plan, Point::at(&coordinates));
                let gradient = rounded(interpreter.output(GRADIENT));
                sample.gradient = another(gradient);
            }
            let (normal, gradient) = (precise(&sample.normal), precise(&sample.gradient));
            let point = Point { coordinates: &coordinates, normal: &normal, gradient: &gradient };
            interpreter.set_point(&plan, point);
            let values: Vec<_> = (self.callables.iter())
                .filter(|callable| callable.is_of_points())
                .map(|callable| rounded(interpreter.output(callable.output)))
                .collect();
            if values.iter().flatten().all(|value| value.is_finite()) {
                valued.push((sample, values));
            }
        }
        for (sample, values) in valued.into_iter().cycle().take(count) {
            let of_points = self.callables.iter().zip(&mut vectors.expected);
            let of_points = of_points.filter(|(callable, _)| callable.is_of_points());
            of_points.zip(values).for_each(|((_, expected), values)| expected.push(values));
            vectors.samples.push(sample);
        }
    }
}

/// Whether formulas lose so much in double precision that a port has no margin.
fn is_lost(error: &f64) -> bool {
    *error > f64::from(TOLERANCE) / 2.0
}

/// Whether any digit of a function is right in a precision.
fn has_digits(error: &f64) -> bool {
    *error < f64::from(u16::MAX)
}

fn accept(accepted: &mut [u32], errors: &[f64]) {
    for (accepted, error) in accepted.iter_mut().zip(errors).filter(|(_, error)| is_lost(error)) {
        *accepted = (*accepted).max((MARGIN * error).ceil() as u32);
    }
}

const GRADIENT: Output = Output::Quantity(Quantity::DisplacementGradient);

/// Points and times of a body: some spread over both, and each corner at the first or the last time.
fn points(compiled: &Compiled, parameters: &[Precise], set: usize) -> Vec<Sample> {
    let (extent, [first, last]) = domain(&compiled.program, parameters);
    let dimension = extent.dimension();
    let inner = (1..=POINTS).map(|index| halton::<Precise>(index).to_vec());
    let corners = (0..1 << dimension).map(|corner: u32| {
        let end = |bit: bool| Precise::from_f64(if bit { 1.0 } else { 0.0 });
        let mut fractions: Vec<_> = (0..4).map(|axis| end(corner >> axis & 1 == 1)).collect();
        fractions[3] = end(corner.count_ones() % 2 == 1);
        fractions
    });
    let round = |value: Precise| single(value.to_f64());
    let at = |(index, fractions): (usize, Vec<Precise>)| {
        // A different direction at each point.
        let direction: Vec<f64> = (0..compiled.field.dimension)
            .map(|axis| ((7 * index + 3 * axis) as f64).cos())
            .collect();
        let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
        let time = first.clone() + (last.clone() - first.clone()) * fractions[3].clone();
        Sample {
            set,
            time: round(time),
            coordinates: extent.point(&fractions).into_iter().map(round).collect(),
            normal: direction.into_iter().map(|x| single(x / length)).collect(),
            gradient: Vec::new(),
        }
    };
    inner.chain(corners).enumerate().map(at).collect()
}

/// A gradient close to the gradient of a field. In a body that keeps its volume, J - 1 is a difference of larger numbers,
/// and no formula computes all its digits from a rounded H.
fn another(gradient: Vec<f64>) -> Vec<f64> {
    let factors = (0..).map(|index| 1.0 + f64::from(index) / 16.0);
    gradient.into_iter().zip(factors).map(|(value, factor)| single(value * factor)).collect()
}

/// The nearest number of single precision; 0 for one that would lose digits by its size.
fn single(value: f64) -> f64 {
    let near = value as f32;
    match near.is_subnormal() {
        true => 0.0,
        false if near.is_finite() => f64::from(near),
        false => value,
    }
}

/// The nearest number of single precision to a parameter, which may not become 0: the field may divide by it.
fn single_parameter(value: f64) -> f64 {
    match single(value) {
        0.0 => value,
        near => near,
    }
}

fn exact(value: f64) -> Rational {
    Rational::try_from(value).unwrap_or(Rational::ZERO)
}

fn precise(values: &[f64]) -> Vec<Precise> {
    values.iter().map(|value| Precise::from_f64(*value)).collect()
}

fn rounded(values: Vec<Precise>) -> Vec<f64> {
    // A zero has no sign.
    values.iter().map(|value| value.to_f64() + 0.0).collect()
}
