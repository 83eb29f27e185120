//! Points spread evenly over the declared body and time window.

use crate::compile::Compiled;
use crate::expr::Rational;
use crate::program::interpret::{Interpreter, Number};
use crate::program::{Bound, Output};
use crate::spec::Body;

/// A reference position and a time.
#[derive(Clone, Debug)]
pub struct Sample<T> {
    /// X, `dimension` components.
    pub coordinates: Vec<T>,
    /// t.
    pub time: T,
}

/// The first `count` points of the Halton sequence (Halton, Numer. Math. 2, 1960), mapped to the
/// domain of a field with these parameters.
pub fn samples<T: Number>(compiled: &Compiled, parameters: &[T], count: usize) -> Vec<Sample<T>> {
    let interpreter = Interpreter::new(&compiled.program, parameters);
    let bound = |bound: Bound| interpreter.output(Output::Bound(bound));
    let time = bound(Bound::Time);
    let between =
        |from: &T, to: &T, fraction: T| from.clone() + (to.clone() - from.clone()) * fraction;
    (1..=count)
        .map(|index| {
            let fraction =
                |axis: usize| T::from_rational(&radical_inverse(index, [2, 3, 5, 7][axis]));
            let coordinates = match &compiled.field.domain.body {
                Body::Box { .. } => {
                    let (lower, upper) = (bound(Bound::Lower), bound(Bound::Upper));
                    let edges = lower.iter().zip(&upper).enumerate();
                    edges
                        .map(|(axis, (lower, upper))| between(lower, upper, fraction(axis)))
                        .collect()
                }
                Body::Annulus { .. } => {
                    let theta = bound(Bound::Theta);
                    let angle = between(&theta[0], &theta[1], fraction(0));
                    let (inner, outer) = (bound(Bound::Inner), bound(Bound::Outer));
                    let radius = between(&inner[0], &outer[0], fraction(1));
                    vec![radius.clone() * angle.clone().cos(), radius * angle.sin()]
                }
            };
            Sample { coordinates, time: between(&time[0], &time[1], fraction(3)) }
        })
        .collect()
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
