//! The program that checks the module: test vectors, and a comparison in both precisions.

use std::fmt::Write as _;

use super::comment;
use crate::port::Port;
use crate::port::check::{Check, columns, without};
use crate::port::vectors::Sample;
use crate::text::listed;
use mms_spec::quantity::Shape;

/// The text of `FIELD_check.rs`.
pub(super) fn text(port: &Port<'_>) -> String {
    let name = &port.name;
    let mut header = port.check_header(&format!("{name}.rs"));
    if let Some(last) = header.last_mut() {
        *last += " Numbers are the bits of an `f64`.";
    }
    let mut text = comment(&header, "//");
    let _ = write!(text, "\n#[path = \"{name}.rs\"]\nmod {name};\n\nuse {name}::Real;\n\n");
    text + &tables(port) + &program(port)
}

fn tables(port: &Port<'_>) -> String {
    let (vectors, samples) = (port.subject.vectors(), port.samples());
    let mut text = format!("const SETS: usize = {};\n\n", vectors.sets.len());
    if !port.parameters.is_empty() {
        let sets: String = vectors.sets.iter().map(|set| row(set, 4)).collect();
        let _ = write!(
            text,
            "/// Parameters: the defaults, others, and extremes.\n\
             const PARAMETERS: [[u64; {}]; SETS] = [\n{sets}];\n\n",
            port.parameters.len()
        );
    }
    if !samples.is_empty() {
        let dimension = port.dimension();
        let points: String = samples.iter().map(|samples| points(samples)).collect();
        let _ = write!(
            text,
            "const POINTS: usize = {};\n\n/// The points of a set of parameters.\n\
             #[allow(dead_code, non_snake_case)]\nstruct Points<T> {{\n    \
             t: [T; POINTS],\n    X: Columns<T, {dimension}>,\n    N: Columns<T, {dimension}>,\n    \
             H: Columns<T, {}>,\n}}\n\nconst POINTS_OF: [Points<u64>; SETS] = [\n{points}];\n\n",
            port.points(),
            dimension * dimension
        );
    }
    for Check { callable, expected, .. } in port.checks() {
        let (upper, count) = (callable.name.to_ascii_uppercase(), callable.components.len());
        let rows = if callable.is_of_points() { "POINTS" } else { "1" };
        let values: String = expected.iter().map(|rows| block(rows, "", 4)).collect();
        let _ = write!(text, "const {upper}: [[[u64; {rows}]; {count}]; SETS] = [\n{values}];\n\n");
    }
    text
}

/// The points of a set of parameters, as columns.
fn points(samples: &[Sample]) -> String {
    let column = |name: &str, of: fn(&Sample) -> Vec<f64>| {
        let rows: Vec<Vec<f64>> = samples.iter().map(of).collect();
        block(&rows, name, 8)
    };
    let times: Vec<f64> = samples.iter().map(|sample| sample.time).collect();
    format!(
        "    Points {{\n        t: {}{}{}{}    }},\n",
        row(&times, 8).trim_start(),
        column("X: ", |it| it.coordinates.clone()),
        column("N: ", |it| it.normal.clone()),
        column("H: ", |it| it.gradient.clone())
    )
}

/// The columns of rows, behind `name` and as many spaces.
fn block(rows: &[Vec<f64>], name: &str, indent: usize) -> String {
    let columns: String = columns(rows).iter().map(|column| row(column, indent + 4)).collect();
    format!("{:indent$}{name}[\n{columns}{:indent$}],\n", "", "")
}

/// A row of numbers, behind as many spaces.
fn row(values: &[f64], indent: usize) -> String {
    let bits: Vec<String> = values.iter().map(|value| format!("{:#x}", value.to_bits())).collect();
    let lines = listed(&bits, 96 - indent).join(&format!("\n{:indent$} ", ""));
    format!("{:indent$}[{lines}],\n", "")
}

