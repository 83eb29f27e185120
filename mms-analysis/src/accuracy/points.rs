//! The points of the body and times of the window where errors are measured, as numbers of a precision.
//!
//! They are random, and the same in every run. One in four lies on a face or close to one.

use mms_codegen::compile::Compiled;
use mms_codegen::variation::free_axes;
use mms_mechanics::extent::Extent;
use mms_mechanics::sample::domain;
use mms_program::precision::Digits;
use mms_symbolic::expr::Rational;

/// The region of points and times.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SampleRegion {
    /// In the body, at times of the window.
    Body,
    /// In the body, with s added along each axis: s is the last parameter.
    Shifted,
    /// In the body, at times a million windows later.
    Late,
    /// In the body, with a coordinate or the time that is subnormal.
    Subnormal,
    /// With a coordinate or the time that is the largest number; outside of the body.
    Largest,
}

/// The number of time windows by which [`SampleRegion::Late`] is later.
pub const LATE: f64 = 1e6;

/// The inputs of one evaluation.
#[derive(Clone, Debug)]
pub struct Input<T> {
    /// X.
    pub coordinates: Vec<T>,
    /// t.
    pub time: T,
    /// N, a unit vector up to rounding.
    pub normal: Vec<T>,
}

/// Random numbers (Steele, Lea & Flood, Fast splittable pseudorandom number generators, 2014).
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number between 0 and 1, with 53 digits.
    fn fraction(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * 2f64.powi(-53)
    }

    /// A number between 0 and 1, with as many digits as the precision has.
    fn digits<T: Digits>(&mut self) -> T {
        let (high, low) = (self.fraction(), self.fraction());
        T::from_parts(high, low * 2f64.powi(-53))
    }

    /// A fraction on a face, or closer to it than 1/1000.
    fn near_face<T: Digits>(&mut self) -> T {
        let kind = self.bits() % 4;
        let distance = T::from_f64(self.fraction() * 2f64.powi(-10));
        match kind {
            0 => T::from_f64(0.0),
            1 => T::from_f64(1.0),
            2 => distance,
            _ => T::from_f64(1.0) - distance,
        }
    }
}

/// Inputs for a field with these parameters. Fewer than `count`, or none, if the body and the time window do not contain that
/// many.
pub fn inputs<T: Digits>(
    compiled: &Compiled,
    parameters: &[T],
    place: SampleRegion,
    count: usize,
) -> Vec<Input<T>> {
    let (extent, window) = domain(&compiled.program, parameters);
    let mut random = Random(0);
    let inputs = (0..count).filter_map(|index| {
        let mut input = inside(&extent, &window, index, &mut random);
        match place {
            SampleRegion::Body => {}
            SampleRegion::Shifted => {
                let shift = *parameters.last()?;
                let axes = free_axes(compiled.field.space);
                input.coordinates[axes].iter_mut().for_each(|x| *x = *x + shift);
            }
            SampleRegion::Late => {
                input.time = input.time + (window[1] - window[0]) * T::from_f64(LATE);
            }
            SampleRegion::Subnormal => subnormal(&mut input, &extent, &window, index)?,
            SampleRegion::Largest => largest(&mut input, index),
        }
        Some(input)
    });
    inputs.collect()
}

fn inside<T: Digits>(
    extent: &Extent<T>,
    [first, last]: &[T; 2],
    index: usize,
    random: &mut Random,
) -> Input<T> {
    let dimension = extent.dimension();
    let mut fractions: Vec<T> = (0..dimension).map(|_| random.digits()).collect();
    if index.is_multiple_of(4) {
        fractions[index / 4 % dimension] = random.near_face();
    }
    let fraction: T = random.digits();
    let direction: Vec<f64> = (0..dimension).map(|_| random.fraction() - 0.5).collect();
    let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
    Input {
        coordinates: extent.point(&fractions),
        time: *first + (*last - *first) * fraction,
        normal: direction.iter().map(|x| T::from_f64(x / length)).collect(),
    }
}

/// The index of the extreme coordinate of an input; `None` for the time. Coordinates and the time take turns.
fn extreme_input(index: usize, dimension: usize) -> Option<usize> {
    Some(index % (dimension + 1)).filter(|axis| *axis < dimension)
}

/// Makes a coordinate or the time subnormal, if that is in the body or in the window.
fn subnormal<T: Digits>(
    input: &mut Input<T>,
    extent: &Extent<T>,
    window: &[T; 2],
    index: usize,
) -> Option<()> {
    let tiny = (1 + index % 1000) as f64 * T::PRECISION.smallest();
    let holds = |from: &T, to: &T| (from.parts().0..=to.parts().0).contains(&tiny);
    let Some(axis) = extreme_input(index, extent.dimension()) else {
        return holds(&window[0], &window[1]).then(|| input.time = T::from_f64(tiny));
    };
    if let Some(bounds) = extent.box_bounds() {
        let [lower, upper] = &bounds[axis];
        return holds(lower, upper).then(|| input.coordinates[axis] = T::from_f64(tiny));
    }
    // On an axis of space, halfway along the body, except for the tiny coordinate.
    let near = extent.map(|value| value.parts().0);
    let coordinates = match extent {
        Extent::Block(block) => {
            let [inner, outer] = block.bounds[0];
            let mut coordinates = vec![T::from_f64(0.0); extent.dimension()];
            coordinates[0] = inner + (outer - inner) * T::from_f64(0.5);
            coordinates[axis.max(1)] = T::from_f64(tiny);
            coordinates
        }
        _ => {
            let mut coordinates = input.coordinates.clone();
            coordinates[axis] = T::from_f64(tiny);
            coordinates
        }
    };
    let place: Vec<f64> = coordinates.iter().map(|value| value.parts().0).collect();
    near.contains(&place).then(|| input.coordinates = coordinates)
}

/// Makes a coordinate or the time the largest number, of either sign.
fn largest<T: Digits>(input: &mut Input<T>, index: usize) {
    let dimension = input.coordinates.len();
    let sign = if (index / (dimension + 1)).is_multiple_of(2) { 1.0 } else { -1.0 };
    let value = T::from_f64(sign * T::PRECISION.largest());
    match extreme_input(index, dimension) {
        Some(axis) => input.coordinates[axis] = value,
        None => input.time = value,
    }
}

/// The size of the body.
pub fn size(compiled: &Compiled, parameters: &[f64]) -> f64 {
    domain(&compiled.program, parameters).0.size()
}

/// Converts a number of double precision exactly.
pub fn exact(value: f64) -> Option<Rational> {
    Rational::try_from(value).ok()
}
