//! The program that checks a build: calls of every function, and a comparison.

use std::fmt::Write as _;

use super::comment;
use crate::port::Port;
use crate::port::check::Check;

/// The text that reads the test vectors, in C and in C++.
const VECTORS: &str = include_str!("support/vectors.c");

/// The text of `FIELD_check.c`.
pub(super) fn text(port: &Port<'_>) -> String {
    let (name, upper) = (&port.name, port.name.to_ascii_uppercase());
    let mut text = comment(&port.check_header(&format!("a build of {name}.c")), "");
    let _ = write!(
        text,
        "#include \"{name}.h\"\n\n#include <float.h>\n#include <math.h>\n{INCLUDED}\ntypedef {name}_real real;\n\n"
    );
    if port.subject.vectors().accepted_in_single.is_none() {
        let _ = write!(
            text,
            "#ifdef {upper}_FLOAT\n#error \"the numbers of {name} are beyond the range of float\"\n#endif\n\n"
        );
    }
    text += &format!("{}\n{}\n", sizes(port), reader(port));
    let set = |(place, name)| format!("        parameters.{name} = (real)numbers[{place}];\n");
    let default = |(place, name)| {
        format!("    check(\"default of {name}\", 1, &numbers[{place}], &parameters.{name});\n")
    };
    let parameters = || port.parameters.values().enumerate();
    let calls: String = match port.checks() {
        checks if checks.is_empty() => "        (void)found;\n".into(),
        checks => checks.iter().map(|check| call(name, check)).collect(),
    };
    text + &include_str!("support/check.c")
        .replace("field_:", &format!("{name}:"))
        .replace("field_", &format!("{name}_"))
        .replace("    DEFAULTS\n", &parameters().map(default).collect::<String>())
        .replace("        GIVEN\n", &parameters().map(set).collect::<String>())
        .replace("        FUNCTIONS\n", &calls)
}

/// The headers of the code that reads the test vectors.
pub(crate) const INCLUDED: &str = "#include <stdio.h>\n#include <stdlib.h>\n#include <string.h>\n";

/// Writes the code that reads the test vectors of a field.
pub(crate) fn reader(port: &Port<'_>) -> String {
    VECTORS.replace("VECTORS", &port.vectors_name())
}

/// The sizes of the compared arrays.
pub(crate) fn sizes(port: &Port<'_>) -> String {
    let (sets, points) = (port.subject.vectors().sets.len(), port.points());
    let (parameters, width, widest) = (port.parameters.len(), port.width(), port.widest());
    let largest = (points * width.max(widest)).max(parameters).max(widest);
    format!(
        "enum {{\n    SETS = {sets}, POINTS = {points}, ROOM = {}, DIMENSION = {}, SQUARED = {}, PARAMETERS = {parameters},\n    \
         WIDTH = {width}, WIDEST = {widest}, LARGEST = {largest}, LINE = 256\n}};\n",
        points.max(1),
        port.dimension(),
        port.rows().pow(2)
    )
}

/// The line that checks a function.
fn call(name: &str, check: &Check<'_>) -> String {
    let callable = check.callable;
    let count = callable.components.len();
    let mut arguments = vec![if callable.time { "&now[p]" } else { "&field" }.to_string()];
    arguments.extend(callable.arrays().iter().map(|(array, _)| format!("at[p].{array}")));
    let mut result = "*out = ";
    if !callable.is_scalar() {
        result = "";
        arguments.push("out".into());
    }
    let rows = if callable.is_of_points() { "POINTS" } else { "1" };
    let start = format!("        CHECK({}, {rows}, {count},", check.table);
    let call = format!("{result}{name}_{}({}));\n", callable.name, arguments.join(", "));
    let between = if start.len() + call.len() <= 100 { " " } else { "\n              " };
    start + between + &call
}
