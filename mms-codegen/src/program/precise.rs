//! Arbitrary precision: the reference against which closed forms and precisions are judged.

use core::ops::{Add, Div, Mul, Neg, Sub};

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;
use dashu_int::ops::CubicRoot as _;
use mms_math::Scalar;

use super::interpret::Number;
use crate::expr::Rational;

/// Significant bits: 77 decimal digits.
const BITS: usize = 256;

/// A result beyond this exponent of two is treated as not representable, so that no evaluation
/// takes unbounded time or memory.
const LARGEST_EXPONENT: isize = 1 << 20;

/// The same for the exponent of an angle: reducing it takes as many digits of pi.
const LARGEST_ANGLE: isize = 1 << 12;

type Float = FBig<HalfEven, 2>;

/// A number of 77 significant decimal digits, or undefined.
///
/// What has no finite real value (1/0, ln(-1), an overflow) is undefined, and so is everything
/// computed from it.
#[derive(Clone, Debug)]
pub struct Precise(Option<Float>);

impl Precise {
    /// The value nearest to an exact number.
    pub fn new(number: &Rational) -> Self {
        let numerator = Float::from(number.numerator().clone()).with_precision(BITS).value();
        let denominator = Float::from(number.denominator().clone()).with_precision(BITS).value();
        Precise(Some(numerator / denominator))
    }

    /// The nearest `f64`; not a number where undefined.
    pub fn to_f64(&self) -> f64 {
        self.0.as_ref().map_or(f64::NAN, |value| value.to_f64().value())
    }

    /// The magnitude.
    pub fn magnitude(self) -> Self {
        match &self.0 {
            Some(value) if *value < Float::ZERO => -self,
            _ => self,
        }
    }

    /// Whether both are defined and `self` is at most `other`.
    pub fn at_most(&self, other: &Precise) -> bool {
        matches!((&self.0, &other.0), (Some(a), Some(b)) if a <= b)
    }

    /// Whether the value is a real number.
    pub fn is_defined(&self) -> bool {
        self.0.is_some()
    }

    fn map(self, defined: impl Fn(&Float) -> bool, function: impl Fn(&Float) -> Float) -> Self {
        Precise(self.0.filter(|value| defined(value)).map(|value| function(&value))).bounded()
    }

    fn combine(self, other: Self, function: impl Fn(Float, Float) -> Float) -> Self {
        Precise(self.0.zip(other.0).map(|(a, b)| function(a, b))).bounded()
    }

    fn bounded(self) -> Self {
        let in_range =
            |value: &Float| value.repr().is_finite() && exponent(value) < LARGEST_EXPONENT;
        // Exact results such as exp(0) = 1 come without a precision, which functions need.
        let rounded = |value: Float| value.with_precision(BITS).value();
        Precise(self.0.filter(in_range).map(rounded))
    }
}

/// The position of the leading bit.
fn exponent(value: &Float) -> isize {
    value.repr().exponent().saturating_add_unsigned(value.repr().digits())
}

/// Whether the exponential function and its like stay within bounds.
fn moderate(value: &Float) -> bool {
    exponent(value) <= 19
}

fn is_angle(value: &Float) -> bool {
    exponent(value) <= LARGEST_ANGLE
}

fn within_one(value: &Float) -> bool {
    *value >= Float::NEG_ONE && *value <= Float::ONE
}

impl Add for Precise {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.combine(other, |a, b| a + b)
    }
}

impl Sub for Precise {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.combine(other, |a, b| a - b)
    }
}

impl Mul for Precise {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.combine(other, |a, b| a * b)
    }
}

impl Div for Precise {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let other = Precise(other.0.filter(|value| *value != Float::ZERO));
        self.combine(other, |a, b| a / b)
    }
}

impl Neg for Precise {
    type Output = Self;
    fn neg(self) -> Self {
        Precise(self.0.map(|value| -value))
    }
}

impl Number for Precise {
    fn from_rational(number: &Rational) -> Self {
        Precise::new(number)
    }
}

impl Scalar for Precise {
    fn from_f64(value: f64) -> Self {
        Precise(Float::try_from(value).ok().map(|value| value.with_precision(BITS).value()))
            .bounded()
    }

    fn pi() -> Self {
        Precise(Some(Float::pi(BITS)))
    }

    fn sqrt(self) -> Self {
        self.map(|x| *x >= Float::ZERO, |x| x.sqrt())
    }

    fn cbrt(self) -> Self {
        self.map(|_| true, |x| x.cbrt())
    }

    fn exp(self) -> Self {
        self.map(moderate, |x| x.exp())
    }

    fn exp_m1(self) -> Self {
        self.map(moderate, |x| x.exp_m1())
    }

    fn ln(self) -> Self {
        self.map(|x| *x > Float::ZERO, |x| x.ln())
    }

    fn ln_1p(self) -> Self {
        self.map(|x| *x > Float::NEG_ONE, |x| x.ln_1p())
    }

    fn sin(self) -> Self {
        self.map(is_angle, |x| x.sin())
    }

    fn cos(self) -> Self {
        self.map(is_angle, |x| x.cos())
    }

    fn tan(self) -> Self {
        self.map(is_angle, |x| x.tan())
    }

    fn sinh(self) -> Self {
        self.map(moderate, |x| x.sinh())
    }

    fn cosh(self) -> Self {
        self.map(moderate, |x| x.cosh())
    }

    fn tanh(self) -> Self {
        self.map(moderate, |x| x.tanh())
    }

    fn asin(self) -> Self {
        self.map(within_one, |x| x.asin())
    }

    fn acos(self) -> Self {
        self.map(within_one, |x| x.acos())
    }

    fn atan(self) -> Self {
        self.map(|_| true, |x| x.atan())
    }

    fn atan2(self, x: Self) -> Self {
        let origin = |value: &Option<Float>| value.as_ref().is_some_and(|v| *v == Float::ZERO);
        if origin(&self.0) && origin(&x.0) {
            return Precise(None);
        }
        self.combine(x, |y, x| y.atan2(&x))
    }

    fn powf(self, exponent: Self) -> Self {
        let zero = |value: &Precise| value.0.as_ref().is_some_and(|v| *v == Float::ZERO);
        let positive = exponent.0.as_ref().is_some_and(|v| *v > Float::ZERO);
        if zero(&self) && positive {
            return self;
        }
        (exponent * self.ln()).exp()
    }
}
