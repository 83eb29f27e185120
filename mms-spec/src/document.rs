//! Parses a TOML text to its tree, with every syntax error as a diagnostic.
//!
//! After an error TOML parses on as far as it can, and then reports consequences of the error as well. Here each slip gets one
//! message, and the tree has a list of damaged places: a reader must not complain about damaged values, or about keys that may
//! have been lost.

use std::ops::Range;

use toml::de::{DeTable, DeValue, Error};

use crate::brackets;
use crate::diagnostic::{Diagnostic, quoted};
use crate::source::{SourceId, Sources, Span};

/// The longest file that is read, in bytes.
pub const MAX_FILE: usize = 1 << 20;

/// The largest number of syntax errors in one file; further ones are noise.
const MAX_ERRORS: usize = 20;

/// A TOML file as far as it could be read.
pub(super) struct Document<'a> {
    /// The tree.
    pub root: DeTable<'a>,
    /// The places of the syntax errors.
    pub damage: Vec<Range<usize>>,
    /// Whether keys or tables of the file may be missing from the tree, or misplaced in it.
    pub incomplete: bool,
}

impl<'a> Document<'a> {
    /// Parses a text. `None` only for a text that is too long.
    pub fn parse(
        sources: &'a Sources,
        id: SourceId,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Option<Self> {
        let text = sources.get(id).text.as_str();
        if text.len() > MAX_FILE {
            let message = format!("the file has {} bytes; at most {MAX_FILE} are read", text.len());
            diagnostics.push(Diagnostic::error(sources.span(id, 0, 0), message));
            return None;
        }
        let (root, errors) = DeTable::parse_recoverable(text);
        let root = root.into_inner();
        let mut slips: Vec<Slip> = errors
            .iter()
            .take(MAX_ERRORS)
            .map(|error| Slip::new(sources, id, &root, error))
            .collect();
        slips.sort_by_key(|slip| slip.span.start);
        let incomplete =
            errors.len() > MAX_ERRORS || slips.iter().any(|slip| slip.kind == Damage::Lossy);
        let is_open = |error: &Error| {
            ["unclosed array,", "unclosed inline table,"]
                .iter()
                .any(|open| error.message().starts_with(open))
        };
        let open = errors.iter().any(is_open).then(|| brackets::unclosed(text)).flatten();
        let damaged = slips.iter().filter(|slip| !slip.is_duplicate()).map(Slip::place);
        // Values inside an open bracket are misplaced in the tree.
        let damage = damaged.chain(open.map(|open| open..text.len())).collect();
        diagnostics.extend(explained(sources, id, &slips, open));
        Some(Document { root, damage, incomplete })
    }
}

/// The extent of the damage of a syntax error.
#[derive(Clone, Copy, PartialEq)]
enum Damage {
    /// A table that exists already; its keys are kept.
    SecondTable,
    /// A key that exists already; the first one is kept.
    SecondKey,
    /// One value.
    Value,
    /// Everything after the error, to an unknown extent.
    Lossy,
}

/// A syntax error.
struct Slip {
    span: Span,
    kind: Damage,
    message: String,
}

impl Slip {
    fn new(sources: &Sources, id: SourceId, root: &DeTable<'_>, error: &Error) -> Self {
        let place = error.span().unwrap_or(0..0);
        let span = sources.span(id, place.start, place.end);
        let message = error.message().to_string();
        let kind = if message == "duplicate key" {
            let header = line_before(sources, span).trim_start().starts_with('[');
            if header { Damage::SecondTable } else { Damage::SecondKey }
        } else if is_in_value(root, &place) && !message.starts_with("invalid multi-line") {
            Damage::Value
        } else {
            // A long string without an end includes the rest of the file.
            Damage::Lossy
        };
        Slip { span, kind, message }
    }

    fn is_duplicate(&self) -> bool {
        matches!(self.kind, Damage::SecondTable | Damage::SecondKey)
    }

