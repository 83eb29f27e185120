//! Presentation MathML in a page of its own, which browsers show without a script. The page is
//! well-formed XML.

use super::document::Document;
use super::name::{Name, greek};
use super::page::{Block, blocks, left, title};
use super::relation::Setting;
use super::text::{scientific, word};
use super::walk::{Exponent, Notation};
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::Function;

/// The whole derivation as a page.
pub fn page(document: &Document) -> String {
    let title = escape(&title(document));
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\" xmlns=\"http://www.w3.org/1999/xhtml\">\n\
         <head><meta charset=\"utf-8\"/><title>{title}</title></head>\n<body>\n\
         <h1>{title}</h1>\n{}</body>\n</html>\n",
        part(document, 2)
    )
}

/// The page without its title, for a page of the caller's: its headings are `h2` for a level of 2, and so on.
pub fn part(document: &Document, level: u8) -> String {
    let mut text = String::new();
    for block in blocks(document) {
        match block {
            Block::Title(..) => {}
            Block::Note(note) => text.push_str(&format!("<p>{}</p>\n", escape(&note))),
            Block::Heading { name, relation, note, .. } => {
                text.push_str(&format!("<h{level}>{}</h{level}>\n", escape(name)));
                if let Some(note) = note {
                    text.push_str(&format!("<p>{}</p>\n", escape(&note)));
                }
                if let Some(parts) = relation {
                    text.push_str(&display(&MathMl.relation(&parts)));
                }
            }
            Block::Where => text.push_str("<p>where</p>\n"),
            Block::Lines { lines, .. } => {
                for line in lines.iter() {
                    let value = document.formula(line.value, &MathMl);
                    let left = left(line, &MathMl, "<mo>=</mo>");
                    text.push_str(&display(&format!("{left}<mo>=</mo>{value}")));
                }
            }
        }
    }
    text
}

fn display(formula: &str) -> String {
    let namespace = "http://www.w3.org/1998/Math/MathML";
    format!("<math display=\"block\" xmlns=\"{namespace}\">{formula}</math>\n")
}

/// Formulas as MathML elements.
pub struct MathMl;

impl Notation for MathMl {
    fn whole(&self, digits: &str) -> String {
        match scientific(digits) {
            Some((mantissa, exponent)) if mantissa == "1" => {
                superscript("<mn>10</mn>", &number(&exponent))
            }
            Some((mantissa, exponent)) => {
                let power = superscript("<mn>10</mn>", &number(&exponent));
                row(&format!("{}<mo>&#xD7;</mo>{power}", number(&mantissa)))
            }
            None => number(digits),
        }
    }

    fn pi(&self) -> String {
        identifier("\u{3c0}")
    }

    fn name(&self, name: &Name) -> String {
        if name.is_dotted() {
            let dots = if name.along.len() == 1 { "\u{2d9}" } else { "\u{a8}" };
            let stem = identifier(&name.stem);
            return format!("<mover accent=\"true\">{stem}<mo>{dots}</mo></mover>");
        }
        let (stem, digits) = stem(name);
        let mut below = String::new();
        if !digits.is_empty() || !name.index.is_empty() {
            below.push_str(&number(&format!("{digits}{}", name.index)));
        }
        if !name.along.is_empty() {
            below.push_str("<mo>,</mo>");
            name.along.iter().for_each(|along| below.push_str(&identifier(along.label())));
        }
        match below.is_empty() {
            true => stem,
            false => format!("<msub>{stem}{}</msub>", row(&below)),
        }
    }

    fn sum(&self, terms: &[(bool, String)]) -> String {
        let mut inside = String::new();
        for (index, (is_negative, term)) in terms.iter().enumerate() {
            match (index, is_negative) {
                (0, false) => {}
                (_, true) => inside.push_str("<mo>\u{2212}</mo>"),
                (_, false) => inside.push_str("<mo>+</mo>"),
            }
            inside.push_str(term);
        }
        row(&inside)
    }

    fn product(&self, factors: &[String]) -> String {
        match factors {
            [single] => single.clone(),
            // A thin blank separates long names; screen readers read the invisible sign aloud.
            several => row(&several.join("<mo>&#x2062;</mo><mspace width=\"0.15em\"/>")),
        }
    }

    fn fraction(&self, above: &str, below: &str) -> String {
        format!("<mfrac>{above}{below}</mfrac>")
    }

    fn has_bars(&self) -> bool {
        true
    }

    fn power(&self, base: &str, exponent: &Exponent) -> String {
        match exponent {
            Exponent::Number(value) if value.is_int() => {
                superscript(base, &number(&value.to_string()))
            }
            Exponent::Number(value) => {
                let (above, below) = value.clone().into_parts();
                let (above, below) = (number(&above.to_string()), number(&below.to_string()));
                superscript(base, &row(&format!("{above}<mo>/</mo>{below}")))
            }
            Exponent::Formula { text, .. } => superscript(base, text),
        }
    }

