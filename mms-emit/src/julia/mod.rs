//! Julia: a module of functions that broadcast, and a program that checks it.

mod check;
mod dialect;
mod module;

use crate::port::Port;
use crate::port::names::{FUNCTIONS, Rules};
use crate::target::{Bundle, Subject, Target};

/// Julia.
pub const TARGET: Target = Target {
    name: "julia",
    alias: None,
    doc: "Julia: a module of functions that broadcast, in both precisions, and a check program",
    emit: bundle,
    words: RULES.words,
};

/// Names that Julia takes.
const RULES: Rules = Rules {
    words: &[KEYWORDS, "T Parameters float promote new"],
    modules: &[KEYWORDS, FUNCTIONS, NAMES],
    folds_case: false,
    longest: 120,
};

/// The keywords of the Julia Manual, section Keywords, also the words of two-word keywords.
const KEYWORDS: &str = "\
    abstract baremodule begin break catch const continue do else elseif end export false finally for \
    function global if import in isa let local macro module mutable outer primitive public quote return \
    struct true try type using where while";

/// Names that the module uses itself: a module of such a name would hide them.
const NAMES: &str = "\
    Base Core Main T Parameters Field Instant BigFloat Ref abs acos asin atan cbrt cos cosh cospi exp expm1 \
    float log log1p ln_1p_rest pi promote setprecision sin sinh sinpi sqrt tan tanh wide dimension";

fn bundle(subject: &Subject<'_>) -> Bundle {
    let port = Port::new(subject, &RULES);
    let texts = [(".jl", module::text(&port)), ("_check.jl", check::text(&port))];
    port.bundle(texts, "julia --startup-file=no FIELD_check.jl")
}
