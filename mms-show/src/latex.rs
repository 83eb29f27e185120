//! LaTeX: a small document of its own, which needs only amsmath, or a fragment to be put into one.

use super::document::{Document, Line};
use super::language::signed;
use super::name::{Along, Name, greek};
use super::page::{Block, blocks, derivation, left};
use super::relation::Setting;
use super::text::{scientific, word};
use super::walk::{Exponent, Notation};
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::Function;
use mms_symbolic::sorted::SortedMap;

const HEAD: &str = "\\documentclass{article}
\\usepackage[margin=20mm]{geometry}
\\usepackage{amsmath}
\\allowdisplaybreaks
\\begin{document}
\\raggedright
";

/// The whole derivation as a document.
pub fn page(document: &Document) -> String {
    format!("{HEAD}{}\\end{{document}}\n", set(document, blocks(document)))
}

/// The derivation from u on, without a preamble, to be put into a document.
pub fn fragment(document: &Document) -> String {
    set(document, derivation(document))
}

fn set(document: &Document, blocks: Vec<Block<'_>>) -> String {
    let latex = Latex::of(document);
    let mut text = String::new();
    for block in blocks {
        match block {
            Block::Title(title) => {
                text.push_str(&format!("\\section*{{{}}}\n", escape(&title)));
            }
            Block::Note(note) => text.push_str(&format!("\\noindent {}\\par\n", escape(&note))),
            Block::Heading { name, relation, note, .. } => {
                if !name.is_empty() {
                    text.push_str(&format!("\\subsection*{{{}}}\n", escape(name)));
                }
                if let Some(note) = note {
                    text.push_str(&format!("\\noindent {}\n", escape(&note)));
                }
                if let Some(parts) = relation {
                    text.push_str(&format!("\\[{}\\]\n", latex.relation(&parts)));
                }
            }
            Block::Where => text.push_str("\\noindent where\n"),
            Block::Lines { lines, .. } => text.push_str(&align(document, &lines, &latex)),
        }
    }
    text
}

fn align(document: &Document, lines: &[Line], latex: &Latex<'_>) -> String {
    let lines = lines.iter().map(|line| {
        let value = document.formula(line.value, latex);
        format!("  {} &= {value}", left(line, latex, " = "))
    });
    let lines: Vec<_> = lines.collect();
    format!("\\begin{{align*}}\n{}\n\\end{{align*}}\n", lines.join(" \\\\\n"))
}

/// Formulas as LaTeX sets them, with amsmath.
pub struct Latex<'a> {
    /// The symbols that parameters declare, by their names.
    symbols: &'a SortedMap<String, String>,
}

impl<'a> Latex<'a> {
    /// The notation of a document, with the symbols of its parameters.
    pub fn of(document: &'a Document) -> Self {
        Latex { symbols: &document.symbols }
    }
}

impl Notation for Latex<'_> {
    fn whole(&self, digits: &str) -> String {
        match scientific(digits) {
            Some((mantissa, exponent)) if mantissa == "1" => format!("10^{{{exponent}}}"),
            Some((mantissa, exponent)) => format!("{mantissa} \\cdot 10^{{{exponent}}}"),
            None => digits.into(),
        }
    }

    fn pi(&self) -> String {
        "\\pi".into()
    }

    fn name(&self, name: &Name) -> String {
        if name.is_dotted() {
            let dots = if name.along.len() == 1 { "dot" } else { "ddot" };
            return format!("\\{dots}{{{}}}", name.stem);
        }
        if let Some(symbol) = self.symbols.get(&name.identifier()) {
            return symbol.clone();
        }
        let (stem, digits) = stem(name);
        let along: String = name.along.iter().map(|along| label(*along)).collect();
        let comma = if along.is_empty() { "" } else { "," };
        // An index beside digits of the stem, as in k_{1,X}, needs no further mark.
        let below = format!("{digits}{}{comma}{along}", name.index);
        if below.is_empty() { stem } else { format!("{stem}_{{{below}}}") }
    }

    fn sum(&self, terms: &[(bool, String)]) -> String {
        signed(terms, "-")
    }

    fn product(&self, factors: &[String]) -> String {
        factors.join(" \\, ")
    }

    fn fraction(&self, above: &str, below: &str) -> String {
        format!("\\frac{{{above}}}{{{below}}}")
    }

    fn has_bars(&self) -> bool {
        true
    }

    fn power(&self, base: &str, exponent: &Exponent) -> String {
        let exponent = match exponent {
            Exponent::Number(number) => number.to_string(),
            Exponent::Formula { text, .. } => text.clone(),
        };
        // The braces keep what has a superscript of its own from being read as two.
        format!("{{{base}}}^{{{exponent}}}")
    }

    fn root(&self, degree: u8, radicand: &str, _: bool) -> String {
        match degree {
            2 => format!("\\sqrt{{{radicand}}}"),
            _ => format!("\\sqrt[3]{{{radicand}}}"),
        }
    }

    fn call(&self, function: Function, arguments: &[String], power: Option<&str>) -> String {
        let power = power.map(|power| format!("^{{{power}}}")).unwrap_or_default();
        let inside = self.parentheses(&arguments.join(", "));
        format!("{}{power}{inside}", command(function))
    }

    fn has_powers_of_functions(&self) -> bool {
        true
    }

    fn parentheses(&self, inside: &str) -> String {
        format!("\\left({inside}\\right)")
    }
}

