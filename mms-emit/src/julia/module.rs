//! The module: parameters, a prepared field, a field at a time, and their functions.

use std::fmt::Write as _;

use super::dialect::Julia;
use crate::port::Port;
use crate::port::body::{Body, local};
use crate::port::callable::Callable;
use crate::port::faces;
use crate::port::motion::{self, tuple};
use crate::port::number::decimal;
use crate::text::{indented, listed, wrapped};
use mms_program::Value;
use mms_spec::quantity::Shape;

const POINT: &str = include_str!("support/point.jl");

/// The text of `FIELD.jl`.
pub(super) fn text(port: &Port<'_>) -> String {
    let name = &port.name;
    let mut header = port.header();
    header.push(format!(
        "Functions take a prepared field, or one at a time, and coordinates; they return a number, a tuple, or a tuple of rows, and broadcast: f.(now, X, Y). Numbers are Float64 or Float32, as the parameters are. Where a formula has no real value they throw a DomainError. {name}_check.jl checks the result."
    ));
    let mut text = documented(&header, 96);
    let _ = write!(
        text,
        "module {name}\n\n\"The number of space dimensions.\"\nconst dimension = {}\n\n",
        port.dimension()
    );
    let claims = port.claims(|face, claim| format!("    {face} = \"{claim}\","));
    if !claims.is_empty() {
        let _ = write!(text, "\"{}\"\nconst faces = (\n{claims})\n\n", faces::DOC);
    }
    text += &port.motion(|end, numbers| {
        let doc = documented(&[motion::DOC.into()], 96);
        format!("{doc}const {end} = {}\n", tuple(numbers))
    });
    text += &parameters(port);
    text += &structure(
        "The values that depend only on the parameters.",
        "Field",
        &port.kept,
        &port.kept_wide,
    );
    text += &structure(
        "The values that depend only on the parameters and the time.",
        "Instant",
        &port.kept_at_times,
        &[],
    );
    let (_, support) = POINT.split_once("\n\n").unwrap_or_default();
    text += support;
    let bodies = port.bodies(&Julia);
    text += &prepare(port, &bodies.prepare);
    text += &at_time(&bodies.at_time);
    for (callable, body) in port.with_bodies(&bodies) {
        text += &function(port, callable, body);
    }
    text + "\nend\n"
}

/// Paragraphs as documentation of what follows.
fn documented(paragraphs: &[String], width: usize) -> String {
    let paragraphs: Vec<String> =
        paragraphs.iter().map(|text| wrapped(&escaped(text), width).join("\n")).collect();
    format!("\"\"\"\n{}\n\"\"\"\n", paragraphs.join("\n\n"))
}

/// A text inside of a string.
fn escaped(text: &str) -> String {
    let special = |c: char| matches!(c, '\\' | '"' | '$');
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        escaped.extend(special(c).then_some('\\'));
        escaped.push(c);
    }
    escaped
}

fn structure(doc: &str, name: &str, values: &[Value], wide: &[Value]) -> String {
    let mut text = format!("\"{doc}\"\nstruct {name}{{T}}\n");
    for value in values {
        let _ = writeln!(text, "    {}::T", local(*value, false));
    }
    for value in wide {
        let _ = writeln!(text, "    {}::BigFloat", local(*value, true));
    }
    text + "end\n\n"
}

fn parameters(port: &Port<'_>) -> String {
    let defaults = &port.subject.vectors().defaults;
    let mut text = "\"The parameters; their defaults come from the field file, or were set.\"\n\
                    struct Parameters{T<:AbstractFloat}\n"
        .to_string();
    for (index, name) in &port.parameters {
        let _ = writeln!(text, "    \"{}\"", escaped(&port.parameter_doc(*index)));
        let _ = writeln!(text, "    {name}::T");
    }
    text += "end\n\n";
    if port.parameters.is_empty() {
        return text + "Parameters() = Parameters{Float64}()\n\n";
    }
    let names: Vec<String> = port.parameters.values().cloned().collect();
    let keywords: Vec<String> = (names.iter().zip(defaults))
        .map(|(name, default)| format!("{name} = {}", decimal(*default)))
        .collect();
    let floats: Vec<String> = names.iter().map(|name| format!("float({name})")).collect();
    let own = |head: &str, start: &str| bracketed(&format!("{head}(; "), &keywords, start);
    text += &own("Parameters", ") = ");
    text += &bracketed("Parameters(promote(", &floats, ")...)\n\n");
    text += &own("Parameters{T}", ") where {T<:AbstractFloat} = ");
    text + &bracketed("Parameters{T}(", &names, ")\n\n")
}

/// Items between brackets: on the line of the brackets if they fit, or on lines of their own.
fn bracketed(open: &str, items: &[String], close: &str) -> String {
    match listed(items, 88).as_slice() {
        [line] if line.len() <= 40 => format!("{open}{line}{close}"),
        lines => format!("{}\n    {},\n{close}", open.trim_end(), lines.join("\n    ")),
    }
}

/// The call of a constructor within digits enough.
fn constructed(
    head: &str,
    doc: &str,
    statements: &[String],
    call: &str,
    items: &[String],
) -> String {
    let items = match items {
        [] => String::new(),
        items => format!("\n            {},\n        ", listed(items, 84).join("\n            ")),
    };
    format!(
        "\n\"{doc}\"\nfunction {head}\n    setprecision(BigFloat, 512) do\n{}        \
         {call}({items})\n    end\nend\n",
        indented(statements, 8)
    )
}

fn prepare(port: &Port<'_>, body: &Body) -> String {
    let mut items: Vec<String> = body.results[..port.kept.len()].to_vec();
    items.extend(port.kept_wide.iter().map(|value| local(*value, true)));
    constructed(
        "prepare(parameters::Parameters{T}) where {T}",
        "Computes once what only the parameters determine.",
        &body.statements,
        "Field{T}",
        &items,
    )
}

fn at_time(body: &Body) -> String {
    constructed(
        "at_time(field::Field{T}, t) where {T}",
        "Computes once what the parameters and the time determine.",
        &body.statements,
        "Instant{T}",
        &body.results,
    )
}

fn function(port: &Port<'_>, callable: &Callable, body: &Body) -> String {
    let owner = if callable.time { "now::Instant{T}" } else { "field::Field{T}" };
    let mut arguments = vec![owner.to_string()];
    arguments.extend(callable.input_names());
    let doc = callable.documentation();
    let tuple = |items: &[String]| match items {
        [item] => format!("({item},)"),
        items => format!("({})", items.join(", ")),
    };
    let value = match callable.shape {
        Some(Shape::Scalar) => body.results[0].clone(),
        Some(Shape::Tensor) => {
            tuple(&body.results.chunks(port.rows()).map(tuple).collect::<Vec<_>>())
        }
        Some(Shape::Vector) | None => tuple(&body.results),
    };
    format!(
        "\n{}function {}({}) where {{T}}\n{}    return {value}\nend\n",
        documented(&[doc], 92),
        callable.name,
        arguments.join(", "),
        indented(&body.statements, 4)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_stays_in_its_string() {
        assert_eq!(escaped(r#"a "b" $(c) \d"#), r#"a \"b\" \$(c) \\d"#);
        let text = documented(&["a \"\"\"".into(), "b".into()], 9);
        assert_eq!(text, "\"\"\"\na \\\"\\\"\\\"\n\nb\n\"\"\"\n");
    }
}
