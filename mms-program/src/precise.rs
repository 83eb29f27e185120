//! Arbitrary precision: the reference for closed forms and precisions.
//!
//! The number of digits is a parameter: a result is trusted if more digits do not change it.

use core::ops::{Add, Div, Mul, Neg, Sub};

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;
use dashu_int::ops::CubicRoot as _;
use mms_math::Scalar;

use crate::interpret::Number;
use crate::operation_cost;
use mms_symbolic::expr::{Function, Rational};

/// The limit of binary exponents: a result beyond it is not representable, and a result below its negative is 0. So exponents
/// never overflow their own integers.
const LARGEST_EXPONENT: isize = 1 << (isize::BITS - 4);

/// The largest binary exponent of an argument whose exponential is within these bounds.
const LARGEST_ARGUMENT: isize = isize::BITS as isize - 5;

/// The exponent of the largest angle: its reduction needs as many digits of pi.
const LARGEST_ANGLE: isize = 1 << 12;

type Float = FBig<HalfEven, 2>;

/// A number of `BITS` significant bits, or undefined.
///
/// A result without a finite real value (1/0, ln(-1), exp(1e30)) is undefined, and so is everything computed from it. Numbers
/// are distinguished from 0 down to 2^-2^60, so that exp(-1e7) is a number like any other.
#[derive(Clone, Debug)]
pub struct Binary<const BITS: usize>(Option<Float>);

/// A number of 77 significant decimal digits, or undefined.
pub type Precise = Binary<256>;

impl<const BITS: usize> Binary<BITS> {
    /// The value nearest to an exact number.
    pub fn new(number: &Rational) -> Self {
        let numerator = Float::from(number.numerator().clone()).with_precision(BITS).value();
        let denominator = Float::from(number.denominator().clone()).with_precision(BITS).value();
        Binary(Some(numerator / denominator))
    }

    /// The nearest `f64`; NaN if undefined.
    pub fn to_f64(&self) -> f64 {
        self.0.as_ref().map_or(f64::NAN, |value| value.to_f64().value())
    }

    /// Decimal digits in scientific notation; `None` if undefined.
    pub fn decimal(&self, digits: usize) -> Option<String> {
        let decimal = self.0.as_ref()?.to_decimal().value();
        Some(format!("{:e}", decimal.with_precision(digits).value()))
    }

    /// The magnitude.
    pub fn magnitude(self) -> Self {
        match &self.0 {
            Some(value) if *value < Float::ZERO => -self,
            _ => self,
        }
    }

    /// Whether both are defined and `self` is at most `other`.
    pub fn at_most(&self, other: &Self) -> bool {
        matches!((&self.0, &other.0), (Some(a), Some(b)) if a <= b)
    }

    /// The number with more digits, or the nearest one with fewer.
    pub fn with_bits<const OTHER: usize>(&self) -> Binary<OTHER> {
        Binary(self.0.clone().map(|value| value.with_precision(OTHER).value()))
    }

    /// Whether the value is a real number.
    pub fn is_defined(&self) -> bool {
        self.0.is_some()
    }

    fn map(self, defined: impl Fn(&Float) -> bool, function: impl Fn(&Float) -> Float) -> Self {
        Binary(self.0.filter(|value| defined(value)).map(|value| function(&value))).bounded()
    }

    fn combine(self, other: Self, function: impl Fn(Float, Float) -> Float) -> Self {
        Binary(self.0.zip(other.0).map(|(a, b)| function(a, b))).bounded()
    }

    fn bounded(self) -> Self {
        let in_range =
            |value: &Float| value.repr().is_finite() && exponent(value) < LARGEST_EXPONENT;
        // A real number has one zero: a negative zero would turn atan2 around.
        let told_from_zero = |value: Float| match exponent(&value) > -LARGEST_EXPONENT {
            true if value != Float::ZERO => value,
            _ => Float::ZERO,
        };
        // Exact results such as exp(0) = 1 have no precision, which functions need.
        let rounded = |value: Float| told_from_zero(value).with_precision(BITS).value();
        Binary(self.0.filter(in_range).map(rounded))
    }
}

/// The position of the leading bit.
fn exponent(value: &Float) -> isize {
    value.repr().exponent().saturating_add_unsigned(value.repr().digits())
}

/// Whether the exponential function and related ones stay within bounds.
fn moderate(value: &Float) -> bool {
    exponent(value) <= LARGEST_ARGUMENT
}

/// Whether the exponential function does not become too large; it may be arbitrarily small.
fn not_too_large(value: &Float) -> bool {
    *value < Float::ZERO || moderate(value)
}

/// Whether exp(x) is 1 + x to all digits.
fn is_negligible<const BITS: usize>(x: &Float) -> bool {
    exponent(x) < -2 * BITS as isize
}

/// The remainder of a number of half turns after whole turns are subtracted, without error.
fn within_a_turn(x: &Float) -> Float {
    let two = Float::from(2);
    x - (x / &two).round() * two
}

/// The sine of x half turns, exact if it is 0.
fn sin_pi<const BITS: usize>(x: &Float) -> Float {
    let x = within_a_turn(x);
    if x.clone().round() == x { Float::ZERO } else { (Float::pi(BITS) * x).sin() }
}

