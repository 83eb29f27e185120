//! Texts from outside: names and titles of fields and materials, references, sources of closed forms, descriptions, names of
//! extremes, paths, and formats and commands in checkpoints.
//!
//! A text from outside may steer a terminal, or look like a line of the program's own. A `Foreign` therefore has no `Display`: the
//! caller chooses how to print it. For a terminal, `shown()` escapes every invisible character, as Rust does, and returns one
//! line of at most a thousand characters. For emitted code, `in_a_comment()` replaces them by blanks. `raw()` is for code that
//! escapes by itself, and for comparisons. `path` shows a path, and `markup` removes characters that HTML and XML forbid.
//! Diagnostics and their source lines are shown in the same way.

use std::path::Path;

use serde_core::{Deserialize, Deserializer, Serialize, Serializer};

/// The largest number of characters of a text that are shown.
pub const MOST: usize = 1000;

/// The largest number of characters of a path that are shown: more than any system opens.
const MOST_OF_PATH: usize = 5000;

/// A text from outside. It has no `Display`: use [`shown`](Foreign::shown). As JSON, which escapes, it is unchanged.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Foreign(String);

impl Foreign {
    /// The text as written, for code that escapes it by itself, and for comparisons.
    pub fn raw(&self) -> &str {
        &self.0
    }

    /// The text for a person: see [`shown`].
    pub fn shown(&self) -> String {
        shown(&self.0)
    }

    /// The text for a comment of emitted code, on one line, with blanks for invisible characters. An escape would have a
    /// meaning in some languages.
    pub fn in_a_comment(&self) -> String {
        blanked(&self.0)
    }
}

impl<T: Into<String>> From<T> for Foreign {
    fn from(text: T) -> Self {
        Foreign(text.into())
    }
}

impl PartialEq<str> for Foreign {
    fn eq(&self, other: &str) -> bool {
        self.0 == other
    }
}

impl PartialEq<&str> for Foreign {
    fn eq(&self, other: &&str) -> bool {
        self.0 == *other
    }
}

impl PartialEq<String> for Foreign {
    fn eq(&self, other: &String) -> bool {
        self.0 == *other
    }
}

impl Serialize for Foreign {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Foreign {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        String::deserialize(deserializer).map(Foreign)
    }
}

/// A text on one line, cut to [`MOST`] characters: characters that are invisible, end lines or change the direction of writing
/// are escaped as in Rust, such as `\n` or `\u{1b}`.
pub fn shown(text: &str) -> String {
    cut(text, MOST)
}

/// A path on one line, escaped likewise, in full.
pub fn path(path: &Path) -> String {
    cut(&path.to_string_lossy(), MOST_OF_PATH)
}

/// Escapes at most `most` characters of a text.
fn cut(text: &str, most: usize) -> String {
    let end = text.char_indices().nth(most).map_or(text.len(), |(end, _)| end);
    let mut shown = escaped(&text[..end], |c| c.escape_debug().to_string());
    if end < text.len() {
        shown += "...";
    }
    shown
}

/// A whole message that may contain foreign texts, on one line.
pub fn one_line(text: &str) -> String {
    cut(text, usize::MAX)
}

/// Lines of this program that may contain foreign texts: the whole text, with invisible characters of each line escaped.
pub fn lines(text: &str) -> String {
    escaped(text, |c| match c {
        '\n' | '\t' => c.to_string(),
        other => other.escape_debug().to_string(),
    })
}

/// The JSON document in visible characters only.
pub fn json(document: &str) -> String {
    escaped(document, |c| match c {
        '\n' => c.to_string(),
        other => {
            let mut units = [0; 2];
            other.encode_utf16(&mut units).iter().map(|unit| format!("\\u{unit:04x}")).collect()
        }
    })
}

/// A text on one line, with blanks for invisible characters.
pub fn blanked(text: &str) -> String {
    escaped(text, |_| " ".to_owned()).trim_end().into()
}

