//! The dependence of a field on its parameters: which one scales the displacement, and where J is small or large.

use mms_math::Scalar as _;

use super::points::{Input, SampleRegion, exact, inputs};
use mms_codegen::compile::Compiled;
use mms_mechanics::extent::{Extent, spread};
use mms_mechanics::sample::domain;
use mms_mechanics::{Bound, Output};
use mms_program::interpret::{Interpreter, Point};
use mms_program::precise::Precise;
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::Rational;
use mms_symbolic::sorted::SortedMap;

/// The number of points that show the effect of a parameter.
const POINTS: usize = 64;

/// The factor, as a power of two, by which a parameter is reduced to test whether u is proportional to a power of it.
const REDUCED: i32 = 30;

/// The number of doublings of an amplitude that are tried.
const DOUBLINGS: usize = 40;

/// A parameter with which the displacement vanishes.
#[derive(Clone, Copy, Debug)]
pub struct Amplitude {
    /// The index of the parameter.
    pub parameter: usize,
    /// The default of the parameter.
    pub value: f64,
    /// For small values, the largest |u| is `factor` times the parameter to the power `order`.
    factor: f64,
    order: f64,
}

impl Amplitude {
    /// The amplitude with this index, if all of u vanishes with it and neither body nor time window depend on it.
    pub fn of(compiled: &Compiled, parameter: usize) -> Option<Amplitude> {
        let value = compiled.parameters::<f64>(&SortedMap::new())[parameter];
        let reduced = value * 2f64.powi(-REDUCED);
        if value == 0.0 || !value.is_finite() || !reduced.is_normal() {
            return None;
        }
        let [with, without] = [value, reduced].map(|value| set(parameter, value));
        if bounds(compiled, &with) != bounds(compiled, &without) {
            return None;
        }
        let [whole, rest] = [with, without].map(|set| largest_displacement(compiled, &set));
        let scale = 2f64.powi(-REDUCED);
        let vanishes = whole > 0.0 && rest > 0.0 && rest <= 2.0 * scale * whole;
        let order = ((whole / rest).log2() / f64::from(REDUCED)).round();
        vanishes.then(|| Amplitude {
            parameter,
            value,
            factor: rest / reduced.abs().powf(order),
            order,
        })
    }

    /// The first amplitude of a field.
    pub fn find(compiled: &Compiled) -> Option<Amplitude> {
        (0..compiled.model.parameters.len())
            .filter(|index| !compiled.field.parameters[*index].frozen)
            .find_map(|index| Self::of(compiled, index))
    }

    /// The parameter value for which the largest |u| is about `displacement`, if that is small.
    pub fn for_displacement(&self, displacement: f64) -> f64 {
        (displacement / self.factor).powf(1.0 / self.order).copysign(self.value)
    }
}

/// A setting of one parameter; empty if the value is not finite.
pub fn set(parameter: usize, value: f64) -> SortedMap<usize, Rational> {
    exact(value).map(|value| (parameter, value)).into_iter().collect()
}

fn bounds(compiled: &Compiled, set: &SortedMap<usize, Rational>) -> Vec<f64> {
    let interpreter = Interpreter::new(&compiled.program, &compiled.parameters::<f64>(set));
    let all = Bound::ALL.into_iter();
    all.flat_map(|bound| interpreter.output(Output::Bound(bound))).collect()
}

/// The largest |u|, with 77 digits: differences in the formula may cancel.
fn largest_displacement(compiled: &Compiled, set: &SortedMap<usize, Rational>) -> f64 {
    let output = Output::Quantity(Quantity::Displacement);
    let parameters = compiled.parameters::<Precise>(set);
    let mut interpreter = Interpreter::new(&compiled.program, &parameters);
    let plan = interpreter.plan(&[output]);
    let points = inputs(compiled, &compiled.parameters::<f64>(set), SampleRegion::Body, POINTS);
    let mut largest = 0.0_f64;
    for input in points {
        let coordinates: Vec<_> = input.coordinates.iter().map(|x| Precise::from_f64(*x)).collect();
        interpreter.set_time(&Precise::from_f64(input.time));
        interpreter.set_point(&plan, Point::at(&coordinates));
        let components = interpreter.output(output);
        largest = components.iter().map(|u| u.to_f64().abs()).fold(largest, f64::max);
    }
    largest
}

/// The region in which J is searched.
#[derive(Clone, Copy, Debug)]
pub enum Search {
    /// The requested number of points of the body and the time window, where errors are measured.
    Points(usize),
    /// All of the body and the time window.
    Everywhere,
}

/// The number of points of the whole body that are tested first.
const SPREAD: usize = 256;

/// The part of the body's edges and the time window to which an extremum of J is located.
const FINEST: f64 = 1e-9;

/// J of a field with some parameters.
struct Jacobian<'a> {
    interpreter: Interpreter<'a, f64, Output>,
    plan: Vec<bool>,
    extent: Extent<f64>,
    window: [f64; 2],
}

