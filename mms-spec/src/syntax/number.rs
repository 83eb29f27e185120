//! Decimal numbers, exactly.

use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;

/// The largest number of digits of a number.
pub const MAX_DIGITS: usize = 1000;

/// The largest decimal exponent of a number, of either sign: far beyond every target's floating-point numbers, and small enough
/// that a file full of such numbers is read quickly.
pub const MAX_EXPONENT: usize = 1000;

/// Reads digits with an optional point and exponent, such as `12`, `.5`, `1.` or `1.5e-3`. The error is the mistake and its
/// label.
pub(super) fn exact(text: &str) -> Result<RBig, (String, String)> {
    let (mantissa, exponent) = match text.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, Some(exponent)),
        None => (text, None),
    };
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let length = whole.len() + fraction.len();
    if length > MAX_DIGITS {
        let message = format!("this number has {length} digits");
        return Err((message, format!("at most {MAX_DIGITS} are read")));
    }
    let malformed = || (format!("`{text}` is not a number"), "expected digits".into());
    let digits: UBig = [whole, fraction].concat().parse().map_err(|_| malformed())?;
    let exponent = exponent.map_or(Ok(0), decimal_exponent)?;
    let scale = exponent - fraction.len() as isize;
    let power = UBig::from(10u8).pow(scale.unsigned_abs());
    Ok(if scale < 0 {
        RBig::from_parts(IBig::from(digits), power)
    } else {
        RBig::from(digits * power)
    })
}

fn decimal_exponent(text: &str) -> Result<isize, (String, String)> {
    let (is_negative, digits) = match text.strip_prefix('-') {
        Some(digits) => (true, digits),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    };
    if digits.is_empty() {
        let message = "the exponent of this number has no digits".to_string();
        return Err((message, "expected digits after the `e`".into()));
    }
    // Digits that do not fit exceed the bound as well.
    match digits.parse::<isize>() {
        Ok(size) if size.unsigned_abs() <= MAX_EXPONENT => {
            Ok(if is_negative { -size } else { size })
        }
        _ => Err((
            "the exponent of this number is too large".into(),
            format!("at most {MAX_EXPONENT} is read, of either sign"),
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ratio(numerator: i64, denominator: u64) -> RBig {
        RBig::from_parts(numerator.into(), denominator.into())
    }

    #[test]
    fn decimals_are_exact() {
        for (text, value) in [
            ("0.1", ratio(1, 10)),
            ("12", ratio(12, 1)),
            (".5", ratio(1, 2)),
            ("3.", ratio(3, 1)),
            ("1.25e2", ratio(125, 1)),
            ("1.5E+1", ratio(15, 1)),
            ("5e-1", ratio(1, 2)),
            ("0e-400", ratio(0, 1)),
        ] {
            assert_eq!(exact(text), Ok(value), "{text}");
        }
        let tiny = exact("1e-400").expect("a number");
        assert_eq!(tiny * RBig::from(UBig::from(10u8).pow(400)), RBig::ONE);
    }

    #[test]
    fn sizes_are_bounded() {
        assert!(exact(&"9".repeat(MAX_DIGITS)).is_ok());
        assert!(exact(&"9".repeat(MAX_DIGITS + 1)).is_err());
        assert!(exact("1e1000").is_ok());
        for text in ["1e1001", "1e-1001", "1e999999999", "1e99999999999999999999999"] {
            assert!(exact(text).is_err(), "{text}");
        }
    }

    #[test]
    fn half_numbers_are_refused() {
        for text in ["", ".", "1e", "1e+", "e5", ".e1"] {
            assert!(exact(text).is_err(), "{text}");
        }
    }
}
