//! Dual numbers: a value and its derivative in one direction, by the chain rule of each operation as it is evaluated. They
//! compute derivatives without expressions.

use core::ops::{Add, Div, Mul, Neg, Sub};

use mms_math::Scalar;

use crate::interpret::Number;
use mms_symbolic::expr::{Function, Rational};

/// A value and its first derivative, both in any scalar: `f64`, 256 bits, an interval, or dual
/// numbers again for second derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<T> {
    /// The value.
    pub value: T,
    /// The derivative of the value.
    pub slope: T,
}

impl<T: Scalar> Dual<T> {
    /// A number that does not change.
    pub fn constant(value: T) -> Self {
        Dual { value, slope: T::from_f64(0.0) }
    }

    /// The variable of differentiation.
    pub fn variable(value: T) -> Self {
        Dual { value, slope: T::from_f64(1.0) }
    }

    /// f(self), given f and f' at the value.
    fn chain(self, value: T, derivative: T) -> Self {
        Dual { value, slope: derivative * self.slope }
    }
}

/// The methods of [`Scalar`] for numbers with derivatives that only need `constant` and `chain`: constants, which do not
/// change, and functions of one argument.
macro_rules! lifted {
    () => {
        fn from_parts(high: f64, low: f64) -> Self {
            Self::constant(T::from_parts(high, low))
        }

        fn from_f64(value: f64) -> Self {
            Self::constant(T::from_f64(value))
        }

        fn ratio(numerator: i32, denominator: i32) -> Self {
            Self::constant(T::ratio(numerator, denominator))
        }

        fn pi() -> Self {
            Self::constant(T::pi())
        }

        $crate::dual::lifted!(
            sqrt cbrt exp exp_m1 ln ln_1p ln_1p_rest sin_pi cos_pi sin cos tan sinh cosh tanh asin acos atan
        );
    };
    ($($function:ident)+) => {
        $(fn $function(self) -> Self {
            let [value, derivative] = $crate::dual::rules::$function(self.value.clone());
            self.chain(value, derivative)
        })+
    };
}

pub(super) use lifted;

fn one<T: Scalar>() -> T {
    T::from_f64(1.0)
}

impl<T: Scalar> Add for Dual<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Dual { value: self.value + other.value, slope: self.slope + other.slope }
    }
}

impl<T: Scalar> Sub for Dual<T> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Dual { value: self.value - other.value, slope: self.slope - other.slope }
    }
}

impl<T: Scalar> Mul for Dual<T> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let slope = self.slope * other.value.clone() + self.value.clone() * other.slope;
        Dual { value: self.value * other.value, slope }
    }
}

impl<T: Scalar> Div for Dual<T> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value.clone();
        let slope = (self.slope - value.clone() * other.slope) / other.value;
        Dual { value, slope }
    }
}

impl<T: Scalar> Neg for Dual<T> {
    type Output = Self;
    fn neg(self) -> Self {
        Dual { value: -self.value, slope: -self.slope }
    }
}

impl<T: Number> Number for Dual<T> {
    fn bounds(&self) -> [f64; 2] {
        self.value.bounds()
    }

    fn steps(&self, function: Option<Function>) -> u64 {
        // One evaluation for the value, and one for the slope.
        2 * self.value.steps(function)
    }

    fn from_rational(number: &Rational) -> Self {
        Dual::constant(T::from_rational(number))
    }

    fn wide_from_rational(number: &Rational) -> Self::Wide {
        Dual::constant(T::wide_from_rational(number))
    }

    fn wide_square(wide: Self::Wide) -> Self::Wide {
        let derivative = T::Wide::from_f64(2.0) * wide.value.clone();
        let value = T::wide_square(wide.value.clone());
        wide.chain(value, derivative)
    }

    fn square(self) -> Self {
        let derivative = T::from_f64(2.0) * self.value.clone();
        let value = self.value.clone().square();
        self.chain(value, derivative)
    }
}

impl<T: Scalar> Scalar for Dual<T> {
    type Wide = Dual<T::Wide>;

    fn widen(self) -> Self::Wide {
        Dual { value: self.value.widen(), slope: self.slope.widen() }
    }

