//! Numbers as text.

use mms_program::interpret::parts;
use mms_symbolic::expr::Rational;

/// The nearest double to an exact number, as the shortest decimal that reads back as it, always with
/// a point: `2.0`, `1.0e-400` is `0.0`.
pub fn decimal(value: f64) -> String {
    let text = format!("{value:?}");
    match text.split_once('e') {
        Some((digits, exponent)) if !digits.contains('.') => format!("{digits}.0e{exponent}"),
        _ => text,
    }
}

/// The nearest double to an exact number.
pub fn nearest(number: &Rational) -> f64 {
    parts(number).0
}

/// A double in the hexadecimal form of C and Python, with all its bits.
pub fn hexadecimal(value: f64) -> String {
    let bits = value.to_bits();
    let sign = if value.is_sign_negative() { "-" } else { "" };
    let fraction = bits & ((1 << 52) - 1);
    let exponent = ((bits >> 52) & 0x7ff) as i64;
    if exponent == 0 && fraction == 0 {
        return format!("{sign}0x0.0p+0");
    }
    let (first, exponent) = if exponent == 0 { (0, -1022) } else { (1, exponent - 1023) };
    let digits = format!("{fraction:013x}");
    let digits = match digits.trim_end_matches('0') {
        "" => "0",
        digits => digits,
    };
    format!("{sign}0x{first}.{digits}p{exponent:+}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn doubles_are_written_with_all_their_bits() {
        for (value, text) in [
            (1.0, "0x1.0p+0"),
            (-0.75, "-0x1.8p-1"),
            (0.1, "0x1.999999999999ap-4"),
            (f64::MAX, "0x1.fffffffffffffp+1023"),
            (f64::from_bits(1), "0x0.0000000000001p-1022"),
            (-0.0, "-0x0.0p+0"),
        ] {
            assert_eq!(hexadecimal(value), text);
        }
    }

    #[test]
    fn decimals_have_a_point() {
        for (value, text) in
            [(2.0, "2.0"), (1e300, "1.0e300"), (1.5e-7, "1.5e-7"), (0.0, "0.0"), (-3.25, "-3.25")]
        {
            assert_eq!(decimal(value), text);
            assert_eq!(text.parse(), Ok(value));
        }
        let third = Rational::from_parts(1.into(), 3_u8.into());
        assert_eq!(nearest(&third), 1.0 / 3.0);
    }
}
