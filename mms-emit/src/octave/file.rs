//! The file: one function, which returns handles to those below it.

use std::fmt::Write as _;

use super::comment;
use super::dialect::Octave;
use crate::port::Port;
use crate::port::body::{Place, local};
use crate::port::callable::Callable;
use crate::port::support::Support;
use mms_mechanics::Output;

const WIDE: &str = include_str!("support/wide.m");
const POINT: &str = include_str!("support/point.m");

/// The text of `FIELD.m`.
pub(super) fn text(port: &Port<'_>) -> String {
    let functions = defaults(port) + &prepare(port) + &at_time(port) + &evaluations(port);
    let needed = |text| Support::new(text, &["%"]).needed(&functions);
    let mut text = face(port) + &functions;
    for block in needed(POINT).into_iter().chain(needed(WIDE)) {
        let _ = write!(text, "\n{block}\n");
    }
    text
}

/// What a user calls.
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
        text += &comment(&[callable.documentation(port.dimension())], "  ");
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

/// The results: each component, or one row where nothing is of points.
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

fn indented(statements: &[String]) -> String {
    statements.iter().map(|statement| format!("  {statement}\n")).collect()
}

fn defaults(port: &Port<'_>) -> String {
    let roots: Vec<_> =
        port.parameters.keys().map(|index| port.values(Output::Parameter(*index))[0]).collect();
    let body = port.body(&Octave, &roots, Place::Parameters);
    let mut text = "\nfunction parameters = default_parameters()\n".to_string();
    text += &indented(&body.statements);
    text += "  parameters = struct();\n";
    for ((index, name), value) in port.parameters.iter().zip(&body.results) {
        text += &comment(&[port.parameter_doc(*index)], "  ");
        let _ = writeln!(text, "  parameters.{name} = {value};");
    }
    text + "end\n"
}

fn prepare(port: &Port<'_>) -> String {
    let roots: Vec<_> = port.kept.iter().chain(&port.kept_wide).copied().collect();
    let body = port.body(&Octave, &roots, Place::Parameters);
    let mut text = "\nfunction field = prepare(parameters)\n".to_string();
    text += &indented(&body.statements);
    text += "  field = struct();\n";
    for (value, result) in port.kept.iter().zip(&body.results) {
        let _ = writeln!(text, "  field.{} = {result};", local(*value, false));
    }
    for value in &port.kept_wide {
        let _ = writeln!(text, "  field.{0} = {0};", local(*value, true));
    }
    text + "end\n"
}

fn at_time(port: &Port<'_>) -> String {
    let body = port.body(&Octave, &port.kept_at_times, Place::Times);
    let mut text = "\nfunction now = at_time(field, t)\n".to_string();
    text += &indented(&body.statements);
    text += "  now = struct();\n";
    for (value, result) in port.kept_at_times.iter().zip(&body.results) {
        let _ = writeln!(text, "  now.{} = {result};", local(*value, false));
    }
    text + "end\n"
}

fn evaluations(port: &Port<'_>) -> String {
    port.callables.iter().map(|callable| evaluation(port, callable)).collect()
}

fn evaluation(port: &Port<'_>, callable: &Callable) -> String {
    let place = Place::Points { timed: callable.time };
    let body = port.body(&Octave, port.values(callable.output), place);
    let mut text = format!(
        "\nfunction {} = evaluate_{}({})\n",
        results(callable),
        callable.name,
        arguments(callable)
    );
    text += &indented(&body.statements);
    if callable.is_of_points() {
        let like = callable.input_names().join(" + ");
        let _ = writeln!(text, "  like = {like};");
        for (component, result) in callable.components.iter().zip(&body.results) {
            let _ = writeln!(text, "  {component} = shaped({result}, like);");
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
