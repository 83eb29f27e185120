//! The precisions that code is generated for, as numbers with a rounding unit and a range.

use mms_math::{Double, Scalar as _};

use crate::interpret::Number;
use crate::precise::Binary;

/// The precision of a computation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Precision {
    /// Single precision.
    F32,
    /// Double precision.
    F64,
    /// Twice the digits of double precision.
    Wide,
}

impl Precision {
    /// Every precision, the shortest first.
    pub const ALL: [Precision; 3] = [Precision::F32, Precision::F64, Precision::Wide];

    /// The name on the command line and in JSON.
    pub fn name(self) -> &'static str {
        match self {
            Precision::F32 => "f32",
            Precision::F64 => "f64",
            Precision::Wide => "wide",
        }
    }

    /// The precision with this name.
    pub fn from_name(name: &str) -> Option<Precision> {
        Self::ALL.into_iter().find(|precision| precision.name() == name)
    }

    /// The distance from 1 to the next number; 2^-104 for twice the digits.
    pub fn eps(self) -> f64 {
        match self {
            Precision::F32 => f64::from(f32::EPSILON),
            Precision::F64 => f64::EPSILON,
            Precision::Wide => 2f64.powi(-104),
        }
    }

    /// The least magnitude that has all digits.
    pub fn least(self) -> f64 {
        match self {
            Precision::F32 => f64::from(f32::MIN_POSITIVE),
            Precision::F64 => f64::MIN_POSITIVE,
            // Below this, intermediate products have a subnormal low part.
            Precision::Wide => 2f64.powi(-960),
        }
    }

    /// The largest number.
    pub fn largest(self) -> f64 {
        match self {
            Precision::F32 => f64::from(f32::MAX),
            Precision::F64 | Precision::Wide => f64::MAX,
        }
    }

    /// The smallest number.
    pub fn smallest(self) -> f64 {
        match self {
            Precision::F32 => f64::from(f32::from_bits(1)),
            Precision::F64 | Precision::Wide => f64::from_bits(1),
        }
    }
}

/// A number in one of these precisions.
pub trait Digits: Number + Copy {
    /// The precision.
    const PRECISION: Precision;

    /// The number as an unevaluated sum.
    fn parts(self) -> (f64, f64);

    /// Whether the value is a finite number.
    fn is_number(self) -> bool {
        self.parts().0.is_finite()
    }

    /// The number with arbitrary precision.
    fn precisely<const BITS: usize>(self) -> Binary<BITS> {
        let (high, low) = self.parts();
        Binary::from_f64(high) + Binary::from_f64(low)
    }
}

impl Digits for f32 {
    const PRECISION: Precision = Precision::F32;

    fn parts(self) -> (f64, f64) {
        (f64::from(self), 0.0)
    }
}

impl Digits for f64 {
    const PRECISION: Precision = Precision::F64;

    fn parts(self) -> (f64, f64) {
        (self, 0.0)
    }
}

impl Digits for Double {
    const PRECISION: Precision = Precision::Wide;

    fn parts(self) -> (f64, f64) {
        (self.to_f64(), self.low())
    }
}

#[cfg(test)]
mod tests {
    use super::Precision;

    #[test]
    fn half_of_the_smallest_is_nothing_and_twice_the_largest_infinite() {
        for precision in [Precision::F32, Precision::F64, Precision::Wide] {
            let of_type = |number: f64| match precision {
                Precision::F32 => f64::from(number as f32),
                Precision::F64 | Precision::Wide => number,
            };
            let (smallest, largest) = (precision.smallest(), precision.largest());
            assert!(of_type(smallest) > 0.0 && of_type(smallest / 2.0) == 0.0);
            assert!(of_type(largest).is_finite() && of_type(largest * 2.0).is_infinite());
        }
    }
}
