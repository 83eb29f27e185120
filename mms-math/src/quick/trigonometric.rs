//! The sine, the cosine and the tangent.
//!
//! The argument is reduced by the nearest multiple of a quarter turn, and the number of quarter turns selects one of the two
//! polynomials, and its sign. A sine and a cosine of one argument share all of that.

use super::number::Float;
use crate::lane::{Lane, NEAR_ZERO, WITHIN_ONE};

/// The sine and the cosine of the remainder, not yet turned, and the number of quarter turns in the lowest bits.
type Reduced<T, const FUSED: bool> = (Lane<T, FUSED>, Lane<T, FUSED>, <T as Float>::Bits);

#[inline(always)]
fn reduced<T: Float, const FUSED: bool>(x: Lane<T, FUSED>) -> Reduced<T, FUSED> {
    let (turns, bits) = x.nearest(Lane::of(core::f64::consts::FRAC_2_PI), T::of(0.0));
    let [r, rest] = T::quarter_turns_off(x, turns);
    let (sin, cos) = within_an_eighth(r, rest, x.zero_within(T::LARGEST_ANGLE));
    (sin, cos, bits)
}

/// The sine and the cosine of r + rest, |r| <= pi/4. `zero` is added to the square: it is 0 or NaN.
#[inline(always)]
fn within_an_eighth<T: Float, const FUSED: bool>(
    r: Lane<T, FUSED>,
    rest: Lane<T, FUSED>,
    zero: Lane<T, FUSED>,
) -> (Lane<T, FUSED>, Lane<T, FUSED>) {
    let s = r.times_plus(r, zero);
    let sin = (r * s).times_plus(s.polynomial(T::POLYNOMIALS.sin), rest);
    let cos = s.polynomial(T::POLYNOMIALS.cos);
    let (one, half) = (Lane::of(1.0), Lane::of(-0.5));
    let cos = if FUSED {
        one + s.times_plus(s.times_plus(cos, half), -(r * rest))
    } else {
        // Half the square is the largest term: its product must not be rounded.
        let (high, low) = one.sum(s * half);
        high + (low + ((s * s) * cos - r * rest))
    };
    ((r + sin).signed_as(r), cos)
}

#[inline(always)]
fn reduced_half_turns<T: Float, const FUSED: bool>(x: Lane<T, FUSED>) -> Reduced<T, FUSED> {
    let (turns, bits) = x.nearest(Lane::of(2.0), T::of(0.0));
    let r = turns.times_plus(Lane::of(-0.5), x);
    // An eighth of the magnitude below which numbers have halves.
    let zero = x.zero_within(T::INTEGERS * T::of(1.0 / 12.0));
    let [pi, rest] = T::PI.map(Lane);
    if FUSED {
        let s = r.times_plus(r, zero);
        let sin = s.times_plus(s.polynomial(T::POLYNOMIALS.sin_pi), rest);
        let cos = s.times_plus(s.polynomial(T::POLYNOMIALS.cos_pi), Lane::of(1.0));
        (r.times_plus(pi, r * sin), cos, bits)
    } else {
        let (near, low) = r.product(pi);
        let (sin, cos) = within_an_eighth(near, low + r * rest, zero);
        (sin, cos, bits)
    }
}

#[inline(always)]
fn sine<T: Float, const FUSED: bool>((sin, cos, turns): Reduced<T, FUSED>) -> Lane<T, FUSED> {
    let value = if turns & T::ONE == T::ONE { cos } else { sin };
    value.turned(second_bit_as_sign::<T>(turns))
}

#[inline(always)]
fn cosine<T: Float, const FUSED: bool>((sin, cos, turns): Reduced<T, FUSED>) -> Lane<T, FUSED> {
    let value = if turns & T::ONE == T::ONE { sin } else { cos };
    value.turned(second_bit_as_sign::<T>(turns + T::ONE))
}

#[inline(always)]
fn second_bit_as_sign<T: Float>(turns: T::Bits) -> T::Bits {
    (turns << (8 * size_of::<T>() - 2)) & T::SIGN
}

/// The sine. At most 1.1 ulp, for |x| <= 2^20 in `f64` and 2^17 in `f32`.
#[inline(always)]
pub fn sin<T: Float, const FUSED: bool>(x: Lane<T, FUSED>) -> Lane<T, FUSED> {
    sine(reduced(x))
}

