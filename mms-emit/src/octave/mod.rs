//! Octave and MATLAB: one file of functions over arrays of any shape, and a program that checks it.

mod check;
mod dialect;
mod file;

use crate::port::Port;
use crate::port::names::Rules;
use crate::target::{Bundle, Subject, Target};
use crate::text::wrapped;

/// Octave and MATLAB.
pub const TARGET: Target = Target {
    name: "octave",
    alias: Some("matlab"),
    doc: "Octave and MATLAB: one file of functions over arrays, which broadcast, and a check program",
    emit: bundle,
    words: RULES.words,
};

/// Rules of the language for names; a file named after a function would hide it.
const RULES: Rules =
    Rules { words: &[KEYWORDS], modules: &[KEYWORDS, FUNCTIONS], folds_case: false, longest: 63 };

/// The keywords of both languages (`iskeyword`).
const KEYWORDS: &str = "\
    __FILE__ __LINE__ arguments break case catch classdef continue do else elseif end \
    end_try_catch end_unwind_protect endclassdef endenumeration endevents endfor endfunction endif \
    endmethods endparfor endproperties endspmd endswitch endwhile enumeration events for function \
    global if methods otherwise parfor persistent properties return spmd switch try until unwind_protect \
    unwind_protect_cleanup while";

/// Functions that the files call, and others that should not be hidden.
const FUNCTIONS: &str = "\
    all any angle area axis bar box cat columns cross cylinder date diff disp dot ellipsoid error eval eye \
    fill filter find gamma grid hist image inv kron length line lower upper mean median mesh mode norm \
    null orth patch path pie plot polar print prod quad rand range rank ribbon run shift sort sphere \
    stairs std sum surf svd text trace type var view warning who \
    abs acos asin atan atan2 cell class cos cosh deal double eps exit exp expm1 fix floor fprintf hex2num \
    isequal isfinite log log1p log2 max mod nthroot numel ones pi pow2 power realmin rem repmat reshape round \
    sign sin single sinh size sqrt tan tanh zeros i j ans NaN Inf";

fn bundle(subject: &Subject<'_>) -> Bundle {
    let port = Port::new(subject, &RULES);
    let texts = [(".m", file::text(&port)), ("_check.m", check::text(&port))];
    port.bundle(texts, "octave-cli --norc --no-history --quiet --eval FIELD_check")
}

/// Paragraphs as lines of a comment.
fn comment(paragraphs: &[String], indent: &str) -> String {
    let paragraphs: Vec<Vec<String>> =
        paragraphs.iter().map(|text| wrapped(text, 96 - indent.len())).collect();
    let lines = paragraphs.join(&String::new());
    // A line of a bracket alone would begin or end a block of comments.
    let lines = lines.iter().map(|line| format!("{indent}% {line}").trim_end().to_string() + "\n");
    lines.collect()
}
