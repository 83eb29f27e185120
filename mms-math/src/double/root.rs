//! Roots, by Newton's method from an `f64`.

use super::Double;
use super::exact::exponent;

/// Computes the root of the scaled argument, and scales it back, so that no product over- or underflows.
///
/// `fraction` computes the root of an argument of 1 <= x < 2^degree.
fn root(x: Double, degree: i32, fraction: impl Fn(Double) -> Double) -> Double {
    let shift = exponent(x.high).div_euclid(degree);
    fraction(x.scaled(-degree * shift)).scaled(shift)
}

/// The square root for 1 <= x < 4. The first guess is within 6 % of the root, and each step squares the error.
fn square_root(x: Double) -> Double {
    let guess = (0..4).fold((x.high + 2.0) / 3.0, |y, _| 0.5 * (y + x.high / y));
    let rest = x - Double::of(guess) * Double::of(guess);
    Double::new(guess, rest.high / (2.0 * guess))
}

/// The cube root for 1 <= x < 8. The first guess is within 12 % of the root, and each step squares the error.
fn cube_root(x: Double) -> Double {
    let step = |y: f64| y - (y * y * y - x.high) / (3.0 * y * y);
    let guess = (0..5).fold((x.high + 6.0) / 7.0, |y, _| step(y));
    let rest = x - Double::of(guess) * Double::of(guess) * Double::of(guess);
    Double::new(guess, rest.high / (3.0 * guess * guess))
}

impl Double {
    pub(super) fn square_root(self) -> Self {
        if self.high == 0.0 || self.high == f64::INFINITY {
            return self;
        }
        if self.high > 0.0 { root(self, 2, square_root) } else { Double::NAN }
    }

    pub(super) fn cubic_root(self) -> Self {
        if self.high == 0.0 || !self.high.is_finite() {
            return self;
        }
        root(self.magnitude(), 3, cube_root).with_sign_of(self.high)
    }
}
