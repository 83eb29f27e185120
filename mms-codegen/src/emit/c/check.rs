//! The program that checks a build: test vectors, and a comparison.

use std::fmt::Write as _;

use super::comment;
use crate::emit::port::Port;
use crate::emit::port::callable::Callable;
use crate::emit::port::number::hexadecimal;
use crate::emit::port::vectors::Vectors;
use crate::emit::text::listed;

/// The text of `FIELD_check.c`.
pub(super) fn text(port: &Port<'_>) -> String {
    let vectors = port.subject.vectors();
    let (name, upper) = (&port.name, port.name.to_ascii_uppercase());
    let mut header = port.header();
    header.push(format!(
        "Checks a build of {name}.c: runs every function at the points below, prints its worst error, and fails where that is not accepted. {}",
        vectors.meaning()
    ));
    let mut text = comment(&header, "");
    text += &format!(
        "#include \"{name}.h\"\n\n#include <float.h>\n#include <math.h>\n#include <stdio.h>\n\n"
    );
    text += &format!(
        "enum {{ SETS = {}, SAMPLES = {} }};\n\n",
        vectors.sets.len(),
        vectors.samples.len()
    );
    if vectors.accepted_in_single.is_none() {
        text += &format!(
            "#ifdef {upper}_FLOAT\n#error \"the numbers of {name} are beyond the range of float\"\n#endif\n\n"
        );
    }
    text += &tables(port, vectors);
    let program = include_str!("support/check.c");
    text += &program
        .replace("FIELD", &upper)
        .replace("field_:", &format!("{name}:"))
        .replace("field_", &format!("{name}_"));
    text += &main(port, vectors);
    text
}

fn tables(port: &Port<'_>, vectors: &Vectors) -> String {
    let mut text = String::new();
    if !port.parameters.is_empty() {
        text += &format!(
            "/* Parameters: the defaults, others, and extremes. */\n\
             static const double sets[SETS][{}] = {{\n",
            port.parameters.len()
        );
        vectors.sets.iter().for_each(|set| text += &row(set));
        text += "};\n\n";
    }
    if !vectors.samples.is_empty() {
        text += &samples(port, vectors);
    }
    for (callable, expected) in port.callables.iter().zip(&vectors.expected) {
        if expected.is_empty() {
            continue;
        }
        let rows = if callable.is_of_points() { "SAMPLES" } else { "SETS" };
        text += &format!(
            "static const double {}_expected[{rows}][{}] = {{\n",
            callable.name,
            callable.components.len()
        );
        expected.iter().for_each(|values| text += &row(values));
        text += "};\n\n";
    }
    text
}

/// The points: of which set of parameters, t, X, N and H.
fn samples(port: &Port<'_>, vectors: &Vectors) -> String {
    let (name, dimension) = (&port.name, port.dimension());
    format!(
        "static const struct {{\n    int set;\n    {name}_real t, X[{dimension}], N[{dimension}], H[{}];\n\
         }} samples[SAMPLES] = {{\n{}}};\n\n",
        dimension * dimension,
        sample_rows(vectors)
    )
}

/// The same as rows of a table.
pub(in crate::emit) fn sample_rows(vectors: &Vectors) -> String {
    let rows = vectors.samples.iter().map(|sample| {
        let arrays = [&sample.coordinates, &sample.normal, &sample.gradient];
        let arrays = arrays.map(|values| format!("{{{}}}", hexadecimals(values).join(", ")));
        let time = hexadecimal(sample.time);
        let items: Vec<_> = [sample.set.to_string(), time].into_iter().chain(arrays).collect();
        format!("    {{{}}},\n", listed(&items, 92).join("\n     "))
    });
    rows.collect()
}

fn hexadecimals(values: &[f64]) -> Vec<String> {
    values.iter().map(|value| hexadecimal(*value)).collect()
}

/// A row of numbers.
pub(in crate::emit) fn row(values: &[f64]) -> String {
    format!("    {{{}}},\n", listed(&hexadecimals(values), 92).join("\n     "))
}

fn main(port: &Port<'_>, vectors: &Vectors) -> String {
    let name = &port.name;
    let mut text = "int main(void)\n{\n".to_string();
    let timed = port.callables.iter().any(|callable| callable.time);
    if !port.parameters.is_empty() {
        text += &format!("    const {name}_parameters defaults = {name}_default_parameters();\n");
    }
    text += &format!("    static {name}_field fields[SETS];\n");
    let samples = !vectors.samples.is_empty();
    if timed && samples {
        text += &format!("    static {name}_instant now[SAMPLES];\n");
    }
    let set: Vec<String> =
        (0..port.parameters.len()).map(|place| format!("({name}_real)sets[s][{place}]")).collect();
    let set = if set.is_empty() { "0".into() } else { listed(&set, 84).join("\n            ") };
    text += &format!(
        "    for (int s = 0; s < SETS; s++) {{\n        const {name}_parameters parameters = {{\n            \
         {set}\n        }};\n        fields[s] = {name}_prepare(&parameters);\n    }}\n"
    );
    if timed && samples {
        text += &format!(
            "    for (int s = 0; s < SAMPLES; s++) {{\n        now[s] = {name}_at_time(&fields[samples[s].set], samples[s].t);\n    }}\n"
        );
    }
    for (parameter, value) in port.parameters.values().zip(&vectors.defaults) {
        let _ = writeln!(text, "    CHECK_DEFAULT({parameter}, {});", hexadecimal(*value));
    }
    for (place, callable) in port.callables.iter().enumerate() {
        if samples || !callable.is_of_points() {
            let accepted = accepted(name, vectors, place);
            let _ = writeln!(text, "    {}", check(port, callable, &accepted));
        }
    }
    text + "    return conclude();\n}\n"
}

/// The accepted error, which may be another one in single precision.
fn accepted(name: &str, vectors: &Vectors, place: usize) -> String {
    let double = vectors.accepted[place];
    match vectors.accepted_in_single.as_ref().map(|single| single[place]) {
        Some(single) if single != double => {
            format!("sizeof({name}_real) < sizeof(double) ? {single} : {double}")
        }
        _ => double.to_string(),
    }
}

fn check(port: &Port<'_>, callable: &Callable, accepted: &str) -> String {
    let subject = match (callable.time, callable.is_of_points()) {
        (true, _) => "&now[s]",
        (false, true) => "&fields[samples[s].set]",
        (false, false) => "&fields[s]",
    };
    let mut arguments = vec![subject.to_string()];
    arguments.extend(callable.arrays().iter().map(|(array, _)| format!("samples[s].{array}")));
    let mut start = "";
    if callable.is_scalar() {
        start = "out[0] = ";
    } else {
        arguments.push("out".into());
    }
    let kind = if callable.is_of_points() { "CHECK" } else { "CHECK_DOMAIN" };
    let count = callable.components.len();
    let call = format!("{start}{}_{}({})", port.name, callable.name, arguments.join(", "));
    let line = format!("{kind}({}, {count}, {accepted}, {call});", callable.name);
    if line.len() <= 96 {
        return line;
    }
    format!("{kind}({}, {count}, {accepted},\n          {call});", callable.name)
}
