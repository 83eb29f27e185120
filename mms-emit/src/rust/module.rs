//! The module: the scalar trait, types, functions, and twice the digits where they are needed.

use std::fmt::Write as _;

use super::comment;
use super::dialect::Rust;
use crate::port::Port;
use crate::port::body::{Bodies, Body, local};
use crate::port::callable::Callable;
use crate::port::faces;
use crate::port::motion;
use crate::port::support::Support;
use crate::text::indented;
use mms_program::Value;
use mms_spec::quantity::Shape;

const REAL: &str = include_str!("support/real.rs");
const WIDE: &str = include_str!("support/wide.rs");

/// The lints that generated items allow: mathematical names, and functions without a caller.
const ALLOWED: &str = "#[allow(dead_code, non_snake_case, unused_variables, clippy::all)]\n";

/// The text of `FIELD.rs`.
pub(super) fn text(port: &Port<'_>) -> String {
    let bodies = port.bodies(&Rust);
    let items =
        parameters(port, &bodies.defaults) + &field(port, &bodies) + &instant(port, &bodies);
    let mut calls = bodies.calls();
    // The implementations of the operators, which begin with that word and have the type with them.
    calls.to("core");
    let wide = Support::new(WIDE, &["///", "//", "#"]).needed(&calls).join("\n\n");
    let wide = wide.replace("\n#[derive", &format!("\n{ALLOWED}#[derive"));
    let mut header = port.header();
    header.push(format!(
        "A module for `mod {0};` or `include!`, which needs `core`, and the standard library or `libm` for elementary functions. {0}_check.rs checks the result.",
        port.name
    ));
    let mut text = comment(&header, "//");
    let _ = write!(
        text,
        "\n/// The number of space dimensions.\n#[allow(dead_code)]\npub const DIMENSION: usize = {};\n\n{}\n",
        port.dimension(),
        REAL.replace("pub trait Real:", "#[allow(dead_code)]\npub trait Real:")
    );
    let claims = port.claims(|face, claim| format!("    (\"{face}\", \"{claim}\"),"));
    if !claims.is_empty() {
        let _ = write!(
            text,
            "/// {}\n#[allow(dead_code)]\npub const FACES: &[(&str, &str)] = &[\n{claims}];\n\n",
            faces::DOC
        );
    }
    text += &port.motion(|end, numbers| {
        format!(
            "{}#[allow(dead_code)]\npub const {}: [f64; DIMENSION] = [{}];\n",
            documented(motion::DOC, ""),
            end.to_ascii_uppercase(),
            numbers.join(", ")
        )
    });
    if !wide.is_empty() {
        let _ = write!(text, "{wide}\n\n");
    }
    text + &items
}

/// Lines of documentation.
fn documented(doc: &str, indent: &str) -> String {
    comment(&[doc.to_string()], &format!("{indent}///"))
}

/// A struct that is generic in its scalar, even if no member uses it.
fn structure(doc: &str, name: &str, members: &str) -> String {
    format!(
        "{}{ALLOWED}#[derive(Clone, Copy, Debug)]\npub struct {name}<T> {{\n{members}    \
         marker: core::marker::PhantomData<T>,\n}}\n\n",
        documented(doc, "")
    )
}

fn members(values: &[Value], wide: bool) -> String {
    let kind = if wide { "Wide" } else { "T" };
    values.iter().map(|value| format!("    {}: {kind},\n", local(*value, wide))).collect()
}

fn parameters(port: &Port<'_>, body: &Body) -> String {
    let mut members = String::new();
    for (index, name) in &port.parameters {
        members += &documented(&port.parameter_doc(*index), "    ");
        let _ = writeln!(members, "    pub {name}: T,");
    }
    let doc = "The parameters; their defaults come from the field file, or were set.";
    let mut text = structure(doc, "Parameters", &members);
    let _ = write!(
        text,
        "{ALLOWED}impl<T: Real> Default for Parameters<T> {{\n    fn default() -> Self {{\n{}        \
         Parameters {{\n",
        indented(&body.statements, 8)
    );
    for (name, value) in port.parameters.values().zip(&body.results) {
        let _ = writeln!(text, "            {name}: {value},");
    }
    text + "            marker: core::marker::PhantomData,\n        }\n    }\n}\n\n"
}

fn field(port: &Port<'_>, bodies: &Bodies) -> String {
    let held = members(&port.kept, false) + &members(&port.kept_wide, true);
    let mut text = structure("The values that depend only on the parameters.", "Field", &held);
    let body = &bodies.prepare;
    let _ = write!(
        text,
        "/// Computes once what only the parameters determine.\n{ALLOWED}\
         pub fn prepare<T: Real>(parameters: &Parameters<T>) -> Field<T> {{\n{}    Field {{\n",
        indented(&body.statements, 4)
    );
    for (value, result) in port.kept.iter().zip(&body.results) {
        let _ = writeln!(text, "        {}: {result},", local(*value, false));
    }
    for value in &port.kept_wide {
        let _ = writeln!(text, "        {},", local(*value, true));
    }
    text += "        marker: core::marker::PhantomData,\n    }\n}\n\n";
    let _ = write!(text, "{ALLOWED}impl<T: Real> Field<T> {{\n{}", at_time(port, &bodies.at_time));
    text + &methods(port, bodies, false) + "}\n\n"
}

