//! The cube root and powers.

use super::number::Float;
use super::{exponential, logarithm};
use crate::lane::Lane;

/// The cube root. At most 0.9 ulp, for 0 and all normal numbers.
///
/// A third of the bits approximates x^(-1/3) to some 3 %, a polynomial improves it to half the digits, and one step of Halley's
/// method to the root. A root of half the digits has an exact square.
#[inline(always)]
pub fn cbrt<T: Float, const FUSED: bool>(x: Lane<T, FUSED>) -> Lane<T, FUSED> {
    let magnitude = x.abs();
    let integers = T::INTEGERS * T::of(2.0 / 3.0);
    let upper = T::from_bits((magnitude.0.bits() >> T::CBRT_SHIFT) | integers.bits());
    let upper = Lane::<T, FUSED>(upper - integers);
    let shift = T::INTEGERS;
    let third = upper.times_plus(Lane::of(-1.0 / 3.0), Lane(shift + T::CBRT_OFFSET));
    let inverse = Lane(T::from_bits((third.0.bits() - shift.bits()) << T::CBRT_SHIFT));
    let off = (magnitude * inverse).times_from(inverse * inverse, Lane::of(1.0));
    let inverse = inverse * off.polynomial(T::POLYNOMIALS.inverse_cbrt);
    let root = Lane(T::from_bits((magnitude * inverse * inverse).0.bits() & T::UPPER_HALF));
    let step = magnitude / (root * root) - root;
    let relative = step * inverse * Lane::of(-1.0 / 3.0);
    let root = root + (step * Lane::of(1.0 / 3.0)).times_plus(relative, step * Lane::of(1.0 / 3.0));
    let normal = magnitude.0 >= T::MIN_POSITIVE && magnitude.0 <= T::MAX;
    let root = if normal { root } else { Lane(T::NAN) };
    let root = if magnitude.0 == T::of(0.0) { magnitude } else { root };
    root.turned(x.sign())
}

/// (ln((1 + s)/(1 - s))/s - 2)/s^2 = 2/3 + z Q(z) in z = s^2: minimax on [0, 0.1716^2] with a fixed 2/3, relative error
/// 1.1e-20.
const TAIL: [f64; 7] = [
    0.4000000000000225,
    0.2857142857010208,
    0.22222222519495557,
    0.18181784403112633,
    0.15386755731760154,
    0.13256853711112135,
    0.1319600621324027,
];

/// 2/3 as a sum.
const TWO_THIRDS: [f64; 2] = [0.6666666666666666, 3.700743415417188e-17];

/// ln x to some 65 binary digits, on the range of [`logarithm::ln`].
#[inline(always)]
fn long_logarithm<const FUSED: bool>(x: Lane<f64, FUSED>) -> [Lane<f64, FUSED>; 2] {
    let (n, _, m) = logarithm::split(x);
    let one = Lane(1.0);
    let f = m - one;
    let below = m + one;
    let inverse = one / below;
    let s = f * inverse;
    let (product, rest) = s.product(below);
    let left = ((f - product) - rest) - s * (m - (below - one));
    let s_rest = left * inverse;
    let (z, z_rest) = s.product(s);
    let z_rest = (s + s).times_plus(s_rest, z_rest);
    let [two_thirds, third_rest] = TWO_THIRDS.map(Lane);
    let (w, w_rest) = two_thirds.sum(z * z.polynomial(&TAIL));
    let w_rest = w_rest + third_rest;
    let (cube, cube_rest) = z.product(s);
    let cube_rest = z.times_plus(s_rest, z_rest.times_plus(s, cube_rest));
    let (tail, tail_rest) = cube.product(w);
    let tail_rest = cube.times_plus(w_rest, cube_rest.times_plus(w, tail_rest));
    let (high, first) = (n * Lane(f64::LN_2[0])).sum(s + s);
    let (high, second) = high.sum(tail);
    let small = n.times_plus(Lane(f64::LN_2[1]), s_rest + s_rest + tail_rest);
    let (high, low) = high.sum((first + second) + small);
    [high, low + logarithm::zero_within(n)]
}

/// x^y. At most 1.3 ulp, if x is in the range of the logarithm and the result in the range of the exponential function.
#[inline(always)]
pub fn of_double<const FUSED: bool>(x: Lane<f64, FUSED>, y: Lane<f64, FUSED>) -> Lane<f64, FUSED> {
    let [high, low] = long_logarithm(x);
    let (product, rest) = y.product(high);
    exponential::exp_of_sum(product, y.times_plus(low, rest))
}

/// x^y. At most 0.6 ulp, for positive x.
#[inline(always)]
pub fn of_single<const FUSED: bool>(x: Lane<f32, FUSED>, y: Lane<f32, FUSED>) -> Lane<f32, FUSED> {
    let [x, y] = [x, y].map(|value| Lane::<f64, FUSED>(f64::from(value.0)));
    Lane(exponential::exp(y * logarithm::ln(x)).0 as f32)
}
