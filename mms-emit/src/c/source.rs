//! The source file: definitions, and what C lacks.

use std::fmt::Write as _;

use super::dialect::C;
use super::header::{batch_head, head, subject};
use super::{broken, comment};
use crate::port::Port;
use crate::port::body::{Bodies, Body, local};
use crate::port::callable::Callable;
use crate::port::support::Support;
use crate::text::indented;

/// Twice the digits of a double, in C++ too.
pub(crate) const WIDE: &str = include_str!("support/wide.c");
/// Functions of a point that C lacks, in C++ too.
pub(crate) const POINT: &str = include_str!("support/point.c");

/// The text of `FIELD.c`.
pub(super) fn text(port: &Port<'_>) -> String {
    let bodies = port.bodies(&C);
    let calls = bodies.calls();
    let [wide, point] = [WIDE, POINT].map(|text| support(text).needed(&calls).join("\n\n"));
    let (name, upper) = (&port.name, port.name.to_ascii_uppercase());
    let mut text = comment(&port.header(), "");
    text += &format!("#include \"{name}.h\"\n\n#include <math.h>\n\n");
    if !wide.is_empty() {
        text += "#ifdef __FAST_MATH__\n\
                 #error \"-ffast-math takes away the digits that double-double arithmetic gains\"\n\
                 #endif\n\n";
    }
    text += &format!(
        "typedef {name}_real real;\n\n#define REAL(number) ((real)(number))\n\
         #ifdef {upper}_FLOAT\n#define MATH(function) function##f\n\
         #else\n#define MATH(function) function\n#endif\n\n"
    );
    if !wide.is_empty() {
        text += &match port.kept_wide.is_empty() {
            true => "/* A number of twice the digits of a double. */\n\
                     typedef struct { double high, low; } wide;\n\n"
                .into(),
            false => format!("typedef {name}_wide wide;\n\n"),
        };
    }
    for support in [wide, point].iter().filter(|support| !support.is_empty()) {
        text += support;
        text += "\n\n";
    }
    text + &functions(port, &bodies)
}

/// The blocks of a support text in C.
pub(crate) fn support(text: &'static str) -> Support {
    Support::new(text, &["/*", "#"])
}

fn functions(port: &Port<'_>, bodies: &Bodies) -> String {
    let mut text = defaults(port, &bodies.defaults) + "\n";
    text += &(prepare(port, &bodies.prepare) + "\n" + &at_time(port, &bodies.at_time));
    for (callable, body) in port.with_bodies(bodies) {
        text += "\n";
        text += &match callable.is_of_points() {
            true => of_many_points(port, callable, body) + "\n" + &of_one_point(port, callable),
            false => of_no_point(port, callable, body),
        };
    }
    text
}

fn defaults(port: &Port<'_>, body: &Body) -> String {
    let name = &port.name;
    let mut text = format!("{name}_parameters {name}_default_parameters(void)\n{{\n");
    text += &format!("    {name}_parameters parameters;\n");
    text += &indented(&body.statements, 4);
    for (member, value) in port.parameters.values().zip(&body.results) {
        let _ = writeln!(text, "    parameters.{member} = {value};");
    }
    if port.parameters.is_empty() {
        text += "    parameters.none = 0;\n";
    }
    text + "    return parameters;\n}\n"
}

fn prepare(port: &Port<'_>, body: &Body) -> String {
    let name = &port.name;
    let mut text =
        format!("{name}_field {name}_prepare(const {name}_parameters *parameters)\n{{\n");
    text += &format!("    {name}_field field;\n");
    text += &indented(&body.statements, 4);
    if !body.reads_parameters() {
        text += "    (void)parameters;\n";
    }
    for (value, result) in port.kept.iter().zip(&body.results) {
        let _ = writeln!(text, "    field.{} = {result};", local(*value, false));
    }
    for value in &port.kept_wide {
        let wide = local(*value, true);
        let _ = writeln!(text, "    field.{wide} = {wide};");
    }
    if body.results.is_empty() {
        text += "    field.none = 0;\n";
    }
    text + "    return field;\n}\n"
}

fn at_time(port: &Port<'_>, body: &Body) -> String {
    let name = &port.name;
    let arguments = [format!("const {name}_field *field"), format!("{name}_real t")];
    let mut text = broken(&format!("{name}_instant {name}_at_time"), &arguments, "\n{\n");
    text += &format!("    {name}_instant now;\n");
    text += &indented(&body.statements, 4);
    if !body.reads_kept {
        text += "    (void)field;\n";
    }
    if body.inputs.is_empty() {
        text += "    (void)t;\n";
    }
    for (value, result) in port.kept_at_times.iter().zip(&body.results) {
        let _ = writeln!(text, "    now.{} = {result};", local(*value, false));
    }
    if port.kept_at_times.is_empty() {
        text += "    now.none = 0;\n";
    }
    text + "    return now;\n}\n"
}

/// A loop over points, which is where a function is computed.
fn of_many_points(port: &Port<'_>, callable: &Callable, body: &Body) -> String {
    let mut text = batch_head(port, callable, "restrict ") + "\n{\n";
    if !body.reads_kept {
        let _ = writeln!(text, "    (void){};", if callable.time { "now" } else { "field" });
    }
    for symbol in callable.inputs.iter().filter(|symbol| !body.inputs.contains(symbol)) {
        let _ = writeln!(text, "    (void){};", port.input(*symbol));
    }
    text += "    for (size_t i = 0; i < n; i++) {\n";
    text += &indented(&body.statements, 8);
    for (component, value) in callable.components.iter().zip(&body.results) {
        let _ = writeln!(text, "        {component}[i] = {value};");
    }
    text + "    }\n}\n"
}

/// A function of one point, which calls the function of many points.
fn of_one_point(port: &Port<'_>, callable: &Callable) -> String {
    let mut arguments = vec![if callable.time { "now" } else { "field" }.to_string(), "1".into()];
    for (array, count) in callable.arrays() {
        arguments.extend((0..count).map(|index| format!("&{array}[{index}]")));
    }
    let count = callable.components.len();
    let mut text = head(port, callable) + "\n{\n";
    let call = format!("{}_{}_batch", port.name, callable.name);
    if callable.is_scalar() {
        text += "    real out;\n";
        arguments.push("&out".into());
    } else {
        arguments.extend((0..count).map(|index| format!("&out[{index}]")));
    }
    text += &broken(&format!("    {call}"), &arguments, ";\n");
    if callable.is_scalar() {
        text += "    return out;\n";
    }
    text + "}\n"
}

/// A function of no point: a part of the domain.
fn of_no_point(port: &Port<'_>, callable: &Callable, body: &Body) -> String {
    let mut text = head(port, callable) + "\n{\n";
    debug_assert!(subject(port, callable).ends_with("field"));
    if !body.reads_kept {
        text += "    (void)field;\n";
    }
    text += &indented(&body.statements, 4);
    if callable.is_scalar() {
        let _ = writeln!(text, "    return {};", body.results[0]);
    } else {
        for (index, value) in body.results.iter().enumerate() {
            let _ = writeln!(text, "    out[{index}] = {value};");
        }
    }
    text + "}\n"
}
