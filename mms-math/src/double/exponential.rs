//! The exponential function and the hyperbolic ones.

use core::f64::consts::LN_2;

use super::Double;
use super::exact::nearest_integer;
use super::series::{EXPONENTIAL, polynomial};

/// ln 2 in three parts. The first two have 42 bits, so that products with integers of 11 bits are
/// exact; together they have 137 bits.
pub(super) const LN_2_PARTS: [f64; 3] =
    [0.6931471805598903, 5.49792301870721e-14, 1.1612227229362532e-26];

/// Beyond this magnitude of x, exp(x) is infinite or 0 with any scale.
pub(super) const ALL_OR_NOTHING: f64 = 800.0;

/// Beyond this power of two, one of 1 and the power is negligible beside the other.
const NEGLIGIBLE_POWER: f64 = 110.0;

/// Beyond this argument tanh is 1.
const LARGEST_OF_TANH: f64 = 40.0;

/// exp(x) - 1, for |x| <= 0.35.
fn near_zero(x: Double) -> Double {
    // A zero keeps its sign, which sums would lose.
    if x.high == 0.0 {
        return x;
    }
    x + x * x * polynomial(x, &EXPONENTIAL, 13)
}

/// exp(x) 2^shift, for |x| <= 0.35.
pub(super) fn near_one(x: Double, shift: i32) -> Double {
    (near_zero(x) + Double::ONE).scaled(shift)
}

/// The integer k and the rest r of x = k ln 2 + r, |r| <= 0.35, for |x| <= 800.
fn reduced(x: Double) -> (f64, Double) {
    let count = nearest_integer(x.high / LN_2);
    if count == 0.0 {
        return (0.0, x);
    }
    let rest = LN_2_PARTS.iter().fold(x, |rest, part| rest - Double::of(count * part));
    (count, rest)
}

/// exp(x) 2^shift, for |shift| <= 1: without the overflow that exp(x) alone might have.
fn exp_scaled(x: Double, shift: i32) -> Double {
    if x.high.is_nan() {
        return x;
    }
    if x.high.abs() > ALL_OR_NOTHING {
        return if x.high > 0.0 { Double::INFINITY } else { Double::ZERO };
    }
    let (count, rest) = reduced(x);
    near_one(rest, count as i32 + shift)
}

impl Double {
    pub(super) fn exponential(self) -> Self {
        exp_scaled(self, 0)
    }

    pub(super) fn exponential_m1(self) -> Self {
        if self.high.is_nan() || self.high.abs() > ALL_OR_NOTHING {
            return self.exponential() - Double::ONE;
        }
        let (count, rest) = reduced(self);
        if count == 0.0 {
            return near_zero(rest);
        }
        if count.abs() > NEGLIGIBLE_POWER {
            return self.exponential() - Double::ONE;
        }
        let power = Double::ONE.scaled(count as i32);
        power * near_zero(rest) + (power - Double::ONE)
    }

    /// (e^x - e^-x)/2: from e = exp_m1(x) as (e + e/(1 + e))/2 where the difference would cancel.
    pub(super) fn hyperbolic_sine(self) -> Self {
        if self.high.abs() < 1.0 {
            let e = self.magnitude().exponential_m1();
            return (e + e / (Double::ONE + e)).scaled(-1).with_sign_of(self.high);
        }
        let half = exp_scaled(self.magnitude(), -1);
        (half - Double::of(0.25) / half).with_sign_of(self.high)
    }

    pub(super) fn hyperbolic_cosine(self) -> Self {
        let half = exp_scaled(self.magnitude(), -1);
        half + Double::of(0.25) / half
    }

    /// e/(e + 2) with e = exp_m1(2 x).
    pub(super) fn hyperbolic_tangent(self) -> Self {
        if self.high.abs() > LARGEST_OF_TANH {
            return Double::ONE.with_sign_of(self.high);
        }
        let e = self.magnitude().scaled(1).exponential_m1();
        (e / (e + Double::of(2.0))).with_sign_of(self.high)
    }
}
