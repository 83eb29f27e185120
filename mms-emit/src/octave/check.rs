//! The program that checks the file: test vectors, and a comparison in both precisions.

use std::fmt::Write as _;

use super::comment;
use crate::port::Port;
use crate::port::vectors::{Sample, Vectors};

const SUPPORT: &str = include_str!("support/check.m");

/// The text of `FIELD_check.m`.
pub(super) fn text(port: &Port<'_>) -> String {
    let vectors = port.subject.vectors();
    let name = &port.name;
    let mut header = port.check_header(&format!("{name}.m"));
    if let Some(last) = header.last_mut() {
        *last += " Numbers are the digits of hex2num.";
    }
    let mut text = format!("function {name}_check()\n{}", comment(&header, "  "));
    text += "\n  % Parameters: the defaults, others, and extremes.\n";
    text += &table("sets", &vectors.sets, vectors.sets.len());
    text += "  % The points of each set of parameters: t, X, N and H.\n";
    let _ = writeln!(text, "  points = cell(1, {});", vectors.sets.len());
    for (set, samples) in port.samples().into_iter().enumerate() {
        let numbers: Vec<Vec<f64>> = samples.iter().map(Sample::numbers).collect();
        text += &table(&format!("points{{{}}}", set + 1), &numbers, numbers.len());
    }
    for check in port.checks() {
        for (set, rows) in check.expected.iter().enumerate() {
            let name = format!("expected.{}{{{}}}", check.callable.name, set + 1);
            text += &table(&name, rows, rows.len());
        }
    }
    text += &defaults(port, vectors);
    text += &functions(port, vectors);
    text += include_str!("support/main.m").replace("field_", name).as_str();
    text + "\n" + SUPPORT
}

/// The statement that gives a name to a table.
fn table(name: &str, rows: &[Vec<f64>], count: usize) -> String {
    if rows.iter().all(Vec::is_empty) {
        return format!("  {name} = zeros({count}, 0);\n");
    }
    let mut text = format!("  {name} = rows([ ...\n");
    for row in rows {
        let digits: String = row.iter().map(|value| format!("{:016x}", value.to_bits())).collect();
        let _ = writeln!(text, "    '{digits}'; ...");
    }
    text + "  ]);\n"
}

fn defaults(port: &Port<'_>, vectors: &Vectors) -> String {
    let names: Vec<String> = port.parameters.values().map(|name| format!("'{name}'")).collect();
    let defaults = std::slice::from_ref(&vectors.defaults);
    format!("  names = {{{}}};\n{}", names.join(", "), table("defaults", defaults, 1))
}

/// What is checked: name, what it is of, the columns of what it takes, the number of its components, and
/// the accepted errors.
fn functions(port: &Port<'_>, vectors: &Vectors) -> String {
    let mut text = "\n  % Name, what it is of, columns of its inputs, components, accepted errors.\n  functions = { ...\n"
        .to_string();
    for check in port.checks() {
        let callable = check.callable;
        let of = match (callable.is_of_points(), callable.time) {
            (false, _) => "alone",
            (true, false) => "field",
            (true, true) => "now",
        };
        let columns: Vec<usize> =
            callable.columns(port.dimension()).iter().map(|it| it + 1).collect();
        let accepted_in_single = check.accepted_in_single.map_or("Inf".into(), |it| it.to_string());
        let _ = writeln!(
            text,
            "    '{}', '{of}', {columns:?}, {}, {}, {accepted_in_single}; ...",
            callable.name,
            callable.components.len(),
            check.accepted,
        );
    }
    text += "  };\n";
    let has_single = vectors.accepted_in_single.is_some();
    let precisions = if has_single { "'double', 'single'" } else { "'double'" };
    text + &format!("  precisions = {{{precisions}}};\n")
}
