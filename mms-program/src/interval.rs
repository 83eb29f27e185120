//! Interval arithmetic: a scalar that represents every number between two bounds, so that one evaluation bounds a program over
//! a whole box.
//!
//! Every operation rounds outward: for any point of the box, the exact value of an expression lies within the result. Sums,
//! products and quotients are rounded by the sign of their exact rounding error, so that an exact result stays exact;
//! elementary functions use directed rounding in arbitrary precision at their bounds (`functions.rs`).

mod functions;
mod quick;

use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::interpret::Number;
use crate::operation_cost;
use mms_symbolic::expr::{Function, Rational};

/// Below this magnitude the rounding error of a product may itself be rounded: 2^-960.
const NEARLY_SUBNORMAL: f64 = 1e-289;

/// The numbers between two bounds, and whether a value is defined at every point of the box that it was computed over.
///
/// A bound may be infinite, and is then not attained. If an operation leaves its domain at some point of the box (a division by
/// an interval with 0, the logarithm of one that reaches 0), the result is not defined, and neither is any value computed from
/// it; its bounds are still valid at every point where the value exists.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    lower: f64,
    upper: f64,
    defined: bool,
}

impl Interval {
    /// The whole line, without a guarantee of a value anywhere.
    pub const UNDEFINED: Interval =
        Interval { lower: f64::NEG_INFINITY, upper: f64::INFINITY, defined: false };

    /// The numbers from `lower` to `upper`, both included; undefined unless `lower <= upper`.
    pub fn new(lower: f64, upper: f64) -> Self {
        if lower <= upper { Interval { lower, upper, defined: true } } else { Interval::UNDEFINED }
    }

    /// The lower bound; minus infinity if there is none.
    pub fn lower(self) -> f64 {
        self.lower
    }

    /// The upper bound; infinity if there is none.
    pub fn upper(self) -> f64 {
        self.upper
    }

    /// Whether the value exists at every point of the box.
    pub fn is_defined(self) -> bool {
        self.defined
    }

    /// Whether a number lies within the bounds.
    pub fn contains(self, number: f64) -> bool {
        self.lower <= number && number <= self.upper
    }

    /// Whether every number of `other` lies within the bounds.
    pub fn encloses(self, other: Interval) -> bool {
        self.lower <= other.lower && other.upper <= self.upper
    }

    /// The numbers within the bounds of both, for two enclosures of one value.
    pub fn meet(self, other: Interval) -> Self {
        let (lower, upper) = (self.lower.max(other.lower), self.upper.min(other.upper));
        // Two disjoint enclosures of one value enclose no value at all.
        Interval::new(lower, upper).only_if(self.defined || other.defined)
    }

    /// The largest magnitude within the bounds.
    pub fn farthest(self) -> f64 {
        self.lower.abs().max(self.upper.abs())
    }

    /// The number halfway between the bounds, or near it.
    pub fn middle(self) -> f64 {
        (self.lower / 2.0 + self.upper / 2.0).clamp(self.lower, self.upper)
    }

    /// The distance of the bounds.
    pub fn width(self) -> f64 {
        self.upper - self.lower
    }

    /// Keeps the bounds, defined only if `condition` is true too.
    fn only_if(mut self, condition: bool) -> Self {
        self.defined &= condition;
        self
    }
}

impl Neg for Interval {
    type Output = Self;
    fn neg(self) -> Self {
        Interval { lower: -self.upper, upper: -self.lower, defined: self.defined }
    }
}

impl Add for Interval {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let lower = sum_below(self.lower, other.lower);
        let upper = -sum_below(-self.upper, -other.upper);
        Interval::new(lower, upper).only_if(self.defined && other.defined)
    }
}

