//! The rule for names of fields: a file's stem becomes a module of generated code.

use crate::names::{MAX_NAME, is_identifier};

/// Returns the mistake in a field's name, and a similar valid name.
pub fn validate(name: &str) -> Result<(), String> {
    if is_keyword(name) {
        return Err(format!(
            "`{name}` is a word of Rust, and a field becomes a module: try `{name}_field`"
        ));
    }
    if is_plain(name) {
        return Ok(());
    }
    if name.len() > MAX_NAME {
        return Err(format!("the name has {} characters, expected at most {MAX_NAME}", name.len()));
    }
    let rule = "a field's name is lower-case letters, digits and underscores, a letter first";
    let near = near(name);
    if name.contains(['/', '\\']) {
        return Err(format!("`{name}` is not a name: {rule}; the folder is given by `--output`"));
    }
    if !is_plain(&near) || is_keyword(&near) {
        return Err(format!("`{name}` is not a name: {rule}"));
    }
    Err(format!("`{name}` is not a name: {rule}; try `{near}`"))
}

/// The words that Rust 2024 reserves, strict ones and others.
const KEYWORDS: &[&str] = &[
    "Self", "abstract", "as", "async", "await", "become", "box", "break", "const", "continue",
    "crate", "do", "dyn", "else", "enum", "extern", "false", "final", "fn", "for", "if", "impl",
    "in", "let", "loop", "macro", "match", "mod", "move", "mut", "override", "priv", "pub", "ref",
    "return", "self", "static", "struct", "super", "trait", "true", "try", "type", "typeof",
    "unsafe", "unsized", "use", "virtual", "where", "while", "yield",
];

/// Whether Rust reserves a word, so that a module cannot have this name without `r#`.
pub fn is_keyword(name: &str) -> bool {
    KEYWORDS.contains(&name)
}

/// The rule for field files: the rule for names without capital letters, so that files and modules are the same on every
/// system.
fn is_plain(name: &str) -> bool {
    is_identifier(name)
        && name.len() <= MAX_NAME
        && name.starts_with(|first: char| first.is_ascii_lowercase())
        && !name.bytes().any(|byte| byte.is_ascii_uppercase())
}

/// The name that a user who wrote `name` may have meant.
fn near(name: &str) -> String {
    let stem = name.strip_suffix(".toml").unwrap_or(name).to_ascii_lowercase();
    let word = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    let word: String = stem.chars().map(word).collect();
    if word.starts_with(|first: char| first.is_ascii_digit()) {
        return format!("field_{word}");
    }
    word.trim_matches('_').into()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn complaint(name: &str) -> String {
        validate(name).expect_err(name)
    }

    #[test]
    fn plain_names_pass() {
        for name in ["ring", "bar_1d", "x", "a2_", &"a".repeat(MAX_NAME)] {
            assert!(validate(name).is_ok(), "{name}");
        }
    }

    #[test]
    fn other_names_get_the_nearest_one() {
        for (name, near) in [
            ("Ring", "`ring`"),
            ("my-ring", "`my_ring`"),
            ("ring.toml", "`ring`"),
            ("2d", "`field_2d`"),
            ("_ring", "`ring`"),
            ("fn", "`fn_field`"),
            ("self", "`self_field`"),
        ] {
            assert!(complaint(name).ends_with(&format!("try {near}")), "{}", complaint(name));
        }
    }

    #[test]
    fn names_that_cannot_be_mended_get_the_rule() {
        for name in ["", "_", "\u{3bb}", "--", "fields/ring", "a\"); evil("] {
            assert!(complaint(name).contains("lower-case letters"), "{}", complaint(name));
        }
        assert!(complaint("fields/ring").contains("`--output`"));
        assert!(complaint(&"a".repeat(MAX_NAME + 1)).contains("101 characters"));
    }
}
