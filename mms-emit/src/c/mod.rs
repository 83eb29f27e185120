//! C99: a header, a source file, and a program that checks them.

pub(super) mod check;
pub(super) mod dialect;
mod header;
pub(super) mod source;

use self::dialect::RULES;
use crate::port::Port;
use crate::target::{Bundle, Subject, Target};
use crate::text::wrapped;

/// C.
pub const TARGET: Target = Target {
    name: "c",
    alias: None,
    doc: "C99: a header, a source file and a check program",
    emit: bundle,
    words: RULES.words,
};

/// The flags of the line that proves a port: every warning is an error, and no operations are fused, because fused
/// operations would change what double-double arithmetic relies on.
const FLAGS: &str = "-std=c99 -O2 -Wall -Wextra -Werror -ffp-contract=off";

fn bundle(subject: &Subject<'_>) -> Bundle {
    let port = Port::new(subject, &RULES);
    let texts = [
        (".h", header::text(&port)),
        (".c", source::text(&port)),
        ("_check.c", check::text(&port)),
    ];
    port.bundle(
        texts,
        &format!("cc {FLAGS} FIELD.c FIELD_check.c -lm -o FIELD_check && ./FIELD_check"),
    )
}

/// Paragraphs as one comment.
pub(super) fn comment(paragraphs: &[String], indent: &str) -> String {
    // Breaks up comment marks, and the trigraphs that C99 reads as other characters.
    let harmless =
        |text: &String| text.replace("*/", "* /").replace("/*", "/ *").replace("??", "? ?");
    let paragraphs: Vec<Vec<String>> =
        paragraphs.iter().map(|text| wrapped(&harmless(text), 96 - indent.len())).collect();
    let lines = paragraphs.join(&String::new());
    let lines: Vec<&str> = lines.iter().map(|line| line.trim_end()).collect();
    let mut text = format!("{indent}/* {}", lines[0]);
    for line in &lines[1..] {
        text = text + "\n" + format!("{indent} * {line}").trim_end();
    }
    text + " */\n"
}

/// Paragraphs as one documentation comment.
fn documented(paragraphs: &[String], indent: &str) -> String {
    comment(paragraphs, indent).replacen("/*", "/**", 1)
}

/// A function's head or call, broken where it is too long.
pub(super) fn broken(start: &str, arguments: &[String], end: &str) -> String {
    let line = format!("{start}({}){end}", arguments.join(", "));
    if line.len() <= 100 {
        return line;
    }
    let indent = " ".repeat(start.len() - start.trim_start().len() + 8);
    let lines = crate::text::listed(arguments, 100 - indent.len());
    format!("{start}(\n{indent}{}){end}", lines.join(&format!("\n{indent}")))
}