impl Sub for Interval {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Interval {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self, other);
        // The bounds that make the least and the greatest product.
        let ([least, least_by], [greatest, greatest_by]) = if a.lower >= 0.0 {
            let least = if b.lower >= 0.0 { a.lower } else { a.upper };
            let greatest = if b.upper >= 0.0 { a.upper } else { a.lower };
            ([least, b.lower], [greatest, b.upper])
        } else if a.upper <= 0.0 {
            let least = if b.upper >= 0.0 { a.lower } else { a.upper };
            let greatest = if b.lower >= 0.0 { a.upper } else { a.lower };
            ([least, b.upper], [greatest, b.lower])
        } else if b.lower >= 0.0 {
            ([a.lower, b.upper], [a.upper, b.upper])
        } else if b.upper <= 0.0 {
            ([a.upper, b.lower], [a.lower, b.lower])
        } else {
            return a.mixed_product(b);
        };
        let (lower, upper) =
            (product_below(least, least_by), -product_below(-greatest, greatest_by));
        Interval::new(lower, upper).only_if(a.defined && b.defined)
    }
}

impl Interval {
    /// The product of two intervals that both have 0 inside.
    fn mixed_product(self, other: Self) -> Self {
        let lower = f64::min(
            product_below(self.lower, other.upper),
            product_below(self.upper, other.lower),
        );
        let upper = f64::max(
            -product_below(-self.lower, other.lower),
            -product_below(-self.upper, other.upper),
        );
        Interval::new(lower, upper).only_if(self.defined && other.defined)
    }
}

impl Div for Interval {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        if other.contains(0.0) {
            return Interval::UNDEFINED;
        }
        // The bounds that make the least and the greatest quotient: the divisor has one sign.
        let is_positive = other.lower > 0.0;
        let (least, greatest) =
            if is_positive { (self.lower, self.upper) } else { (self.upper, self.lower) };
        let (near, far) =
            if is_positive { (other.lower, other.upper) } else { (other.upper, other.lower) };
        let least_by = if (least >= 0.0) == is_positive { far } else { near };
        let greatest_by = if (greatest >= 0.0) == is_positive { near } else { far };
        let lower = quotient_below(least, least_by);
        let upper = -quotient_below(-greatest, greatest_by);
        Interval::new(lower, upper).only_if(self.defined && other.defined)
    }
}

impl Number for Interval {
    fn bounds(&self) -> [f64; 2] {
        [self.lower, self.upper]
    }

    fn or(self, other: Self) -> Self {
        let (lower, upper) = (self.lower.min(other.lower), self.upper.max(other.upper));
        Interval::new(lower, upper).only_if(self.defined && other.defined)
    }

    fn steps(&self, function: Option<Function>) -> u64 {
        operation_cost::of_interval(function, [self.lower, self.upper])
    }

    fn from_rational(number: &Rational) -> Self {
        let near = number.to_f64().value();
        let lower = if at_most(near, number) { near } else { near.next_down() };
        let upper = if lower == near && !equals(near, number) { near.next_up() } else { near };
        Interval::new(lower, upper)
    }

    fn wide_square(wide: Self) -> Self {
        wide.square()
    }

    fn wide_from_rational(number: &Rational) -> Self {
        Self::from_rational(number)
    }

    fn square(self) -> Self {
        let farthest = self.lower.abs().max(self.upper.abs());
        let nearest = if self.contains(0.0) { 0.0 } else { self.lower.abs().min(self.upper.abs()) };
        let (lower, upper) = (product_below(nearest, nearest), -product_below(-farthest, farthest));
        Interval::new(lower, upper).only_if(self.defined)
    }
}

fn at_most(value: f64, number: &Rational) -> bool {
    match Rational::try_from(value) {
        Ok(exact) => exact <= *number,
        Err(_) => value < 0.0,
    }
}

fn equals(value: f64, number: &Rational) -> bool {
    Rational::try_from(value).is_ok_and(|exact| exact == *number)
}

