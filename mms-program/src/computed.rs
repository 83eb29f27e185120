//! Values as a precision computes them: bounds of the exact value over a box, and of the distance of a computed value from it.
//!
//! Each operation passes on the errors of its operands, by the mean-value theorem over the possible computed operands, and adds
//! its own: some units of the last digit, and the least number near underflow (Higham, Accuracy and Stability of Numerical
//! Algorithms, 2002, chapter 2). A value that overflows, leaves a domain or is beyond the range of a function does not exist,
//! and neither does any value computed from it. The exact value keeps its own bounds, so that they can be made sharper by
//! knowledge such as J > 0.

use core::marker::PhantomData;
use core::ops::{Add, Div, Mul, Neg, Sub};

use mms_math::{FEW_HALF_TURNS, FEW_RADIANS, LARGEST_ANGLE, Scalar};

use crate::interpret::Number;
use crate::interval::Interval;
use mms_symbolic::expr::{Function, Rational};

/// A number format, described by its errors.
pub trait Format: Copy + core::fmt::Debug + 'static {
    /// The format of the stages of parameters and of t.
    type Wide: Format;
    /// The largest error of one operation, relative to its result; an upper bound for the wider formats.
    const UNIT: f64;
    /// The largest error of one operation whose result is near underflow.
    const LEAST: f64;
    /// The largest result that is a number with all digits.
    const LARGEST: f64;
    /// The largest angle whose sine is computed.
    const LARGEST_ANGLE: f64;
    /// The nearest number of the format.
    fn nearest(value: f64) -> f64;
}

/// `f32`.
#[derive(Clone, Copy, Debug)]
pub struct Single;

/// `f64`.
#[derive(Clone, Copy, Debug)]
pub struct Double;

/// The sum of two `f64`: [`mms_math::Double`], and its counterpart in emitted code.
#[derive(Clone, Copy, Debug)]
pub struct Pair;

impl Format for Single {
    type Wide = Double;
    const UNIT: f64 = 1.0 / (1 << 24) as f64;
    const LEAST: f64 = 1.5e-45;
    const LARGEST: f64 = f32::MAX as f64;
    const LARGEST_ANGLE: f64 = f64::MAX;
    fn nearest(value: f64) -> f64 {
        f64::from(value as f32)
    }
}

impl Format for Double {
    type Wide = Pair;
    const UNIT: f64 = 1.0 / (1_u64 << 53) as f64;
    const LEAST: f64 = 5e-324;
    const LARGEST: f64 = f64::MAX;
    const LARGEST_ANGLE: f64 = f64::MAX;
    fn nearest(value: f64) -> f64 {
        value
    }
}

impl Format for Pair {
    type Wide = Pair;
    const UNIT: f64 = 1.0 / (1_u128 << 104) as f64;
    // Low parts underflow below 2^-960, and may be dropped above 2^1020.
    const LEAST: f64 = 1e-300;
    const LARGEST: f64 = 1e307;
    const LARGEST_ANGLE: f64 = (1_u64 << 50) as f64;
    fn nearest(value: f64) -> f64 {
        value
    }
}

/// The error of an elementary function, in units of a rounding: twice the largest declared one.
const OF_FUNCTIONS: f64 = 8.0;

/// The allowance for rounding in the bounds themselves: less than a thousand roundings each.
const SLACK: f64 = 1.0 + 1e-12;

/// Bounds of a value, and of the error of its computed value.
#[derive(Clone, Copy, Debug)]
pub struct Computed<F> {
    exact: Interval,
    /// The bound of the error; infinite if the value may not exist.
    error: f64,
    format: PhantomData<F>,
}

impl<F: Format> Computed<F> {
    /// Bounds of an input from this interval, before or after it is rounded to the format.
    pub fn input(exact: Interval) -> Self {
        if !exact.is_defined() {
            return Self::of(exact, f64::INFINITY);
        }
        let [lower, upper] = [exact.lower(), exact.upper()].map(F::nearest);
        let hull = Interval::new(exact.lower().min(lower), exact.upper().max(upper));
        Self::of(hull, if hull.farthest() <= F::LARGEST { 0.0 } else { f64::INFINITY })
    }

