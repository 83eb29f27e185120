//! The exponential function and functions derived from it.
//!
//! x = n ln 2 + r with |r| <= (ln 2)/2, and 2^n is assembled from the bits of n.

use super::number::Float;
use crate::lane::Lane;

/// r as a sum, and the exponent's bits of 2^(n + offset).
#[inline(always)]
fn reduced<T: Float, const FUSED: bool>(
    x: Lane<T, FUSED>,
    offset: f64,
) -> ([Lane<T, FUSED>; 2], T::Bits) {
    let (n, bits) = x.nearest(Lane::of(core::f64::consts::LOG2_E), T::BIAS + T::of(offset));
    let coarse = n.times_from(Lane(T::LN_2[0]), x);
    let near = n.times_from(Lane(T::LN_2[1]), coarse);
    let rest = n.times_from(Lane(T::LN_2[1]), coarse - near);
    ([near, rest], bits << (T::DIGITS - 1))
}

/// e^(x + rest), where rest is less than some digits of x.
#[inline(always)]
pub fn exp_of_sum<T: Float, const FUSED: bool>(
    x: Lane<T, FUSED>,
    rest: Lane<T, FUSED>,
) -> Lane<T, FUSED> {
    let ([r, _], scale) = reduced(x, 0.0);
    let r = r + (rest + x.zero_within(T::LARGEST_EXPONENT));
    let one = Lane::of(1.0);
    let value = r.polynomial(T::POLYNOMIALS.exp).times_plus(r, one).times_plus(r, one);
    value * Lane(T::from_bits(scale))
}

/// The exponential function. At most 1.15 ulp in `f64` and 1.1 in `f32`, for |x| <= 708.7 in `f64` and 87.6 in `f32`.
#[inline(always)]
pub fn exp<T: Float, const FUSED: bool>(x: Lane<T, FUSED>) -> Lane<T, FUSED> {
    // The rest is -0: the compiler may omit the addition of -0, but not of 0.
    exp_of_sum(x, Lane::of(-0.0))
}

/// exp(x) - 1. At most 1.05 ulp in `f64` and 1.0 in `f32`, for |x| <= 708.7 in `f64` and 87.6 in `f32`.
#[inline(always)]
pub fn exp_m1<T: Float, const FUSED: bool>(x: Lane<T, FUSED>) -> Lane<T, FUSED> {
    let ([r, rest], scale) = reduced(x, 0.0);
    let scale = Lane(T::from_bits(scale));
    let less = scale - Lane::of(1.0);
    let high = scale.times_plus(r, less);
    let low = scale.times_plus(r, less - high);
    let rest = rest + x.zero_within(T::LARGEST_EXPONENT);
    let curved = (r * r).times_plus(r.polynomial(T::POLYNOMIALS.exp), rest);
    (high + scale.times_plus(curved, low)).signed_as(x)
}

/// sinh(x), cosh(x) and exp(-x), from the same functions of r and n ln 2. Neither division nor cancellation.
#[inline(always)]
fn hyperbolic<T: Float, const FUSED: bool>(x: Lane<T, FUSED>) -> [Lane<T, FUSED>; 3] {
    let ([r, rest], up) = reduced(x, -1.0);
    let bias = (T::of(1.0).bits() << 1) - (T::ONE << T::DIGITS);
    let [up, down] = [up, bias - up].map(|bits| Lane(T::from_bits(bits)));
    let (cosh, sinh) = (up + down, up - down);
    let s = r * r;
    let curved = (r * s).times_plus(s.polynomial(T::POLYNOMIALS.sinh), rest);
    let less = s * s.polynomial(T::POLYNOMIALS.cosh);
    let high = r.times_plus(cosh, sinh);
    let low = r.times_plus(cosh, sinh - high);
    let sum = high + less.times_plus(sinh, curved.times_plus(cosh, low));
    let inverse = (down + down) * (Lane::of(1.0) + (less - (r + curved)));
    [sum, cosh + less.times_plus(cosh, (r + curved) * sinh), inverse]
}

/// The hyperbolic sine. At most 1.3 ulp in `f64` and 1.2 in `f32`, for |x| <= 707 in `f64` and 86 in `f32`.
#[inline(always)]
pub fn sinh<T: Float, const FUSED: bool>(x: Lane<T, FUSED>) -> Lane<T, FUSED> {
    let [sinh, ..] = hyperbolic(x);
    (sinh + x.zero_within(T::LARGEST_EXPONENT - T::of(1.6))).signed_as(x)
}

/// The hyperbolic cosine. At most 1.3 ulp in `f64` and 1.6 in `f32`, for |x| <= 707 in `f64` and 86 in `f32`.
#[inline(always)]
pub fn cosh<T: Float, const FUSED: bool>(x: Lane<T, FUSED>) -> Lane<T, FUSED> {
    let [_, cosh, _] = hyperbolic(x);
    cosh + x.zero_within(T::LARGEST_EXPONENT - T::of(1.6))
}

/// The hyperbolic tangent. At most 2.4 ulp.
#[inline(always)]
pub fn tanh<T: Float, const FUSED: bool>(x: Lane<T, FUSED>) -> Lane<T, FUSED> {
    let magnitude = x.abs();
    let limit = Lane(T::LARGEST_TANH);
    let bounded = if magnitude.0 > limit.0 { limit } else { magnitude };
    let [sinh, cosh, inverse] = hyperbolic(bounded);
    // From about 1/2 on it is computed from its difference to 1.
    let large = bounded.0 > T::of(0.55);
    let quotient = if large { inverse } else { sinh } / cosh;
    let tanh = if large { Lane::of(1.0) - quotient } else { quotient };
    tanh.turned(x.sign())
}
