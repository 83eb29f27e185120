//! A body in numbers, and points spread evenly (a low-discrepancy sequence) over it.

use std::f64::consts::TAU;

use mms_program::interpret::Number;
use mms_spec::Face;
use mms_symbolic::expr::Rational;

/// What rounding makes of a bound, relative to the larger one.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// A body in numbers.
#[derive(Clone, Debug)]
pub enum Extent<T> {
    /// A box: its least and its greatest coordinates.
    Box([Vec<T>; 2]),
    /// A ring or a sector of it: inner and outer radius, first and last angle.
    Annulus([T; 2], [T; 2]),
}

impl<T: Number> Extent<T> {
    /// The point at these fractions of the way from one end to the other: of each edge of a box;
    /// of the angle and of the radius of an annulus.
    pub fn point(&self, fractions: &[T]) -> Vec<T> {
        match self {
            Extent::Box([lower, upper]) => {
                let edges = lower.iter().zip(upper).zip(fractions);
                edges.map(|((lower, upper), fraction)| between(lower, upper, fraction)).collect()
            }
            Extent::Annulus([inner, outer], [first, last]) => {
                let angle = between(first, last, &fractions[0]);
                let radius = between(inner, outer, &fractions[1]);
                vec![radius.clone() * angle.clone().cos(), radius * angle.sin()]
            }
        }
    }

    /// How many fractions a point has.
    pub fn dimension(&self) -> usize {
        match self {
            Extent::Box([lower, _]) => lower.len(),
            Extent::Annulus(..) => 2,
        }
    }
}

impl Extent<f64> {
    /// Whether a point is in the body or on its boundary, or within rounding of it.
    pub fn contains(&self, point: &[f64]) -> bool {
        match (self, point) {
            (Extent::Box([lower, upper]), _) => lower
                .iter()
                .zip(upper)
                .zip(point)
                .all(|((lower, upper), coordinate)| is_between(*lower, *upper, *coordinate)),
            (Extent::Annulus([inner, outer], [first, last]), [x, y]) => {
                let turns = (y.atan2(*x) - first).rem_euclid(TAU);
                // A little before the first angle is nearly a turn behind it.
                let angle = if TAU - turns <= ROUNDING * TAU { 0.0 } else { turns };
                is_between(*inner, *outer, x.hypot(*y)) && is_between(0.0, last - first, angle)
            }
            (Extent::Annulus(..), _) => false,
        }
    }
}

impl Extent<f64> {
    /// The length, area or volume of the body.
    pub fn measure(&self) -> f64 {
        match self {
            Extent::Box([lower, upper]) => lower.iter().zip(upper).map(|(a, b)| b - a).product(),
            Extent::Annulus([inner, outer], [first, last]) => {
                (last - first) / 2.0 * (outer * outer - inner * inner)
            }
        }
    }

    /// How far a point is from the body, in the unit of lengths; 0 within it.
    pub fn distance(&self, point: &[f64]) -> f64 {
        match (self, point) {
            (Extent::Box([lower, upper]), _) => {
                let sides = point.iter().zip(lower.iter().zip(upper));
                sides.map(|(x, (a, b))| beyond(*x, *a, *b).powi(2)).sum::<f64>().sqrt()
            }
            (Extent::Annulus([inner, outer], [first, last]), [x, y]) => {
                if (y.atan2(*x) - first).rem_euclid(TAU) <= last - first {
                    return beyond(x.hypot(*y), *inner, *outer);
                }
                let to_edge = |angle: &f64| {
                    let (sine, cosine) = angle.sin_cos();
                    let along = (x * cosine + y * sine).clamp(*inner, *outer);
                    (x - along * cosine).hypot(y - along * sine)
                };
                to_edge(first).min(to_edge(last))
            }
            (Extent::Annulus(..), _) => f64::INFINITY,
        }
    }
}

impl Extent<f64> {
    /// How far a point of the body is from a face of it, in the unit of lengths; infinitely far from one that the body does
    /// not have.
    pub fn distance_to(&self, face: Face, point: &[f64]) -> f64 {
        match (self, face, point) {
            (Extent::Box([lower, _]), Face::Min(axis), _) if axis < lower.len() => {
                (point[axis] - lower[axis]).abs()
            }
            (Extent::Box([_, upper]), Face::Max(axis), _) if axis < upper.len() => {
                (upper[axis] - point[axis]).abs()
            }
            (Extent::Annulus([inner, _], _), Face::Inner, [x, y]) => (x.hypot(*y) - inner).abs(),
            (Extent::Annulus([_, outer], _), Face::Outer, [x, y]) => (outer - x.hypot(*y)).abs(),
            (Extent::Annulus(_, [first, _]), Face::ThetaMin, [x, y]) => to_ray(*first, [*x, *y]),
            (Extent::Annulus(_, [_, last]), Face::ThetaMax, [x, y]) => to_ray(*last, [*x, *y]),
            _ => f64::INFINITY,
        }
    }
}

