//! The two formats: their bits, and the constants that depend on the number of digits.

use core::fmt::Debug;
use core::num::Wrapping;
use core::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Not, Shl, Shr, Sub};

use crate::lane::Lane;

/// The bits of a number as an integer that wraps around.
pub trait Bits:
    Copy
    + PartialEq
    + Add<Output = Self>
    + Sub<Output = Self>
    + BitAnd<Output = Self>
    + BitOr<Output = Self>
    + BitXor<Output = Self>
    + Not<Output = Self>
    + Shl<usize, Output = Self>
    + Shr<usize, Output = Self>
{
}

impl Bits for Wrapping<u32> {}
impl Bits for Wrapping<u64> {}

/// The polynomials, each from its lowest power on.
#[derive(Debug)]
pub struct Polynomials<T: 'static> {
    /// (sin(pi r)/r - pi)/s in s = r^2.
    pub sin_pi: &'static [T],
    /// (cos(pi r) - 1)/s in s = r^2.
    pub cos_pi: &'static [T],
    /// (sin(r)/r - 1)/s in s = r^2.
    pub sin: &'static [T],
    /// (cos(r) - 1 + s/2)/s^2 in s = r^2.
    pub cos: &'static [T],
    /// Like `sin`, on twice the range.
    pub sin_near_zero: &'static [T],
    /// Like `cos`, on twice the range.
    pub cos_near_zero: &'static [T],
    /// Like `sin`, up to [`WITHIN_ONE`](crate::WITHIN_ONE).
    pub sin_within_one: &'static [T],
    /// Like `cos`, up to [`WITHIN_ONE`](crate::WITHIN_ONE).
    pub cos_within_one: &'static [T],
    /// (exp(r) - 1 - r)/r^2 in r.
    pub exp: &'static [T],
    /// (sinh(r)/r - 1)/s in s = r^2.
    pub sinh: &'static [T],
    /// (cosh(r) - 1)/s in s = r^2.
    pub cosh: &'static [T],
    /// (ln((1 + s)/(1 - s))/s - 2)/z in z = s^2.
    pub ln: &'static [T],
    /// (atan(q)/q - 1)/z in z = q^2.
    pub atan: &'static [T],
    /// (asin(q)/q - 1)/z in z = q^2.
    pub asin: &'static [T],
    /// (1 - h)^(-1/3) in h.
    pub inverse_cbrt: &'static [T],
}

/// `f32` or `f64`.
pub trait Float:
    Copy
    + Debug
    + PartialEq
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + 'static
{
    /// An integer of the same size.
    type Bits: Bits;

    /// The binary digits of a significand.
    const DIGITS: usize;
    /// The bias of the exponent's bits.
    const BIAS: Self;
    /// The greatest finite number.
    const MAX: Self;
    /// The least normal number.
    const MIN_POSITIVE: Self;
    /// NaN.
    const NAN: Self;
    /// 3/2 2^(DIGITS - 1): numbers near it are integers, and their lowest bits are the integer's.
    const INTEGERS: Self;
    /// The bit of the sign.
    const SIGN: Self::Bits;
    /// The bits of the significand.
    const SIGNIFICAND: Self::Bits;
    /// The sign, the exponent and the upper half of the significand.
    const UPPER_HALF: Self::Bits;
    /// The integer 1.
    const ONE: Self::Bits;

    /// ln 2 as a sum; an exponent times the first part is exact.
    const LN_2: [Self; 2];
    /// pi as a sum.
    const PI: [Self; 2];
    /// The largest angle that [`Float::quarter_turns_off`] reduces.
    const LARGEST_ANGLE: Self;
    /// The largest |x| of an exponential: 2^(x/ln 2) is normal for both signs.
    const LARGEST_EXPONENT: Self;
    /// The largest |x| for which tanh(x) is not 1.
    const LARGEST_TANH: Self;
    /// The number of bits that the first step to a cube root drops, so that the rest fits into half a significand.
    const CBRT_SHIFT: usize;
    /// The bits of x^(-1/3) are about this minus a third of the upper bits of x.
    const CBRT_OFFSET: Self;
    /// The polynomials.
    const POLYNOMIALS: Polynomials<Self>;

    /// The nearest value.
    fn of(value: f64) -> Self;
    /// The bits of the number.
    fn bits(self) -> Self::Bits;
    /// The number with these bits.
    fn from_bits(bits: Self::Bits) -> Self;
    /// `self * factor + term`, rounded once.
    fn fused(self, factor: Self, term: Self) -> Self;
    /// Whether the number is NaN.
    fn is_nan(self) -> bool;
    /// The square root.
    fn sqrt(self) -> Self;
    /// x - n pi/2 as a sum, where n is the nearest integer to x/(pi/2) (Cody & Waite, 1980).
    fn quarter_turns_off<const FUSED: bool>(
        x: Lane<Self, FUSED>,
        n: Lane<Self, FUSED>,
    ) -> [Lane<Self, FUSED>; 2];
    /// x^y for x > 0.
    fn powf<const FUSED: bool>(x: Lane<Self, FUSED>, y: Lane<Self, FUSED>) -> Lane<Self, FUSED>;
}

macro_rules! format {
    ($float:ident, $bits:ident, digits: $digits:literal, cbrt_shift: $shift:literal) => {
        type Bits = Wrapping<$bits>;
        const DIGITS: usize = $digits;
        const BIAS: Self = ($float::MAX_EXP - 1) as $float;
        const MAX: Self = $float::MAX;
        const MIN_POSITIVE: Self = $float::MIN_POSITIVE;
        const NAN: Self = $float::NAN;
        const INTEGERS: Self = (3u64 << ($digits - 2)) as $float;
        const SIGN: Self::Bits = Wrapping(1 << ($bits::BITS - 1));
        const SIGNIFICAND: Self::Bits = Wrapping((1 << ($digits - 1)) - 1);
        const UPPER_HALF: Self::Bits = Wrapping($bits::MAX << ($digits / 2 + 1));
        const ONE: Self::Bits = Wrapping(1);
        const CBRT_SHIFT: usize = $shift;

        #[inline(always)]
        fn of(value: f64) -> Self {
            value as $float
        }
        #[inline(always)]
        fn bits(self) -> Self::Bits {
            Wrapping(self.to_bits())
        }
        #[inline(always)]
        fn from_bits(bits: Self::Bits) -> Self {
            $float::from_bits(bits.0)
        }
        #[inline(always)]
        fn fused(self, factor: Self, term: Self) -> Self {
            $float::mul_add(self, factor, term)
        }
        #[inline(always)]
        fn is_nan(self) -> bool {
            $float::is_nan(self)
        }
        #[inline(always)]
        fn sqrt(self) -> Self {
            $float::sqrt(self)
        }
    };
}

mod double;
mod single;
