//! The logarithm.
//!
//! x = 2^n (1 + f) with 1 + f between the roots of 1/2 and 2, and ln(1 + f) = f - s (f - R(s^2))
//! with s = f/(2 + f) and R(s^2) = ln((1 + s)/(1 - s))/s - 2 (as Ng, fdlibm, 1993, arranges it).

use super::number::Float;
use crate::lane::Lane;

/// The number n of x = 2^n m, the exponent's bits of 2^n and m, whose root bounds are [`Float`]'s; for positive normal x. For
/// any other x, |n| is so large that [`zero_within`] returns NaN.
#[inline(always)]
pub fn split<T: Float, const FUSED: bool>(
    x: Lane<T, FUSED>,
) -> (Lane<T, FUSED>, T::Bits, Lane<T, FUSED>) {
    let root = T::of(core::f64::consts::FRAC_1_SQRT_2).bits();
    let one = T::of(1.0).bits();
    let bits = x.0.bits() - root + one;
    let integers = T::INTEGERS * T::of(2.0 / 3.0);
    let biased = T::from_bits((bits >> (T::DIGITS - 1)) | integers.bits());
    let n = biased - (integers + T::BIAS);
    let m = T::from_bits((bits & T::SIGNIFICAND) + root);
    (Lane(n), bits & !T::SIGNIFICAND, Lane(m))
}

/// 0 for the exponents of positive normal numbers, otherwise NaN.
#[inline(always)]
pub fn zero_within<T: Float, const FUSED: bool>(n: Lane<T, FUSED>) -> Lane<T, FUSED> {
    n.zero_within(T::BIAS - T::of(1.75))
}

/// f - ln(1 + f) - rest.
#[inline(always)]
fn less<T: Float, const FUSED: bool>(f: Lane<T, FUSED>, rest: Lane<T, FUSED>) -> Lane<T, FUSED> {
    let s = f / (f + Lane::of(2.0));
    let z = s * s;
    let g = z.times_from(z.polynomial(T::POLYNOMIALS.ln), f);
    s.times_plus(g, -rest)
}

/// The natural logarithm. At most 0.9 ulp, for all x from sqrt(2) times the least normal number to a sixth of the largest.
#[inline(always)]
pub fn ln<T: Float, const FUSED: bool>(x: Lane<T, FUSED>) -> Lane<T, FUSED> {
    let (n, _, m) = split(x);
    let f = m - Lane::of(1.0);
    let less = less(f, n.times_plus(Lane(T::LN_2[1]), zero_within(n)));
    n.times_plus(Lane(T::LN_2[0]), f - less)
}

/// n, f and f - ln(1 + f) - n (ln 2)'s lesser part, for 1 + x.
#[inline(always)]
fn of_one_plus<T: Float, const FUSED: bool>(x: Lane<T, FUSED>) -> [Lane<T, FUSED>; 3] {
    let one = Lane::of(1.0);
    let (n, bits, _) = split(one + x);
    let scale = Lane(T::from_bits((one.0.bits() << 1) - bits));
    let shift = scale - one;
    let f = x.times_plus(scale, shift);
    let lost = x.times_plus(scale, shift - f);
    let rest = n.times_plus(Lane(T::LN_2[1]), lost + zero_within(n));
    [n, f, less(f, rest)]
}

/// ln(1 + x). At most 1.0 ulp, for all x from -1, exclusive, to a sixth of the largest number.
#[inline(always)]
pub fn ln_1p<T: Float, const FUSED: bool>(x: Lane<T, FUSED>) -> Lane<T, FUSED> {
    let [n, f, less] = of_one_plus(x);
    n.times_plus(Lane(T::LN_2[0]), f - less).signed_as(x)
}

/// x - ln(1 + x), at most 2.8 ulp in `f64` and 2.6 in `f32`, on the range of [`ln_1p`].
#[inline(always)]
pub fn ln_1p_rest<T: Float, const FUSED: bool>(x: Lane<T, FUSED>) -> Lane<T, FUSED> {
    let [n, f, less] = of_one_plus(x);
    (n.times_from(Lane(T::LN_2[0]), x) - f) + less
}
