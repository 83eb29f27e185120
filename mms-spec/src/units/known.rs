//! The units that files may use: the SI units with their prefixes, and a few others.

use super::dimension::Dimension;
use crate::suggest;

/// The size of a unit, as 10^tens * 60^sixties SI units. The two factors are independent, so that sizes are equal only if both
/// exponents are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// The exponent of 10.
    pub tens: i16,
    /// The exponent of 60.
    pub sixties: i16,
}

impl Size {
    /// The size of the SI unit.
    pub const SI: Size = Size { tens: 0, sixties: 0 };
}

/// A unit without its prefix: symbol, name, exponents in the order of `BASE`, power of ten of the SI unit, and whether prefixes
/// are allowed.
struct Plain {
    symbol: &'static str,
    name: &'static str,
    exponents: [i8; 7],
    size: Size,
    prefixed: bool,
}

const fn si(symbol: &'static str, name: &'static str, exponents: [i8; 7]) -> Plain {
    Plain { symbol, name, exponents, size: Size::SI, prefixed: true }
}

const fn other(
    symbol: &'static str,
    name: &'static str,
    exponents: [i8; 7],
    (tens, sixties): (i16, i16),
) -> Plain {
    Plain { symbol, name, exponents, size: Size { tens, sixties }, prefixed: false }
}

/// Every unit; if a text could mean two of them, it means the first.
const UNITS: &[Plain] = &[
    si("m", "metre", [0, 1, 0, 0, 0, 0, 0]),
    si("s", "second", [0, 0, 1, 0, 0, 0, 0]),
    si("Pa", "pascal", [1, -1, -2, 0, 0, 0, 0]),
    si("N", "newton", [1, 1, -2, 0, 0, 0, 0]),
    si("J", "joule", [1, 2, -2, 0, 0, 0, 0]),
    si("W", "watt", [1, 2, -3, 0, 0, 0, 0]),
    si("Hz", "hertz", [0, 0, -1, 0, 0, 0, 0]),
    si("K", "kelvin", [0, 0, 0, 1, 0, 0, 0]),
    si("A", "ampere", [0, 0, 0, 0, 1, 0, 0]),
    si("mol", "mole", [0, 0, 0, 0, 0, 1, 0]),
    si("cd", "candela", [0, 0, 0, 0, 0, 0, 1]),
    si("rad", "radian", [0; 7]),
    si("C", "coulomb", [0, 0, 1, 0, 1, 0, 0]),
    si("V", "volt", [1, 2, -3, 0, -1, 0, 0]),
    si("F", "farad", [-1, -2, 4, 0, 2, 0, 0]),
    si("ohm", "ohm", [1, 2, -3, 0, -2, 0, 0]),
    si("S", "siemens", [-1, -2, 3, 0, 2, 0, 0]),
    si("Wb", "weber", [1, 2, -2, 0, -1, 0, 0]),
    si("T", "tesla", [1, 0, -2, 0, -1, 0, 0]),
    si("H", "henry", [1, 2, -2, 0, -2, 0, 0]),
    Plain { size: Size { tens: -3, sixties: 0 }, ..si("g", "gram", [1, 0, 0, 0, 0, 0, 0]) },
    Plain { size: Size { tens: 5, sixties: 0 }, ..si("bar", "bar", [1, -1, -2, 0, 0, 0, 0]) },
    other("tonne", "ton", [1, 0, 0, 0, 0, 0, 0], (3, 0)),
    other("t", "tonne", [1, 0, 0, 0, 0, 0, 0], (3, 0)),
    other("min", "minute", [0, 0, 1, 0, 0, 0, 0], (0, 1)),
    other("h", "hour", [0, 0, 1, 0, 0, 0, 0], (0, 2)),
];

/// The prefixes, with their powers of ten.
const PREFIXES: &[(&str, i16)] = &[
    ("k", 3),
    ("M", 6),
    ("G", 9),
    ("T", 12),
    ("m", -3),
    ("u", -6),
    ("n", -9),
    ("p", -12),
    ("c", -2),
    ("d", -1),
    ("h", 2),
    ("da", 1),
];

/// Names that people try, with advice.
const REFUSED: &[(&str, &str)] = &[
    ("deg", "angles are in radians, and values are not converted: use `rad` or `1`"),
    ("degree", "angles are in radians, and values are not converted: use `rad` or `1`"),
    ("degC", "temperatures are in `K`"),
    ("celsius", "temperatures are in `K`"),
    ("percent", "a ratio has the unit `1`, and its value is a fraction"),
    ("meter", "did you mean `m`?"),
    ("sec", "did you mean `s`?"),
    ("kilogram", "did you mean `kg`?"),
    ("millimetre", "did you mean `mm`?"),
    ("millimeter", "did you mean `mm`?"),
    ("ft", "values are not converted: use `m`"),
    ("inch", "values are not converted: use `m`"),
    ("psi", "values are not converted: use `Pa`"),
    ("lb", "values are not converted: use `kg`"),
];

