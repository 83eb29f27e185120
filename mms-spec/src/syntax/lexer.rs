//! Reads characters as tokens.

use std::ops::Range;

use dashu_ratio::RBig;

use super::ast::Operator;
use super::number;
use crate::diagnostic::{Diagnostic, quoted};
use crate::formula::Formula;

/// The largest number of complaints about characters of one formula.
const MAX_COMPLAINTS: usize = 10;

/// A token and its place in the formula's text.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Token {
    /// The kind of the token.
    pub kind: TokenKind,
    /// The bytes of the token in the text.
    pub range: Range<usize>,
}

/// The kind of a token.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum TokenKind {
    Number(RBig),
    Name,
    Operator(Operator),
    Open,
    Close,
    Comma,
    /// The end of the text.
    End,
}

/// The tokens of a formula, the last one [`TokenKind::End`]. `None` if a character is wrong.
pub(super) fn tokens(formula: &Formula, diagnostics: &mut Vec<Diagnostic>) -> Option<Vec<Token>> {
    let mut lexer = Lexer { formula, position: 0, complaints: Vec::new() };
    let mut tokens = Vec::new();
    while lexer.complaints.len() < MAX_COMPLAINTS {
        lexer.skip_blank();
        if lexer.rest().is_empty() {
            break;
        }
        tokens.extend(lexer.token());
    }
    let end = formula.text.len();
    tokens.push(Token { kind: TokenKind::End, range: end..end });
    let is_right = lexer.complaints.is_empty();
    diagnostics.append(&mut lexer.complaints);
    is_right.then_some(tokens)
}

struct Lexer<'a> {
    formula: &'a Formula,
    position: usize,
    complaints: Vec<Diagnostic>,
}

impl<'a> Lexer<'a> {
    fn rest(&self) -> &'a str {
        &self.formula.text[self.position..]
    }

    fn skip_blank(&mut self) {
        let rest = self.rest();
        self.position += rest.len() - rest.trim_start_matches([' ', '\t', '\n', '\r']).len();
    }

    /// Reads one token; `None` if it is wrong.
    fn token(&mut self) -> Option<Token> {
        let (start, rest) = (self.position, self.rest());
        let (kind, length) = match rest.chars().next()? {
            '0'..='9' | '.' => return self.number(),
            'A'..='Z' | 'a'..='z' | '_' => (TokenKind::Name, prefix(rest, is_name)),
            '+' => (TokenKind::Operator(Operator::Add), 1),
            '-' => (TokenKind::Operator(Operator::Subtract), 1),
            '*' if rest.starts_with("**") => {
                let message = "unexpected `**`".into();
                return self.complain(2, message, "not an operator", Some("a power is `^`".into()));
            }
            '*' => (TokenKind::Operator(Operator::Multiply), 1),
            '/' => (TokenKind::Operator(Operator::Divide), 1),
            '^' => (TokenKind::Operator(Operator::Power), 1),
            '(' => (TokenKind::Open, 1),
            ')' => (TokenKind::Close, 1),
            ',' => (TokenKind::Comma, 1),
            _ => return self.unexpected(),
        };
        self.position += length;
        Some(Token { kind, range: start..self.position })
    }

    /// Reads digits, a point, digits, and an exponent with its sign.
    fn number(&mut self) -> Option<Token> {
        let (start, rest) = (self.position, self.rest());
        let mut length = prefix(rest, |character| character.is_ascii_digit() || character == '.');
        length += exponent(&rest[length..]);
        let text = &rest[..length];
        if text.matches('.').count() > 1 {
            let message = format!("{} is not a number", quoted(text));
            return self.complain(length, message, "more than one decimal point", None);
        }
        match number::exact(text) {
            Ok(value) => {
                self.position += length;
                let kind = TokenKind::Number(value);
                Some(Token { kind, range: start..self.position })
            }
            Err((message, label)) => self.complain(length, message, &label, None),
        }
    }

    /// Complains about a run of characters that no expression has.
    fn unexpected(&mut self) -> Option<Token> {
        let rest = self.rest();
        let length = prefix(rest, |character| !is_expected(character));
        let found = &rest[..length];
        let plural = if found.chars().count() == 1 { "" } else { "s" };
        let message = format!("unexpected character{plural} {}", quoted(found));
        let label = if found.chars().all(char::is_alphabetic) {
            "names are ASCII letters, digits and `_`"
        } else {
            "expected a number, a name, an operator or a parenthesis"
        };
        self.complain(length, message, label, advice(found))
    }

    fn complain(
        &mut self,
        length: usize,
        message: String,
        label: &str,
        help: Option<String>,
    ) -> Option<Token> {
        let span = self.formula.span_of(self.position..self.position + length);
        let mut diagnostic = Diagnostic::error(span, message).label(label);
        diagnostic.help.extend(help);
        self.complaints.push(diagnostic);
        self.position += length;
        None
    }
}

/// The length of the longest prefix of characters that satisfy `holds`.
fn prefix(text: &str, holds: impl Fn(char) -> bool) -> usize {
    text.find(|character| !holds(character)).unwrap_or(text.len())
}

fn is_name(character: char) -> bool {
    character.is_ascii_alphanumeric() || character == '_'
}

fn is_expected(character: char) -> bool {
    is_name(character) || " \t\r\n.+-*/^(),".contains(character)
}

/// The length of the exponent at the start of a text. In `2exp(X)` there is none.
fn exponent(text: &str) -> usize {
    if !text.starts_with(['e', 'E']) {
        return 0;
    }
    let signed = 1 + usize::from(text[1..].starts_with(['+', '-']));
    let length = signed + prefix(&text[signed..], |character| character.is_ascii_digit());
    if length == 1 && text[1..].starts_with(is_name) { 0 } else { length }
}

/// The text to write instead of characters that people type or paste into formulas.
fn advice(found: &str) -> Option<String> {
    let instead: Option<String> = found.chars().map(spelling).collect();
    if let Some(instead) = instead {
        return Some(format!("write `{instead}`"));
    }
    match found.chars().next()? {
        '=' => Some("an expression has no `=`: give names to values in [let]".into()),
        '<' | '>' | '?' | '!' | '&' | '|' => {
            Some("a field is one smooth expression, without cases".into())
        }
        '%' => Some("there is no remainder: it is not smooth".into()),
        _ => None,
    }
}

fn spelling(character: char) -> Option<&'static str> {
    Some(match character {
        '\u{b7}' | '\u{d7}' | '\u{22c5}' | '\u{2217}' => "*",
        '\u{2212}' | '\u{2013}' | '\u{2010}' => "-",
        '\u{f7}' | '\u{2215}' | '\u{2044}' => "/",
        '\u{b2}' => "^2",
        '\u{b3}' => "^3",
        '[' | '{' => "(",
        ']' | '}' => ")",
        '\u{3b1}' => "alpha",
        '\u{3b2}' => "beta",
        '\u{3b3}' => "gamma",
        '\u{3b5}' => "epsilon",
        '\u{3b8}' => "theta",
        '\u{3ba}' => "kappa",
        '\u{3bb}' => "lambda",
        '\u{3bc}' | '\u{b5}' => "mu",
        '\u{3bd}' => "nu",
        '\u{3c0}' => "pi",
        '\u{3c1}' => "rho",
        '\u{3c3}' => "sigma",
        '\u{3c9}' => "omega",
        _ => return None,
    })
}
