//! Texts and places in them.

use std::io;

use crate::foreign::Foreign;

/// A text with the path that messages show for it.
#[derive(Clone, Debug)]
pub struct Source {
    /// The path as a user should read it, relative to the manifest if there is one.
    pub path: Foreign,
    /// The whole text.
    pub text: String,
}

/// The text of a file.
///
/// # Errors
/// The file is not UTF-8 text; the error has the place.
pub fn text(bytes: Vec<u8>) -> io::Result<String> {
    String::from_utf8(bytes).map_err(|error| {
        let before = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let before = String::from_utf8_lossy(before);
        let line = before.matches('\n').count() + 1;
        let column = before.chars().rev().take_while(|&c| c != '\n').count() + 1;
        let place = format!("line {line}, column {column}");
        let message = format!("{place}: expected text in UTF-8; save the file in that encoding");
        io::Error::new(io::ErrorKind::InvalidData, message)
    })
}

/// The index of one of the [`Sources`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SourceId(u32);

impl SourceId {
    /// The position in the order of addition.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A byte range of one source; always on character boundaries of its text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Span {
    /// The text.
    pub source: SourceId,
    /// The first byte.
    pub start: usize,
    /// One past the last byte.
    pub end: usize,
}

/// A value and the place where it was written.
#[derive(Clone, Debug, PartialEq)]
pub struct Spanned<T> {
    /// The value.
    pub value: T,
    /// The place in the file.
    pub span: Span,
}

/// The texts of one compilation: the field file and its material file, and the texts of a selection.
#[derive(Clone, Debug, Default)]
pub struct Sources(Vec<Source>);

impl Sources {
    /// Adds a text.
    pub fn add(&mut self, path: impl Into<Foreign>, text: impl Into<String>) -> SourceId {
        let id = SourceId(u32::try_from(self.0.len()).unwrap_or(u32::MAX));
        self.0.push(Source { path: path.into(), text: text.into() });
        id
    }

    /// The text at this position in the order of addition.
    pub fn nth(&self, index: usize) -> Option<SourceId> {
        let id = u32::try_from(index).ok()?;
        (index < self.0.len()).then_some(SourceId(id))
    }

    /// Every text, in the order of addition.
    pub fn texts(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(|source| source.text.as_str())
    }

    /// A hash of all texts, 64 bits in hexadecimal: FNV-1a (Fowler, Noll and Vo). It distinguishes inputs, and is the same on
    /// every machine.
    pub fn hash(&self) -> String {
        let of = |hash: u64, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        let hash = self.texts().flat_map(str::bytes).fold(0xcbf2_9ce4_8422_2325, of);
        format!("{hash:016x}")
    }

    /// The text with this id.
    pub fn get(&self, id: SourceId) -> &Source {
        &self.0[id.0 as usize]
    }

    /// The bytes `start..end` of a text, moved onto character boundaries inside it: a place that is safe to slice for any
    /// input.
    pub fn span(&self, source: SourceId, start: usize, end: usize) -> Span {
        let text = &self.get(source).text;
        let start = boundary_before(text, start);
        Span { source, start, end: boundary_before(text, end).max(start) }
    }

    /// The place of a part of a TOML tree.
    pub fn span_of<T>(&self, source: SourceId, part: &toml::Spanned<T>) -> Span {
        let place = part.span();
        self.span(source, place.start, place.end)
    }

    /// The text that a span covers.
    pub fn slice(&self, span: Span) -> &str {
        let span = self.span(span.source, span.start, span.end);
        &self.get(span.source).text[span.start..span.end]
    }

    /// Line and column of the first character of a span, both counted from 1, columns in
    /// characters.
    pub fn location(&self, span: Span) -> (usize, usize) {
        let text = &self.get(span.source).text;
        let before = &text[..boundary_before(text, span.start)];
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        let line = before.bytes().filter(|byte| *byte == b'\n').count() + 1;
        (line, before[line_start..].chars().count() + 1)
    }

    /// `path:line:column` of the start of a span, for a person.
    pub fn place(&self, span: Span) -> String {
        let (line, column) = self.location(span);
        format!("{}:{line}:{column}", self.get(span.source).path.shown())
    }
}

/// The last character boundary at or before an offset.
fn boundary_before(text: &str, offset: usize) -> usize {
    let mut offset = offset.min(text.len());
    while !text.is_char_boundary(offset) {
        offset -= 1;
    }
    offset
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn location_counts_characters_not_bytes() {
        let mut sources = Sources::default();
        let id = sources.add("x.toml", "a\r\n\u{3bb}\u{3bc} b\n");
        let place = |start| sources.location(sources.span(id, start, start));
        assert_eq!(place(0), (1, 1));
        assert_eq!(place(3), (2, 1));
        assert_eq!(place(8), (2, 4));
        assert_eq!(place(1000), (3, 1));
    }

    #[test]
    fn spans_stay_on_character_boundaries() {
        let mut sources = Sources::default();
        let id = sources.add("x.toml", "\u{3bb}");
        assert_eq!(sources.slice(sources.span(id, 1, 1)), "");
        assert_eq!(sources.slice(sources.span(id, 0, 9)), "\u{3bb}");
    }
}
