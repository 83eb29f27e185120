//! C++17: a header, templated on the scalar, and a program that checks it.

mod check;
mod dialect;
mod header;

use crate::c::dialect::{C_KEYWORDS, CPP_KEYWORDS, HEADERS, MACROS};
use crate::port::Port;
use crate::port::names::Rules;
use crate::target::{Bundle, Subject, Target};

/// C++.
pub const TARGET: Target = Target {
    name: "cpp",
    alias: None,
    doc: "C++17: a header templated on the scalar, also for CUDA and HIP, and a check program",
    emit: bundle,
    words: RULES.words,
};

/// Rules of C++ for names.
const RULES: Rules = Rules {
    words: &[C_KEYWORDS, CPP_KEYWORDS, MACROS, "T Parameters"],
    modules: &[C_KEYWORDS, CPP_KEYWORDS, MACROS, HEADERS],
    folds_case: false,
    longest: 120,
};

const FLAGS: &str = "-std=c++17 -O2 -Wall -Wextra -Werror -ffp-contract=off";

fn bundle(subject: &Subject<'_>) -> Bundle {
    let port = Port::new(subject, &RULES);
    let texts = [(".hpp", header::text(&port)), ("_check.cpp", check::text(&port))];
    port.bundle(texts, &format!("c++ {FLAGS} FIELD_check.cpp -o FIELD_check && ./FIELD_check"))
}
