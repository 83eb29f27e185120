//! The program that checks the header: test vectors, and a comparison in both precisions.

use std::fmt::Write as _;

use crate::c::check::{block, numbers, row};
use crate::c::{broken, comment};
use crate::port::Port;
use crate::port::check::{Check, columns, without};
use crate::port::number::hexadecimal;
use crate::port::vectors::Sample;

/// The text of `FIELD_check.cpp`.
pub(super) fn text(port: &Port<'_>) -> String {
    let name = &port.name;
    let mut text = comment(&port.check_header(&format!("{name}.hpp")), "");
    let _ = write!(
        text,
        "#include \"{name}.hpp\"\n\n#include <array>\n#include <cmath>\n#include <cstdio>\n#include <limits>\n\n\
         namespace mms_check {{\nnamespace {{\n\n"
    );
    text + &tables(port) + &program(port)
}

fn tables(port: &Port<'_>) -> String {
    let (name, dimension) = (&port.name, port.dimension());
    let (vectors, samples) = (port.subject.vectors(), port.samples());
    let mut text =
        format!("constexpr int SETS = {}, POINTS = {};\n\n", vectors.sets.len(), port.points());
    let real = |value: &f64| match f64::from(*value as f32) == *value {
        true => hexadecimal(*value),
        false => format!("T({})", hexadecimal(*value)),
    };
    let set = |set: &Vec<f64>| row(&set.iter().map(real).collect::<Vec<_>>(), 4);
    let sets: String = vectors.sets.iter().map(|it| format!("    {{{}}},\n", set(it))).collect();
    let _ = write!(
        text,
        "/// Parameters: the defaults, others, and extremes.\n\
         template <class T> constexpr {name}::Parameters<T> sets[SETS] = {{\n{sets}}};\n\n"
    );
    if !samples.is_empty() {
        let squared = dimension * dimension;
        let points: String = samples.iter().map(|samples| points(samples)).collect();
        let _ = write!(
            text,
            "/// The points of a set of parameters.\ntemplate <class T> struct Points {{\n    \
             T t[POINTS], X[{dimension}][POINTS], N[{dimension}][POINTS], H[{squared}][POINTS];\n}};\n\n\
             template <class T> constexpr Points<T> points[SETS] = {{\n{points}}};\n\n"
        );
    }
    for Check { callable, expected, .. } in port.checks() {
        let (function, count) = (&callable.name, callable.components.len());
        let (shape, values): (_, String) = match callable.is_of_points() {
            true => (
                format!("[{count}][POINTS]"),
                expected.iter().map(|it| block(&columns(it), 4)).collect(),
            ),
            false => (
                format!("[{count}]"),
                expected.iter().map(|it| format!("    {{{}}},\n", numbers(&it[0], 4))).collect(),
            ),
        };
        let _ =
            write!(text, "constexpr double expected_{function}[SETS]{shape} = {{\n{values}}};\n\n");
    }
    text
}

/// The points of a set of parameters, as columns.
fn points(samples: &[Sample]) -> String {
    let column = |of: fn(&Sample) -> &Vec<f64>| {
        let rows: Vec<Vec<f64>> = samples.iter().map(|sample| of(sample).clone()).collect();
        block(&columns(&rows), 8)
    };
    let times: Vec<f64> = samples.iter().map(|sample| sample.time).collect();
    format!(
        "    {{\n        {{{}}},\n{}{}{}    }},\n",
        numbers(&times, 8),
        column(|it| &it.coordinates),
        column(|it| &it.normal),
        column(|it| &it.gradient)
    )
}

/// The program itself, with its list of functions.
fn program(port: &Port<'_>) -> String {
    let (name, checks) = (&port.name, port.checks());
    let widest = checks.iter().map(|check| check.callable.components.len()).max().unwrap_or(1);
    let mut text = include_str!("support/check.hpp").to_string();
    if port.points() == 0 {
        text = without(&text, "/// The numbers of a point", "template <class T> void check_all");
        text = without(&text, "        const auto &at", "        FUNCTIONS");
    }
    if checks.iter().any(|check| check.accepted_in_single.is_none()) {
        text = text.replace("    check_all<float>();\n", "");
    }
    let functions: String = match checks.is_empty() {
        true => "        (void)field;\n        (void)out;\n".into(),
        false => checks.iter().map(|check| call(name, check)).collect(),
    };
    text.replace("WIDEST", &widest.to_string())
        .replace("field_", name)
        .replace("    DEFAULTS\n", &defaults(port))
        .replace("        FUNCTIONS\n", &functions)
}

/// The lines that check the defaults of the parameters.
fn defaults(port: &Port<'_>) -> String {
    let mut text = match port.parameters.is_empty() {
        true => String::new(),
        false => format!("    const auto defaults = {}::default_parameters<T>();\n", port.name),
    };
    for (parameter, value) in port.parameters.values().zip(&port.subject.vectors().defaults) {
        let value = hexadecimal(*value);
        let _ = writeln!(
            text,
            "    check(\"default of {parameter}\", 1, 1, std::array{{{value}}}.data(), &defaults.{parameter});"
        );
    }
    text
}

/// The lines that check a function.
fn call(name: &str, check: &Check<'_>) -> String {
    let (callable, accepted) = (check.callable, check.accepted_in_both());
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
            "{}        check(\"{function}\", {count}, {accepted}, expected_{function}[set], out);\n",
            one("        ", ";\n")
        );
    }
    let indent = " ".repeat(14);
    let many = broken(&format!("{indent}{name}::{function}_batch"), &many, ");\n");
    format!("        CHECK({function}, {count}, {accepted},\n{}{many}", one(&indent, ",\n"))
}