/// A text for a document of HTML or XML, including markup, without forbidden characters, line ends within scripts, and
/// characters that change the direction of writing beyond their element.
pub fn markup(text: &str) -> String {
    let is_forbidden = |c: char| {
        let is_control = c.is_control() && !matches!(c, '\n' | '\t');
        let is_nothing = c as u32 & 0xfffe == 0xfffe || ('\u{fdd0}'..='\u{fdef}').contains(&c);
        is_control || is_nothing || is_line_end(c) || turns(c)
    };
    text.chars().filter(|&c| !is_forbidden(c)).collect()
}

/// A text with its invisible characters replaced by `escape`.
fn escaped(text: &str, escape: impl Fn(char) -> String) -> String {
    let mut seen = String::with_capacity(text.len());
    for c in text.chars() {
        if is_visible(c) { seen.push(c) } else { seen += &escape(c) }
    }
    seen
}

/// Whether a character changes the direction of writing.
fn turns(c: char) -> bool {
    matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// Whether a character ends a line or a paragraph, and is not one of the usual line ends.
fn is_line_end(c: char) -> bool {
    matches!(c, '\u{2028}' | '\u{2029}')
}

/// Whether a character is visible as itself, and has no other effect.
fn is_visible(c: char) -> bool {
    match c {
        ' '..='~' => true,
        _ if is_line_end(c) => false,
        _ if c.is_control() => false,
        _ if c.is_whitespace() => true,
        // A mark that joins the letter before it is escaped as well if it is alone, or first in a text.
        _ => {
            let mut text = [b'x', 0, 0, 0, 0];
            let length = 1 + c.encode_utf8(&mut text[1..]).len();
            let text = str::from_utf8(&text[..length]).unwrap_or_default();
            text.escape_debug().eq(text.chars())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_steers_a_terminal_is_seen_and_does_nothing() {
        for (text, seen) in [
            ("x\u{1b}]0;pwned\u{7}\u{1b}[2J", r"x\u{1b}]0;pwned\u{7}\u{1b}[2J"),
            ("T\n  proof  J > 0\r\t", r"T\n  proof  J > 0\r\t"),
            ("a\u{9b}31m\u{7f}\0", r"a\u{9b}31m\u{7f}\0"),
            ("\u{202e}evil\u{2069}\u{200f}\u{61c}", r"\u{202e}evil\u{2069}\u{200f}\u{61c}"),
            ("\u{2028}\u{feff}\u{200b}\u{e0041}", r"\u{2028}\u{feff}\u{200b}\u{e0041}"),
        ] {
            assert_eq!(Foreign::from(text).shown(), seen);
            assert_eq!(lines(seen), seen);
        }
        for text in ["it's \"a\\b\"", "e\u{301} \u{3bb} \u{3000}\u{4e2d} \u{a0}", "\u{1f9ea}"] {
            assert_eq!(shown(text), text);
        }
    }

    #[test]
    fn a_long_text_is_cut_and_a_long_path_is_not() {
        let long = "\u{3bb}".repeat(MOST + 1);
        assert_eq!(shown(&long), format!("{}...", "\u{3bb}".repeat(MOST)));
        assert_eq!(shown(&long[2..]), long[2..]);
        assert_eq!(path(Path::new(&long)), long);
        assert_eq!(one_line(&long), long);
    }

    #[test]
    fn lines_of_ours_stay_and_documents_say_the_same() {
        assert_eq!(lines("a\n\tb\u{1b}\r\n"), "a\n\tb\\u{1b}\\r\n");
        assert_eq!(json("{\n\"\u{7f}\u{9b}\u{e0041}\"}"), "{\n\"\\u007f\\u009b\\udb40\\udc41\"}");
    }

    #[test]
    fn a_comment_stays_on_its_line_and_a_page_holds_what_it_may() {
        assert_eq!(blanked("a\nevil()\r\u{202e}b \u{2028}"), "a evil()  b");
        assert_eq!(blanked(""), "");
        assert_eq!(
            markup("<p>\n\t\u{1b}[2J\u{9b}\0\u{ffff}\u{5fffe}\u{fdd0}\u{202e}\u{2028}\u{2029}</p>"),
            "<p>\n\t[2J</p>"
        );
    }
}
