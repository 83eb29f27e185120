//! Texts from outside: names and titles of fields and materials, references, sources of closed forms,
//! descriptions, names of extremes, paths, and formats and commands in checkpoints.
//!
//! Such a text may steer a terminal, or look like a line of the program's own. A `Foreign` therefore has no
//! `Display`: who prints it must say how. On a terminal, `shown()` escapes every character that cannot be seen, as
//! Rust does, and keeps to one line of a thousand characters. In emitted code, `in_a_comment()` puts blanks in
//! their place. `raw()` is for what escapes by itself, and for comparisons. `path` shows a path, and `markup`
//! leaves out what HTML and XML forbid. Diagnostics and their source lines are shown in the same way.

use std::path::Path;

use serde_core::{Deserialize, Deserializer, Serialize, Serializer};

/// Of a text no more characters than this are shown.
pub const MOST: usize = 1000;

/// Of a path: more than any system opens.
const MOST_OF_PATH: usize = 5000;

/// A text from outside. It does not print itself: [`shown`](Foreign::shown) does. As JSON, which escapes, it is what it
/// is.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Foreign(String);

impl Foreign {
    /// As it was written, for what escapes it by itself, and for comparisons.
    pub fn raw(&self) -> &str {
        &self.0
    }

    /// For a person: see [`shown`].
    pub fn shown(&self) -> String {
        shown(&self.0)
    }

    /// For a comment of emitted code, on one line: what cannot be seen is a blank. An escape would mean something to
    /// some languages.
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

/// A text on one line, at most [`MOST`] characters of it: what cannot be seen, ends lines or changes the direction of
/// writing is written as Rust escapes it, such as `\n` or `\u{1b}`.
pub fn shown(text: &str) -> String {
    cut(text, MOST)
}

/// A path in the same way, in full.
pub fn path(path: &Path) -> String {
    cut(&path.to_string_lossy(), MOST_OF_PATH)
}

/// The same of as many characters as are wanted.
fn cut(text: &str, most: usize) -> String {
    let end = text.char_indices().nth(most).map_or(text.len(), |(end, _)| end);
    let mut shown = escaped(&text[..end], |c| c.escape_debug().to_string());
    if end < text.len() {
        shown += "...";
    }
    shown
}

/// A message that may hold foreign texts, all of it, on one line.
pub fn one_line(text: &str) -> String {
    cut(text, usize::MAX)
}

/// Lines of ours that may hold foreign texts: all of it, but in each line what cannot be seen is escaped.
pub fn lines(text: &str) -> String {
    escaped(text, |c| match c {
        '\n' | '\t' => c.to_string(),
        other => other.escape_debug().to_string(),
    })
}

/// JSON that says the same in characters that can be seen.
pub fn json(document: &str) -> String {
    escaped(document, |c| match c {
        '\n' => c.to_string(),
        other => {
            let mut units = [0; 2];
            other.encode_utf16(&mut units).iter().map(|unit| format!("\\u{unit:04x}")).collect()
        }
    })
}

/// A text on one line, with blanks for what cannot be seen.
pub fn blanked(text: &str) -> String {
    escaped(text, |_| " ".to_owned()).trim_end().into()
}

/// A text for a document of HTML or XML, markup and all, without what these forbid, what ends a line in a script, and what
/// changes the direction of writing beyond its element.
pub fn markup(text: &str) -> String {
    let is_forbidden = |c: char| {
        let is_control = c.is_control() && !matches!(c, '\n' | '\t');
        let is_nothing = c as u32 & 0xfffe == 0xfffe || ('\u{fdd0}'..='\u{fdef}').contains(&c);
        is_control || is_nothing || is_line_end(c) || turns(c)
    };
    text.chars().filter(|&c| !is_forbidden(c)).collect()
}

/// A text with the characters that cannot be seen written in another way.
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

/// Whether a character ends a line or a paragraph, and is none of those that a text has for that.
fn is_line_end(c: char) -> bool {
    matches!(c, '\u{2028}' | '\u{2029}')
}

/// Whether a character is seen as itself, and does nothing else.
fn is_visible(c: char) -> bool {
    match c {
        ' '..='~' => true,
        _ if is_line_end(c) => false,
        _ if c.is_control() => false,
        _ if c.is_whitespace() => true,
        // Alone, or first in a text, a mark that joins the letter before it is escaped as well.
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
