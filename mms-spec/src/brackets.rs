//! Finds the bracket that was never closed.
//!
//! An array without its end includes everything after it, and TOML reports an error at each of those places but not where the
//! end is missing. This module finds the place that a person would point at.

/// The `[` or `{` of a value that is never closed, in a text that has one.
pub(super) fn unclosed(text: &str) -> Option<usize> {
    let mut open: Vec<(usize, u8)> = Vec::new();
    let mut position = 0;
    while let Some(byte) = text.as_bytes().get(position) {
        let rest = &text.as_bytes()[position..];
        match byte {
            b'#' => position += length_to(rest, b"\n", false),
            b'"' | b'\'' => {
                position += string(rest);
                continue;
            }
            b'[' | b'{' => open.push((position, *byte)),
            b']' | b'}' => {
                open.pop();
            }
            // An array has no keys: its end is missing before this one.
            b'=' if open.last().is_some_and(|(_, bracket)| *bracket == b'[') => break,
            _ => {}
        }
        position += 1;
    }
    open.last().map(|(start, _)| *start)
}

/// The length of the string that starts here; a short one ends with its line.
fn string(rest: &[u8]) -> usize {
    let quote = rest[0];
    let escapes = quote == b'"';
    if rest.starts_with(&[quote; 3]) {
        return 3 + length_to(&rest[3..], &[quote; 3], escapes) + 3;
    }
    let end = length_to(&rest[1..], &[quote], escapes);
    let line = length_to(&rest[1..], b"\n", false);
    1 + end.min(line) + 1
}

/// The distance to a mark; an escaped character is no mark.
fn length_to(text: &[u8], mark: &[u8], escapes: bool) -> usize {
    let mut position = 0;
    while position < text.len() && !text[position..].starts_with(mark) {
        position += if escapes && text[position] == b'\\' { 2 } else { 1 };
    }
    position.min(text.len())
}

#[cfg(test)]
mod tests {
    use super::unclosed;

    #[test]
    fn finds_the_bracket_without_an_end() {
        assert_eq!(unclosed("a = [1, 2\nb = 3\n"), Some(4));
        assert_eq!(unclosed("a = [[1], [2\nb = 3\n"), Some(10));
        assert_eq!(unclosed("a = { b = 1\n[c]\n"), Some(4));
        assert_eq!(unclosed("[t]\na = [\"]\", ']', '''\n]''' # ]\n"), Some(8));
        assert_eq!(unclosed("a = [\"\\\"]\"\n\"x"), Some(4));
        assert_eq!(unclosed("[t]\na = [1]\n"), None);
    }
}
