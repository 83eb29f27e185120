//! The program that checks the file: test vectors, and a comparison in both precisions.

use std::fmt::Write as _;

use super::comment;
use crate::emit::port::Port;
use crate::emit::port::callable::Callable;
use crate::emit::port::vectors::Vectors;

const SUPPORT: &str = include_str!("support/check.m");

/// The text of `FIELD_check.m`.
pub(super) fn text(port: &Port<'_>) -> String {
    let vectors = port.subject.vectors();
    let name = &port.name;
    let mut header = port.header();
    header.push(format!(
        "Checks {name}.m: runs every function at the points below, prints its worst error, and fails where that is not accepted. {} Numbers are the digits of hex2num.",
        vectors.meaning()
    ));
    let mut text = format!("function {name}_check()\n{}", comment(&header, "  "));
    text += "\n  % Parameters: the defaults, others, and extremes.\n";
    text += &table("sets", &vectors.sets, vectors.sets.len());
    text += "  % Points: t, X, N and H; and which set of parameters each is of.\n";
    let samples: Vec<Vec<f64>> = (vectors.samples.iter())
        .map(|sample| {
            let parts = [&sample.coordinates, &sample.normal, &sample.gradient];
            std::iter::once(sample.time).chain(parts.into_iter().flatten().copied()).collect()
        })
        .collect();
    text += &table("samples", &samples, samples.len());
    let which: Vec<String> =
        vectors.samples.iter().map(|sample| (sample.set + 1).to_string()).collect();
    let _ = writeln!(
        text,
        "  set_of = [ ...\n    {}];",
        crate::emit::text::listed(&which, 90).join(" ...\n    ")
    );
    for (callable, expected) in port.callables.iter().zip(&vectors.expected) {
        text += &table(&format!("expected.{}", callable.name), expected, expected.len());
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

/// What is checked: name, its owner (0 a prepared field, 1 that at a time, 2 a prepared field without a
/// point), the columns of what it takes, the number of its components, and the accepted errors.
fn functions(port: &Port<'_>, vectors: &Vectors) -> String {
    let mut text = "\n  % Name, owner (0 field, 1 now, 2 field alone), columns of its inputs, components, accepted errors.\n  functions = { ...\n"
        .to_string();
    let single = vectors.accepted_in_single.as_ref();
    for (place, callable) in port.callables.iter().enumerate() {
        if vectors.expected[place].is_empty() {
            continue;
        }
        let owner = match (callable.is_of_points(), callable.time) {
            (false, _) => 2,
            (true, timed) => usize::from(timed),
        };
        let count = if owner == 2 { 1 } else { callable.components.len() };
        let accepted = vectors.accepted[place];
        let accepted_in_single = single.map_or("Inf".into(), |single| single[place].to_string());
        let _ = writeln!(
            text,
            "    '{}', {owner}, {}, {count}, {accepted}, {accepted_in_single}; ...",
            callable.name,
            columns(callable, port.dimension())
        );
    }
    text += "  };\n";
    let precisions = if single.is_some() { "'double', 'single'" } else { "'double'" };
    text + &format!("  precisions = {{{precisions}}};\n")
}

fn columns(callable: &Callable, dimension: usize) -> String {
    let mut columns: Vec<String> = Vec::new();
    for (array, count) in callable.arrays() {
        let first = match array {
            "N" => 2 + dimension,
            "H" => 2 + 2 * dimension,
            _ => 2,
        };
        columns.extend((first..first + count).map(|column| column.to_string()));
    }
    format!("[{}]", columns.join(", "))
}