/// The cosine of x half turns, exact if it is 0.
fn cos_pi<const BITS: usize>(x: &Float) -> Float {
    let x = within_a_turn(x);
    let quarters = &x + &x;
    let is_odd = quarters == Float::ONE || quarters == Float::NEG_ONE;
    if is_odd { Float::ZERO } else { (Float::pi(BITS) * x).cos() }
}

/// The binary exponent below which x - ln(1 + x) is computed as a sum, and above which as a difference.
const SMALL: isize = -32;

/// x - ln(1 + x) = x^2/2 - x^3/3 + ... for a small x, to all digits.
fn ln_1p_rest<const BITS: usize>(x: &Float) -> Float {
    let terms = 2..=3 + BITS.div_ceil(SMALL.unsigned_abs());
    // Evaluated by Horner's scheme, from the last term on.
    let sum = terms.rev().fold(Float::ZERO, |sum, n| {
        let coefficient = Float::ONE.with_precision(BITS).value() / Float::from(n);
        coefficient - x * sum
    });
    x * x * sum
}

fn exp<const BITS: usize>(x: &Float) -> Float {
    if !moderate(x) {
        return Float::ZERO;
    }
    if is_negligible::<BITS>(x) { Float::ONE + x } else { x.exp() }
}

fn exp_m1<const BITS: usize>(x: &Float) -> Float {
    if !moderate(x) {
        return Float::NEG_ONE;
    }
    if is_negligible::<BITS>(x) { x.clone() } else { x.exp_m1() }
}

fn is_angle(value: &Float) -> bool {
    exponent(value) <= LARGEST_ANGLE
}

fn within_one(value: &Float) -> bool {
    *value >= Float::NEG_ONE && *value <= Float::ONE
}

impl<const BITS: usize> Add for Binary<BITS> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.combine(other, |a, b| a + b)
    }
}

impl<const BITS: usize> Sub for Binary<BITS> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.combine(other, |a, b| a - b)
    }
}

impl<const BITS: usize> Mul for Binary<BITS> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.combine(other, |a, b| a * b)
    }
}

impl<const BITS: usize> Div for Binary<BITS> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let other = Binary(other.0.filter(|value| *value != Float::ZERO));
        self.combine(other, |a, b| a / b)
    }
}

impl<const BITS: usize> Neg for Binary<BITS> {
    type Output = Self;
    fn neg(self) -> Self {
        Binary(self.0.map(|value| -value)).bounded()
    }
}

impl<const BITS: usize> Number for Binary<BITS> {
    fn bounds(&self) -> [f64; 2] {
        [self.to_f64(); 2]
    }

    fn steps(&self, function: Option<Function>) -> u64 {
        operation_cost::of_digits(function, BITS, self.0.as_ref().map_or(0, exponent))
    }

    fn from_rational(number: &Rational) -> Self {
        Binary::new(number)
    }

    fn wide_from_rational(number: &Rational) -> Self {
        Self::from_rational(number)
    }
}

impl<const BITS: usize> Scalar for Binary<BITS> {
    type Wide = Self;

    fn widen(self) -> Self {
        self
    }

    fn narrow(wide: Self) -> Self {
        wide
    }

    fn from_f64(value: f64) -> Self {
        Binary(Float::try_from(value).ok().map(|value| value.with_precision(BITS).value()))
            .bounded()
    }

    fn pi() -> Self {
        Binary(Some(Float::pi(BITS)))
    }

    fn sqrt(self) -> Self {
        self.map(|x| *x >= Float::ZERO, |x| x.sqrt())
    }

    fn cbrt(self) -> Self {
        self.map(|_| true, |x| x.cbrt())
    }

    fn exp(self) -> Self {
        self.map(not_too_large, exp::<BITS>)
    }

    fn exp_m1(self) -> Self {
        self.map(not_too_large, exp_m1::<BITS>)
    }

    fn ln(self) -> Self {
        self.map(|x| *x > Float::ZERO, |x| x.ln())
    }

    fn ln_1p(self) -> Self {
        self.map(|x| *x > Float::NEG_ONE, |x| x.ln_1p())
    }

    fn ln_1p_rest(self) -> Self {
        match &self.0 {
            Some(x) if exponent(x) < SMALL => self.map(|_| true, ln_1p_rest::<BITS>),
            _ => self.clone() - self.ln_1p(),
        }
    }

    fn sin(self) -> Self {
        self.map(is_angle, |x| x.sin())
    }

    fn cos(self) -> Self {
        self.map(is_angle, |x| x.cos())
    }

    fn sin_pi(self) -> Self {
        self.map(is_angle, sin_pi::<BITS>)
    }

    fn cos_pi(self) -> Self {
        self.map(is_angle, cos_pi::<BITS>)
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
        self.map(|_| true, |x| x.tanh())
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
            return Binary(None);
        }
        self.combine(x, |y, x| y.atan2(&x))
    }

    fn powf(self, exponent: Self) -> Self {
        let zero = |value: &Self| value.0.as_ref().is_some_and(|v| *v == Float::ZERO);
        let positive = exponent.0.as_ref().is_some_and(|v| *v > Float::ZERO);
        if zero(&self) && positive {
            return self;
        }
        (exponent * self.ln()).exp()
    }
}