/// How far a point is from the ray at an angle.
fn to_ray(angle: f64, [x, y]: [f64; 2]) -> f64 {
    let (sine, cosine) = angle.sin_cos();
    let along = (x * cosine + y * sine).max(0.0);
    (x - along * cosine).hypot(y - along * sine)
}

fn beyond(value: f64, lower: f64, upper: f64) -> f64 {
    (lower - value).max(value - upper).max(0.0)
}

/// Whether a number lies between two others, or within rounding of them.
pub fn is_between(lower: f64, upper: f64, value: f64) -> bool {
    let rounding = ROUNDING * f64::max(lower.abs(), upper.abs());
    (lower - rounding..=upper + rounding).contains(&value)
}

pub(crate) fn between<T: Number>(from: &T, to: &T, fraction: &T) -> T {
    from.clone() + (to.clone() - from.clone()) * fraction.clone()
}

/// The point of that index, from 1 on, of the Halton sequence (Halton, Numer. Math. 2, 1960) in
/// the unit cube of four dimensions.
pub fn halton<T: Number>(index: usize) -> [T; 4] {
    [2, 3, 5, 7].map(|base| T::from_rational(&radical_inverse(index, base)))
}

/// The point of that index, from 1 on, of the Halton sequence in the unit cube of any dimension.
pub fn spread(index: usize, dimension: usize) -> Vec<Rational> {
    let mut primes: Vec<usize> = Vec::with_capacity(dimension);
    for n in 2.. {
        if primes.len() == dimension {
            break;
        }
        let mut divisors = primes.iter().take_while(|prime| *prime * *prime <= n);
        if divisors.all(|prime| !n.is_multiple_of(*prime)) {
            primes.push(n);
        }
    }
    primes.into_iter().map(|base| radical_inverse(index, base)).collect()
}

/// The digits of `index` in `base`, mirrored at the radix point.
fn radical_inverse(mut index: usize, base: usize) -> Rational {
    let (mut numerator, mut denominator) = (0usize, 1usize);
    while index > 0 {
        numerator = numerator * base + index % base;
        denominator *= base;
        index /= base;
    }
    Rational::from_parts(numerator.into(), denominator.into())
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    /// Against the nearest of many points of the body.
    #[test]
    fn distances_are_those_to_the_nearest_point() {
        let bodies = [
            Extent::Box([vec![0.0, -1.0], vec![2.0, 1.0]]),
            Extent::Annulus([1.0, 2.0], [0.25 * PI, 1.5 * PI]),
            Extent::Annulus([0.5, 1.0], [0.0, 2.0 * PI]),
        ];
        let fractions = || (0..=400).map(|k| f64::from(k) / 400.0);
        for body in &bodies {
            for [x, y] in [[0.0, 0.0], [3.0, 2.0], [0.1, -1.7], [1.5, 0.2], [-1.2, 0.3], [0.2, 0.1]]
            {
                let points =
                    fractions().flat_map(|a| fractions().map(move |b| body.point(&[a, b])));
                let nearest =
                    points.map(|p| (p[0] - x).hypot(p[1] - y)).fold(f64::INFINITY, f64::min);
                let found = body.distance(&[x, y]);
                assert!((found - nearest).abs() < 0.02, "{body:?}, {x}, {y}: {found}, {nearest}");
                assert_eq!(found == 0.0, body.contains(&[x, y]), "{body:?}, {x}, {y}");
            }
        }
        assert_eq!(bodies[0].distance_to(Face::Max(1), &[0.5, 0.75]), 0.25);
        assert_eq!(bodies[0].distance_to(Face::Inner, &[0.5, 0.75]), f64::INFINITY);
        assert!((bodies[1].distance_to(Face::Outer, &[-1.5, 0.0]) - 0.5).abs() < 1e-15);
        assert!((bodies[1].distance_to(Face::ThetaMin, &[0.0, 2.0]) - 2f64.sqrt()).abs() < 1e-15);
        assert!((bodies[1].distance_to(Face::ThetaMax, &[-1.0, -1.0]) - 1.0).abs() < 1e-15);
        assert_eq!(bodies[0].measure(), 4.0);
        assert!((bodies[2].measure() - 0.75 * PI).abs() < 1e-12);
    }
}