    /// A value whose only error is one rounding.
    pub fn rounded(exact: Interval) -> Self {
        let is_number =
            exact.lower() == exact.upper() && F::nearest(exact.lower()) == exact.lower();
        if is_number { Self::of(exact, 0.0) } else { Self::of(exact, 0.0).after(1.0) }
    }

    fn of(exact: Interval, error: f64) -> Self {
        Computed { exact, error, format: PhantomData }
    }

    /// Whether the value is computed everywhere, and is a finite number.
    pub fn is_finite(&self) -> bool {
        self.exact.is_defined() && self.error < f64::INFINITY
    }

    /// The bound of the distance of a computed value from the exact one.
    pub fn error(&self) -> f64 {
        self.error
    }

    /// Bounds of the computed value.
    pub fn reach(&self) -> Interval {
        if !self.is_finite() {
            return Interval::UNDEFINED;
        }
        self.exact + Interval::new(-self.error, self.error)
    }

    /// Intersects the bounds of the exact value with known ones.
    pub fn meet(self, known: Interval) -> Self {
        let met = self.exact.meet(known);
        if met.is_defined() { Self::of(met, self.error) } else { self }
    }

    /// Adds the rounding error of the operation that makes the value, in units.
    fn after(self, units: f64) -> Self {
        let largest = (self.exact.farthest() + self.error) * SLACK;
        let own = units * (largest * F::UNIT + F::LEAST);
        let is_number = self.exact.is_defined() && largest + own <= F::LARGEST;
        let error = if is_number { (self.error + own) * SLACK } else { f64::INFINITY };
        Self::of(self.exact, error)
    }

    /// f(self), which changes by at most `slope` times the change of its argument.
    fn map(self, exact: Interval, slope: f64) -> Self {
        self.moved(exact, slope * self.error)
    }

    /// f(self), which changes by at most `by` under the error of its argument.
    fn moved(self, exact: Interval, by: f64) -> Self {
        // 0 times an infinite slope is 0: an argument without an error gives a value without one.
        let by = if self.error == 0.0 { 0.0 } else { by * SLACK };
        Self::of(exact, if by.is_nan() { f64::INFINITY } else { by }).after(OF_FUNCTIONS)
    }

    /// Subtracts whole turns from an angle of more than a few turns. The exact value is defined with as many turns subtracted
    /// as the computed value has; that number may be off by one for an angle between two turns.
    fn within(self, few: f64, largest: f64) -> Self {
        let farthest = self.reach().farthest();
        if !self.is_finite() || farthest <= few {
            return self;
        }
        let few = (few + self.error) * SLACK;
        // An angle that is too large stays as it is.
        let all = if farthest > largest { self.exact } else { Interval::from_f64(0.0) };
        let exact = Interval::new(all.lower().min(-few), all.upper().max(few));
        Self::of(exact, self.error).after(OF_FUNCTIONS)
    }

    /// A function of angles up to the largest one, with values within 1.
    fn wave(self, exact: Interval, slope: f64, largest: f64) -> Self {
        if self.reach().farthest() > largest {
            return Self::of(exact, f64::INFINITY);
        }
        let by = (slope * self.error).min(2.0);
        self.moved(exact, if self.is_finite() { by } else { f64::INFINITY })
    }

    fn with_wide<W>(self) -> Computed<W> {
        Computed { exact: self.exact, error: self.error, format: PhantomData }
    }
}

/// The least magnitude within bounds.
fn nearest_to_zero(bounds: Interval) -> f64 {
    bounds.magnitude().lower()
}

impl<F: Format> Neg for Computed<F> {
    type Output = Self;
    fn neg(self) -> Self {
        Self::of(-self.exact, self.error)
    }
}

