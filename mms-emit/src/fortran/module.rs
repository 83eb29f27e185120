//! The module: types, procedures, and what Fortran lacks.

use std::fmt::Write as _;

use super::dialect::Fortran;
use super::{comment, continued, declared, documented};
use crate::port::Port;
use crate::port::body::{Bodies, Body, local};
use crate::port::callable::Callable;
use crate::port::faces;
use crate::port::motion;
use crate::port::support::Support;
use mms_program::Value;

const WIDE: &str = include_str!("support/wide.f90");
const POINT: &str = include_str!("support/point.f90");

/// The functions of the support text behind the operators.
const OPERATORS: [&str; 6] =
    ["wide_of", "wide_add", "wide_sub", "wide_neg", "wide_mul", "wide_div"];

/// The text of `FIELD.f90`.
pub(super) fn text(port: &Port<'_>) -> String {
    let name = &port.name;
    let bodies = port.bodies(&Fortran);
    let (is_wide, mut calls) = (bodies.are_wide(), bodies.calls());
    if is_wide {
        OPERATORS.iter().for_each(|name| _ = calls.to(name));
    }
    let needed = |text: &'static str| {
        let procedures = text.split_once("contains\n").map_or("", |(_, procedures)| procedures);
        Support::new(procedures, &["!"]).needed(&calls).join("\n\n")
    };
    let support = [needed(WIDE), needed(POINT)];
    let mut header = port.header();
    header.push(format!(
        "Numbers are of the kind wp, real64, which is c_double of iso_c_binding; for single precision change its line to kind(1.0). Compile with -ffp-contract=off: what needs only parameters and the time is computed with twice the digits of a double. {name}_check.f90 checks the result."
    ));
    let mut text = comment(&header, "");
    let _ = write!(
        text,
        "module {name}\n  use, intrinsic :: iso_fortran_env, only: real64\n  implicit none\n  private\n\n"
    );
    let mut public: Vec<&str> = vec!["default_parameters", "prepare", "at_time"];
    public.extend(port.callables.iter().map(|callable| callable.name.as_str()));
    for name in public {
        let _ = writeln!(text, "  public :: {name}");
    }
    let _ = write!(
        text,
        "\n  integer, parameter, public :: wp = real64\n  integer, parameter, public :: dimension = {}\n",
        port.dimension()
    );
    let claims = port.claims(|face, claim| {
        format!("  character(len=*), parameter, public :: face_{face} = \"{claim}\"")
    });
    if !claims.is_empty() {
        let _ = write!(text, "\n  !> {}\n{claims}", faces::DOC);
    }
    let motion = port.motion(|end, numbers| {
        let numbers: Vec<_> = numbers.iter().map(|number| format!("{number}_wp")).collect();
        // On a line of their own, three numbers are less than the 132 columns that Fortran reads.
        let numbers = numbers.join(", ");
        format!("  real(wp), parameter, public :: {end}(dimension) = &\n      [{numbers}]")
    });
    if !motion.is_empty() {
        let _ = write!(text, "\n{}{motion}", documented(motion::DOC, "  "));
    }
    if is_wide {
        // Private ones that nothing uses would be warned of.
        text += "  public :: operator(+), operator(-), operator(*), operator(/)\n\n  \
                 integer, parameter :: dp = real64\n\n";
        text += between(WIDE, "  type :: wide\n", "contains\n");
    } else {
        text += "\n";
    }
    text += &types(port);
    text += "contains\n\n";
    text += &procedures(port, &bodies);
    for part in support.iter().filter(|part| !part.is_empty()) {
        let _ = write!(text, "\n{part}\n");
    }
    let _ = writeln!(text, "\nend module {name}");
    text
}

fn between<'a>(text: &'a str, start: &str, end: &str) -> &'a str {
    let rest = text.find(start).map_or("", |at| &text[at..]);
    rest.split(end).next().unwrap_or("")
}

fn types(port: &Port<'_>) -> String {
    let mut text = "  !> The parameters.\n  type, public :: parameters_type\n".to_string();
    for (index, parameter) in &port.parameters {
        text += &documented(&port.parameter_doc(*index), "    ");
        let _ = writeln!(text, "    real(wp) :: {parameter} = 0.0_wp");
    }
    text += "  end type parameters_type\n\n";
    text += "  !> The values that depend only on the parameters.\n  type, public :: field_type\n    private\n";
    text += &declared("real(wp)", &names(&port.kept, false), "    ");
    text += &declared("type(wide)", &names(&port.kept_wide, true), "    ");
    text += "  end type field_type\n\n";
    text += "  !> The values that depend only on the parameters and the time.\n  type, public :: instant_type\n    private\n";
    text += &declared("real(wp)", &names(&port.kept_at_times, false), "    ");
    text + "  end type instant_type\n\n"
}

fn names(values: &[Value], wide: bool) -> Vec<String> {
    values.iter().map(|value| local(*value, wide)).collect()
}

fn procedures(port: &Port<'_>, bodies: &Bodies) -> String {
    let mut text = defaults(port, &bodies.defaults) + "\n";
    text += &(prepare(port, &bodies.prepare) + "\n" + &at_time(port, &bodies.at_time));
    for (callable, body) in port.with_bodies(bodies) {
        text += "\n";
        text += &match (callable.is_of_points(), callable.is_scalar()) {
            (true, _) => of_points(port, callable, body),
            (false, is_scalar) => of_no_point(callable, body, is_scalar),
        };
    }
    text
}

