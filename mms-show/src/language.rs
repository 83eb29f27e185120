//! The language of field files: formulas written here can be parsed again.

use mms_symbolic::expr::Function;

use super::name::Name;
use super::walk::{Exponent, Notation};

/// Formulas as field files have them.
pub struct Language;

impl Notation for Language {
    fn whole(&self, digits: &str) -> String {
        digits.into()
    }

    fn pi(&self) -> String {
        "pi".into()
    }

    fn name(&self, name: &Name) -> String {
        name.identifier()
    }

    fn sum(&self, terms: &[(bool, String)]) -> String {
        signed(terms, "-")
    }

    fn product(&self, factors: &[String]) -> String {
        factors.join("*")
    }

    fn fraction(&self, above: &str, below: &str) -> String {
        format!("{above}/{below}")
    }

    fn has_bars(&self) -> bool {
        false
    }

    fn power(&self, base: &str, exponent: &Exponent) -> String {
        match exponent {
            Exponent::Number(number) if number.is_int() => format!("{base}^{number}"),
            Exponent::Number(number) => format!("{base}^({number})"),
            Exponent::Formula { text, is_atom: true } => format!("{base}^{text}"),
            Exponent::Formula { text, is_atom: false } => format!("{base}^({text})"),
        }
    }

    fn root(&self, degree: u8, radicand: &str, _: bool) -> String {
        match degree {
            2 => format!("sqrt({radicand})"),
            _ => format!("cbrt({radicand})"),
        }
    }

    fn call(&self, function: Function, arguments: &[String], power: Option<&str>) -> String {
        let call = format!("{}({})", function.name(), arguments.join(", "));
        match power {
            Some(power) => format!("{call}^{power}"),
            None => call,
        }
    }

    fn has_powers_of_functions(&self) -> bool {
        false
    }

    fn parentheses(&self, inside: &str) -> String {
        format!("({inside})")
    }
}

/// Terms on one line, with blanks around the signs between them.
pub(super) fn signed(terms: &[(bool, String)], minus: &str) -> String {
    let mut text = String::new();
    for (index, (is_negative, term)) in terms.iter().enumerate() {
        match (index, is_negative) {
            (0, false) => {}
            (0, true) => text.push_str(minus),
            (_, false) => text.push_str(" + "),
            (_, true) => text.push_str(&format!(" {minus} ")),
        }
        text.push_str(term);
    }
    text
}