fn at_time(port: &Port<'_>, body: &Body) -> String {
    let mut text = format!(
        "    /// Computes once what the parameters and the time determine.\n    \
         pub fn at_time(&self, t: T) -> Instant<T> {{\n{}        Instant {{\n",
        indented(&body.statements, 8)
    );
    for (value, result) in port.kept_at_times.iter().zip(&body.results) {
        let _ = writeln!(text, "            {}: {result},", local(*value, false));
    }
    text + "            marker: core::marker::PhantomData,\n        }\n    }\n"
}

fn instant(port: &Port<'_>, bodies: &Bodies) -> String {
    let held = members(&port.kept_at_times, false);
    let doc = "The values that depend only on the parameters and the time.";
    let mut text = structure(doc, "Instant", &held);
    let _ = writeln!(text, "{ALLOWED}impl<T: Real> Instant<T> {{");
    let methods = methods(port, bodies, true);
    text += methods.trim_start_matches('\n');
    text + "}\n"
}

fn methods(port: &Port<'_>, bodies: &Bodies, timed: bool) -> String {
    let mut text = String::new();
    for (callable, body) in port.with_bodies(bodies).filter(|(callable, _)| callable.time == timed)
    {
        text += "\n";
        text += &method(port, callable, body);
        if callable.is_of_points() {
            text += "\n";
            text += &batch(port, callable);
        }
    }
    text
}

/// Items in brackets, in rows of `columns` where they are a matrix.
fn array(items: &[String], columns: Option<usize>) -> String {
    let list = |items: &[String]| format!("[{}]", items.join(", "));
    match columns {
        Some(columns) => list(&items.chunks(columns).map(list).collect::<Vec<_>>()),
        None => list(items),
    }
}

/// The type of `count` numbers.
fn kind(shape: Option<Shape>, count: usize, rows: usize) -> String {
    match shape {
        Some(Shape::Scalar) => "T".into(),
        Some(Shape::Tensor) => format!("[[T; {rows}]; {rows}]"),
        Some(Shape::Vector) | None => format!("[T; {count}]"),
    }
}

/// A function of one point, or of none.
fn method(port: &Port<'_>, callable: &Callable, body: &Body) -> String {
    let rows = port.rows();
    let mut arguments = vec!["&self".to_string()];
    let mut left = callable.input_names().into_iter();
    for (name, count) in callable.arrays() {
        let items: Vec<String> = left.by_ref().take(count).collect();
        let (columns, shape) = match name {
            "H" => (Some(rows), Shape::Tensor),
            _ => (None, Shape::Vector),
        };
        arguments.push(format!("{}: {}", array(&items, columns), kind(Some(shape), count, rows)));
    }
    let result = match callable.shape {
        Some(Shape::Scalar) => body.results[0].clone(),
        Some(Shape::Tensor) => array(&body.results, Some(rows)),
        Some(Shape::Vector) | None => array(&body.results, None),
    };
    format!(
        "{}    #[inline]\n    pub fn {}({}) -> {} {{\n{}        {result}\n    }}\n",
        documented(&callable.documentation(), "    "),
        callable.name,
        arguments.join(", "),
        kind(callable.shape, callable.components.len(), rows),
        indented(&body.statements, 8)
    )
}

/// A function of many points.
fn batch(port: &Port<'_>, callable: &Callable) -> String {
    let rows = port.rows();
    let count = callable.components.len();
    let (mut arguments, mut short, mut call) =
        (vec!["&self".to_string()], String::new(), Vec::new());
    for (name, count) in callable.arrays() {
        arguments.push(format!("{name}: [&[T]; {count}]"));
        let _ = writeln!(short, "        let {name} = {name}.map(|{name}| &{name}[..count]);");
        let items: Vec<String> = (0..count).map(|index| format!("{name}[{index}][i]")).collect();
        call.push(array(&items, (name == "H").then_some(rows)));
    }
    arguments.push(format!("out: [&mut [T]; {count}]"));
    let stores: String = (0..count)
        .map(|index| {
            let component = match callable.shape {
                Some(Shape::Scalar) => "value".into(),
                Some(Shape::Tensor) => {
                    format!("value[{}][{}]", index / rows, index % rows)
                }
                Some(Shape::Vector) | None => format!("value[{index}]"),
            };
            format!("            out[{index}][i] = {component};\n")
        })
        .collect();
    let doc = format!(
        "The same at many points: a slice for each coordinate and each component ({}), of which none may be shorter than the first component.",
        callable.components.join(", ")
    );
    documented(&doc, "    ")
        + &format!(
            "    pub fn {}_batch({}) {{\n        let count = out[0].len();\n{short}        \
             let out = out.map(|out| &mut out[..count]);\n        \
             for i in 0..count {{\n            let value = self.{}({});\n{stores}        }}\n    }}\n",
            callable.name,
            arguments.join(", "),
            callable.name,
            call.join(", ")
        )
}
