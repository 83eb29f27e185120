//! Parses the text of a unit to its dimension.

use super::dimension::Dimension;
use super::known::{self, Size};
use crate::diagnostic::{Diagnostic, quoted};
use crate::formula::Formula;
use crate::source::{Sources, Span, Spanned};
use crate::syntax::{self, Ast, NodeKind, Operator};
use dashu_ratio::RBig as Rational;

/// A unit such as `kg/m^3`: products, quotients and powers of symbols.
#[derive(Clone, Debug)]
pub struct Unit {
    /// The dimension of the unit.
    pub dimension: Dimension,
    /// The symbols in it, in the order of the text.
    pub symbols: Vec<Symbol>,
}

/// One symbol in a unit, such as `kg`.
#[derive(Clone, Debug)]
pub struct Symbol {
    /// The symbol, and its place.
    pub symbol: Spanned<String>,
    /// The dimension of the symbol.
    pub dimension: Dimension,
    /// The size of the symbol, relative to the SI unit.
    pub size: Size,
}

/// A part of a unit.
#[derive(Clone)]
enum Part {
    Dimension(Box<Dimension>),
    Number(Rational),
}

impl Unit {
    /// Reads the unit in a string of a file. Every mistake is reported; the unit is then `None`.
    pub fn parse(
        sources: &Sources,
        text: &Spanned<String>,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Option<Unit> {
        let raw = sources.slice(text.span);
        Self::of(&Formula::from_string(raw, &text.value, text.span), diagnostics)
    }

    /// The unit of a plain text, if it is one.
    pub fn known(text: &str) -> Option<Unit> {
        let mut sources = Sources::default();
        let source = sources.add("unit", text);
        let formula = Formula::plain(text, sources.span(source, 0, text.len()));
        Self::of(&formula, &mut Vec::new())
    }

    fn of(formula: &Formula, diagnostics: &mut Vec<Diagnostic>) -> Option<Unit> {
        if formula.text.trim().is_empty() {
            let label = "a number without unit has the unit `1`";
            diagnostics.push(Diagnostic::error(formula.span, "this unit is empty").label(label));
            return None;
        }
        let reported = diagnostics.len();
        let unit = syntax::parse(formula, diagnostics)
            .and_then(|ast| Reader { ast: &ast, diagnostics }.unit());
        for diagnostic in &mut diagnostics[reported..] {
            if diagnostic.help.is_empty() {
                diagnostic.help.push("a unit is such as `kg/m^3`, `N*m`, `s^-1` or `1`".into());
            }
        }
        unit
    }
}

struct Reader<'a> {
    ast: &'a Ast,
    diagnostics: &'a mut Vec<Diagnostic>,
}

