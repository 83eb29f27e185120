//! Infers dimensions through every operation of a formula, on its text as parsed.
//!
//! On the tree each operation still has its place, and nothing has been cancelled or collected. The required dimension is
//! compared with each term of a formula's outermost sum. The number 0 fits any dimension, other numbers have none. The
//! dimension of a part with a reported mistake is unknown, and its uses are not reported again.
//!
//! | rule | |
//! |---|---|
//! | a + b, a - b, hypot(a, b), atan2(a, b) | one dimension; an angle has none |
//! | a^n, sqrt, cbrt | exponents times the number n |
//! | a^b with b not a number | both without dimension |
//! | every other function | argument without dimension |

use std::collections::BTreeMap;

use super::dimension::{Dimension, bits};
use super::message;
use crate::diagnostic::Diagnostic;
use crate::source::Span;
use crate::syntax::{Ast, NodeKind, Operator};
use dashu_ratio::RBig as Rational;

/// The longest number that is tracked, so that no formula takes long.
const MAX_BITS: usize = 4096;

/// The largest exponent that is applied to a number; larger ones are applied to dimensions only.
const MAX_EXPONENT: isize = 64;

/// The dimension and the number of a value, as far as they are known.
#[derive(Clone, Debug, PartialEq)]
pub struct Measure {
    /// The dimension; `None` for the number 0, which fits any.
    pub dimension: Option<Dimension>,
    /// The value, if it is a rational number.
    pub number: Option<Rational>,
}

impl Measure {
    /// A value of this dimension.
    pub fn of(dimension: Dimension) -> Self {
        Measure { dimension: Some(dimension), number: None }
    }

    /// A number.
    pub fn number(number: Rational) -> Self {
        let dimension = if number.is_zero() { None } else { Some(Dimension::NONE) };
        Measure { dimension, number: Some(number) }
    }

    fn is_zero(&self) -> bool {
        self.dimension.is_none()
    }

    /// Whether the value fits where this dimension is expected.
    pub fn fits(&self, expected: &Dimension) -> bool {
        self.dimension.as_ref().is_none_or(|dimension| dimension == expected)
    }
}

/// The required dimension of a formula, and the message for a mistake.
#[derive(Clone, Debug)]
pub struct ExpectedDimension<'a> {
    /// The dimension.
    pub dimension: Dimension,
    /// The mistake in one sentence, such as "the displacement must be a length".
    pub message: String,
    /// The consequence of the mistake, if any.
    pub consequence: Option<&'a str>,
}

/// The names that formulas may use, with their dimensions.
#[derive(Clone, Debug, Default)]
pub struct Formulas {
    names: BTreeMap<String, Measure>,
}

impl Formulas {
    /// Defines a name; `None` if a mistake in its definition has been reported.
    pub fn define(&mut self, name: &str, measure: Option<Measure>) {
        match measure {
            Some(measure) => self.names.insert(name.into(), measure),
            None => self.names.remove(name),
        };
    }

    /// The dimension and the number of a name, if they are known.
    pub fn get(&self, name: &str) -> Option<&Measure> {
        self.names.get(name)
    }

    /// Infers the dimension of a formula. Reports the operations that units forbid; the result is then `None`, as for an
    /// unknown name.
    pub fn infer(&self, ast: &Ast, diagnostics: &mut Vec<Diagnostic>) -> Option<Measure> {
        let none = vec![false; ast.nodes.len()];
        self.measures(ast, &none, diagnostics).pop().flatten()
    }

    /// Checks that a formula has the required dimension. Each term of a sum is checked on its own, so that the message can name
    /// the term.
    pub fn expect(
        &self,
        ast: &Ast,
        expected: &ExpectedDimension<'_>,
        diagnostics: &mut Vec<Diagnostic>,
    ) {
        let sums = outer_sums(ast);
        let measures = self.measures(ast, &sums, diagnostics);
        for (term, measure) in measures.iter().enumerate() {
            // Operations have consumed their operands: only the terms remain.
            let Some(measure) = measure else { continue };
            if !measure.fits(&expected.dimension) {
                diagnostics.push(message::term(self, ast, term, measure, expected));
            }
        }
    }

