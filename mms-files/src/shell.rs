//! Quotes command lines, so that a shell splits them into the same words again.

use std::ffi::OsString;

use mms_spec::foreign;

/// Quotes a word, on one line. Escapes invisible characters byte by byte, as shells read them since POSIX.1-2024.
pub fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "_-+=.,:/@%".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.to_owned();
    }
    if foreign::one_line(word) == word {
        return format!("'{}'", word.replace('\'', r"'\''"));
    }
    let escaped = |c: char| match c {
        '\'' | '\\' => format!("\\{c}"),
        ' '..='~' => c.to_string(),
        other => other.to_string().bytes().map(|byte| format!("\\{byte:03o}")).collect(),
    };
    format!("$'{}'", word.chars().map(escaped).collect::<String>())
}

/// The command line of `mms` with these arguments.
pub fn command<W: AsRef<str>>(arguments: impl IntoIterator<Item = W>) -> String {
    let words = arguments.into_iter().map(|word| format!(" {}", quoted(word.as_ref())));
    format!("mms{}", words.collect::<String>())
}

/// The words of a command line; replaces bytes that are no text.
pub fn words(arguments: impl IntoIterator<Item = OsString>) -> Vec<String> {
    arguments.into_iter().map(|word| word.to_string_lossy().into_owned()).collect()
}

#[cfg(test)]
mod tests {
    use super::{command, quoted};

    #[test]
    fn a_shell_reads_back_what_was_quoted() {
        for (word, text) in [
            ("out/bar_1d", "out/bar_1d"),
            ("my folder", "'my folder'"),
            ("it's", r"'it'\''s'"),
            ("", "''"),
            ("a=b*c", "'a=b*c'"),
            ("8,16", "8,16"),
            ("a\n\u{1b}\u{9b}'\\b", r"$'a\012\033\302\233\'\\b'"),
        ] {
            assert_eq!(quoted(word), text);
        }
    }

    #[test]
    fn a_command_is_what_a_shell_takes_apart_again() {
        let arguments = ["study", "--rigid=rotation = \"pi*t\"", "young=2*pi", "it's"];
        let expected = r#"mms study '--rigid=rotation = "pi*t"' 'young=2*pi' 'it'\''s'"#;
        assert_eq!(command(arguments), expected);
        assert_eq!(command::<&str>([]), "mms");
    }
}
