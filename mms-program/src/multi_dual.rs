//! Dual numbers of several directions that share one value. They have the bounds of a [`Dual`] for each direction, at the cost
//! of one value and the slopes.

use core::ops::{Add, Div, Mul, Neg, Sub};

use mms_math::Scalar;

use crate::dual::{Dual, lifted};
use crate::interpret::Number;
use crate::interval::Interval;
use mms_symbolic::expr::{Function, Rational};

/// The largest number of directions: the entries of a gradient.
const DIRECTIONS: usize = 9;

/// The bits of all directions.
const ALL: u16 = (1 << DIRECTIONS) - 1;

/// Bounds, or bounds with a slope.
pub trait Bounds: Number<Wide = Self> + Copy {
    /// Whether the number is exactly 0.
    fn is_zero(self) -> bool;
}

impl Bounds for Interval {
    fn is_zero(self) -> bool {
        self.is_defined() && self.lower() == 0.0 && self.upper() == 0.0
    }
}

impl Bounds for Dual<Interval> {
    fn is_zero(self) -> bool {
        self.value.is_zero() && self.slope.is_zero()
    }
}

/// A value and its derivatives in some directions.
#[derive(Clone, Copy, Debug)]
pub struct MultiDual<T> {
    /// The value.
    pub value: T,
    slopes: [T; DIRECTIONS],
    /// The directions whose slope may differ from 0, one bit for each.
    moved: u16,
}

impl<T: Bounds> MultiDual<T> {
    /// A number that does not change.
    pub fn constant(value: T) -> Self {
        MultiDual { value, slopes: [T::from_f64(0.0); DIRECTIONS], moved: 0 }
    }

    /// A variable that changes in one direction, with slope 1.
    pub fn variable(value: T, direction: usize) -> Self {
        let mut variable = MultiDual::constant(value);
        variable.slopes[direction] = T::from_f64(1.0);
        variable.moved = 1 << direction;
        variable
    }

    /// The derivative in a direction.
    pub fn slope(&self, direction: usize) -> T {
        self.slopes[direction]
    }

    /// f(self), given f and f' at the value.
    fn chain(self, value: T, derivative: T) -> Self {
        // If the derivative is unknown, 0 times it is not 0.
        let is_clean = (derivative * T::from_f64(0.0)).is_zero();
        let mut slopes = self.slopes;
        let moved = if is_clean { self.moved } else { ALL };
        for direction in directions(moved) {
            slopes[direction] = derivative * self.slopes[direction];
        }
        MultiDual { value, slopes, moved }
    }

    /// f(self, other), given the value, and the slope if one operand changes or both do.
    fn join(self, other: Self, value: T, slope: impl Fn(Option<T>, Option<T>) -> T) -> Self {
        let zero = T::from_f64(0.0);
        let [of_first, of_second] = [slope(Some(zero), None), slope(None, Some(zero))];
        // If a factor is unknown, 0 times it is not 0.
        let (mut first, mut second) = (self.moved, other.moved);
        if !of_first.is_zero() || !of_second.is_zero() {
            (first, second) = (ALL, ALL);
        }
        let mut slopes = [zero; DIRECTIONS];
        for direction in directions(first | second) {
            let moved = |by: u16, slope: T| (by >> direction & 1 == 1).then_some(slope);
            let own = moved(first, self.slopes[direction]);
            slopes[direction] = slope(own, moved(second, other.slopes[direction]));
        }
        MultiDual { value, slopes, moved: first | second }
    }
}

/// The directions of some bits.
fn directions(moved: u16) -> impl Iterator<Item = usize> {
    (0..DIRECTIONS).filter(move |direction| moved >> direction & 1 == 1)
}

impl<T: Bounds> Add for MultiDual<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let mut sum = self;
        for direction in directions(other.moved) {
            sum.slopes[direction] = match self.moved >> direction & 1 {
                1 => self.slopes[direction] + other.slopes[direction],
                _ => other.slopes[direction],
            };
        }
        MultiDual { value: self.value + other.value, moved: self.moved | other.moved, ..sum }
    }
}

impl<T: Bounds> Sub for MultiDual<T> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<T: Bounds> Mul for MultiDual<T> {
    type Output = Self;
    #[expect(clippy::suspicious_arithmetic_impl, reason = "the rule of products")]
    fn mul(self, other: Self) -> Self {
        self.join(other, self.value * other.value, |a, b| match (a, b) {
            (Some(a), Some(b)) => a * other.value + self.value * b,
            (Some(a), None) => a * other.value,
            (None, b) => self.value * b.unwrap_or_else(zero),
        })
    }
}

impl<T: Bounds> Div for MultiDual<T> {
    type Output = Self;
    #[expect(clippy::suspicious_arithmetic_impl, reason = "the rule of quotients")]
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        self.join(other, value, |a, b| match (a, b) {
            (Some(a), None) => a / other.value,
            (a, b) => {
                let (a, b) = (a.unwrap_or_else(zero), b.unwrap_or_else(zero));
                (a - value * b) / other.value
            }
        })
    }
}

impl<T: Bounds> Neg for MultiDual<T> {
    type Output = Self;
    fn neg(self) -> Self {
        let mut negative = self;
        for direction in directions(self.moved) {
            negative.slopes[direction] = -self.slopes[direction];
        }
        MultiDual { value: -self.value, ..negative }
    }
}

fn zero<T: Scalar>() -> T {
    T::from_f64(0.0)
}

impl<T: Bounds> Number for MultiDual<T> {
    fn bounds(&self) -> [f64; 2] {
        self.value.bounds()
    }

    fn steps(&self, function: Option<Function>) -> u64 {
        // For one direction; the caller knows their number.
        2 * self.value.steps(function)
    }

    fn from_rational(number: &Rational) -> Self {
        MultiDual::constant(T::from_rational(number))
    }

    fn wide_from_rational(number: &Rational) -> Self::Wide {
        MultiDual::constant(T::wide_from_rational(number))
    }

    fn square(self) -> Self {
        self.chain(self.value.square(), T::from_f64(2.0) * self.value)
    }

    fn wide_square(wide: Self::Wide) -> Self::Wide {
        wide.chain(T::wide_square(wide.value), T::from_f64(2.0) * wide.value)
    }
}

impl<T: Bounds> Scalar for MultiDual<T> {
    type Wide = Self;

    fn widen(self) -> Self {
        self
    }

    fn narrow(wide: Self) -> Self {
        wide
    }

    lifted!();

    fn atan2(self, x: Self) -> Self {
        let squares = x.value * x.value + self.value * self.value;
        self.join(x, self.value.atan2(x.value), |a, b| {
            let (a, b) = (a.unwrap_or_else(zero), b.unwrap_or_else(zero));
            (x.value * a - self.value * b) / squares
        })
    }

    fn powf(self, exponent: Self) -> Self {
        let power = self.value.powf(exponent.value);
        let by_base = exponent.value * self.value.powf(exponent.value - T::from_f64(1.0));
        let by_exponent = power * self.value.ln();
        self.join(exponent, power, |a, b| {
            let (a, b) = (a.unwrap_or_else(zero), b.unwrap_or_else(zero));
            by_base * a + by_exponent * b
        })
    }
}