    /// The measures of the nodes that are no operand of an inferred operation. Sums in `outer` are not inferred.
    fn measures(
        &self,
        ast: &Ast,
        outer: &[bool],
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Vec<Option<Measure>> {
        let mut inference = Inference { names: self, ast, values: Vec::new(), diagnostics };
        for (index, node) in ast.nodes.iter().enumerate() {
            let measure = if outer[index] { None } else { inference.node(&node.kind) };
            inference.values.push(measure);
        }
        inference.values
    }
}

/// The sums and changes of sign whose operands are the terms of a formula.
fn outer_sums(ast: &Ast) -> Vec<bool> {
    let mut outer = vec![false; ast.nodes.len()];
    let mut waiting: Vec<usize> = ast.nodes.len().checked_sub(1).into_iter().collect();
    while let Some(index) = waiting.pop() {
        match ast.nodes[index].kind {
            NodeKind::Negate(operand) => waiting.push(operand),
            NodeKind::Binary(Operator::Add | Operator::Subtract, left, right) => {
                waiting.extend([left, right]);
            }
            _ => continue,
        }
        outer[index] = true;
    }
    outer
}

struct Inference<'a> {
    names: &'a Formulas,
    ast: &'a Ast,
    /// The measures of the nodes so far; an operation consumes those that are its operands.
    values: Vec<Option<Measure>>,
    diagnostics: &'a mut Vec<Diagnostic>,
}

impl Inference<'_> {
    fn node(&mut self, kind: &NodeKind) -> Option<Measure> {
        match kind {
            NodeKind::Number(number) => Some(Measure::number(number.clone())),
            NodeKind::Name(name) => self.names.get(name).cloned(),
            NodeKind::Negate(operand) => {
                let value = self.values[*operand].take()?;
                Some(Measure { number: value.number.map(|number| -number), ..value })
            }
            NodeKind::Binary(operator, left, right) => {
                let (a, b) = (self.values[*left].take(), self.values[*right].take());
                let (a, b) = (a?, b?);
                match operator {
                    Operator::Add => self.sum(a, b, *right, |a, b| a + b),
                    Operator::Subtract => self.sum(a, b, *right, |a, b| a - b),
                    Operator::Multiply => product(a, b),
                    Operator::Divide => quotient(a, b),
                    Operator::Power => self.power(a, b, [*left, *right]),
                }
            }
            NodeKind::Call { name, arguments } => self.call(&name.value, arguments),
        }
    }

    fn span(&self, node: usize) -> Span {
        self.ast.nodes[node].span
    }

    fn sum(
        &mut self,
        a: Measure,
        b: Measure,
        right: usize,
        operation: impl Fn(&Rational, &Rational) -> Rational,
    ) -> Option<Measure> {
        let number = match (&a.number, &b.number) {
            (Some(a), Some(b)) => Some(operation(a, b)),
            _ => None,
        };
        match (a.dimension, b.dimension) {
            _ if number.is_some() => bounded(number?),
            (Some(a), Some(b)) if a != b => {
                let diagnostic = message::sum(self.names, self.ast, right, [&a, &b]);
                self.diagnostics.push(diagnostic);
                None
            }
            (a, b) => Some(Measure { dimension: a.or(b), number: None }),
        }
    }

    fn power(&mut self, base: Measure, exponent: Measure, places: [usize; 2]) -> Option<Measure> {
        let Some(number) = &exponent.number else {
            return self.variable_power(&base, &exponent, places);
        };
        if let Some(base) = &base.number {
            return number_power(base, number);
        }
        match base.dimension {
            Some(dimension) => dimension.power(number).map(Measure::of),
            // 0^0 is 1 for a 0 of any dimension.
            None if number.is_zero() => Some(Measure::of(Dimension::NONE)),
            None => Some(base),
        }
    }

    fn variable_power(
        &mut self,
        base: &Measure,
        exponent: &Measure,
        [left, right]: [usize; 2],
    ) -> Option<Measure> {
        let mut complete = true;
        if !exponent.fits(&Dimension::NONE) {
            let diagnostic = message::pure(
                self.names,
                self.ast,
                right,
                exponent,
                "an exponent must be a number without unit",
            );
            self.diagnostics.push(diagnostic);
            complete = false;
        }
        if !base.fits(&Dimension::NONE) {
            let diagnostic = message::pure(
                self.names,
                self.ast,
                left,
                base,
                "the base of a variable exponent must be a number without unit",
            );
            self.diagnostics.push(diagnostic);
            complete = false;
        }
        complete.then(|| Measure::of(Dimension::NONE))
    }

    fn call(&mut self, name: &str, arguments: &[usize]) -> Option<Measure> {
        let values: Vec<_> = arguments.iter().map(|index| self.values[*index].take()).collect();
        let values: Vec<Measure> = values.into_iter().collect::<Option<_>>()?;
        match (name, values.as_slice()) {
            ("sqrt", [value]) => root(value, 2),
            ("cbrt", [value]) => root(value, 3),
            ("hypot" | "atan2", [a, b]) => self.pair(name, [a, b], arguments[1]),
            ("sqrt" | "cbrt" | "hypot" | "atan2", _) => None,
            (_, [value]) => self.pure_argument(name, value, arguments[0]),
            _ => None,
        }
    }

    /// A function of two values of one dimension.
    fn pair(&mut self, name: &str, [a, b]: [&Measure; 2], second: usize) -> Option<Measure> {
        if let (Some(a), Some(b)) = (&a.dimension, &b.dimension)
            && a != b
        {
            let diagnostic = message::pair(name, self.span(second), [a, b]);
            self.diagnostics.push(diagnostic);
            return None;
        }
        let common = if a.is_zero() { &b.dimension } else { &a.dimension };
        let dimension = if name == "hypot" { common.clone() } else { Some(Dimension::NONE) };
        Some(Measure { dimension, number: None })
    }

    fn pure_argument(&mut self, name: &str, value: &Measure, place: usize) -> Option<Measure> {
        if !crate::language::FUNCTIONS.contains(&name) {
            // The name is no function: resolving it reports that.
            return None;
        }
        if value.fits(&Dimension::NONE) {
            return Some(Measure::of(Dimension::NONE));
        }
        let what = format!("the argument of `{name}` must be a number without unit");
        let diagnostic = message::pure(self.names, self.ast, place, value, &what);
        self.diagnostics.push(diagnostic);
        None
    }
}

