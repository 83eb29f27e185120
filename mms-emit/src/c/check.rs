//! The program that checks a build: test vectors, and a comparison.

use std::fmt::Write as _;

use super::comment;
use crate::port::Port;
use crate::port::check::{Check, without};
use crate::port::number::hexadecimal;
use crate::port::vectors::Sample;
use crate::text::listed;

/// The text of `FIELD_check.c`.
pub(super) fn text(port: &Port<'_>) -> String {
    let vectors = port.subject.vectors();
    let (name, upper) = (&port.name, port.name.to_ascii_uppercase());
    let mut text = comment(&port.check_header(&format!("a build of {name}.c")), "");
    let _ = write!(
        text,
        "#include \"{name}.h\"\n\n#include <float.h>\n#include <math.h>\n#include <stdio.h>\n\ntypedef {name}_real real;\n\n"
    );
    if vectors.accepted_in_single.is_none() {
        let _ = write!(
            text,
            "#ifdef {upper}_FLOAT\n#error \"the numbers of {name} are beyond the range of float\"\n#endif\n\n"
        );
    }
    text += &tables(port);
    text + &program(port)
}

fn tables(port: &Port<'_>) -> String {
    let (name, dimension) = (&port.name, port.dimension());
    let (vectors, samples) = (port.subject.vectors(), port.samples());
    let mut text =
        format!("enum {{ SETS = {}, POINTS = {} }};\n\n", vectors.sets.len(), port.points());
    let real = |value: &f64| match f64::from(*value as f32) == *value {
        true => hexadecimal(*value),
        false => format!("(real){}", hexadecimal(*value)),
    };
    let sets = vectors.sets.iter().map(|set| match set.as_slice() {
        [] => "0".into(),
        set => row(&set.iter().map(real).collect::<Vec<_>>(), 4),
    });
    let sets: String = sets.map(|set| format!("    {{{set}}},\n")).collect();
    let _ = write!(
        text,
        "/* Parameters: the defaults, others, and extremes. */\n\
         static const {name}_parameters sets[SETS] = {{\n{sets}}};\n\n"
    );
    if !samples.is_empty() {
        let squared = dimension * dimension;
        let set = |samples: &&[Sample]| samples.iter().map(sample).collect::<String>();
        let sets = samples.iter().map(|samples| format!("    {{\n{}    }},\n", set(samples)));
        let _ = write!(
            text,
            "/* The points of each set of parameters. */\nstatic const struct point {{\n    \
             real t, X[{dimension}], N[{dimension}], H[{squared}];\n\
             }} points[SETS][POINTS] = {{\n{}}};\n\n",
            sets.collect::<String>()
        );
    }
    for Check { callable, expected, .. } in port.checks() {
        let rows = if callable.is_of_points() { "POINTS" } else { "1" };
        let (function, count) = (&callable.name, callable.components.len());
        let values = expected.iter().map(|rows| block(rows, 4));
        let _ = write!(
            text,
            "static const double expected_{function}[SETS][{rows}][{count}] = {{\n{}}};\n\n",
            values.collect::<String>()
        );
    }
    text
}

/// A point: t, X, N and H.
fn sample(sample: &Sample) -> String {
    let arrays = [&sample.coordinates, &sample.normal, &sample.gradient];
    let arrays = arrays.map(|values| format!("{{{}}}", numbers(values, 8)));
    let items: Vec<_> = [hexadecimal(sample.time)].into_iter().chain(arrays).collect();
    format!("        {{{}}},\n", row(&items, 8))
}

/// Rows of numbers in a bracket that stands behind `indent` spaces.
pub(crate) fn block(rows: &[Vec<f64>], indent: usize) -> String {
    let row = |row: &Vec<f64>| format!("{:indent$}    {{{}}},\n", "", numbers(row, indent + 4));
    let rows: String = rows.iter().map(row).collect();
    format!("{:indent$}{{\n{rows}{:indent$}}},\n", "", "")
}

/// Numbers behind a bracket that stands behind `indent` spaces.
pub(crate) fn numbers(values: &[f64], indent: usize) -> String {
    let numbers: Vec<String> = values.iter().map(|value| hexadecimal(*value)).collect();
    row(&numbers, indent)
}

/// The same of any items.
pub(crate) fn row(items: &[String], indent: usize) -> String {
    listed(items, 96 - indent).join(&format!("\n{:1$}", "", indent + 1))
}

/// The program itself, with its list of functions.
fn program(port: &Port<'_>) -> String {
    let (name, checks) = (&port.name, port.checks());
    let widest = checks.iter().map(|check| check.callable.components.len()).max().unwrap_or(1);
    let functions: String = match checks.is_empty() {
        true => "        (void)field;\n        (void)found;\n".into(),
        false => checks.iter().map(|check| call(name, check)).collect(),
    };
    let mut text = include_str!("support/check.c").to_string();
    let mut found = format!("POINTS * {widest}");
    if port.points() == 0 {
        found = widest.to_string();
        text = without(&text, "        const struct point", "        FUNCTIONS");
    }
    text.replace("FOUND", &found)
        .replace("field_:", &format!("{name}:"))
        .replace("field_", &format!("{name}_"))
        .replace("    DEFAULTS\n", &defaults(port))
        .replace("        FUNCTIONS\n", &functions)
}

/// The lines that check the defaults of the parameters.
fn defaults(port: &Port<'_>) -> String {
    let name = &port.name;
    let mut text = match port.parameters.is_empty() {
        true => String::new(),
        false => format!("    const {name}_parameters defaults = {name}_default_parameters();\n"),
    };
    for (parameter, value) in port.parameters.values().zip(&port.subject.vectors().defaults) {
        let _ = writeln!(
            text,
            "    check(\"default of {parameter}\", 1, 1, &(const double){{{}}}, &defaults.{parameter});",
            hexadecimal(*value)
        );
    }
    text
}

/// The line that checks a function.
fn call(name: &str, check: &Check<'_>) -> String {
    let callable = check.callable;
    let (function, count) = (&callable.name, callable.components.len());
    let mut arguments = vec![if callable.time { "&now[p]" } else { "&field" }.to_string()];
    arguments.extend(callable.arrays().iter().map(|(array, _)| format!("at[p].{array}")));
    let mut result = "*out = ";
    if !callable.is_scalar() {
        result = "";
        arguments.push("out".into());
    }
    let rows = if callable.is_of_points() { "POINTS" } else { "1" };
    let accepted = match check.accepted_in_single {
        Some(single) if single != check.accepted => {
            format!("sizeof(real) < sizeof(double) ? {single} : {}", check.accepted)
        }
        _ => check.accepted.to_string(),
    };
    let start = format!("        CHECK({function}, {rows}, {count}, {accepted},");
    let call = format!("{result}{name}_{function}({}));\n", arguments.join(", "));
    let between = if start.len() + call.len() <= 100 { " " } else { "\n              " };
    start + between + &call
}