impl Reader<'_> {
    fn unit(&mut self) -> Option<Unit> {
        let mut parts = Vec::<Option<Part>>::with_capacity(self.ast.nodes.len());
        let mut symbols = Vec::new();
        for node in &self.ast.nodes {
            let part = match &node.kind {
                NodeKind::Number(number) => Some(Part::Number(number.clone())),
                NodeKind::Name(name) => self.symbol(name, node.span, &mut symbols),
                NodeKind::Negate(operand) => match parts[*operand].take() {
                    Some(Part::Number(number)) => Some(Part::Number(-number)),
                    Some(_) => self.refuse(node.span, "a unit has no sign"),
                    None => None,
                },
                NodeKind::Binary(operator, left, right) => {
                    let (a, b) = (parts[*left].take(), parts[*right].take());
                    let places = [*left, *right].map(|index| self.ast.nodes[index].span);
                    match a.zip(b) {
                        Some((a, b)) => self.binary(*operator, a, b, places),
                        None => None,
                    }
                }
                NodeKind::Call { name, .. } => self.refuse(name.span, "a unit has no functions"),
            };
            parts.push(part);
        }
        let root = self.ast.nodes.last()?;
        let dimension = self.dimension(parts.pop()??, root.span)?;
        Some(Unit { dimension, symbols })
    }

    fn refuse(&mut self, span: Span, message: &str) -> Option<Part> {
        let label = "expected symbols, `*`, `/` and `^`";
        self.diagnostics.push(Diagnostic::error(span, message).label(label));
        None
    }

    fn symbol(&mut self, name: &str, span: Span, symbols: &mut Vec<Symbol>) -> Option<Part> {
        let Some((dimension, size)) = known::find(name) else {
            let message = format!("unknown unit {}", quoted(name));
            self.diagnostics.push(
                Diagnostic::error(span, message)
                    .label("not a unit of measurement")
                    .help(known::advice(name)),
            );
            return None;
        };
        let symbol = Spanned { value: name.to_string(), span };
        symbols.push(Symbol { symbol, dimension: dimension.clone(), size });
        Some(Part::Dimension(Box::new(dimension)))
    }

    fn binary(
        &mut self,
        operator: Operator,
        a: Part,
        b: Part,
        [left, right]: [Span; 2],
    ) -> Option<Part> {
        match operator {
            Operator::Add | Operator::Subtract => {
                self.refuse(right, "a unit is a product, not a sum")
            }
            Operator::Power => self.power(a, b, [left, right]),
            Operator::Multiply | Operator::Divide => {
                let times = operator == Operator::Multiply;
                if let (Part::Number(a), Part::Number(b)) = (&a, &b) {
                    return self.quotient(a, b, times, right);
                }
                let (a, b) = (self.dimension(a, left)?, self.dimension(b, right)?);
                let product = if times { a.times(&b) } else { a.over(&b) };
                self.bounded(product, right)
            }
        }
    }

    /// Arithmetic in an exponent such as `(1/2)`.
    fn quotient(&mut self, a: &Rational, b: &Rational, times: bool, span: Span) -> Option<Part> {
        let short = [a, b].iter().all(|number| super::dimension::bits(number) <= 64);
        match times {
            _ if !short || (!times && b.is_zero()) => self.refuse(span, "a strange number"),
            true => Some(Part::Number(a * b)),
            false => Some(Part::Number(a / b)),
        }
    }

    fn power(&mut self, a: Part, b: Part, [left, right]: [Span; 2]) -> Option<Part> {
        let Part::Number(exponent) = b else {
            return self.refuse(right, "the exponent of a unit is a number");
        };
        let dimension = self.dimension(a, left)?;
        self.bounded(dimension.power(&exponent), right)
    }

    fn bounded(&mut self, dimension: Option<Dimension>, span: Span) -> Option<Part> {
        match dimension {
            Some(dimension) => Some(Part::Dimension(Box::new(dimension))),
            None => self.refuse(span, "the exponent of a unit is too long"),
        }
    }

    /// The dimension of a part that is a factor of a unit: a symbol, or the number 1.
    fn dimension(&mut self, part: Part, span: Span) -> Option<Dimension> {
        match part {
            Part::Dimension(dimension) => Some(*dimension),
            Part::Number(number) if number.is_one() => Some(Dimension::NONE),
            Part::Number(number) => {
                let message = format!("a unit has no number such as `{number}` in it");
                self.diagnostics.push(
                    Diagnostic::error(span, message)
                        .label("only the number 1 is allowed here")
                        .help("values are not converted: put the factor into the value"),
                );
                None
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<String, Vec<String>> {
        let raw = format!("\"{text}\"");
        let mut sources = Sources::default();
        let id = sources.add("x.toml", raw.as_str());
        let value = Spanned { value: text.to_string(), span: sources.span(id, 0, raw.len()) };
        let mut diagnostics = Vec::new();
        let unit = Unit::parse(&sources, &value, &mut diagnostics);
        match unit.filter(|_| diagnostics.is_empty()) {
            Some(unit) => Ok(unit.dimension.to_string()),
            None => Err(diagnostics
                .iter()
                .map(|found| format!("{}: {}", sources.slice(found.span), found.message))
                .collect()),
        }
    }

    #[test]
    fn units_have_dimensions() {
        for (text, dimension) in [
            ("1", "1"),
            ("rad/s", "1/s"),
            ("kg/m^3", "kg/m^3"),
            ("tonne/mm^3", "kg/m^3"),
            ("N*mm^-2", "Pa"),
            ("kg/(m*s^2)", "Pa"),
            ("MPa*m^(1/2)", "kg*m^(-1/2)*s^-2"),
            ("1/s^2", "s^-2"),
            ("J/(kg*K)", "m^2*s^-2*K^-1"),
        ] {
            assert_eq!(read(text), Ok(dimension.into()), "{text}");
        }
    }

    #[test]
    fn what_is_no_unit_is_refused_at_its_place() {
        for (text, message) in [
            ("kg/metre^3", "metre: unknown unit `metre`"),
            ("10*m", "10: a unit has no number such as `10` in it"),
            ("m + s", "s: a unit is a product, not a sum"),
            ("-m", "-m: a unit has no sign"),
            ("m^s", "s: the exponent of a unit is a number"),
            ("m^(1/0)", "0: a strange number"),
            ("sqrt(m)", "sqrt: a unit has no functions"),
            ("2", "2: a unit has no number such as `2` in it"),
        ] {
            assert_eq!(read(text), Err(vec![message.into()]), "{text}");
        }
    }

    #[test]
    fn every_quantity_has_a_unit() {
        for quantity in crate::quantity::Quantity::ALL {
            assert!(Unit::known(quantity.unit()).is_some(), "{}", quantity.name());
        }
        assert!(Unit::known("furlong").is_none());
    }

    #[test]
    fn every_unknown_symbol_is_named() {
        let messages = read("foo*m/quux").expect_err("two unknown units");
        assert_eq!(messages.len(), 2);
    }
}
