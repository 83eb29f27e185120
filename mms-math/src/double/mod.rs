//! Double-double arithmetic: some 31 significant digits as the sum of two `f64`.
//!
//! # Accuracy
//!
//! Errors are in units of 2^-104, that is 4.9e-32, relative to the value. These bounds, asserted by
//! tests, are the largest errors against 77 digits, rounded up:
//!
//! | | units |
//! |---|---|
//! | a + b, a - b | 0.6 |
//! | a b, a / b, sqrt, exp, exp_m1, ln, ln_1p, sinh, cosh, tanh, sin, cos, sin_pi, cos_pi, asin, atan, atan2 | 1 |
//! | cbrt, tan, acos | 1.5 |
//! | ln_1p_rest | 3 |
//! | powf | 7, reached where the power is near 2^900 or 2^-900 |
//!
//! After whole turns are subtracted from an angle, the error of the remainder is less than 2^-106 turns.
//!
//! The bounds hold if the low parts of the argument, of the result and of intermediate products are normal numbers: for
//! magnitudes from 2^-960 to 2^1020, say 1e-289 to 1e307. Below, digits fade until only the digits of `f64` remain; above, up
//! to the overflow, the low part of a product may be dropped. Infinities and NaN have no low part, and follow the rules of
//! `f64`. For angles beyond 2^50, that is 1.1e15, sin, cos and tan are NaN; sin_pi and cos_pi have no such limit.

mod exact;
mod exponential;
mod logarithm;
mod root;
mod scalar;
mod series;
mod trigonometric;

use core::ops::{Add, Div, Mul, Neg, Sub};

use exact::{ordered_sum, two_product, two_sum};

/// A number of about 106 significant bits: the unevaluated sum of two `f64`.
///
/// The high part is the sum rounded to nearest. Arithmetic uses no fused multiply-add and no
/// function of a library, so that results are the same on every machine.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Double {
    high: f64,
    low: f64,
}

impl Double {
    const ZERO: Double = Double::of(0.0);
    const ONE: Double = Double::of(1.0);
    const INFINITY: Double = Double::of(f64::INFINITY);
    const NAN: Double = Double::of(f64::NAN);

    /// The sum of two numbers, exact unless it overflows.
    pub const fn new(a: f64, b: f64) -> Self {
        let (high, low) = two_sum(a, b);
        Double::normalised(high, low)
    }

    /// The nearest `f64`.
    pub const fn to_f64(self) -> f64 {
        self.high
    }

    /// The difference from the nearest `f64`.
    pub const fn low(self) -> f64 {
        self.low
    }

    /// Converts `value`.
    const fn of(value: f64) -> Self {
        Double { high: value, low: 0.0 }
    }

    /// The number `sum` + `rest`, where `rest` must be the smaller. A correction that is not finite, such as the round-off of
    /// an infinity, is dropped. A correction of 0 is not added, so that a negative zero keeps its sign.
    const fn normalised(sum: f64, rest: f64) -> Self {
        if rest == 0.0 || !rest.is_finite() {
            return Double::of(sum);
        }
        let (high, low) = ordered_sum(sum, rest);
        if high.is_finite() { Double { high, low } } else { Double::of(high) }
    }

    /// Adds both pairs with their round-off (Joldes, Muller and Popescu, 2017, algorithm 6).
    const fn plus(self, other: Self) -> Self {
        let (sum, sum_rest) = two_sum(self.high, other.high);
        if !sum.is_finite() {
            return Double::of(sum);
        }
        let (low, low_rest) = two_sum(self.low, other.low);
        let first = Double::normalised(sum, sum_rest + low);
        Double::normalised(first.high, low_rest + first.low)
    }

    const fn minus(self, other: Self) -> Self {
        self.plus(other.negated())
    }

    const fn negated(self) -> Self {
        Double { high: -self.high, low: -self.low }
    }

    /// Multiplies without the product of the low parts, which is below the last digit (Dekker, 1971).
    const fn times(self, other: Self) -> Self {
        let (product, rest) = two_product(self.high, other.high);
        Double::normalised(product, rest + (self.high * other.low + self.low * other.high))
    }

    /// Divides by three quotients of high parts, each of the remainder of the last.
    const fn over(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self.minus(other.times(Double::of(first)));
        let second = rest.high / other.high;
        let rest = rest.minus(other.times(Double::of(second)));
        let third = rest.high / other.high;
        let quotient = Double::normalised(first, second);
        Double::normalised(quotient.high, quotient.low + third)
    }

    /// The quotient of two integers below 2^53, each part rounded once: the remainder of a quotient is exact.
    const fn quotient(numerator: f64, denominator: f64) -> Self {
        let high = numerator / denominator;
        let (product, rest) = two_product(high, denominator);
        Double::normalised(high, ((numerator - product) - rest) / denominator)
    }

    /// `self` 2^`shift`, for |shift| <= 2044.
    const fn scaled(self, shift: i32) -> Self {
        Double::normalised(exact::scaled(self.high, shift), exact::scaled(self.low, shift))
    }

    const fn magnitude(self) -> Self {
        if self.high.is_sign_negative() { self.negated() } else { self }
    }

    /// The magnitude of `self` with the sign of `sign`.
    const fn with_sign_of(self, sign: f64) -> Self {
        let magnitude = self.magnitude();
        if sign.is_sign_negative() { magnitude.negated() } else { magnitude }
    }
}

impl From<f64> for Double {
    fn from(value: f64) -> Self {
        Double::of(value)
    }
}

impl Add for Double {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.plus(other)
    }
}

impl Sub for Double {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.minus(other)
    }
}

impl Mul for Double {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.times(other)
    }
}

impl Div for Double {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        self.over(other)
    }
}

impl Neg for Double {
    type Output = Self;
    fn neg(self) -> Self {
        self.negated()
    }
}
