//! The program that checks the header: test vectors, and a comparison in both precisions.

use std::fmt::Write as _;

use crate::emit::c::check::{row, sample_rows};
use crate::emit::c::{broken, comment};
use crate::emit::port::Port;
use crate::emit::port::callable::Callable;
use crate::emit::port::number::hexadecimal;
use crate::emit::port::vectors::Vectors;

/// The text of `FIELD_check.cpp`.
pub(super) fn text(port: &Port<'_>) -> String {
    let vectors = port.subject.vectors();
    let (name, dimension) = (&port.name, port.dimension());
    let mut header = port.header();
    header.push(format!(
        "Checks {name}.hpp: runs every function at the points below, prints its worst error, and fails where that is not accepted. {}",
        vectors.meaning()
    ));
    let mut text = comment(&header, "");
    let _ = write!(
        text,
        "#include \"{name}.hpp\"\n\n#include <array>\n#include <cmath>\n#include <cstdio>\n#include <limits>\n\n\
         namespace {{\n\nconstexpr int SETS = {}, SAMPLES = {};\n\n",
        vectors.sets.len(),
        vectors.samples.len()
    );
    if !port.parameters.is_empty() {
        text += "/// Parameters: the defaults, others, and extremes.\n";
        let _ = writeln!(text, "constexpr double sets[SETS][{}] = {{", port.parameters.len());
        vectors.sets.iter().for_each(|set| text += &row(set));
        text += "};\n\n";
    }
    if !vectors.samples.is_empty() {
        let _ = write!(
            text,
            "struct Sample {{\n    int set;\n    double t, X[{dimension}], N[{dimension}], H[{}];\n}};\n\n\
             constexpr Sample samples[SAMPLES] = {{\n{}}};\n\n",
            dimension * dimension,
            sample_rows(vectors)
        );
    }
    for (callable, expected) in port.callables.iter().zip(&vectors.expected) {
        if expected.is_empty() {
            continue;
        }
        let rows = if callable.is_of_points() { "SAMPLES" } else { "SETS" };
        let count = callable.components.len();
        let _ = writeln!(text, "constexpr double {}_expected[{rows}][{count}] = {{", callable.name);
        expected.iter().for_each(|values| text += &row(values));
        text += "};\n\n";
    }
    text += &include_str!("support/check.hpp").replace("field_ ", &format!("{name} "));
    text += "\ntemplate <class T> int check(const char *precision)\n{\n";
    text += &body(port, vectors);
    text += "    return errors.conclude();\n}\n\n} // namespace\n\nint main()\n{\n";
    text += "    int failures = check<double>(\"double precision\");\n";
    if vectors.accepted_in_single.is_some() {
        text += "    failures += check<float>(\"single precision\");\n";
    }
    text + "    return failures == 0 ? 0 : 1;\n}\n"
}

fn body(port: &Port<'_>, vectors: &Vectors) -> String {
    let name = &port.name;
    let mut text = "    Check<T> errors(precision);\n".to_string();
    if !port.parameters.is_empty() {
        let _ = writeln!(text, "    const auto defaults = {name}::default_parameters<T>();");
    }
    for (parameter, value) in port.parameters.values().zip(&vectors.defaults) {
        let _ = writeln!(
            text,
            "    errors.compare(0, &std::array<double, 1>{{{}}}[0], &defaults.{parameter}, 1);\n    \
             errors.settle(\"default of {parameter}\", 1);",
            hexadecimal(*value)
        );
    }
    let _ =
        writeln!(text, "    {name}::Field<T> fields[SETS];\n    for (int s = 0; s < SETS; s++) {{");
    let _ = writeln!(text, "        {name}::Parameters<T> parameters{{}};");
    for (index, parameter) in port.parameters.values().enumerate() {
        let _ =
            writeln!(text, "        parameters.{parameter} = static_cast<T>(sets[s][{index}]);");
    }
    let _ = writeln!(text, "        fields[s] = {name}::prepare(parameters);\n    }}");
    let single = vectors.accepted_in_single.as_ref().unwrap_or(&vectors.accepted);
    for (place, callable) in port.callables.iter().enumerate() {
        if vectors.expected[place].is_empty() {
            continue;
        }
        text += &check(port, callable, vectors.accepted[place].max(single[place]));
    }
    text
}

fn check(port: &Port<'_>, callable: &Callable, accepted: u32) -> String {
    let name = &port.name;
    let (rows, set) = match callable.is_of_points() {
        true => ("SAMPLES", "samples[s].set"),
        false => ("SETS", "s"),
    };
    let subject = match callable.time {
        true => format!("{name}::at_time(fields[{set}], static_cast<T>(samples[s].t))"),
        false => format!("fields[{set}]"),
    };
    let (function, count) = (&callable.name, callable.components.len());
    let mut arguments = vec!["subject".to_string()];
    let mut given = String::new();
    for (array, _) in callable.arrays() {
        let _ = writeln!(given, "        const auto {array} = of<T>(samples[s].{array});");
        arguments.push(format!("{array}.data()"));
    }
    let mut start = "out[0] = ";
    if !callable.is_scalar() {
        start = "";
        arguments.push("out".into());
    }
    let mut text = format!(
        "    for (int s = 0; s < {rows}; s++) {{\n        const auto subject = {subject};\n{given}        \
         T out[{count}];\n        {start}{name}::{function}({});\n        \
         errors.compare({set}, {function}_expected[s], out, {count});\n",
        arguments.join(", ")
    );
    if callable.is_of_points() {
        text += &batch(port, callable);
    }
    text + &format!("    }}\n    errors.settle(\"{function}\", {accepted});\n")
}

/// The same through the function of many points: the first point, whatever it gives, and this one.
fn batch(port: &Port<'_>, callable: &Callable) -> String {
    let (function, count) = (&callable.name, callable.components.len());
    let mut text = String::new();
    let mut arguments = vec!["subject".to_string(), "2".into()];
    for (array, count) in callable.arrays() {
        let _ = writeln!(
            text,
            "        const auto {array}s = columns<T>(samples[0].{array}, samples[s].{array});"
        );
        arguments.extend((0..count).map(|index| format!("&{array}s[{}]", 2 * index)));
    }
    arguments.extend((0..count).map(|index| format!("&both[{}]", 2 * index)));
    let call = broken(&format!("        {}::{function}_batch", port.name), &arguments, ";");
    text + &format!(
        "        T both[{}];\n{call}\n        \
         errors.compare(samples[s].set, {function}_expected[s], second(both).data(), {count});\n",
        2 * count
    )
}