/// The dimension and the size of the unit with this symbol.
pub fn find(symbol: &str) -> Option<(Dimension, Size)> {
    let exact = UNITS.iter().find(|unit| unit.symbol == symbol).map(|unit| (unit, 0));
    let prefixed = || {
        PREFIXES.iter().find_map(|(prefix, tens)| {
            let rest = symbol.strip_prefix(prefix)?;
            let unit = UNITS.iter().find(|unit| unit.prefixed && unit.symbol == rest)?;
            Some((unit, *tens))
        })
    };
    let (unit, tens) = exact.or_else(prefixed)?;
    let size = Size { tens: unit.size.tens + tens, ..unit.size };
    Some((Dimension::new(unit.exponents), size))
}

/// The symbol of the unit of a dimension with this size: the SI unit's own, else one with a prefix.
pub fn name(dimension: &Dimension, size: Size) -> Option<String> {
    let of = |unit: &&Plain| Dimension::new(unit.exponents) == *dimension;
    if let Some(unit) = UNITS.iter().filter(of).find(|unit| unit.size == size) {
        return Some(unit.symbol.to_owned());
    }
    let prefixed = UNITS.iter().filter(of).filter(|unit| unit.prefixed);
    prefixed.flat_map(|unit| PREFIXES.iter().map(move |prefix| (unit, prefix))).find_map(
        |(unit, (prefix, tens))| {
            let own = Size { tens: unit.size.tens + tens, ..unit.size };
            (own == size).then(|| format!("{prefix}{}", unit.symbol))
        },
    )
}

/// The advice on a symbol that is no unit.
pub fn advice(symbol: &str) -> String {
    if let Some((_, advice)) = REFUSED.iter().find(|(name, _)| is_word(name, symbol)) {
        return advice.to_string();
    }
    if let Some(unit) = UNITS.iter().find(|unit| is_word(unit.name, symbol)) {
        return format!("did you mean `{}`?", unit.symbol);
    }
    let candidates = candidates();
    suggest::advice(symbol, candidates.iter().map(String::as_str), |_| {
        "use SI units with their prefixes, such as `kg/m^3`, `MPa` or `1`".into()
    })
}

/// Whether a text is a word, or its plural, in letters of any case.
fn is_word(word: &str, text: &str) -> bool {
    let singular = text.strip_suffix('s').unwrap_or(text);
    word.len() > 1 && (word.eq_ignore_ascii_case(text) || word.eq_ignore_ascii_case(singular))
}

/// Every symbol, those without a prefix first.
fn candidates() -> Vec<String> {
    let plain = UNITS.iter().map(|unit| unit.symbol.to_string());
    let prefixed = PREFIXES.iter().flat_map(|(prefix, _)| {
        let units = UNITS.iter().filter(|unit| unit.prefixed);
        units.map(move |unit| format!("{prefix}{}", unit.symbol))
    });
    plain.chain(prefixed).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn size(tens: i16, sixties: i16) -> Size {
        Size { tens, sixties }
    }

    #[test]
    fn prefixes_multiply_and_whole_symbols_come_first() {
        for (symbol, found) in [
            ("m", (Dimension::length(), size(0, 0))),
            ("mm", (Dimension::length(), size(-3, 0))),
            ("min", (Dimension::time(), size(0, 1))),
            ("h", (Dimension::time(), size(0, 2))),
            ("MPa", (Dimension::stress(), size(6, 0))),
            ("kg", (Dimension::mechanical([1, 0, 0]), size(0, 0))),
            ("tonne", (Dimension::mechanical([1, 0, 0]), size(3, 0))),
            ("mol", (Dimension::new([0, 0, 0, 0, 0, 1, 0]), size(0, 0))),
            ("cd", (Dimension::new([0, 0, 0, 0, 0, 0, 1]), size(0, 0))),
        ] {
            assert_eq!(find(symbol), Some(found), "{symbol}");
        }
        for symbol in ["", "k", "ktonne", "mmin", "Kg", "meter", "kkg"] {
            assert_eq!(find(symbol), None, "{symbol}");
        }
    }

    #[test]
    fn no_symbol_has_two_meanings() {
        let candidates = candidates();
        for (index, symbol) in candidates.iter().enumerate() {
            assert!(!candidates[..index].contains(symbol), "{symbol}");
        }
    }

    #[test]
    fn slips_are_recognised() {
        for (symbol, near) in [("pa", "Pa"), ("Kg", "kg"), ("metres", "m"), ("Newton", "N")] {
            assert_eq!(advice(symbol), format!("did you mean `{near}`?"));
        }
        assert!(advice("deg").contains("radians"));
        assert!(advice("furlong").contains("SI"));
    }
}
