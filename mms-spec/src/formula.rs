//! The text of one expression, and the map from each of its bytes to the file.
//!
//! The text of a TOML string differs from its source: it has quotes, escapes and line continuations, and a bare number may have
//! underscores. A [`Formula`] stores a map from its text to the source, so that a message about an expression can point at the
//! very character that the user typed.

use std::ops::Range;

use crate::source::Span;

/// An expression as text, not yet parsed.
#[derive(Clone, Debug)]
pub struct Formula {
    /// The expression, with TOML's quotes and escapes removed.
    pub text: String,
    /// The whole value in the file, quotes included.
    pub span: Span,
    /// Consecutive pieces that cover the text; empty for a formula whose mistake has been reported.
    pieces: Vec<Piece>,
}

/// A stretch of the text, and the stretch of the file it was read from.
#[derive(Clone, Debug)]
struct Piece {
    text: Range<usize>,
    source: Range<usize>,
    /// Whether the piece is copied byte by byte, so that places inside correspond; otherwise it is one escape.
    verbatim: bool,
}

impl Formula {
    /// The formula of a TOML string: `raw` is the source text at `span`, quotes included, and `decoded` is its value.
    pub(crate) fn from_string(raw: &str, decoded: &str, span: Span) -> Self {
        let mut scan = Scan::new(raw, span);
        if is_quoted(raw) {
            scan.string();
        }
        if !is_quoted(raw) || scan.formula.text != decoded {
            // This happens only for a string that TOML itself refused; the caret then covers all of it.
            scan.formula.text = decoded.into();
            let (text, source) = (0..decoded.len(), span.start..span.end);
            scan.formula.pieces = vec![Piece { text, source, verbatim: false }];
        }
        scan.formula
    }

    /// The formula of a bare TOML number, from its digits in the file.
    pub(super) fn from_number(raw: &str, span: Span) -> Self {
        let mut scan = Scan::new(raw, span);
        scan.skip(raw.len() - raw.trim_start_matches('+').len());
        while let Some(next) = scan.rest().chars().next() {
            if next == '_' { scan.skip(1) } else { scan.copy(next.len_utf8()) }
        }
        scan.formula
    }

    /// The formula of a text on its own, such as an argument of a command.
    pub fn plain(text: &str, span: Span) -> Self {
        let mut scan = Scan::new(text, span);
        scan.copy(text.len());
        scan.formula
    }

    /// A formula in place of one whose mistake has been reported. It has no text, and parsing it returns nothing and reports
    /// nothing.
    pub fn reported(span: Span) -> Self {
        Formula { text: String::new(), span, pieces: Vec::new() }
    }

    /// Whether the mistake of this formula has been reported.
    pub fn is_reported(&self) -> bool {
        self.pieces.is_empty()
    }

    /// The place in the file of a byte range of the text.
    pub fn span_of(&self, range: Range<usize>) -> Span {
        let start = self.source_of(range.start);
        let end = if range.end > range.start { self.source_end_of(range.end) } else { start };
        Span { source: self.span.source, start, end: end.max(start) }
    }

    /// The place of the character that starts at `offset`.
    fn source_of(&self, offset: usize) -> usize {
        let after = self.pieces.partition_point(|piece| piece.text.end <= offset);
        match self.pieces.get(after) {
            Some(piece) if piece.verbatim => piece.source.start + (offset - piece.text.start),
            Some(piece) => piece.source.start,
            None => self.pieces.last().map_or(self.span.end, |piece| piece.source.end),
        }
    }

    /// The end of the character that ends at `offset`.
    fn source_end_of(&self, offset: usize) -> usize {
        let holding = self.pieces.partition_point(|piece| piece.text.end < offset);
        match self.pieces.get(holding) {
            Some(piece) if piece.verbatim => piece.source.start + (offset - piece.text.start),
            Some(piece) => piece.source.end,
            None => self.pieces.last().map_or(self.span.end, |piece| piece.source.end),
        }
    }
}

/// Walks through the source text of a value and collects its formula.
struct Scan<'a> {
    raw: &'a str,
    position: usize,
    base: usize,
    formula: Formula,
}

impl<'a> Scan<'a> {
    fn new(raw: &'a str, span: Span) -> Self {
        // A piece without text distinguishes an empty string from a reported mistake.
        let opening = Piece { text: 0..0, source: span.start..span.start, verbatim: false };
        let formula = Formula { text: String::new(), span, pieces: vec![opening] };
        Scan { raw, position: 0, base: span.start, formula }
    }

