//! Several divisions for the price of one, and a square root that is divided by.

use super::number::Float;
use crate::lane::Lane;

/// -0, which no sum changes by, where 0 <= self <= limit, else not a number.
#[inline(always)]
fn nothing_within<T: Float, const FUSED: bool>(x: Lane<T, FUSED>, limit: T) -> Lane<T, FUSED> {
    Lane(x.0 * (T::of(1.0) / limit) * T::MAX * T::of(-0.0))
}

/// above / below, element by element: at most 1.5 ulp. The inverse of the product of all
/// denominators gives the inverse of each (Montgomery, 1987), and a step of Newton's method takes
/// off what its roundings add up to.
///
/// Not a number where that product is beyond the range, or a denominator is 0.
#[inline(always)]
pub fn quotients<T: Float, const FUSED: bool, const N: usize>(
    above: [Lane<T, FUSED>; N],
    below: [Lane<T, FUSED>; N],
) -> [Lane<T, FUSED>; N] {
    let one = Lane::of(1.0);
    let mut products = below;
    for index in 1..N {
        products[index] = products[index - 1] * below[index];
    }
    let mut rest = one / products[N - 1];
    let mut inverses = below;
    for index in (1..N).rev() {
        inverses[index] = rest * products[index - 1];
        rest = rest * below[index];
    }
    inverses[0] = rest;
    let mut squares = Lane::of(0.0);
    for (inverse, below) in inverses.iter_mut().zip(below) {
        let error = inverse.times_from(below, one);
        squares = error.times_plus(error, squares);
        *inverse = inverse.times_plus(error, *inverse);
    }
    let nothing = nothing_within(squares, T::of(1.0) / T::INTEGERS);
    core::array::from_fn(|index| above[index].times_plus(inverses[index], nothing))
}

/// The square root, at most 0.6 ulp in `f64` and 0.7 in `f32`, and its inverse, at most 1.0 ulp,
/// without a division: from a guess at the exponent and the first digits (Lomont, 2003) two steps
/// with the first terms of the binomial series.
///
/// Not a number for what is not positive and normal.
#[inline(always)]
pub fn root_and_inverse<T: Float, const FUSED: bool>(x: Lane<T, FUSED>) -> [Lane<T, FUSED>; 2] {
    let one = Lane::of(1.0);
    let guess = Lane(T::from_bits(T::INVERSE_ROOT - (x.0.bits() >> 1)));
    let error = (x * guess).times_from(guess, one);
    let series = error.times_plus(Lane::of(5.0 / 16.0), Lane::of(3.0 / 8.0));
    let series = error.times_plus(series, Lane::of(0.5));
    let better = (guess * error).times_plus(series, guess);
    let error = (x * better).times_from(better, one);
    let series = error.polynomial(T::INVERSE_ROOT_SERIES);
    let inverse = (better * error).times_plus(series, better);
    let nothing = nothing_within(error * error, T::of(1e-8));
    let root = x.times_plus(inverse, nothing);
    let left = root.times_from(root, x);
    [left.times_plus(inverse * Lane::of(0.5), root), inverse]
}
