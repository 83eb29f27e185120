//! The program that checks the module: test vectors, and a comparison in both precisions.

use std::fmt::Write as _;

use crate::emit::port::Port;
use crate::emit::port::callable::Callable;
use crate::emit::port::vectors::Vectors;
use crate::emit::python::module::comment;

/// The text of `FIELD_check.jl`.
pub(super) fn text(port: &Port<'_>) -> String {
    let vectors = port.subject.vectors();
    let name = &port.name;
    let mut header = port.header();
    header.push(format!(
        "Checks {name}.jl: runs every function at the points below, prints its worst error, and fails where that is not accepted. {} Numbers are the bits of a Float64.",
        vectors.meaning()
    ));
    let mut text = comment(&header, "");
    let _ = write!(
        text,
        "\ninclude(\"{name}.jl\")\nimport .{name} as field\n\nconst NAME = \"{name}\"\n\n\
         \"Lines of numbers.\"\nfunction rows(text)\n    \
         number(word) = reinterpret(Float64, parse(UInt64, word; base = 16))\n    \
         return [Float64[number(word) for word in split(line)] for line in split(text, '\\n')[1:end-1]]\nend\n\n\
         # Parameters: the defaults, others, and extremes.\nconst SETS = {}\n\n\
         # Points: t, X, N and H; and which set of parameters each is of.\nconst SAMPLES = {}\n\n",
        table(&vectors.sets),
        table(&samples(vectors))
    );
    let which: Vec<String> =
        vectors.samples.iter().map(|sample| (sample.set + 1).to_string()).collect();
    let _ = write!(
        text,
        "const SET_OF = Int[\n    {}\n]\n\nconst DEFAULTS = {}\n\n\
         # Name, function, its owner, columns of its inputs, accepted errors, and what is expected.\n\
         const FUNCTIONS = [\n",
        crate::emit::text::listed(&which, 90).join("\n    "),
        table(std::slice::from_ref(&vectors.defaults))
    );
    let single = vectors.accepted_in_single.as_ref();
    for (place, callable) in port.callables.iter().enumerate() {
        let expected = &vectors.expected[place];
        if expected.is_empty() {
            continue;
        }
        let owner = match (callable.is_of_points(), callable.time) {
            (false, _) => "alone",
            (true, false) => "field",
            (true, true) => "now",
        };
        let accepted_in_single = single.map_or(0, |single| single[place]);
        let _ = writeln!(
            text,
            "    (\"{0}\", field.{0}, :{owner}, {1}, ({2}, {accepted_in_single}), {3}),",
            callable.name,
            columns(callable, port.dimension()),
            vectors.accepted[place],
            table(expected)
        );
    }
    let precisions = if single.is_some() { "(Float64, Float32)" } else { "(Float64,)" };
    let _ = write!(text, "]\n\nconst PRECISIONS = {precisions}\n\n");
    text + include_str!("support/check.jl")
}

fn samples(vectors: &Vectors) -> Vec<Vec<f64>> {
    let row = |sample: &crate::emit::port::vectors::Sample| {
        let parts = [&sample.coordinates, &sample.normal, &sample.gradient];
        std::iter::once(sample.time).chain(parts.into_iter().flatten().copied()).collect()
    };
    vectors.samples.iter().map(row).collect()
}

/// Rows of numbers.
fn table(rows: &[Vec<f64>]) -> String {
    let mut text = "rows(\"\"\"\n".to_string();
    for row in rows {
        let bits: Vec<String> =
            row.iter().map(|value| format!("{:016x}", value.to_bits())).collect();
        let _ = writeln!(text, "{}", bits.join(" "));
    }
    text + "\"\"\")"
}

fn columns(callable: &Callable, dimension: usize) -> String {
    let mut columns: Vec<usize> = Vec::new();
    for (array, count) in callable.arrays() {
        let first = match array {
            "N" => 2 + dimension,
            "H" => 2 + 2 * dimension,
            _ => 2,
        };
        columns.extend(first..first + count);
    }
    match columns.as_slice() {
        [] => "Int[]".into(),
        columns => format!("{columns:?}"),
    }
}