impl Setting for Latex<'_> {
    fn letter(&self, word: &str, is_bold: bool) -> String {
        let letter = self.name(&Name::plain(word));
        if is_bold { format!("\\boldsymbol{{{letter}}}") } else { letter }
    }

    fn sign(&self, sign: &str) -> String {
        sign.into()
    }

    fn operator(&self, word: &str) -> String {
        match word {
            "det" => "\\det".into(),
            _ => format!("\\operatorname{{{word}}}"),
        }
    }

    fn raised(&self, base: &str, mark: &str) -> String {
        match mark {
            "T" => format!("{base}^{{\\mathsf{{T}}}}"),
            _ => format!("{base}^{{{mark}}}"),
        }
    }

    fn lowered(&self, base: &str, indices: &str) -> String {
        format!("{base}_{{{indices}}}")
    }

    fn applied(&self, function: &str, arguments: &str) -> String {
        format!("{function}({arguments})")
    }

    fn derivative(&self, of: &str, by: &[(String, usize)]) -> String {
        let power = |times: usize| if times > 1 { format!("^{{{times}}}") } else { String::new() };
        let order = power(by.iter().map(|(_, times)| times).sum());
        let by = by.iter().map(|(by, times)| format!("\\partial {by}{}", power(*times)));
        format!("\\frac{{\\partial{order} {of}}}{{{}}}", by.collect::<String>())
    }

    fn over(&self, above: &str, below: &str) -> String {
        self.fraction(above, below)
    }

    fn row(&self, parts: &[String]) -> String {
        parts.join(" ")
    }
}

/// The stem and the digits that belong below it.
fn stem(name: &Name) -> (String, &str) {
    match name.quantity.filter(|quantity| quantity.symbol() == name.stem) {
        Some(Quantity::DivP) => return ("(\\operatorname{Div} P)".into(), ""),
        Some(Quantity::DivSigma) => return ("(\\operatorname{div} \\sigma)".into(), ""),
        Some(Quantity::NominalStress) => return ("P^{\\mathsf{T}}".into(), ""),
        Some(Quantity::BodyForceDensity) => return ("(\\rho_0 b)".into(), ""),
        Some(Quantity::CurrentBodyForceDensity) => return ("(\\rho b)".into(), ""),
        _ => {}
    }
    let (letters, digits) = name.split_digits();
    if let Some(letter) = greek(letters) {
        return (letter.latex.into(), digits);
    }
    match letters.len() {
        1 if letters != "_" => (letters.into(), digits),
        _ => (format!("\\mathrm{{{}}}", letters.replace('_', "\\_")), digits),
    }
}

fn label(along: Along) -> &'static str {
    match along {
        Along::Coordinate(_) | Along::Meridian(_) | Along::Time => along.label(),
        Along::Invariant(_) => match along.label() {
            "I1" => "I_1",
            "I2" => "I_2",
            "I4" => "I_4",
            "eps_trace" => r"\mathrm{tr}\,\varepsilon",
            "eps_squared" => r"\varepsilon:\varepsilon",
            other => other,
        },
    }
}

fn command(function: Function) -> String {
    match function {
        Function::Exp
        | Function::Ln
        | Function::Sin
        | Function::Cos
        | Function::Tan
        | Function::Sinh
        | Function::Cosh
        | Function::Tanh
        | Function::Asin
        | Function::Acos
        | Function::Atan => format!("\\{}", word(function)),
        other => format!("\\operatorname{{{}}}", word(other).replace('_', "\\_")),
    }
}

/// A text that is no formula, with what LaTeX would interpret made harmless.
pub(super) fn escape(text: &str) -> String {
    let mut escaped = String::new();
    for character in text.chars() {
        match character {
            '\\' => escaped.push_str("\\textbackslash{}"),
            '~' => escaped.push_str("\\textasciitilde{}"),
            '^' => escaped.push_str("\\textasciicircum{}"),
            '{' | '}' | '#' | '$' | '%' | '&' | '_' => {
                escaped.push('\\');
                escaped.push(character);
            }
            other => escaped.push(other),
        }
    }
    escaped
}