/// A number, unless it is too long to be tracked.
fn bounded(number: Rational) -> Option<Measure> {
    (bits(&number) <= MAX_BITS).then(|| Measure::number(number))
}

fn product(a: Measure, b: Measure) -> Option<Measure> {
    match (&a.dimension, &b.dimension) {
        (None, _) => Some(a),
        (_, None) => Some(b),
        (Some(left), Some(right)) => match (&a.number, &b.number) {
            (Some(a), Some(b)) => bounded(a * b),
            _ => left.times(right).map(Measure::of),
        },
    }
}

fn quotient(a: Measure, b: Measure) -> Option<Measure> {
    match (&a.dimension, &b.dimension) {
        // The evaluation reports division by zero.
        (_, None) => None,
        (None, _) => Some(a),
        (Some(left), Some(right)) => match (&a.number, &b.number) {
            (Some(a), Some(b)) => bounded(a / b),
            _ => left.over(right).map(Measure::of),
        },
    }
}

fn number_power(base: &Rational, exponent: &Rational) -> Option<Measure> {
    if exponent.is_zero() {
        return Some(Measure::number(Rational::ONE));
    }
    if base.is_zero() {
        let defined = *exponent > Rational::ZERO;
        return defined.then(|| Measure::number(Rational::ZERO));
    }
    let small = isize::try_from(exponent.numerator().clone()).ok();
    let small = small.filter(|size| exponent.is_int() && size.abs() <= MAX_EXPONENT);
    match small {
        Some(size) if bits(base) <= MAX_BITS / 64 => bounded(base.pow(size)),
        // A number of any value; it is no longer tracked as an exponent.
        _ => Some(Measure::of(Dimension::NONE)),
    }
}

fn root(value: &Measure, degree: u8) -> Option<Measure> {
    let exponent = Rational::from_parts(1.into(), degree.into());
    match &value.dimension {
        Some(dimension) => dimension.power(&exponent).map(Measure::of),
        None => Some(value.clone()),
    }
}
