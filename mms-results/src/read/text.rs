//! Numbers in text, and their digits.

use crate::wanted::Wanted;
use crate::{Array, Mistake, Stored, Time};

/// Splits a column name from a unit in brackets after it, as in `u_x [mm]`. A component in brackets is no unit.
pub fn without_unit(text: &str) -> (&str, Option<&str>) {
    let close = |open: char| if open == '[' { ']' } else { ')' };
    let found = text.rfind(['[', '(']).and_then(|at| {
        let open = text[at..].chars().next()?;
        let inside = text[at + 1..].strip_suffix(close(open))?.trim();
        Some((text[..at].trim_end(), inside))
    });
    let is_component =
        |it: &str| it.bytes().all(|byte| byte.is_ascii_digit() || b"xyzXYZ, ".contains(&byte));
    match found {
        Some((name, unit)) if !name.is_empty() && !is_component(unit) => (name, Some(unit)),
        _ => (text, None),
    }
}

/// The form of a number in text.
#[derive(Clone, Copy, Debug, Default)]
struct Written {
    significant: u32,
    decimals: u32,
    is_whole: bool,
    has_exponent: bool,
    ends_in_zero: bool,
}

impl Written {
    fn of(text: &str) -> Self {
        let own = plain(text);
        let text = own.as_deref().unwrap_or(text);
        let (mantissa, exponent) =
            text.split_once(['e', 'E']).map_or((text, false), |(it, _)| (it, true));
        let (before, after) =
            mantissa.split_once('.').map_or((mantissa, None), |(it, after)| (it, Some(after)));
        let digits = before.bytes().chain(after.unwrap_or("").bytes()).filter(u8::is_ascii_digit);
        Written {
            significant: digits.skip_while(|&digit| digit == b'0').count() as u32,
            decimals: after.map_or(0, |after| after.len() as u32),
            is_whole: after.is_none() && !exponent,
            has_exponent: exponent,
            ends_in_zero: after.is_some_and(|after| after.ends_with('0')),
        }
    }
}

/// The common form of all numbers of an array.
#[derive(Clone, Copy, Debug, Default)]
pub struct Style {
    first: Option<Written>,
    most: Written,
    varies: bool,
}

impl Style {
    /// Adds a number.
    pub fn see(&mut self, text: &str) {
        let (one, most) = (Written::of(text), self.most);
        let first = *self.first.get_or_insert(one);
        self.varies |= one.decimals != first.decimals || one.is_whole != first.is_whole;
        self.most = Written {
            significant: most.significant.max(one.significant),
            decimals: first.decimals,
            is_whole: first.is_whole,
            has_exponent: most.has_exponent | one.has_exponent,
            ends_in_zero: most.ends_in_zero | one.ends_in_zero,
        };
    }

    /// The precision of the stored numbers. The same number of digits after the point everywhere counts as fixed only if some
    /// numbers end in zero: 0.125 and 0.375 may be exact.
    pub fn stored(&self) -> Stored {
        let Written { significant, decimals, is_whole, has_exponent, ends_in_zero } = self.most;
        match self.varies || has_exponent {
            false if is_whole => Stored::Whole,
            false if ends_in_zero => Stored::Fixed(decimals),
            _ => Stored::Digits(significant),
        }
    }
}

/// The count of numbers for which memory is reserved at a time.
const CHUNK: usize = 4096;

/// Numbers of a text. A file of a few bytes may declare any number of them, so memory is reserved as they are read.
#[derive(Default)]
pub struct Numbers {
    pub values: Vec<f64>,
    pub style: Style,
}

impl Numbers {
    /// Adds a number.
    ///
    /// # Errors
    /// A word, or too little memory.
    pub fn push(&mut self, text: &str, wanted: &Wanted<'_>) -> Result<(), Mistake> {
        if self.values.len().is_multiple_of(CHUNK) {
            wanted.reserve("the file", CHUNK)?;
        }
        let expected = || Mistake::new(format!("expected a number, found `{text}`"));
        self.values.push(number(text).ok_or_else(expected)?);
        self.style.see(text);
        Ok(())
    }

    /// An array of these numbers; [`finish`] decides its precision.
    pub fn into_array(self, name: &str, components: usize) -> Array {
        let (name, stored) = (name.to_owned(), self.style.stored());
        Array { name, components, values: self.values, stored, ..Array::default() }
    }
}

/// The least number of digits with which a text contains all of a number in single precision, except its last bits.
const ALL_OF_SINGLE: u32 = 8;
/// The least number of digits with which a text contains all of a number in double precision, except its last bits.
const ALL_OF_DOUBLE: u32 = 16;

/// Gives arrays the significant digits of the one with most: a program writes all in one way, and the numbers of an array may
/// need fewer digits.
pub fn finish(arrays: &mut [&mut Array], single: &[bool]) {
    let digits = |stored: Stored| if let Stored::Digits(digits) = stored { digits } else { 0 };
    let most = arrays.iter().map(|array| digits(array.stored)).max().unwrap_or(0);
    for (array, &single) in arrays.iter_mut().zip(single) {
        array.stored = match array.stored {
            Stored::Digits(_) if single && most >= ALL_OF_SINGLE => Stored::Single,
            Stored::Digits(_) if most >= ALL_OF_DOUBLE => Stored::Double,
            Stored::Digits(_) => Stored::Digits(most),
            Stored::Fixed(decimals) if decimals >= ALL_OF_DOUBLE => Stored::Double,
            // The shortest text of a whole number, as 0.0, beside others with all their digits.
            Stored::Fixed(1) if most >= ALL_OF_DOUBLE => Stored::Double,
            other => other,
        };
    }
}