    fn rest(&self) -> &'a str {
        &self.raw[self.position..]
    }

    fn skip(&mut self, length: usize) {
        self.position += length;
    }

    /// Copies source text unchanged.
    fn copy(&mut self, length: usize) {
        let copied = &self.rest()[..length];
        let end = self.base + self.position + length;
        let text_end = self.formula.text.len() + length;
        match self.formula.pieces.last_mut() {
            Some(piece) if piece.verbatim && piece.source.end + length == end => {
                piece.text.end = text_end;
                piece.source.end = end;
            }
            _ => self.push(text_end - length..text_end, length, true),
        }
        self.formula.text.push_str(copied);
        self.position += length;
    }

    /// Reads an escape of `length` bytes as one character.
    fn escape(&mut self, value: char, length: usize) {
        let start = self.formula.text.len();
        self.push(start..start + value.len_utf8(), length, false);
        self.formula.text.push(value);
        self.position += length;
    }

    fn push(&mut self, text: Range<usize>, length: usize, verbatim: bool) {
        let start = self.base + self.position;
        self.formula.pieces.push(Piece { text, source: start..start + length, verbatim });
    }

    /// Reads a TOML string of any of the four kinds.
    fn string(&mut self) {
        let quote = if self.raw.starts_with('\'') { "'" } else { "\"" };
        let long = self.raw.len() >= 6 && self.raw.starts_with(&quote.repeat(3));
        let width = if long { 3 } else { 1 };
        self.skip(width);
        if long {
            self.skip(newline(self.rest()));
        }
        let end = self.raw.len() - width;
        while self.position < end {
            if quote == "\"" && self.rest().starts_with('\\') {
                self.backslash(end);
            } else {
                self.copy(self.rest().chars().next().map_or(0, char::len_utf8));
            }
        }
        let end = self.base + self.position;
        let text = self.formula.text.len();
        // The closing quote: the place of "unexpected end".
        self.formula.pieces.push(Piece { text: text..text, source: end..end, verbatim: false });
    }

    /// Reads an escape, or the end of a line that continues on the next.
    fn backslash(&mut self, end: usize) {
        let after = &self.raw[self.position + 1..end.max(self.position + 1)];
        let blank = after.len() - after.trim_start_matches([' ', '\t']).len();
        if newline(&after[blank..]) > 0 {
            let kept = after.trim_start_matches([' ', '\t', '\r', '\n']);
            return self.skip(1 + after.len() - kept.len());
        }
        match escaped(after) {
            Some((value, length)) => self.escape(value, 1 + length),
            None => self.copy(1),
        }
    }
}

/// Whether a text is a string with both its quotes, as in all valid TOML.
fn is_quoted(raw: &str) -> bool {
    ['"', '\'']
        .iter()
        .any(|quote| raw.len() >= 2 && raw.starts_with(*quote) && raw.ends_with(*quote))
}

/// The length of the newline that a text starts with, if it does.
fn newline(text: &str) -> usize {
    if text.starts_with("\r\n") { 2 } else { usize::from(text.starts_with('\n')) }
}

/// The character of an escape, and the length of the escape without its backslash.
fn escaped(after: &str) -> Option<(char, usize)> {
    let kind = after.chars().next()?;
    let digits = match kind {
        'x' => 2,
        'u' => 4,
        'U' => 8,
        _ => return Some((simple_escape(kind)?, 1)),
    };
    let code = u32::from_str_radix(after.get(1..1 + digits)?, 16).ok()?;
    Some((char::from_u32(code)?, 1 + digits))
}

fn simple_escape(kind: char) -> Option<char> {
    Some(match kind {
        'b' => '\u{8}',
        't' => '\t',
        'n' => '\n',
        'f' => '\u{c}',
        'r' => '\r',
        'e' => '\u{1b}',
        '"' => '"',
        '\\' => '\\',
        _ => return None,
    })
}

/// Formulas for the tests of the parser, without a file around them.
#[cfg(test)]
pub(crate) fn formula_in(raw: &str, source: crate::source::SourceId) -> Formula {
    let decoded = toml::de::DeValue::parse(raw).expect("a TOML string");
    let span = Span { source, start: 0, end: raw.len() };
    Formula::from_string(raw, decoded.get_ref().as_str().expect("a TOML string"), span)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Sources;

    /// The source text at the place of each occurrence of `needle` in the text.
    fn shown(raw: &str, needle: &str) -> String {
        let mut sources = Sources::default();
        let id = sources.add("x.toml", raw);
        let formula = formula_in(raw, id);
        assert_ne!(formula.pieces.iter().filter(|piece| piece.verbatim).count(), 0, "{raw}");
        let start = formula.text.find(needle).expect("the needle");
        sources.slice(formula.span_of(start..start + needle.len())).into()
    }

    #[test]
    fn places_in_every_kind_of_string() {
        assert_eq!(shown("\"a + b\"", "b"), "b");
        assert_eq!(shown("'a + b'", "b"), "b");
        assert_eq!(shown("\"\"\"\n  a\n + b\"\"\"", "b"), "b");
        assert_eq!(shown("'''\r\na\r\n + b'''", "b"), "b");
    }

    #[test]
    fn places_after_escapes_and_in_them() {
        assert_eq!(shown("\"\\u0061 + b\"", "b"), "b");
        assert_eq!(shown("\"\\u0061 + b\"", "a"), "\\u0061");
        assert_eq!(shown("\"a\\t+ b\"", "\t+ b"), "\\t+ b");
        assert_eq!(shown("\"\u{3bb}\\\\ + b\"", "+ b"), "+ b");
        assert_eq!(shown("\"\"\"a + \\\n   b\"\"\"", "b"), "b");
        assert_eq!(shown("\"\"\"a + \\\n   b\"\"\"", "+ b"), "+ \\\n   b");
    }

    #[test]
    fn the_end_of_the_text_is_the_closing_quote() {
        let mut sources = Sources::default();
        let id = sources.add("x.toml", "");
        for (raw, end) in [("\"a +\"", 4), ("''", 1), ("\"\"\"a\\n\"\"\"", 6)] {
            let formula = formula_in(raw, id);
            let length = formula.text.len();
            let span = formula.span_of(length..length);
            assert_eq!((span.start, span.end), (end, end), "{raw}");
            assert!(!formula.is_reported());
        }
    }

    #[test]
    fn numbers_lose_plus_and_underscores() {
        let mut sources = Sources::default();
        let id = sources.add("x.toml", "+1_000.5");
        let formula = Formula::from_number("+1_000.5", sources.span(id, 0, 8));
        assert_eq!(formula.text, "1000.5");
        assert_eq!(sources.slice(formula.span_of(0..6)), "1_000.5");
    }
}