    fn narrow(wide: Self::Wide) -> Self {
        Dual { value: T::narrow(wide.value), slope: T::narrow(wide.slope) }
    }

    lifted!();

    fn atan2(self, x: Self) -> Self {
        let squares = x.value.clone() * x.value.clone() + self.value.clone() * self.value.clone();
        let turn = x.value.clone() * self.slope - self.value.clone() * x.slope;
        Dual { value: self.value.atan2(x.value), slope: turn / squares }
    }

    fn powf(self, exponent: Self) -> Self {
        let power = self.value.clone().powf(exponent.value.clone());
        let by_base = exponent.value.clone()
            * self.value.clone().powf(exponent.value - one::<T>())
            * self.slope;
        let by_exponent = power.clone() * self.value.ln() * exponent.slope;
        Dual { value: power, slope: by_base + by_exponent }
    }
}

/// Functions of one argument, each with its derivative.
pub(super) mod rules {
    use mms_math::Scalar;

    use super::one;

    pub fn sqrt<T: Scalar>(x: T) -> [T; 2] {
        let root = x.sqrt();
        [root.clone(), T::ratio(1, 2) / root]
    }

    pub fn cbrt<T: Scalar>(x: T) -> [T; 2] {
        let root = x.cbrt();
        [root.clone(), T::ratio(1, 3) / (root.clone() * root)]
    }

    pub fn exp<T: Scalar>(x: T) -> [T; 2] {
        let exponential = x.exp();
        [exponential.clone(), exponential]
    }

    pub fn exp_m1<T: Scalar>(x: T) -> [T; 2] {
        [x.clone().exp_m1(), x.exp()]
    }

    pub fn ln<T: Scalar>(x: T) -> [T; 2] {
        [x.clone().ln(), one::<T>() / x]
    }

    pub fn ln_1p<T: Scalar>(x: T) -> [T; 2] {
        [x.clone().ln_1p(), one::<T>() / (one::<T>() + x)]
    }

    pub fn ln_1p_rest<T: Scalar>(x: T) -> [T; 2] {
        [x.clone().ln_1p_rest(), x.clone() / (one::<T>() + x)]
    }

    pub fn sin_pi<T: Scalar>(x: T) -> [T; 2] {
        [x.clone().sin_pi(), T::pi() * x.cos_pi()]
    }

    pub fn cos_pi<T: Scalar>(x: T) -> [T; 2] {
        [x.clone().cos_pi(), -(T::pi() * x.sin_pi())]
    }

    pub fn sin<T: Scalar>(x: T) -> [T; 2] {
        [x.clone().sin(), x.cos()]
    }

    pub fn cos<T: Scalar>(x: T) -> [T; 2] {
        [x.clone().cos(), -x.sin()]
    }

    pub fn tan<T: Scalar>(x: T) -> [T; 2] {
        let tangent = x.tan();
        [tangent.clone(), one::<T>() + tangent.clone() * tangent]
    }

    pub fn sinh<T: Scalar>(x: T) -> [T; 2] {
        [x.clone().sinh(), x.cosh()]
    }

    pub fn cosh<T: Scalar>(x: T) -> [T; 2] {
        [x.clone().cosh(), x.sinh()]
    }

    pub fn tanh<T: Scalar>(x: T) -> [T; 2] {
        let secant = one::<T>() / x.clone().cosh();
        [x.tanh(), secant.clone() * secant]
    }

    pub fn asin<T: Scalar>(x: T) -> [T; 2] {
        [x.clone().asin(), one::<T>() / distance_to_one(x)]
    }

    pub fn acos<T: Scalar>(x: T) -> [T; 2] {
        [x.clone().acos(), -(one::<T>() / distance_to_one(x))]
    }

    pub fn atan<T: Scalar>(x: T) -> [T; 2] {
        [x.clone().atan(), one::<T>() / (one::<T>() + x.clone() * x)]
    }

    /// sqrt(1 - x^2), as sqrt((1 - x)(1 + x)) so that nothing cancels near 1.
    fn distance_to_one<T: Scalar>(x: T) -> T {
        ((one::<T>() - x.clone()) * (one::<T>() + x)).sqrt()
    }
}