/// Times as written, each with as many digits as the one with most.
pub fn times_of(found: &[(f64, Stored)]) -> impl Iterator<Item = Time> {
    let digits = |stored| if let Stored::Digits(digits) = stored { digits } else { 0 };
    let most = found.iter().map(|(_, stored)| digits(*stored)).max().unwrap_or(0);
    found.iter().map(move |&(value, stored)| {
        let stored = if let Stored::Digits(_) = stored { Stored::Digits(most) } else { stored };
        Time { value, rounding: stored.rounding(value) }
    })
}

/// Parses a number as programs write it, also in Fortran: `1.0D-3`, and `1.0-103`, where a third digit replaces the letter.
pub fn number(text: &str) -> Option<f64> {
    let value = text.parse().ok();
    value.or_else(|| plain(text)?.parse().ok())
}

/// A Fortran number with an `e`; `None` if the text has no exponent of its kind.
fn plain(text: &str) -> Option<String> {
    if text.contains(['d', 'D']) {
        return Some(text.replace(['d', 'D'], "e"));
    }
    let sign = text.rfind(['+', '-']).filter(|at| *at > 0)?;
    let (mantissa, exponent) = text.split_at(sign);
    let is_exponent = exponent.len() == 4 && exponent[1..].bytes().all(|it| it.is_ascii_digit());
    let is_mantissa = mantissa.ends_with(|it: char| it.is_ascii_digit() || it == '.');
    (is_exponent && is_mantissa).then(|| format!("{mantissa}e{exponent}"))
}

/// A text with a decimal point for its decimal comma; `None` if it does not have exactly one.
pub fn with_point(text: &str) -> Option<String> {
    let is_one = text.matches(',').count() == 1 && !text.contains('.');
    is_one.then(|| text.replace(',', "."))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stored(texts: &[&str]) -> Stored {
        let mut style = Style::default();
        texts.iter().for_each(|text| style.see(text));
        style.stored()
    }

    #[test]
    fn digits_are_counted_as_they_are_written() {
        assert_eq!(stored(&["1", "-20"]), Stored::Whole);
        assert_eq!(stored(&["0.100000", "12.345678"]), Stored::Fixed(6));
        assert_eq!(stored(&["0.125", "0.375"]), Stored::Digits(3));
        assert_eq!(stored(&["0.00123457", "-0.5"]), Stored::Digits(6));
        assert_eq!(stored(&["1.2346e-03", "1.0000e+00"]), Stored::Digits(5));
        assert_eq!(stored(&["0", "1e-5"]), Stored::Digits(1));
    }

    #[test]
    fn whole_numbers_beside_others_are_as_exact_as_these() {
        let array = |texts: &[&str]| Array {
            name: String::new(),
            components: 1,
            values: Vec::new(),
            stored: stored(texts),
            ..Array::default()
        };
        let zeros = array(&["0.0", "-0.0", "1.0"]);
        let settled = |mut one: Array, mut other: Array| {
            finish(&mut [&mut one, &mut other], &[false; 2]);
            one.stored
        };
        assert_eq!(settled(zeros.clone(), array(&["0.3669589318356906"])), Stored::Double);
        assert_eq!(settled(zeros, array(&["0.366959"])), Stored::Fixed(1));
        assert_eq!(
            settled(array(&["0.00", "1.25"]), array(&["0.3669589318356906"])),
            Stored::Fixed(2)
        );
    }

    #[test]
    fn a_rounding_is_half_a_unit_in_the_last_place() {
        assert_eq!(Stored::Fixed(6).rounding(12.0), 0.5e-6);
        assert!((Stored::Digits(6).rounding(0.00123457) - 0.5e-8).abs() < 1e-20);
        assert_eq!(Stored::Double.rounding(1.0), f64::EPSILON / 2.0);
        assert_eq!(Stored::Single.rounding(2.0), f64::from(f32::EPSILON));
    }

    #[test]
    fn single_precision_is_known_by_its_numbers() {
        let single = [0.0, 0.5, f64::from(0.8_f32)];
        assert_eq!(Stored::Double.at_first(&single), Stored::Single);
        assert_eq!(Stored::Digits(17).at_first(&single), Stored::Single);
        assert_eq!(Stored::Digits(6).at_first(&single), Stored::Digits(6));
        assert_eq!(Stored::Whole.at_first(&[16_777_215.0]), Stored::Whole);
        // Binary fractions with few digits are the same in both.
        assert_eq!(Stored::Double.at_first(&[0.0, 0.5, 0.8125]), Stored::Double);
        assert_eq!(Stored::Double.at_first(&[0.5, 0.8]), Stored::Double);
    }

    #[test]
    fn one_decimal_comma_is_a_point() {
        assert_eq!(with_point("-0,5e3").as_deref(), Some("-0.5e3"));
        assert_eq!(with_point("1,234.5"), None);
        assert_eq!(with_point("1,2,3"), None);
        assert_eq!(with_point("5"), None);
    }

    #[test]
    fn numbers_of_fortran_are_read() {
        assert_eq!(number("1.5D-3"), Some(1.5e-3));
        assert_eq!(number("-2e5"), Some(-2e5));
        assert_eq!(number("word"), None);
        assert_eq!(number("d"), None);
        assert_eq!(number("1.5-103"), Some(1.5e-103));
        assert_eq!(number("-0.25+004"), Some(-2500.0));
        for text in ["1-2", "2026-11-29", "1.5-1003", "-103", "a-103", "+-103"] {
            assert_eq!(number(text), None.or(text.parse().ok()), "{text}");
        }
        assert_eq!(stored(&["1.2346-103", "1.0000+100"]), Stored::Digits(5));
    }
}
