//! Dimensions: the kind of quantity of a value, without regard to the size of its unit.

use std::fmt;

use dashu_ratio::RBig as Rational;

/// The units of the base dimensions, in the order in which they are printed.
pub const BASE: [&str; 7] = ["kg", "m", "s", "K", "A", "mol", "cd"];

/// The longest exponent; bounded, so that no text takes long. No physical exponent is longer.
const MAX_BITS: usize = 64;

/// Dimensions whose unit is better known than the product of base units: the unit, then the exponents of kg, m and s.
const COMMON: &[(&str, [i8; 3])] = &[
    ("m/s", [0, 1, -1]),
    ("m/s^2", [0, 1, -2]),
    ("kg/m^3", [1, -3, 0]),
    ("N", [1, 1, -2]),
    ("Pa", [1, -1, -2]),
    ("J", [1, 2, -2]),
    ("W", [1, 2, -3]),
    ("N/m", [1, 0, -2]),
    ("N/m^3", [1, -2, -2]),
    ("1/s", [0, 0, -1]),
    ("1/m", [0, -1, 0]),
];

/// A product of powers of the seven base dimensions, with exact exponents.
///
/// It is printed as an SI unit: `Pa`, `m/s^2`, `kg*m^-1*s^-1`; without dimension as `1`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Dimension([Rational; 7]);

impl Dimension {
    /// The dimension of pure numbers.
    pub const NONE: Dimension = Dimension([Rational::ZERO; 7]);

    /// The dimension with these exponents, in the order of [`BASE`].
    pub fn new(exponents: [i8; 7]) -> Self {
        Dimension(exponents.map(Rational::from))
    }

    /// A length.
    pub fn length() -> Self {
        Self::mechanical([0, 1, 0])
    }

    /// A time.
    pub fn time() -> Self {
        Self::mechanical([0, 0, 1])
    }

    /// A mass per volume.
    pub fn density() -> Self {
        Self::mechanical([1, -3, 0])
    }

    /// A stress, or an energy per volume.
    pub fn stress() -> Self {
        Self::mechanical([1, -1, -2])
    }

    /// The dimension with these exponents of mass, length and time.
    pub fn mechanical([mass, length, time]: [i8; 3]) -> Self {
        Self::new([mass, length, time, 0, 0, 0, 0])
    }

    /// Whether this is the dimension of pure numbers.
    pub fn is_none(&self) -> bool {
        self.0.iter().all(Rational::is_zero)
    }

    /// The exponents, in the order of [`BASE`].
    pub fn exponents(&self) -> &[Rational; 7] {
        &self.0
    }

    /// The dimension of a product. `None` if an exponent becomes absurdly long.
    pub fn times(&self, other: &Dimension) -> Option<Dimension> {
        self.combine(other, |a, b| a + b)
    }

    /// The dimension of a quotient. `None` if an exponent becomes absurdly long.
    pub fn over(&self, other: &Dimension) -> Option<Dimension> {
        self.combine(other, |a, b| a - b)
    }

    /// The dimension of a power. `None` if an exponent becomes absurdly long.
    pub fn power(&self, exponent: &Rational) -> Option<Dimension> {
        self.combine(&Self::NONE, |a, _| a * exponent)
    }

    fn combine(
        &self,
        other: &Dimension,
        operation: impl Fn(&Rational, &Rational) -> Rational,
    ) -> Option<Dimension> {
        let mut exponents = Self::NONE.0;
        for (result, (a, b)) in exponents.iter_mut().zip(self.0.iter().zip(&other.0)) {
            if a.is_zero() && b.is_zero() {
                continue;
            }
            *result = operation(a, b);
            if bits(result) > MAX_BITS {
                return None;
            }
        }
        Some(Dimension(exponents))
    }

    fn common(&self) -> Option<&'static str> {
        let found = COMMON.iter().find(|(_, exponents)| *self == Self::mechanical(*exponents));
        found.map(|(unit, _)| *unit)
    }
}

/// The length of a number in binary, the longer of numerator and denominator.
pub(super) fn bits(number: &Rational) -> usize {
    use dashu_int::ops::BitTest as _;
    number.numerator().bit_len().max(number.denominator().bit_len())
}

impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(unit) = self.common() {
            return f.write_str(unit);
        }
        let powers = BASE.iter().zip(&self.0).filter(|(_, exponent)| !exponent.is_zero());
        let powers: Vec<String> = powers
            .map(|(unit, exponent)| match exponent {
                one if one.is_one() => unit.to_string(),
                whole if whole.is_int() => format!("{unit}^{whole}"),
                broken => format!("{unit}^({broken})"),
            })
            .collect();
        f.write_str(if powers.is_empty() { "1".into() } else { powers.join("*") }.as_str())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_and_powers_are_exact() {
        let stress = Dimension::stress();
        let speed = stress.over(&Dimension::density()).and_then(|ratio| {
            let half = Rational::from_parts(1.into(), 2u8.into());
            ratio.power(&half)
        });
        assert_eq!(speed, Some(Dimension::mechanical([0, 1, -1])));
        assert_eq!(stress.over(&stress), Some(Dimension::NONE));
    }

    #[test]
    fn prints_known_names_and_products_of_base_units() {
        let third = Rational::from_parts(1.into(), 3u8.into());
        for (dimension, unit) in [
            (Dimension::NONE, "1"),
            (Dimension::stress(), "Pa"),
            (Dimension::density(), "kg/m^3"),
            (Dimension::mechanical([0, 1, -2]), "m/s^2"),
            (Dimension::mechanical([1, -1, -1]), "kg*m^-1*s^-1"),
            (Dimension::new([0, 2, 0, 0, 0, 0, 1]), "m^2*cd"),
            (Dimension::length().power(&third).expect("a short exponent"), "m^(1/3)"),
        ] {
            assert_eq!(dimension.to_string(), unit);
        }
    }

    #[test]
    fn exponents_are_bounded() {
        let huge = Rational::from(i64::MAX);
        let once = Dimension::length().power(&huge).expect("64 bits");
        assert_eq!(once.power(&huge), None);
    }
}