/// Empty uses of names that are not read, so that no compiler warns about them.
fn unused(names: &[&str]) -> String {
    let uses =
        names.iter().map(|name| format!("    associate (unused => {name})\n    end associate\n"));
    uses.collect()
}

fn statements(body: &Body, kind: &str, uses: &str) -> String {
    let mut text = declared(kind, &body.locals, "    ");
    text += uses;
    for statement in &body.statements {
        let _ = writeln!(text, "    {statement}");
    }
    text
}

fn defaults(port: &Port<'_>, body: &Body) -> String {
    let mut text =
        "  !> The parameters of the field file, or those that were set in their place.\n  \
                    pure function default_parameters() result(parameters)\n    \
                    type(parameters_type) :: parameters\n"
            .to_string();
    text += &statements(body, "type(wide)", "");
    if port.parameters.is_empty() {
        text += "    parameters = parameters_type()\n";
    }
    for (member, value) in port.parameters.values().zip(&body.results) {
        let _ = writeln!(text, "    parameters%{member} = {value}");
    }
    text + "  end function default_parameters\n"
}

fn prepare(port: &Port<'_>, body: &Body) -> String {
    let reads = body.reads_parameters();
    let mut text = "  !> Computes once what only the parameters determine.\n  \
                    pure function prepare(parameters) result(field)\n    \
                    type(parameters_type), intent(in) :: parameters\n    \
                    type(field_type) :: field\n"
        .to_string();
    text += &statements(body, "type(wide)", &unused(if reads { &[] } else { &["parameters"] }));
    if body.results.is_empty() {
        text += "    field = field_type()\n";
    }
    for (value, result) in port.kept.iter().zip(&body.results) {
        let _ = writeln!(text, "    field%{} = {result}", local(*value, false));
    }
    for value in &port.kept_wide {
        let wide = local(*value, true);
        let _ = writeln!(text, "    field%{wide} = {wide}");
    }
    text + "  end function prepare\n"
}

fn at_time(port: &Port<'_>, body: &Body) -> String {
    let mut idle = Vec::new();
    idle.extend((!body.reads_kept).then_some("field"));
    idle.extend(body.inputs.is_empty().then_some("t"));
    let mut text = "  !> Computes once what the parameters and the time determine.\n  \
                    pure function at_time(field, t) result(now)\n    \
                    type(field_type), intent(in) :: field\n    real(wp), intent(in) :: t\n    \
                    type(instant_type) :: now\n"
        .to_string();
    text += &statements(body, "type(wide)", &unused(&idle));
    if port.kept_at_times.is_empty() {
        text += "    now = instant_type()\n";
    }
    for (value, result) in port.kept_at_times.iter().zip(&body.results) {
        let _ = writeln!(text, "    now%{} = {result}", local(*value, false));
    }
    text + "  end function at_time\n"
}

/// An elemental procedure: of one point, or of arrays of any shape.
fn of_points(port: &Port<'_>, callable: &Callable, body: &Body) -> String {
    let (subject, kind) = match callable.time {
        true => ("now", "instant_type"),
        false => ("field", "field_type"),
    };
    let inputs = callable.input_names();
    let mut idle = Vec::new();
    idle.extend((!body.reads_kept).then_some(subject));
    let read = |name: &String| body.inputs.iter().any(|symbol| port.input(*symbol) == *name);
    idle.extend(inputs.iter().filter(|name| !read(name)).map(String::as_str));
    let is_scalar = callable.is_scalar();
    let results: Vec<String> = match is_scalar {
        true => vec!["out".into()],
        false => callable.components.clone(),
    };
    let mut arguments = vec![subject.to_string()];
    arguments.extend(inputs.iter().cloned());
    let mut text = documented(&callable.documentation(), "  ");
    if is_scalar {
        let start = format!("  pure elemental function {}", callable.name);
        text += &continued(&start, &arguments, " result(out)");
    } else {
        arguments.extend(results.iter().cloned());
        text +=
            &continued(&format!("  pure elemental subroutine {}", callable.name), &arguments, "");
    }
    let _ = writeln!(text, "    type({kind}), intent(in) :: {subject}");
    text += &declared("real(wp), intent(in)", &inputs, "    ");
    text +=
        &declared(if is_scalar { "real(wp)" } else { "real(wp), intent(out)" }, &results, "    ");
    text += &statements(body, "real(wp)", &unused(&idle));
    for (component, value) in results.iter().zip(&body.results) {
        let _ = writeln!(text, "    {component} = {value}");
    }
    let what = if is_scalar { "function" } else { "subroutine" };
    let _ = writeln!(text, "  end {what} {}", callable.name);
    text
}

/// A function of no point: a part of the domain.
fn of_no_point(callable: &Callable, body: &Body, is_scalar: bool) -> String {
    let name = &callable.name;
    let count = callable.components.len();
    let shape = if is_scalar { String::new() } else { format!("({count})") };
    let mut text = documented(&callable.documentation(), "  ");
    let _ = writeln!(text, "  pure function {name}(field) result(out)");
    let _ = writeln!(text, "    type(field_type), intent(in) :: field\n    real(wp) :: out{shape}");
    text += &statements(body, "real(wp)", &unused(if body.reads_kept { &[] } else { &["field"] }));
    match is_scalar {
        true => {
            let _ = writeln!(text, "    out = {}", body.results[0]);
        }
        false => {
            for (index, value) in body.results.iter().enumerate() {
                let _ = writeln!(text, "    out({}) = {value}", index + 1);
            }
        }
    }
    let _ = writeln!(text, "  end function {name}");
    text
}