impl<'a> Jacobian<'a> {
    const OUTPUT: Output = Output::Quantity(Quantity::Jacobian);

    fn new(compiled: &'a Compiled, set: &SortedMap<usize, Rational>) -> Self {
        let parameters = compiled.parameters::<f64>(set);
        let interpreter = Interpreter::new(&compiled.program, &parameters);
        let plan = interpreter.plan(&[Self::OUTPUT]);
        let (extent, window) = domain(&compiled.program, &parameters);
        Jacobian { interpreter, plan, extent, window }
    }

    fn at(&mut self, coordinates: &[f64], time: f64) -> f64 {
        self.interpreter.set_time(&time);
        self.interpreter.set_point(&self.plan, Point::at(coordinates));
        self.interpreter.output(Self::OUTPUT)[0]
    }

    /// J at these fractions of the body's edges and of the time window.
    fn at_fractions(&mut self, fractions: &[f64]) -> f64 {
        let (time, place) = fractions.split_last().unwrap_or((&0.0, &[]));
        let [first, last] = self.window;
        let coordinates = self.extent.point(place);
        self.at(&coordinates, first + (last - first) * time)
    }

    /// The least of `sign` J: by compass search from the best of many places (Hooke, Jeeves, J. ACM 8 (1961) 212-229).
    fn least_everywhere(&mut self, sign: f64, places: &[Vec<f64>]) -> f64 {
        let (mut best, mut place) = (f64::INFINITY, Vec::new());
        for fractions in places {
            let value = sign * self.at_fractions(fractions);
            if value < best {
                (best, place) = (value, fractions.clone());
            }
        }
        let mut step = 0.125;
        while step > FINEST {
            let before = best;
            for axis in 0..place.len() {
                for direction in [-step, step] {
                    let mut moved = place.clone();
                    moved[axis] = (moved[axis] + direction).clamp(0.0, 1.0);
                    let value = sign * self.at_fractions(&moved);
                    if value < best {
                        (best, place) = (value, moved);
                    }
                }
            }
            if best == before {
                step /= 2.0;
            }
        }
        best
    }
}

/// The points where J is evaluated.
enum Points {
    /// At these points.
    Some(Vec<Input<f64>>),
    /// Searches from these places, as fractions of the body's edges and of the time window.
    From(Vec<Vec<f64>>),
}

impl Points {
    fn new(compiled: &Compiled, search: Search) -> Self {
        let parameters = compiled.parameters::<f64>(&SortedMap::new());
        match search {
            Search::Points(count) => {
                Points::Some(inputs(compiled, &parameters, SampleRegion::Body, count))
            }
            Search::Everywhere => {
                let axes = domain(&compiled.program, &parameters).0.dimension() + 1;
                let parts = |index| spread(index, axes).iter().map(nearest).collect();
                Points::From((1..=SPREAD).map(parts).collect())
            }
        }
    }

    /// The least of `sign` J.
    fn least(&self, compiled: &Compiled, set: &SortedMap<usize, Rational>, sign: f64) -> f64 {
        let mut jacobian = Jacobian::new(compiled, set);
        match self {
            Points::Some(points) => points
                .iter()
                .map(|input| sign * jacobian.at(&input.coordinates, input.time))
                .fold(f64::INFINITY, f64::min),
            Points::From(places) => jacobian.least_everywhere(sign, places),
        }
    }
}

fn nearest(number: &Rational) -> f64 {
    number.to_f64().value()
}

/// The value of an amplitude of least magnitude at which the least J is `target`, if `target` is less than 1, or else at which
/// the greatest J is; the error describes the range of J.
pub fn amplitude_for_jacobian(
    compiled: &Compiled,
    amplitude: &Amplitude,
    target: f64,
    search: Search,
) -> Result<f64, String> {
    let points = Points::new(compiled, search);
    let least =
        |value: f64, sign: f64| points.least(compiled, &set(amplitude.parameter, value), sign);
    let sign = if target < 1.0 { 1.0 } else { -1.0 };
    let is_beyond = |value: f64| least(value, sign) < sign * target;
    let sizes = (0..2 * DOUBLINGS).map(|step| step as f64 - DOUBLINGS as f64);
    let mut tried = sizes.flat_map(|power| [1.0, -1.0].map(|sign| sign * 2f64.powf(power)));
    let found = tried.find(|factor| is_beyond(factor * amplitude.value));
    let Some(factor) = found else {
        let [least, greatest] = [1.0, -1.0].map(|sign| sign * least(amplitude.value, sign));
        return Err(format!(
            "J lies between {least:.3} and {greatest:.3} by default, and no amplitude makes it {target:e}"
        ));
    };
    let (mut within, mut beyond) = (0.5 * factor * amplitude.value, factor * amplitude.value);
    for _ in 0..60 {
        let middle = 0.5 * (within + beyond);
        if is_beyond(middle) {
            beyond = middle;
        } else {
            within = middle;
        }
    }
    Ok(within)
}
