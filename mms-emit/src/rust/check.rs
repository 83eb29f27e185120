//! The program that checks the module: calls of every function, and a comparison in both precisions.

use std::fmt::Write as _;

use super::comment;
use crate::port::Port;
use crate::port::check::Check;
use mms_spec::quantity::Shape;

/// The text of `FIELD_check.rs`.
pub(super) fn text(port: &Port<'_>) -> String {
    let name = &port.name;
    let mut text = comment(&port.check_header(&format!("{name}.rs")), "//");
    let _ = write!(
        text,
        "\n#![allow(dead_code, non_snake_case, unused_mut, unused_variables)]\n\n\
         #[path = \"{name}.rs\"]\nmod {name};\n\nuse {name}::{{DIMENSION, Real}};\n\n\
         const VECTORS: &str = include_str!(\"{}\");\nconst SETS: usize = {};\nconst POINTS: usize = {};\n\
         const PARAMETERS: usize = {};\nconst WIDTH: usize = {};\nconst ROWS: usize = {};\n\n",
        port.vectors_name(),
        port.subject.vectors().sets.len(),
        port.points(),
        port.parameters.len(),
        port.width(),
        port.rows()
    );
    let mut program = include_str!("support/check.rs").to_string();
    if port.subject.vectors().accepted_in_single.is_none() {
        program = program.replace("    check_all::<f32>(&mut errors);\n", "");
    }
    let default = |(place, name)| {
        format!(
            "    errors.check(\"default of {name}\", &table.number({place}), &[[parameters.{name}]]);\n"
        )
    };
    let set =
        |(place, name)| format!("        parameters.{name} = T::of(table.rows[0][{place}]);\n");
    let parameters = || port.parameters.values().enumerate();
    text + &program
        .replace("field_", name)
        .replace("    DEFAULTS;\n", &parameters().map(default).collect::<String>())
        .replace("        GIVEN;\n", &parameters().map(set).collect::<String>())
        .replace("        FUNCTIONS;\n", &port.checks().iter().map(call).collect::<String>())
}

/// The lines that check a function.
fn call(check: &Check<'_>) -> String {
    let (callable, table) = (check.callable, check.table);
    let function = &callable.name;
    let line = |name: &str, found: String| {
        let start = format!("        errors.check(\"{name}\", &table,");
        let between = if start.len() + found.len() < 96 { " " } else { "\n            " };
        format!("{start}{between}&{found});\n")
    };
    let (rows, count) =
        (if callable.is_of_points() { "POINTS" } else { "1" }, callable.components.len());
    let read = format!("        let table = Table::read(lines, \"{table}\", [{rows}, {count}]);\n");
    if !callable.is_of_points() {
        let found = match callable.is_scalar() {
            true => format!("[[field.{function}()]]"),
            false => format!("field.{function}().map(|it| [it])"),
        };
        return read + &line(table, found);
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
    read + &line(table, format!("one(|p| {one})"))
        + &line(&format!("{table}_batch"), format!("many(|p, out| {many})"))
}