    fn place(&self) -> Range<usize> {
        self.span.start..self.span.end
    }
}

/// The line of a place, up to the place.
fn line_before(sources: &Sources, span: Span) -> &str {
    sources.get(span.source).text[..span.start].rsplit('\n').next().unwrap_or_default()
}

/// Whether a place touches a single value of the tree.
fn is_in_value(root: &DeTable<'_>, place: &Range<usize>) -> bool {
    let mut values: Vec<_> = root.values().collect();
    while let Some(value) = values.pop() {
        match value.get_ref() {
            DeValue::Table(table) => values.extend(table.values()),
            DeValue::Array(items) => values.extend(items.iter()),
            _ => {
                let span = value.span();
                if !span.is_empty() && span.start <= place.start && place.end <= span.end {
                    return true;
                }
            }
        }
    }
    false
}

/// One diagnostic for each slip and for the open bracket, none for their consequences.
fn explained(
    sources: &Sources,
    id: SourceId,
    slips: &[Slip],
    open: Option<usize>,
) -> Vec<Diagnostic> {
    let text = sources.get(id).text.as_str();
    let mut told: Vec<&Slip> = Vec::new();
    for slip in slips {
        let is_behind_open = open.is_some_and(|open| slip.span.start > open);
        if !is_behind_open && !told.last().is_some_and(|last| follows(text, last, slip)) {
            told.push(slip);
        }
    }
    let mut diagnostics: Vec<_> = told.into_iter().map(|slip| diagnostic(sources, slip)).collect();
    diagnostics.extend(open.map(|open| {
        let span = sources.span(id, open, open + 1);
        let message = format!("this {} is never closed", quoted(sources.slice(span)));
        Diagnostic::error(span, message).label("what follows cannot be read")
    }));
    diagnostics
}

/// Whether a slip is a consequence of the one before.
fn follows(text: &str, last: &Slip, slip: &Slip) -> bool {
    let between = &text[last.span.start..slip.span.start];
    match slip.kind {
        _ if slip.span == last.span => true,
        Damage::Lossy => !between.contains('\n'),
        // The keys of a table that exists already often exist as well.
        Damage::SecondKey => last.kind == Damage::SecondTable && !between.contains("\n["),
        Damage::SecondTable | Damage::Value => false,
    }
}

fn diagnostic(sources: &Sources, slip: &Slip) -> Diagnostic {
    let found = sources.slice(slip.span);
    let before = line_before(sources, slip.span).trim_end();
    let error = |message: String| Diagnostic::error(slip.span, message);
    match slip.kind {
        Damage::SecondTable => error(format!("the table {} is defined twice", quoted(found)))
            .label("defined again here")
            .help("put all its keys under one header"),
        Damage::SecondKey => error(format!("{} is defined twice in the same table", quoted(found)))
            .label("defined again here")
            .help("keep one of the two, or give them different names"),
        _ if found.is_empty() && before.ends_with('=') => {
            error("a value is missing".into()).label("expected a value after the `=`")
        }
        _ if slip.message.starts_with("string values must be quoted") => {
            error(format!("{} is not a TOML value", quoted(found)))
                .label("an expression is a string, in quotes")
                .help(format!("write \"{}\"", quoted(found).trim_matches('`')))
        }
        _ if slip.message.starts_with("invalid basic string, expected `\"`") => {
            error("this string is never closed".into()).label("expected a `\"`")
        }
        kind => {
            let diagnostic =
                error(format!("the TOML cannot be read: {}", slip.message)).label("found here");
            // If an expression starts with digits, TOML reads all of it as a number.
            let is_number = ["invalid float", "invalid integer"]
                .iter()
                .any(|invalid| slip.message.starts_with(invalid));
            if kind == Damage::Value && is_number {
                return diagnostic.help("an expression is a string: write it in quotes");
            }
            diagnostic
        }
    }
}