impl<F: Format> Add for Computed<F> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::of(self.exact + other.exact, self.error + other.error).after(1.0)
    }
}

impl<F: Format> Sub for Computed<F> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<F: Format> Mul for Computed<F> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self.exact.farthest(), other.exact.farthest());
        let error = product(a, other.error) + product(self.error, b + other.error);
        Self::of(self.exact * other.exact, error).after(1.0)
    }
}

/// a b, where 0 times infinity is infinite: an operand without a value makes a product without one.
fn product(a: f64, b: f64) -> f64 {
    if a.is_infinite() || b.is_infinite() { f64::INFINITY } else { a * b * SLACK }
}

impl<F: Format> Div for Computed<F> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let below = nearest_to_zero(other.reach());
        let exact = self.exact / other.exact;
        if below == 0.0 || !exact.is_defined() || !self.is_finite() {
            return Self::of(exact, f64::INFINITY);
        }
        let error = (self.error + product(exact.farthest(), other.error)) / below;
        Self::of(exact, error).after(1.0)
    }
}

impl<F: Format> Number for Computed<F> {
    fn bounds(&self) -> [f64; 2] {
        self.exact.bounds()
    }

    fn steps(&self, function: Option<Function>) -> u64 {
        // One evaluation for the exact value, and one for the computed value.
        2 * self.exact.steps(function)
    }

    fn from_rational(number: &Rational) -> Self {
        Self::rounded(Interval::from_rational(number))
    }

    fn wide_from_rational(number: &Rational) -> Self::Wide {
        Computed::rounded(Interval::from_rational(number))
    }

    fn square(self) -> Self {
        let error = product(self.error, 2.0 * self.exact.farthest() + self.error);
        Self::of(self.exact.square(), error).after(1.0)
    }

    fn wide_square(wide: Self::Wide) -> Self::Wide {
        wide.square()
    }
}

impl<F: Format> Scalar for Computed<F> {
    type Wide = Computed<F::Wide>;

    fn widen(self) -> Self::Wide {
        self.with_wide()
    }

    fn narrow(wide: Self::Wide) -> Self {
        wide.with_wide::<F>().after(1.0)
    }

    fn from_f64(value: f64) -> Self {
        Self::rounded(Interval::from_f64(value))
    }

    fn ratio(numerator: i32, denominator: i32) -> Self {
        Self::rounded(Interval::ratio(numerator, denominator))
    }

    fn pi() -> Self {
        Self::rounded(Interval::pi())
    }

    fn sqrt(self) -> Self {
        let reach = self.reach();
        if reach.lower() < 0.0 {
            return Self::of(self.exact.sqrt(), f64::INFINITY);
        }
        let steepest = self.error / (2.0 * reach.lower().sqrt());
        self.moved(self.exact.sqrt(), steepest.min(self.error.sqrt()))
    }

    fn cbrt(self) -> Self {
        let steepest = self.error / (3.0 * nearest_to_zero(self.reach()).cbrt().powi(2));
        self.moved(self.exact.cbrt(), steepest.min((4.0 * self.error).cbrt()))
    }

    fn exp(self) -> Self {
        self.map(self.exact.exp(), self.reach().exp().upper())
    }

    fn exp_m1(self) -> Self {
        self.map(self.exact.exp_m1(), self.reach().exp().upper())
    }

    fn ln(self) -> Self {
        let least = self.reach().lower();
        let slope = if least > 0.0 { 1.0 / least } else { f64::INFINITY };
        if least > 0.0 {
            self.map(self.exact.ln(), slope)
        } else {
            Self::of(self.exact.ln(), slope)
        }
    }

    fn ln_1p(self) -> Self {
        let least = 1.0 + self.reach().lower();
        match least > 0.0 {
            true => self.map(self.exact.ln_1p(), 1.0 / least),
            false => Self::of(self.exact.ln_1p(), f64::INFINITY),
        }
    }