/// The largest number that is surely at most a + b.
fn sum_below(a: f64, b: f64) -> f64 {
    let sum = a + b;
    if sum.is_nan() {
        return f64::NEG_INFINITY;
    }
    if sum.is_infinite() {
        return unbounded_below(sum, a.is_finite() && b.is_finite());
    }
    // The rounding error of a sum is a floating-point number (Knuth, The Art of Computer Programming 2, section 4.2.2).
    let rest = sum - a;
    let error = (a - (sum - rest)) + (b - rest);
    if error >= 0.0 { sum } else { sum.next_down() }
}

/// The largest number that is surely at most a b. An infinite bound is not attained, so that 0 times it is 0.
fn product_below(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 {
        return 0.0;
    }
    let product = a * b;
    if product.is_infinite() {
        return unbounded_below(product, a.is_finite() && b.is_finite());
    }
    if product.abs() < NEARLY_SUBNORMAL {
        return stepped_below(product, (a < 0.0) == (b < 0.0));
    }
    // The rounding error of a product is a floating-point number, and one fused operation computes it.
    if a.mul_add(b, -product) >= 0.0 { product } else { product.next_down() }
}

/// The largest number that is surely at most a/b, for b not 0.
fn quotient_below(a: f64, b: f64) -> f64 {
    if a == 0.0 || b.is_infinite() {
        // An infinite bound is not attained; the other corners cover values on the other side of 0.
        return 0.0;
    }
    let quotient = a / b;
    if quotient.is_infinite() {
        return unbounded_below(quotient, a.is_finite());
    }
    if quotient.abs() < NEARLY_SUBNORMAL || a.abs() < NEARLY_SUBNORMAL {
        return stepped_below(quotient, (a < 0.0) == (b < 0.0));
    }
    // The remainder a - q b is a floating-point number, and the sign of a/b - q is its sign times the sign of b.
    let remainder = (-quotient).mul_add(b, a);
    let is_below = if b > 0.0 { remainder >= 0.0 } else { remainder <= 0.0 };
    if is_below { quotient } else { quotient.next_down() }
}

/// A result that overflowed, or an infinite bound.
fn unbounded_below(result: f64, overflowed: bool) -> f64 {
    if result > 0.0 && overflowed { f64::MAX } else { result }
}

/// One step down, but not below 0 if the exact result is positive.
fn stepped_below(result: f64, is_positive: bool) -> f64 {
    let below = result.next_down();
    if is_positive { below.max(0.0) } else { below }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The bounds of a function of two operands that is monotonic in each of them, from its values at all corners.
    fn corners(a: Interval, b: Interval, below: impl Fn(f64, f64) -> f64) -> Interval {
        let corners = [a.lower, a.upper].map(|x| [b.lower, b.upper].map(|y| (x, y)));
        let corners = corners.as_flattened();
        let lower = corners.iter().map(|(x, y)| below(*x, *y)).fold(f64::INFINITY, f64::min);
        let upper = corners.iter().map(|(x, y)| -below(-x, *y)).fold(f64::NEG_INFINITY, f64::max);
        Interval::new(lower, upper).only_if(a.defined && b.defined)
    }

    #[test]
    fn signs_tell_which_corners_a_product_and_a_quotient_are_bounded_by() {
        let ends = [0.0, f64::from_bits(1), 1e-300, 1e-150, 0.1, 1.0, 3.0, 1e200, f64::INFINITY];
        let ends: Vec<f64> = ends.into_iter().flat_map(|end| [end, -end]).collect();
        let pairs = ends.iter().flat_map(|a| ends.iter().map(move |b| (*a, *b)));
        let is_box = |(a, b): &(f64, f64)| a < b || a == b && a.is_finite();
        let boxes: Vec<_> =
            pairs.filter(is_box).map(|(lower, upper)| Interval::new(lower, upper)).collect();
        for (a, b) in boxes.iter().flat_map(|a| boxes.iter().map(move |b| (*a, *b))) {
            assert_eq!(a * b, corners(a, b, product_below), "{a:?} times {b:?}");
            if !b.contains(0.0) {
                assert_eq!(a / b, corners(a, b, quotient_below), "{a:?} over {b:?}");
            }
        }
    }
}
