//! The logarithm, the power, and x - ln(1 + x).
//!
//! With x = 2^k m, m near 1, ln x = k ln 2 + 2 artanh((m - 1)/(m + 1)): the argument of the series
//! is at most 0.172, and nothing cancels next to x = 1.

use core::f64::consts::{LN_2, SQRT_2};

use super::Double;
use super::exact::{
    exact_sum, exponent, nearest_integer, ordered_sum, scaled, two_product, two_sum,
};
use super::exponential::{ALL_OR_NOTHING, LN_2_PARTS, near_one};
use super::series::{INVERSE_TANGENT, polynomial};

/// ln 2, both parts rounded to nearest.
const LN_2_DOUBLE: Double = Double { high: LN_2, low: 2.3190468138462996e-17 };

/// The k of x = 2^k m with m between the square roots of 1/2 and 2.
fn binary_exponent(x: f64) -> i32 {
    let exponent = exponent(x);
    if scaled(x, -exponent) > SQRT_2 { exponent + 1 } else { exponent }
}

/// artanh(x)/x - 1, for |x| <= 0.2.
fn artanh_excess(x: Double) -> Double {
    let square = x * x;
    square * polynomial(square, &INVERSE_TANGENT[..24], 12)
}

/// ln(base + x), for a base of 0 or 1 and a positive, finite sum.
fn logarithm_of_sum(base: f64, x: Double) -> Double {
    let count = binary_exponent((Double::of(base) + x).high);
    let below = x.scaled(-count) + Double::new(scaled(base, -count), -1.0);
    let ratio = below / (below + Double::of(2.0));
    let fraction = (ratio + ratio * artanh_excess(ratio)).scaled(1);
    if count == 0 { fraction } else { LN_2_DOUBLE * Double::of(f64::from(count)) + fraction }
}

/// ln x in three parts, for positive finite x: the relative error is about 2^-110.
///
/// The first term of the series is carried to three parts; the others are smaller by 2^-6.
fn logarithm_in_parts(x: Double) -> [f64; 3] {
    let count = binary_exponent(x.high);
    let below = x.scaled(-count) - Double::ONE;
    let (above, carry) = two_sum(2.0, below.high);
    let (above_rest, above_last) = two_sum(carry, below.low);
    let (above, above_rest) = ordered_sum(above, above_rest);
    let ratio = below / Double { high: above, low: above_rest };
    let [a, b] = [(ratio.high, above), (ratio.high, above_rest)].map(|(x, y)| two_product(x, y));
    let c = two_product(ratio.low, above);
    let small = ratio.high * above_last + ratio.low * above_rest;
    let left = [below.high, below.low, -a.0, -a.1, -b.0, -b.1, -c.0, -c.1, -small];
    let ratio_rest = exact_sum(left)[0] / above;
    let further = (ratio * artanh_excess(ratio)).scaled(1);
    let [first, second, third] = LN_2_PARTS.map(|part| part * f64::from(count));
    let [r, s, t] = [ratio.high, ratio.low, ratio_rest].map(|part| 2.0 * part);
    exact_sum([first, second, third, r, s, t, further.high, further.low])
}

/// `base` to the power `exponent`, for a positive base, both finite and neither 0.
///
/// The logarithm and its product have three parts, since the exponential function turns the
/// absolute error of its argument, which may be 700, into a relative one.
fn finite_power(base: Double, exponent: Double) -> Double {
    let logarithm = logarithm_in_parts(base);
    let rough = exponent.high * logarithm[0];
    if rough.abs() > ALL_OR_NOTHING {
        return if rough > 0.0 { Double::INFINITY } else { Double::ZERO };
    }
    let count = nearest_integer(rough / LN_2);
    let a = two_product(exponent.high, logarithm[0]);
    let b = two_product(exponent.high, logarithm[1]);
    let c = two_product(exponent.low, logarithm[0]);
    let small = exponent.high * logarithm[2] + exponent.low * logarithm[1];
    let [first, second, third] = LN_2_PARTS.map(|part| -part * count);
    let rest = exact_sum([a.0, a.1, b.0, b.1, c.0, c.1, small, first, second, third]);
    near_one(Double::new(rest[0], rest[1]), count as i32)
}

/// The power of a base that is not negative.
fn magnitude_power(base: Double, exponent: Double) -> Double {
    if base == Double::ONE {
        return Double::ONE;
    }
    if base.high > 0.0 && base.high.is_finite() && exponent.high.is_finite() {
        return finite_power(base, exponent);
    }
    let grows = (base > Double::ONE) == (exponent.high > 0.0);
    if grows { Double::INFINITY } else { Double::ZERO }
}

/// Whether both parts are integers: the sum is one only then.
fn is_integer(x: Double) -> bool {
    x.high % 1.0 == 0.0 && x.low % 1.0 == 0.0
}

/// Whether an integer is odd.
fn is_odd(x: Double) -> bool {
    (x.high % 2.0 + x.low % 2.0) % 2.0 != 0.0
}

impl Double {
    pub(super) fn logarithm(self) -> Self {
        if self.high > 0.0 && self.high.is_finite() {
            return logarithm_of_sum(0.0, self);
        }
        // For an infinity, 0, a negative number and NaN, in this order.
        if self.high > 0.0 {
            self
        } else if self.high == 0.0 {
            Double::INFINITY.negated()
        } else {
            Double::NAN
        }
    }

    pub(super) fn logarithm_1p(self) -> Self {
        if self.high == 0.0 {
            return self;
        }
        let sum = Double::ONE + self;
        if sum.high > 0.0 && sum.high.is_finite() {
            return logarithm_of_sum(1.0, self);
        }
        sum.logarithm()
    }

    /// x - ln(1 + x): with s = x/(2 + x), x - 2 s = x s, and the terms of artanh(s) from s^3 on are
    /// subtracted from that, for |s| <= 1/5; the difference itself, elsewhere.
    pub(super) fn logarithm_1p_rest(self) -> Self {
        if self.high == f64::INFINITY {
            return self;
        }
        if self.high < -1.0 / 3.0 || self.high > 0.5 {
            return self - self.logarithm_1p();
        }
        let ratio = self / (self + Double::of(2.0));
        ratio * (self - artanh_excess(ratio).scaled(1))
    }

    /// The power, as for `f64`: anything to the power 0, and 1 to any power, is 1, and a negative base needs integer exponents.
    pub(super) fn power(self, exponent: Self) -> Self {
        if exponent.high == 0.0 || self == Double::ONE {
            return Double::ONE;
        }
        if self.high.is_nan() || exponent.high.is_nan() {
            return Double::NAN;
        }
        let power = magnitude_power(self.magnitude(), exponent);
        if !self.high.is_sign_negative() || !exponent.high.is_finite() {
            power
        } else if is_integer(exponent) {
            if is_odd(exponent) { power.negated() } else { power }
        } else if self.high == 0.0 || self.high.is_infinite() {
            power
        } else {
            Double::NAN
        }
    }
}
