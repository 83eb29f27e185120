//! Elementary functions without branches, calls or tables, so that a loop of them is a loop of
//! vector instructions.
//!
//! Each function is correct within its declared bound, or returns NaN: if its argument is too large for its reduction, or less
//! than the least normal number, or outside the domain. No wrong number is finite. If the result is NaN, the
//! [`Scalar`](crate::Scalar) of `f32` and `f64` calls the standard library.
//!
//! The bounds are in units of the last digit (ulp) of the true value, measured against 77 digits at some ten thousand points of
//! the whole range each, in the worse of the two roundings of `mul_add`. A result below the normal numbers may have an error of
//! one more digit.
//!
//! Coefficients are minimax: they belong to the polynomial with the least maximum error, relative to the function that it is
//! part of (Remez, 1934), with the first three rounded one by one and the others fitted again after each. The stated error is
//! the error of the rounded polynomial.

pub mod exponential;
pub mod inverse;
pub mod logarithm;
pub mod number;
pub mod power;
pub mod trigonometric;

use crate::lane::Lane;
use number::Float;

impl<T: Float, const FUSED: bool> Lane<T, FUSED> {
    /// The nearest value to a constant.
    #[inline(always)]
    fn of(value: f64) -> Self {
        Lane(T::of(value))
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Lane(T::from_bits(self.0.bits() & !T::SIGN))
    }

    /// The sign bit, the others 0.
    #[inline(always)]
    fn sign(self) -> T::Bits {
        self.0.bits() & T::SIGN
    }

    /// Flips the sign if the bit `sign` is set.
    #[inline(always)]
    fn turned(self, sign: T::Bits) -> Self {
        Lane(T::from_bits(self.0.bits() ^ sign))
    }

    /// The number, with the sign of `other` if it is 0; otherwise it already has that sign.
    #[inline(always)]
    fn signed_as(self, other: Self) -> Self {
        Lane(T::from_bits(self.0.bits() | other.sign()))
    }

    /// `self * factor + term` with one rounding if the hardware does that, otherwise with two.
    #[inline(always)]
    pub(crate) fn times_plus(self, factor: Self, term: Self) -> Self {
        Lane(if FUSED { self.0.fused(factor.0, term.0) } else { self.0 * factor.0 + term.0 })
    }

    /// `term - self * factor`.
    #[inline(always)]
    fn times_from(self, factor: Self, term: Self) -> Self {
        (-self).times_plus(factor, term)
    }

    /// A polynomial, from the coefficient of the power 0 on (Horner's scheme: the fewest operations, which matter if many
    /// points are computed at a time).
    #[inline(always)]
    fn polynomial(self, coefficients: &[T]) -> Self {
        let mut terms = coefficients.iter().rev();
        let mut sum = Lane(terms.next().copied().unwrap_or(T::of(0.0)));
        for coefficient in terms {
            sum = sum.times_plus(self, Lane(*coefficient));
        }
        sum
    }

    /// 0 if |self| <= limit, otherwise NaN.
    #[inline(always)]
    fn zero_within(self, limit: T) -> Self {
        Lane(T::from_bits(self.abs().bits_beyond(limit)))
    }

    /// All bits if self > limit >= 0, or if self is NaN, otherwise none; for self >= 0. Integers are compared, since the
    /// multipliers are busier than the integer units.
    #[inline(always)]
    fn bits_beyond(self, limit: T) -> T::Bits {
        let excess = limit.bits() - self.0.bits();
        T::of(0.0).bits() - (excess >> (8 * size_of::<T>() - 1))
    }

    /// The integer n nearest to `self * factor`, and a number whose lowest bits are the bits of n + offset; for |n| below a
    /// quarter of 2^[`T::DIGITS`](Float::DIGITS).
    #[inline(always)]
    fn nearest(self, factor: Self, offset: T) -> (Self, T::Bits) {
        let shift = Lane(T::INTEGERS + offset);
        let shifted = self.times_plus(factor, shift);
        (shifted - shift, shifted.0.bits())
    }

    /// a b as the sum of two numbers, up to an error of some 2^-100 in `f64` (Dekker, 1971, with halves that are truncated
    /// instead of rounded).
    #[inline(always)]
    fn product(self, other: Self) -> (Self, Self) {
        let product = self * other;
        if FUSED {
            return (product, self.times_plus(other, -product));
        }
        let halves = |x: Self| {
            let high = Lane(T::from_bits(x.0.bits() & T::UPPER_HALF));
            (high, x - high)
        };
        let ((a, b), (c, d)) = (halves(self), halves(other));
        (product, ((a * c - product) + a * d + b * c) + b * d)
    }

    /// a + b with |a| >= |b| or a = 0, exactly (Dekker, 1971).
    #[inline(always)]
    fn sum(self, smaller: Self) -> (Self, Self) {
        let sum = self + smaller;
        (sum, smaller - (sum - self))
    }
}
