//! Fortran 2008: a module of elemental procedures, its interface for C, and a program that checks both.

mod check;
mod dialect;
mod face;
mod module;

use crate::port::Port;
use crate::port::names::{FUNCTIONS, Rules};
use crate::target::{Bundle, Subject, Target};
use crate::text::wrapped;

/// Fortran.
pub const TARGET: Target = Target {
    name: "fortran",
    alias: None,
    doc: "Fortran 2008: a module of pure elemental procedures, its interface for C, and a check program",
    emit: bundle,
    words: RULES.words,
};

/// Rules of Fortran for names: up to 63 characters, in any case. No word is reserved, but a module must not have the name of an
/// item in it.
const RULES: Rules = Rules {
    words: &["none"],
    modules: &[
        "wide dp wp settled complement two_sum two_product dimension none iso_fortran_env \
         iso_c_binding omp_lib mpi ieee_arithmetic",
        FUNCTIONS,
        "parameters_type field_type instant_type",
    ],
    folds_case: true,
    longest: 57,
};

const FLAGS: &str = "-std=f2008 -O2 -Wall -Wextra -Werror -ffp-contract=off";

fn bundle(subject: &Subject<'_>) -> Bundle {
    let port = Port::new(subject, &RULES);
    let texts = [
        (".f90", module::text(&port)),
        ("_c.f90", face::text(&port)),
        ("_check.f90", check::text(&port)),
    ];
    let files = "FIELD.f90 FIELD_c.f90 FIELD_check.f90";
    port.bundle(texts, &format!("gfortran {FLAGS} {files} -o FIELD_check && ./FIELD_check"))
}

/// Paragraphs as lines of a comment.
fn comment(paragraphs: &[String], indent: &str) -> String {
    let paragraphs: Vec<Vec<String>> =
        paragraphs.iter().map(|text| wrapped(text, 96 - indent.len())).collect();
    let lines = paragraphs.join(&String::new());
    let lines = lines.iter().map(|line| format!("{indent}! {line}").trim_end().to_string() + "\n");
    lines.collect()
}

/// A text as a comment of documentation.
fn documented(text: &str, indent: &str) -> String {
    let lines = wrapped(text, 95 - indent.len());
    lines.iter().map(|line| format!("{indent}!> {line}\n")).collect()
}

/// Items in brackets after `start`, on as many lines as they need.
fn continued(start: &str, items: &[String], end: &str) -> String {
    let line = format!("{start}({}){end}", items.join(", "));
    if line.len() <= 100 {
        return line + "\n";
    }
    let indent = " ".repeat(start.len() - start.trim_start().len() + 4);
    let lines = crate::text::listed(items, 90);
    format!("{start}( &\n{indent}{}){end}\n", lines.join(&format!(" &\n{indent}")))
}

/// The declaration of some names, or nothing, in statements of a few names each.
fn declared(kind: &str, names: &[String], indent: &str) -> String {
    names.chunks(8).map(|names| format!("{indent}{kind} :: {}\n", names.join(", "))).collect()
}
