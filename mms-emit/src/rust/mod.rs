//! Rust without a dependency: a module that also works in crates without the standard library, and a program that checks it.
//!
//! The target `rust-mms-math` is different: its module has the scalars, the vectorised loops and the bits of `mms-math`.
//! This target uses no crate, and is a port like the ones to other languages.

mod check;
mod dialect;
mod module;

use crate::port::Port;
use crate::port::names::Rules;
use crate::target::{Bundle, Subject, Target};

/// Rust without dependencies.
pub const TARGET: Target = Target {
    name: "rust",
    alias: None,
    doc: "Rust: a module without dependencies, also for `no_std`, and a check program",
    emit: bundle,
    words: RULES.words,
};

/// Rules of Rust for names.
const RULES: Rules = Rules {
    words: &[KEYWORDS, "marker"],
    modules: &[KEYWORDS, "std core alloc main test libm proc_macro"],
    folds_case: false,
    longest: 120,
};

/// The keywords of the Rust Reference: strict, reserved, and the keywords of a single edition.
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