/// The program itself, with its list of functions.
fn program(port: &Port<'_>) -> String {
    let (name, checks) = (&port.name, port.checks());
    let mut text = include_str!("support/check.rs").to_string();
    if checks.iter().any(|check| check.accepted_in_single.is_none()) {
        text = text.replace("    check_all::<f32>(&mut errors);\n", "");
    }
    let functions: String = match checks.is_empty() {
        true => "        let _ = field;\n".into(),
        false => checks.iter().map(call).collect(),
    };
    let helpers = [
        ("flat(", "/// The components of a tensor", "/// A tensor of"),
        ("square(", "/// A tensor of", "impl Points"),
    ];
    for (_, first, end) in helpers.into_iter().filter(|(call, ..)| !functions.contains(call)) {
        text = without(&text, first, end);
    }
    if port.parameters.is_empty() && port.points() == 0 {
        text = without(&text, "/// Numbers in the precision", "/// The numbers of a point.");
    }
    if port.points() == 0 {
        text = without(&text, "/// Columns of numbers", "#[derive");
        text = without(&text, "/// The numbers of a point.", "fn check_all");
        text = without(&text, "        let at: ", "        FUNCTIONS");
    }
    text.replace("DIMENSION", &port.dimension().to_string())
        .replace("field_", name)
        .replace("    DEFAULTS;\n", &defaults(port))
        .replace("        PARAMETERS;\n", &parameters(port))
        .replace("        FUNCTIONS;\n", &functions)
}

/// The lines that check the defaults of the parameters.
fn defaults(port: &Port<'_>) -> String {
    let mut text = match port.parameters.is_empty() {
        true => String::new(),
        false => format!("    let defaults = {}::Parameters::<T>::default();\n", port.name),
    };
    for (parameter, value) in port.parameters.values().zip(&port.subject.vectors().defaults) {
        let _ = writeln!(
            text,
            "    errors.check(\"default of {parameter}\", 1.0, &[[{:#x}]], &[[defaults.{parameter}]]);",
            value.to_bits()
        );
    }
    text
}

/// The lines that make parameters of a set of numbers.
fn parameters(port: &Port<'_>) -> String {
    let name = &port.name;
    let members: Vec<String> =
        port.parameters.values().map(|parameter| format!("parameters.{parameter}")).collect();
    if members.is_empty() {
        return format!("        let parameters = {name}::Parameters::<T>::default();\n");
    }
    format!(
        "        let mut parameters = {name}::Parameters::<T>::default();\n        \
         [\n            {},\n        ] = real(PARAMETERS[set]);\n",
        listed(&members, 84).join("\n            ")
    )
}

/// The lines that check a function.
fn call(check: &Check<'_>) -> String {
    let (callable, accepted) = (check.callable, check.accepted_in_both());
    let (function, upper) = (&callable.name, callable.name.to_ascii_uppercase());
    let line = |name: &str, found: String| {
        let start = format!("        errors.check(\"{name}\", {accepted}.0, &{upper}[set],");
        let between = if start.len() + found.len() < 96 { " " } else { "\n            " };
        format!("{start}{between}&{found});\n")
    };
    if !callable.is_of_points() {
        let found = match callable.is_scalar() {
            true => format!("[[field.{function}()]]"),
            false => format!("field.{function}().map(|it| [it])"),
        };
        return line(function, found);
    }
    let of = if callable.time { "now[p]" } else { "field" };
    let arrays = callable.arrays();
    let given = arrays.iter().map(|(array, _)| match *array {
        "H" => "square(row(&at.H, p))".to_string(),
        array => format!("row(&at.{array}, p)"),
    });
    let one = format!("{of}.{function}({})", given.collect::<Vec<_>>().join(", "));
    let one = match callable.shape {
        Some(Shape::Scalar) => format!("[{one}]"),
        Some(Shape::Tensor) => format!("flat({one})"),
        _ => one,
    };
    let given: String =
        arrays.iter().map(|(array, _)| format!("up_to(&at.{array}, p), ")).collect();
    let many = format!("{of}.{function}_batch({given}out)");
    line(function, format!("one(|p| {one})"))
        + &line(&format!("{function}_batch"), format!("many(|p, out| {many})"))
}
