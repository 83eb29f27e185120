//! The messages of the dimension check.

use std::collections::BTreeSet;

use super::dimension::Dimension;
use super::infer::{ExpectedDimension, Formulas, Measure};
use crate::diagnostic::Diagnostic;
use crate::source::Span;
use crate::syntax::{Ast, NodeKind, Operator};
use dashu_ratio::RBig as Rational;

/// The largest number of names in a term that are explained one by one.
const MAX_NAMES: usize = 6;

/// A term with another dimension than the required one.
pub fn term(
    names: &Formulas,
    ast: &Ast,
    term: usize,
    found: &Measure,
    expected: &ExpectedDimension<'_>,
) -> Diagnostic {
    let found = shown(found);
    let label = format!("this is {}, expected {}", in_words(found), in_words(&expected.dimension));
    let mut diagnostic =
        Diagnostic::error(ast.nodes[term].span, expected.message.clone()).label(label);
    diagnostic.help.extend(explanation(names, ast, term));
    diagnostic.help.extend(nameless(ast, term, found, &expected.dimension));
    diagnostic.help.extend(expected.consequence.map(str::to_string));
    diagnostic
}

/// A value with a unit where a pure number is expected.
pub fn pure(
    names: &Formulas,
    ast: &Ast,
    place: usize,
    found: &Measure,
    message: &str,
) -> Diagnostic {
    let found = shown(found);
    let mut diagnostic = Diagnostic::error(ast.nodes[place].span, message)
        .label(format!("this is {}", in_words(found)));
    diagnostic.help.extend(explanation(names, ast, place));
    match nameless(ast, place, found, &Dimension::NONE) {
        Some(help) => diagnostic.help(help),
        None => diagnostic.help(format!("divide it by a value in {found}")),
    }
}

/// Two terms of a sum, of which the second is in `found[1]`.
pub fn sum(names: &Formulas, ast: &Ast, right: usize, found: [&Dimension; 2]) -> Diagnostic {
    let [left, this] = found.map(in_words);
    let mut diagnostic =
        Diagnostic::error(ast.nodes[right].span, "the terms of a sum must have one unit")
            .label(format!("this is {this}, but the term before it is {left}"));
    diagnostic.help.extend(explanation(names, ast, right));
    diagnostic.help.extend(nameless(ast, right, found[1], found[0]));
    diagnostic
}

/// The second argument of a function whose arguments have one dimension.
pub fn pair(function: &str, second: Span, found: [&Dimension; 2]) -> Diagnostic {
    let [first, this] = found.map(in_words);
    Diagnostic::error(second, format!("the arguments of `{function}` must have one unit"))
        .label(format!("this is {this}, but the first argument is {first}"))
}

/// The dimension of a value that is not the number 0.
fn shown(found: &Measure) -> &Dimension {
    const NONE: &Dimension = &Dimension::NONE;
    found.dimension.as_ref().unwrap_or(NONE)
}

/// A dimension in the middle of a sentence.
pub fn in_words(dimension: &Dimension) -> String {
    if dimension.is_none() { "a number without unit".into() } else { dimension.to_string() }
}

/// The units of the names in a part of a formula, if it is more than a name and some names have units.
fn explanation(names: &Formulas, ast: &Ast, root: usize) -> Option<String> {
    if matches!(ast.nodes[root].kind, NodeKind::Name(_)) {
        return None;
    }
    let mut seen = BTreeSet::new();
    let mut units = Vec::new();
    let mut has_unit = false;
    for node in &ast.nodes[first_node(ast, root)..=root] {
        let NodeKind::Name(name) = &node.kind else { continue };
        let Some(measure) = names.get(name).filter(|_| name != "pi") else { continue };
        if seen.insert(name) && measure.number.is_none() {
            has_unit |= !shown(measure).is_none();
            units.push(format!("`{name}` is {}", in_words(shown(measure))));
        }
    }
    (has_unit && units.len() <= MAX_NAMES).then(|| format!("here {}", units.join(", ")))
}

/// The first node of a part: its nodes are contiguous, operands first.
fn first_node(ast: &Ast, root: usize) -> usize {
    let mut first = root;
    loop {
        first = match &ast.nodes[first].kind {
            NodeKind::Negate(operand) | NodeKind::Binary(_, operand, _) => *operand,
            NodeKind::Call { arguments, .. } => match arguments.first() {
                Some(argument) => *argument,
                None => return first,
            },
            NodeKind::Number(_) | NodeKind::Name(_) => return first,
        };
    }
}

/// Advice about a number that seems to be a value with a unit: a factor of a term whose dimension differs by that unit.
fn nameless(ast: &Ast, term: usize, found: &Dimension, expected: &Dimension) -> Option<String> {
    let mut waiting = vec![(term, false)];
    while let Some((node, divides)) = waiting.pop() {
        match &ast.nodes[node].kind {
            // A whole number beside values with units is usually a plain number.
            NodeKind::Number(number) if !number.is_int() || found.is_none() => {
                let unit = if divides { found.over(expected) } else { expected.over(found) };
                return Some(format!(
                    "give `{}` a name with the unit {} under [parameters], or leave out all units",
                    digits(number),
                    unit?
                ));
            }
            NodeKind::Negate(operand) => waiting.push((*operand, divides)),
            NodeKind::Binary(Operator::Multiply, left, right) => {
                waiting.extend([(*right, divides), (*left, divides)]);
            }
            NodeKind::Binary(Operator::Divide, left, right) => {
                waiting.extend([(*right, !divides), (*left, divides)]);
            }
            _ => {}
        }
    }
    None
}

/// A number of a formula, in short digits.
fn digits(number: &Rational) -> String {
    let value = number.to_f64().value();
    if value.is_finite() && value != 0.0 { value.to_string() } else { number.to_string() }
}