    fn ln_1p_rest(self) -> Self {
        let (reach, exact) = (self.reach(), self.exact.ln_1p_rest());
        let least = 1.0 + reach.lower();
        match least > 0.0 {
            true => self.map(exact, reach.farthest() / least),
            false => Self::of(exact, f64::INFINITY),
        }
    }

    fn sin(self) -> Self {
        self.wave(self.exact.sin(), 1.0, F::LARGEST_ANGLE)
    }

    fn cos(self) -> Self {
        self.wave(self.exact.cos(), 1.0, F::LARGEST_ANGLE)
    }

    fn sin_pi(self) -> Self {
        // Any number of half turns is reduced exactly.
        self.wave((self.exact * Interval::pi()).sin(), 4.0, f64::INFINITY)
    }

    fn cos_pi(self) -> Self {
        self.wave((self.exact * Interval::pi()).cos(), 4.0, f64::INFINITY)
    }

    fn within_turns(self) -> Self {
        self.within(FEW_RADIANS, LARGEST_ANGLE)
    }

    fn within_turns_pi(self) -> Self {
        self.within(FEW_HALF_TURNS, f64::INFINITY)
    }

    fn tan(self) -> Self {
        let reach = self.reach();
        if reach.farthest() > F::LARGEST_ANGLE || !reach.tan().is_defined() {
            return Self::of(self.exact.tan(), f64::INFINITY);
        }
        self.map(self.exact.tan(), 1.0 + reach.tan().farthest().powi(2))
    }

    fn sinh(self) -> Self {
        self.map(self.exact.sinh(), self.reach().cosh().upper())
    }

    fn cosh(self) -> Self {
        self.map(self.exact.cosh(), self.reach().cosh().upper())
    }

    fn tanh(self) -> Self {
        self.map(self.exact.tanh(), 1.0)
    }

    fn asin(self) -> Self {
        self.arc(self.exact.asin())
    }

    fn acos(self) -> Self {
        self.arc(self.exact.acos())
    }

    fn atan(self) -> Self {
        self.map(self.exact.atan(), 1.0)
    }

    fn atan2(self, x: Self) -> Self {
        let exact = self.exact.atan2(x.exact);
        let both = Self::of(exact, self.error.max(x.error));
        let [height, width] = [self.reach(), x.reach()];
        let radius = nearest_to_zero(height).hypot(nearest_to_zero(width));
        let turn = core::f64::consts::TAU;
        let is_cut = |y: Interval, x: Interval| y.contains(0.0) && x.lower() <= 0.0;
        let by = match (is_cut(self.exact, x.exact), is_cut(height, width)) {
            (true, _) => turn,
            // A value on one side of the cut may be computed on the other.
            (false, true) => f64::INFINITY,
            (false, false) => ((self.error + x.error) / radius).min(turn),
        };
        both.moved(exact, by)
    }

    fn powf(self, exponent: Self) -> Self {
        let exact = self.exact.powf(exponent.exact);
        let (base, power) = (self.reach(), exponent.reach());
        let both = Self::of(exact, self.error.max(exponent.error));
        if base.lower() < 0.0 || !base.powf(power).is_defined() {
            return Self::of(exact, f64::INFINITY);
        }
        let relative = self.error * power.farthest() / base.lower();
        let relative = relative + exponent.error * base.ln().farthest();
        both.moved(exact, base.powf(power).upper() * relative)
    }
}

impl<F: Format> Computed<F> {
    /// An inverse sine or cosine: its slope is 1/sqrt(1 - x^2).
    fn arc(self, exact: Interval) -> Self {
        let farthest = self.reach().farthest();
        if farthest > 1.0 || !self.is_finite() {
            return Self::of(exact, f64::INFINITY);
        }
        let slope = 1.0 / ((1.0 - farthest) * (1.0 + farthest)).sqrt();
        self.moved(exact, (slope * self.error).min(2.3 * self.error.sqrt()))
    }
}
