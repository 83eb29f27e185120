//! The file: one function, which returns handles to those below it.

use std::fmt::Write as _;

use super::comment;
use super::dialect::Octave;
use crate::port::Port;
use crate::port::body::{Body, local};
use crate::port::callable::Callable;
use crate::port::support::{Calls, Support};
use crate::text::indented;

const WIDE: &str = include_str!("support/wide.m");
const POINT: &str = include_str!("support/point.m");

/// The text of `FIELD.m`.
pub(super) fn text(port: &Port<'_>) -> String {
    let bodies = port.bodies(&Octave);
    let mut calls = bodies.calls();
    let mut text = face(port) + &defaults(port, &bodies.defaults);
    text += &(prepare(port, &bodies.prepare) + &at_time(port, &bodies.at_time));
    for (callable, body) in port.with_bodies(&bodies) {
        text += &evaluation(callable, body, &mut calls);
    }
    let needed = |text| Support::new(text, &["%"]).needed(&calls);
    for block in needed(POINT).into_iter().chain(needed(WIDE)) {
        let _ = write!(text, "\n{block}\n");
    }
    text
}

/// The function that users call.
fn face(port: &Port<'_>) -> String {
    let name = &port.name;
    let mut header = port.header();
    header.push(format!(
        "f = {name}() has functions as its members: p = f.default_parameters(), field = f.prepare(p), now = f.at_time(field, t), and then quantities of `now` at points. Coordinates are arrays of any shape that broadcast, and each component is a result of its own. {name}_check.m checks the result."
    ));
    let mut text = format!("function f = {name}()\n");
    text += &comment(&header, "  ");
    let _ = writeln!(text, "\n  f.dimension = {};", port.dimension());
    text += "  % The parameters of the field file, or those that were set in their place.\n  \
             f.default_parameters = @default_parameters;\n  \
             % f.prepare(parameters): computes once what only the parameters determine.\n  \
             f.prepare = @prepare;\n  \
             % f.at_time(field, t): computes once what the parameters and the time determine.\n  \
             f.at_time = @at_time;\n";
    for callable in &port.callables {
        text += &comment(&[callable.documentation()], "  ");
        text += &comment(&[usage(callable)], "  ");
        let _ = writeln!(text, "  f.{0} = @evaluate_{0};", callable.name);
    }
    text + "end\n"
}

fn arguments(callable: &Callable) -> String {
    let owner = if callable.time { "now" } else { "field" };
    let mut arguments = vec![owner.to_string()];
    arguments.extend(callable.input_names());
    arguments.join(", ")
}

/// The results: each component, or one row for functions of no point.
fn results(callable: &Callable) -> String {
    match (callable.is_of_points(), callable.components.as_slice()) {
        (_, [one]) => one.clone(),
        (true, several) => format!("[{}]", several.join(", ")),
        (false, _) => callable.name.clone(),
    }
}

fn usage(callable: &Callable) -> String {
    format!("{} = f.{}({})", results(callable), callable.name, arguments(callable))
}

fn defaults(port: &Port<'_>, body: &Body) -> String {
    let mut text = "\nfunction parameters = default_parameters()\n".to_string();
    text += &indented(&body.statements, 2);
    text += "  parameters = struct();\n";
    for ((index, name), value) in port.parameters.iter().zip(&body.results) {
        text += &comment(&[port.parameter_doc(*index)], "  ");
        let _ = writeln!(text, "  parameters.{name} = {value};");
    }
    text + "end\n"
}

fn prepare(port: &Port<'_>, body: &Body) -> String {
    let mut text = "\nfunction field = prepare(parameters)\n".to_string();
    text += &indented(&body.statements, 2);
    text += "  field = struct();\n";
    for (value, result) in port.kept.iter().zip(&body.results) {
        let _ = writeln!(text, "  field.{} = {result};", local(*value, false));
    }
    for value in &port.kept_wide {
        let _ = writeln!(text, "  field.{0} = {0};", local(*value, true));
    }
    text + "end\n"
}

fn at_time(port: &Port<'_>, body: &Body) -> String {
    let mut text = "\nfunction now = at_time(field, t)\n".to_string();
    text += &indented(&body.statements, 2);
    text += "  now = struct();\n";
    for (value, result) in port.kept_at_times.iter().zip(&body.results) {
        let _ = writeln!(text, "  now.{} = {result};", local(*value, false));
    }
    text + "end\n"
}

fn evaluation(callable: &Callable, body: &Body, calls: &mut Calls) -> String {
    let mut text = format!(
        "\nfunction {} = evaluate_{}({})\n",
        results(callable),
        callable.name,
        arguments(callable)
    );
    text += &indented(&body.statements, 2);
    if callable.is_of_points() {
        let shaped = calls.to("shaped");
        let like = callable.input_names().join(" + ");
        let _ = writeln!(text, "  like = {like};");
        for (component, result) in callable.components.iter().zip(&body.results) {
            let _ = writeln!(text, "  {component} = {shaped}({result}, like);");
        }
    } else {
        let value = match body.results.as_slice() {
            [one] => one.clone(),
            several => format!("[{}]", several.join(", ")),
        };
        let _ = writeln!(text, "  {} = {value};", results(callable));
    }
    text + "end\n"
}
