//! Formulas on one line of Unicode.

use crate::language::signed;
use crate::name::{Name, greek};
use crate::relation::Setting;
use crate::walk::{Exponent, Notation};
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::Function;

/// Formulas on one line of Unicode.
pub struct Text;

const MINUS: &str = "\u{2212}";
const TIMES: &str = "\u{b7}";
const ROOT: &str = "\u{221a}";
const CUBE_ROOT: &str = "\u{221b}";

impl Notation for Text {
    fn whole(&self, digits: &str) -> String {
        match scientific(digits) {
            Some((mantissa, exponent)) if mantissa == "1" => format!("10{}", raised(&exponent)),
            Some((mantissa, exponent)) => format!("{mantissa}{TIMES}10{}", raised(&exponent)),
            None => digits.into(),
        }
    }

    fn pi(&self) -> String {
        "\u{3c0}".into()
    }

    fn name(&self, name: &Name) -> String {
        if name.is_dotted() {
            let dot = if name.along.len() == 1 { '\u{307}' } else { '\u{308}' };
            return format!("{}{dot}", name.stem);
        }
        let mut text = self.stem(name);
        text.push_str(&lowered(&name.index));
        if !name.along.is_empty() {
            text.push(',');
            name.along.iter().for_each(|along| text.push_str(&self.label(along.label())));
        }
        text
    }

    fn sum(&self, terms: &[(bool, String)]) -> String {
        signed(terms, MINUS)
    }

    fn product(&self, factors: &[String]) -> String {
        factors.join(TIMES)
    }

    fn fraction(&self, above: &str, below: &str) -> String {
        format!("{above}/{below}")
    }

    fn has_bars(&self) -> bool {
        false
    }

    fn power(&self, base: &str, exponent: &Exponent) -> String {
        match exponent {
            Exponent::Number(number) if number.is_int() => {
                format!("{base}{}", raised(&number.to_string()))
            }
            Exponent::Number(number) => format!("{base}^({number})"),
            Exponent::Formula { text, is_atom: true } => format!("{base}^{text}"),
            Exponent::Formula { text, is_atom: false } => format!("{base}^({text})"),
        }
    }

    fn root(&self, degree: u8, radicand: &str, is_atom: bool) -> String {
        let root = if degree == 2 { ROOT } else { CUBE_ROOT };
        match is_atom {
            true => format!("{root}{radicand}"),
            false => format!("{root}({radicand})"),
        }
    }

    fn call(&self, function: Function, arguments: &[String], power: Option<&str>) -> String {
        let power = power.map(raised).unwrap_or_default();
        format!("{}{power}({})", word(function), arguments.join(", "))
    }

    fn has_powers_of_functions(&self) -> bool {
        true
    }

    fn parentheses(&self, inside: &str) -> String {
        format!("({inside})")
    }
}

impl Setting for Text {
    fn letter(&self, word: &str, _: bool) -> String {
        self.label(word)
    }

    fn sign(&self, sign: &str) -> String {
        match sign {
            "-" => format!(" {MINUS} "),
            "," => ", ".into(),
            sign => format!(" {sign} "),
        }
    }

    fn operator(&self, word: &str) -> String {
        word.into()
    }

    fn raised(&self, base: &str, mark: &str) -> String {
        match mark {
            "T" => format!("{base}\u{1d40}"),
            _ => format!("{base}\u{207b}\u{b9}"),
        }
    }

    fn lowered(&self, base: &str, indices: &str) -> String {
        format!("{base}_{indices}")
    }

    fn applied(&self, function: &str, arguments: &str) -> String {
        format!("{function}({arguments})")
    }

    fn derivative(&self, of: &str, by: &[(String, usize)]) -> String {
        let power =
            |times: usize| if times > 1 { raised(&times.to_string()) } else { String::new() };
        let order = power(by.iter().map(|(_, times)| times).sum());
        let by = by.iter().map(|(by, times)| format!("\u{2202}{by}{}", power(*times)));
        format!("\u{2202}{order}{of}/{}", by.collect::<String>())
    }

    fn over(&self, above: &str, below: &str) -> String {
        format!("{above}/{below}")
    }

    fn row(&self, parts: &[String]) -> String {
        let mut text = String::new();
        for part in parts {
            let is_apart = text.is_empty() || text.ends_with(' ') || part.starts_with([' ', ',']);
            if !is_apart {
                text.push(' ');
            }
            text.push_str(part);
        }
        text
    }
}

impl Text {
    fn stem(&self, name: &Name) -> String {
        let words = match name.quantity.filter(|quantity| quantity.symbol() == name.stem) {
            Some(Quantity::NominalStress) => return "P\u{1d40}".into(),
            Some(Quantity::DivP) => "Div P",
            Some(Quantity::DivSigma) => "div \u{3c3}",
            Some(Quantity::BodyForceDensity) => "\u{3c1}\u{2080} b",
            Some(Quantity::CurrentBodyForceDensity) => "\u{3c1} b",
            _ => return self.label(&name.stem),
        };
        if name.index.is_empty() { words.into() } else { format!("({words})") }
    }

    fn label(&self, word: &str) -> String {
        let name = Name::plain(word);
        let (letters, digits) = name.split_digits();
        self.word(letters) + &lowered(digits)
    }

    fn word(&self, letters: &str) -> String {
        greek(letters).map_or_else(|| letters.into(), |letter| letter.letter.to_string())
    }
}

/// The name of a function that is written as a word; roots and powers are not.
pub(crate) fn word(function: Function) -> &'static str {
    match function {
        Function::Asin => "arcsin",
        Function::Acos => "arccos",
        Function::Atan => "arctan",
        Function::Powf => "pow",
        other => other.name(),
    }
}

/// A number that ends in five zeros or more as a mantissa and an exponent of ten.
pub(crate) fn scientific(digits: &str) -> Option<(String, String)> {
    let mantissa = digits.trim_end_matches('0');
    let zeros = digits.len() - mantissa.len();
    (zeros >= 5 && !mantissa.is_empty()).then(|| (mantissa.into(), zeros.to_string()))
}

fn raised(digits: &str) -> String {
    const RAISED: [char; 10] = [
        '\u{2070}', '\u{b9}', '\u{b2}', '\u{b3}', '\u{2074}', '\u{2075}', '\u{2076}', '\u{2077}',
        '\u{2078}', '\u{2079}',
    ];
    digits.bytes().map(|digit| RAISED[usize::from(digit - b'0') % 10]).collect()
}

fn lowered(digits: &str) -> String {
    let digit = |digit: u8| char::from_u32(0x2080 + u32::from(digit - b'0'));
    digits.bytes().filter_map(digit).collect()
}