    fn root(&self, degree: u8, radicand: &str, _: bool) -> String {
        match degree {
            2 => format!("<msqrt>{radicand}</msqrt>"),
            _ => format!("<mroot>{radicand}<mn>3</mn></mroot>"),
        }
    }

    fn call(&self, function: Function, arguments: &[String], power: Option<&str>) -> String {
        let mut name = identifier(word(function));
        if let Some(power) = power {
            name = superscript(&name, &number(power));
        }
        let inside = self.parentheses(&arguments.join("<mo>,</mo>"));
        row(&format!("{name}<mo>&#x2061;</mo>{inside}"))
    }

    fn has_powers_of_functions(&self) -> bool {
        true
    }

    fn parentheses(&self, inside: &str) -> String {
        row(&format!("<mo>(</mo>{inside}<mo>)</mo>"))
    }
}

impl Setting for MathMl {
    fn letter(&self, word: &str, is_bold: bool) -> String {
        let name = Name::plain(word);
        match is_bold {
            false if word.bytes().all(|byte| byte.is_ascii_digit()) => number(word),
            true => {
                let letter =
                    greek(word).map_or_else(|| word.into(), |word| word.letter.to_string());
                format!("<mi style=\"font-weight: bold\">{}</mi>", escape(&letter))
            }
            false => self.name(&name),
        }
    }

    fn sign(&self, sign: &str) -> String {
        let sign = if sign == "-" { "\u{2212}" } else { sign };
        format!("<mo>{}</mo>", escape(sign))
    }

    fn operator(&self, word: &str) -> String {
        format!("<mi>{word}</mi><mspace width=\"0.2em\"/>")
    }

    fn raised(&self, base: &str, mark: &str) -> String {
        match mark {
            "T" => superscript(base, "<mi mathvariant=\"normal\">T</mi>"),
            _ => superscript(base, "<mrow><mo>\u{2212}</mo><mn>1</mn></mrow>"),
        }
    }

    fn lowered(&self, base: &str, indices: &str) -> String {
        format!("<msub>{base}{}</msub>", identifier(indices))
    }

    fn applied(&self, function: &str, arguments: &str) -> String {
        row(&format!("{function}{}", self.parentheses(arguments)))
    }

    fn derivative(&self, of: &str, by: &[(String, usize)]) -> String {
        let curl = "<mo>\u{2202}</mo>";
        let power = |base: &str, times: usize| match times {
            1 => base.to_string(),
            _ => superscript(base, &number(&times.to_string())),
        };
        let above = power(curl, by.iter().map(|(_, times)| times).sum());
        let below = by.iter().map(|(by, times)| format!("{curl}{}", power(by, *times)));
        let below: String = below.collect();
        self.fraction(&row(&format!("{above}{of}")), &row(&below))
    }

    fn over(&self, above: &str, below: &str) -> String {
        self.fraction(above, below)
    }

    fn row(&self, parts: &[String]) -> String {
        row(&parts.concat())
    }
}

fn row(inside: &str) -> String {
    format!("<mrow>{inside}</mrow>")
}

pub(super) fn number(digits: &str) -> String {
    format!("<mn>{digits}</mn>")
}

pub(super) fn identifier(text: &str) -> String {
    format!("<mi>{}</mi>", escape(text))
}

fn superscript(base: &str, exponent: &str) -> String {
    format!("<msup>{base}{exponent}</msup>")
}

/// The stem and the digits that belong below it.
fn stem(name: &Name) -> (String, &str) {
    let inside = match name.quantity.filter(|quantity| quantity.symbol() == name.stem) {
        Some(Quantity::NominalStress) => {
            return (superscript("<mi>P</mi>", "<mi mathvariant=\"normal\">T</mi>"), "");
        }
        Some(Quantity::DivP) => Some("<mi>Div</mi><mi>P</mi>"),
        Some(Quantity::DivSigma) => Some("<mi>div</mi><mi>\u{3c3}</mi>"),
        Some(Quantity::BodyForceDensity) => {
            Some("<msub><mi>\u{3c1}</mi><mn>0</mn></msub><mi>b</mi>")
        }
        Some(Quantity::CurrentBodyForceDensity) => Some("<mi>\u{3c1}</mi><mi>b</mi>"),
        _ => None,
    };
    if let Some(inside) = inside {
        return (row(&format!("<mo>(</mo>{inside}<mo>)</mo>")), "");
    }
    let (letters, digits) = name.split_digits();
    match greek(letters) {
        Some(letter) => (identifier(&letter.letter.to_string()), digits),
        None => (identifier(letters), digits),
    }
}

/// A text with what XML would interpret made harmless.
pub fn escape(text: &str) -> String {
    let mut escaped = String::new();
    for character in text.chars() {
        match character {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            other => escaped.push(other),
        }
    }
    escaped
}
