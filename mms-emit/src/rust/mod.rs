//! Rust without a dependency: a module that a crate without the standard library takes too, and a
//! program that checks it.
//!
//! The target `rust-mms-math` is another: its module shares its scalars, its vectorised loops and its bits
//! with everything that has `mms-math`. This one shares nothing, and is a port like those to other languages.

mod check;
mod dialect;
mod module;

use crate::port::Port;
use crate::port::names::Rules;
use crate::target::{Bundle, Subject, Target};

/// Rust that stands alone.
pub const TARGET: Target = Target {
    name: "rust",
    alias: None,
    doc: "Rust: a module without any dependency, for `no_std` too, and a check program",
    emit: bundle,
    words: RULES.words,
};

/// Names that Rust takes.
const RULES: Rules = Rules {
    words: &[KEYWORDS, "marker"],
    modules: &[KEYWORDS, "std core alloc main test libm proc_macro"],
    folds_case: false,
    longest: 120,
};

/// The Rust Reference, keywords: strict, reserved, and those of one edition alone.
const KEYWORDS: &str = "\
    as async await break const continue crate dyn else enum extern false fn for gen if impl in let \
    loop match mod move mut pub ref return self Self static struct super trait true try type unsafe \
    use where while abstract become box do final macro override priv typeof unsized virtual yield \
    union macro_rules raw safe";

const FLAGS: &str = "--edition 2021 -O -D warnings";

fn bundle(subject: &Subject<'_>) -> Bundle {
    let port = Port::new(subject, &RULES);
    let texts = [(".rs", module::text(&port)), ("_check.rs", check::text(&port))];
    port.bundle(texts, &format!("rustc {FLAGS} FIELD_check.rs -o FIELD_check && ./FIELD_check"))
}

/// Paragraphs as lines of a comment, each behind `start`.
fn comment(paragraphs: &[String], start: &str) -> String {
    let width = 96 - start.len();
    let paragraphs: Vec<Vec<String>> =
        paragraphs.iter().map(|text| crate::text::wrapped(text, width)).collect();
    let lines = paragraphs.join(&String::new());
    lines.iter().map(|line| format!("{start} {line}").trim_end().to_string() + "\n").collect()
}
