//! A user's text inside emitted code: it can neither end its comment nor hide the code after it.

use mms_spec::foreign::blanked;

/// The words of a text in lines of at most `width` characters, where words allow it.
pub(super) fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines = Vec::new();
    let mut line = String::new();
    for word in blanked(text).split_whitespace() {
        if !line.is_empty() && line.chars().count() + 1 + word.chars().count() > width {
            lines.push(std::mem::take(&mut line));
        }
        if !line.is_empty() {
            line.push(' ');
        }
        line.push_str(word);
    }
    if !line.is_empty() {
        lines.push(line);
    }
    lines
}

/// Items that are separated by `, ` in lines of at most `width` characters, each but the last with
/// its comma; no item is broken.
pub(super) fn listed<T: AsRef<str>>(items: &[T], width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for (index, item) in items.iter().enumerate() {
        let comma = if index + 1 < items.len() { "," } else { "" };
        let item = format!("{}{comma}", item.as_ref());
        match lines.last_mut() {
            Some(line) if line.len() + 1 + item.len() <= width => *line = format!("{line} {item}"),
            _ => lines.push(item),
        }
    }
    lines
}

/// Statements on lines of their own, indented by `by` spaces.
pub(super) fn indented(statements: &[String], by: usize) -> String {
    statements.iter().map(|statement| format!("{:by$}{statement}\n", "")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_break_between_words() {
        assert_eq!(wrapped("a bb  ccc dddddd", 5), ["a bb", "ccc", "dddddd"]);
        assert_eq!(listed(&["a", "b", "c"], 5), ["a, b,", "c"]);
        assert_eq!(listed(&["a b", "c d"], 5), ["a b,", "c d"]);
        assert!(wrapped(" ", 5).is_empty());
    }
}