/// The cosine. At most 1.1 ulp, for |x| <= 2^20 in `f64` and 2^17 in `f32`.
#[inline(always)]
pub fn cos<T: Float, const FUSED: bool>(x: Lane<T, FUSED>) -> Lane<T, FUSED> {
    cosine(reduced(x))
}

/// The tangent. At most 2.4 ulp, for |x| <= 2^20 in `f64` and 2^17 in `f32`.
#[inline(always)]
pub fn tan<T: Float, const FUSED: bool>(x: Lane<T, FUSED>) -> Lane<T, FUSED> {
    let (sin, cos, turns) = reduced(x);
    let odd = turns & T::ONE == T::ONE;
    let (above, below) = if odd { (cos, -sin) } else { (sin, cos) };
    above / below
}

/// sin(pi x). At most 1.0 ulp, for |x| <= 2^49 in `f64` and 2^20 in `f32`; 0 at integers.
#[inline(always)]
pub fn sin_pi<T: Float, const FUSED: bool>(x: Lane<T, FUSED>) -> Lane<T, FUSED> {
    sine(reduced_half_turns(x))
}

/// cos(pi x). At most 1.0 ulp, for |x| <= 2^49 in `f64` and 2^20 in `f32`; 0 halfway between integers.
#[inline(always)]
pub fn cos_pi<T: Float, const FUSED: bool>(x: Lane<T, FUSED>) -> Lane<T, FUSED> {
    cosine(reduced_half_turns(x))
}

/// The sine. At most 1.7 ulp, for |x| <= [`NEAR_ZERO`].
#[inline(always)]
pub fn sin_near_zero<T: Float, const FUSED: bool>(x: Lane<T, FUSED>) -> Lane<T, FUSED> {
    unreduced_sine(x, NEAR_ZERO, T::POLYNOMIALS.sin_near_zero)
}

/// The cosine for |x| <= [`NEAR_ZERO`]. The error is at most 0.9 of the format's epsilon, also near the zero.
#[inline(always)]
pub fn cos_near_zero<T: Float, const FUSED: bool>(x: Lane<T, FUSED>) -> Lane<T, FUSED> {
    unreduced_cosine(x, NEAR_ZERO, T::POLYNOMIALS.cos_near_zero)
}

/// The sine. At most 1.7 ulp, for |x| <= [`WITHIN_ONE`].
#[inline(always)]
pub fn sin_within_one<T: Float, const FUSED: bool>(x: Lane<T, FUSED>) -> Lane<T, FUSED> {
    unreduced_sine(x, WITHIN_ONE, T::POLYNOMIALS.sin_within_one)
}

/// The cosine. The error is at most 0.9 of the format's epsilon, for |x| <= [`WITHIN_ONE`].
#[inline(always)]
pub fn cos_within_one<T: Float, const FUSED: bool>(x: Lane<T, FUSED>) -> Lane<T, FUSED> {
    unreduced_cosine(x, WITHIN_ONE, T::POLYNOMIALS.cos_within_one)
}

#[inline(always)]
fn unreduced_sine<T: Float, const FUSED: bool>(
    x: Lane<T, FUSED>,
    limit: f64,
    polynomial: &[T],
) -> Lane<T, FUSED> {
    let s = square_within(x, limit);
    (x * s).times_plus(s.polynomial(polynomial), x)
}

#[inline(always)]
fn unreduced_cosine<T: Float, const FUSED: bool>(
    x: Lane<T, FUSED>,
    limit: f64,
    polynomial: &[T],
) -> Lane<T, FUSED> {
    let s = square_within(x, limit);
    let cos = s.times_plus(s.polynomial(polynomial), Lane::of(-0.5));
    s.times_plus(cos, Lane::of(1.0))
}

/// x^2, or NaN if |x| is beyond `limit`.
#[inline(always)]
fn square_within<T: Float, const FUSED: bool>(x: Lane<T, FUSED>, limit: f64) -> Lane<T, FUSED> {
    let s = x * x;
    Lane(T::from_bits(s.0.bits() | s.bits_beyond(T::of(limit * limit))))
}
