//! [`Scalar`] for [`Double`].

use super::Double;
use super::trigonometric::DOUBLE_PI;
use crate::Scalar;

impl Scalar for Double {
    type Wide = Self;

    fn widen(self) -> Self {
        self
    }

    fn narrow(wide: Self) -> Self {
        wide
    }

    fn from_f64(value: f64) -> Self {
        Double::of(value)
    }

    fn ratio(numerator: i32, denominator: i32) -> Self {
        Double::quotient(f64::from(numerator), f64::from(denominator))
    }

    fn pi() -> Self {
        DOUBLE_PI
    }

    fn sqrt(self) -> Self {
        self.square_root()
    }

    fn cbrt(self) -> Self {
        self.cubic_root()
    }

    fn exp(self) -> Self {
        self.exponential()
    }

    fn exp_m1(self) -> Self {
        self.exponential_m1()
    }

    fn ln(self) -> Self {
        self.logarithm()
    }

    fn ln_1p(self) -> Self {
        self.logarithm_1p()
    }

    fn ln_1p_rest(self) -> Self {
        self.logarithm_1p_rest()
    }

    fn sin_pi(self) -> Self {
        self.sine_of_half_turns()
    }

    fn cos_pi(self) -> Self {
        self.cosine_of_half_turns()
    }

    fn within_turns(self) -> Self {
        self.less_turns()
    }

    fn within_turns_pi(self) -> Self {
        self.less_pairs_of_half_turns()
    }

    fn sin(self) -> Self {
        self.circular_sine()
    }

    fn cos(self) -> Self {
        self.circular_cosine()
    }

    fn tan(self) -> Self {
        self.circular_tangent()
    }

    fn sinh(self) -> Self {
        self.hyperbolic_sine()
    }

    fn cosh(self) -> Self {
        self.hyperbolic_cosine()
    }

    fn tanh(self) -> Self {
        self.hyperbolic_tangent()
    }

    fn asin(self) -> Self {
        self.inverse_sine()
    }

    fn acos(self) -> Self {
        self.inverse_cosine()
    }

    fn atan(self) -> Self {
        self.angle(Double::ONE)
    }

    fn atan2(self, x: Self) -> Self {
        self.angle(x)
    }

    fn powf(self, exponent: Self) -> Self {
        self.power(exponent)
    }
}
