//! The program that checks the header: calls of every function, and a comparison in both precisions.

use std::fmt::Write as _;

use crate::c::check::{INCLUDED, reader, sizes};
use crate::c::{broken, comment};
use crate::port::Port;
use crate::port::check::Check;

/// The text of `FIELD_check.cpp`.
pub(super) fn text(port: &Port<'_>) -> String {
    let name = &port.name;
    let mut text = comment(&port.check_header(&format!("{name}.hpp")), "");
    let _ = write!(
        text,
        "#include \"{name}.hpp\"\n\n#include <array>\n#include <cmath>\n#include <cstdio>\n#include <limits>\n\
         {INCLUDED}\nnamespace mms_check {{\nnamespace {{\n\n{}\n{}\n",
        sizes(port),
        reader(port)
    );
    let mut program = include_str!("support/check.hpp").to_string();
    if port.subject.vectors().accepted_in_single.is_none() {
        program = program.replace("    check_all<float>();\n", "");
    }
    let set = |(place, name)| format!("        parameters.{name} = T(numbers[{place}]);\n");
    let default = |(place, name)| {
        format!("    check(\"default of {name}\", 1, 1, &numbers[{place}], &parameters.{name});\n")
    };
    let parameters = || port.parameters.values().enumerate();
    let calls: String = match port.checks() {
        checks if checks.is_empty() => "        (void)found;\n        (void)out;\n".into(),
        checks => checks.iter().map(|check| call(name, check)).collect(),
    };
    text + &program
        .replace("field_", name)
        .replace("    DEFAULTS\n", &parameters().map(default).collect::<String>())
        .replace("        GIVEN\n", &parameters().map(set).collect::<String>())
        .replace("        FUNCTIONS\n", &calls)
}

/// The lines that check a function.
fn call(name: &str, check: &Check<'_>) -> String {
    let (callable, table) = (check.callable, check.table);
    let (function, count) = (&callable.name, callable.components.len());
    let of = if callable.time { "now[p]" } else { "field" }.to_string();
    let (mut one, mut many) = (vec![of.clone()], vec![of, "p + 1".into()]);
    for (array, count) in callable.arrays() {
        one.push(format!("row(at.{array}, p).data()"));
        many.extend((0..count).map(|k| format!("at.{array}[{k}]")));
    }
    many.extend((0..count).map(|k| format!("found[{k}]")));
    let mut result = "*out = ";
    if !callable.is_scalar() {
        result = "";
        one.push("out".into());
    }
    let one =
        |indent: &str, end: &str| broken(&format!("{indent}{result}{name}::{function}"), &one, end);
    if !callable.is_of_points() {
        return format!(
            "        table(\"{table}\", 1, {count});\n{}        check(\"{table}\", 1, {count}, numbers, out);\n",
            one("        ", ";\n")
        );
    }
    let indent = " ".repeat(14);
    let many = broken(&format!("{indent}{name}::{function}_batch"), &many, ");\n");
    format!("        CHECK({table}, {count},\n{}{many}", one(&indent, ",\n"))
}
