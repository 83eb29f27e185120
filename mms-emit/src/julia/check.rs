//! The program that checks the module: test vectors, and a comparison in both precisions.

use std::fmt::Write as _;

use crate::port::Port;
use crate::port::vectors::Sample;
use crate::python::module::comment;

/// The text of `FIELD_check.jl`.
pub(super) fn text(port: &Port<'_>) -> String {
    let vectors = port.subject.vectors();
    let name = &port.name;
    let mut header = port.check_header(&format!("{name}.jl"));
    if let Some(last) = header.last_mut() {
        *last += " Numbers are the bits of a Float64.";
    }
    let mut text = comment(&header, "");
    let mut samples = port.samples().into_iter();
    let points = vectors.sets.iter().map(|_| {
        samples.next().unwrap_or_default().iter().map(Sample::numbers).collect::<Vec<_>>()
    });
    let _ = write!(
        text,
        "\ninclude(\"{name}.jl\")\nimport .{name} as field\n\nconst NAME = \"{name}\"\n\n\
         \"Lines of numbers.\"\nfunction rows(text)\n    \
         number(word) = reinterpret(Float64, parse(UInt64, word; base = 16))\n    \
         return [Float64[number(word) for word in split(line)] for line in split(text, '\\n')[1:end-1]]\nend\n\n\
         # Parameters: the defaults, others, and extremes.\nconst SETS = {}\n\n\
         # The points of each set of parameters: t, X, N and H.\nconst POINTS = {}\n\n\
         const DEFAULTS = {}\n\n\
         # Name, function, its owner, columns of its inputs, accepted errors, and what is expected.\n\
         const FUNCTIONS = [\n",
        table(&vectors.sets),
        tables(points),
        table(std::slice::from_ref(&vectors.defaults))
    );
    for check in port.checks() {
        let callable = check.callable;
        let owner = match (callable.is_of_points(), callable.time) {
            (false, _) => "alone",
            (true, false) => "field",
            (true, true) => "now",
        };
        let columns: Vec<usize> =
            callable.columns(port.dimension()).iter().map(|it| it + 1).collect();
        let _ = writeln!(
            text,
            "    (\"{0}\", field.{0}, :{owner}, Int{columns:?}, ({1}, {2}), {3}),",
            callable.name,
            check.accepted,
            check.accepted_in_single.unwrap_or(0),
            tables(check.expected.iter().map(|it| it.to_vec()))
        );
    }
    let has_single = vectors.accepted_in_single.is_some();
    let precisions = if has_single { "(Float64, Float32)" } else { "(Float64,)" };
    let _ = write!(text, "]\n\nconst PRECISIONS = {precisions}\n\n");
    text + include_str!("support/check.jl")
}

/// Rows of numbers for each set of parameters.
fn tables(sets: impl Iterator<Item = Vec<Vec<f64>>>) -> String {
    format!("[{}]", sets.map(|rows| table(&rows)).collect::<Vec<_>>().join(", "))
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
