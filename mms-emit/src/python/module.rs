//! The module: parameters, a prepared field, a field at a time, and what Python lacks.

use std::fmt::Write as _;

use super::dialect::Library;
use crate::port::Port;
use crate::port::body::{Bodies, Body, local};
use crate::port::callable::Callable;
use crate::port::faces;
use crate::port::motion::{self, tuple};
use crate::port::support::{Calls, Support, names_in};
use crate::text::{indented, listed, wrapped};
use mms_spec::quantity::Shape;

const WIDE: &str = include_str!("support/wide.py");
const MATH: &str = include_str!("support/point.py");
const NUMPY: &str = include_str!("support/numpy_point.py");

/// The text of `FIELD.py`.
pub(super) fn text(port: &Port<'_>, library: Library) -> String {
    let name = &port.name;
    let bodies = port.bodies(&library);
    let mut calls = bodies.calls();
    let mut classes = defaults(port, library, &bodies.defaults);
    classes += &field(port, library, &bodies, &mut calls);
    classes += &(instant(port, library, &bodies, &mut calls) + &prepare());
    let needed = |text| Support::new(text, &["#"]).needed(&calls);
    let support = match library {
        Library::Math => [needed(WIDE), needed(MATH)].concat(),
        Library::NumPy => [needed(WIDE), needed(NUMPY)].concat(),
        Library::SymPy | Library::Ufl => Vec::new(),
    };
    let uses_math = calls.names().any(|name| name.starts_with("math."))
        || support.iter().any(|block| names_in(block).any(|name| name == "math"));
    let mut header = port.header();
    let usage = match library {
        Library::Math => {
            "Functions take numbers, and return a float, a tuple, or a tuple of rows. Where a formula has no value they raise an error, as the module math does."
        }
        Library::NumPy => {
            "Functions take numbers or arrays that broadcast, and return an array: the indices of the component come first, the indices of the inputs last."
        }
        Library::SymPy => {
            "Functions take symbols, expressions or numbers, and return an expression or a matrix. All numbers are exact."
        }
        Library::Ufl => {
            "Functions take components of coordinates, and return an expression, a vector or a matrix of UFL; parameters and t are numbers or constants of UFL. Logarithms and exponentials near 1 are written out, without a difference that optimisers may take for 0."
        }
    };
    header.push(format!("{usage} {name}_check.py checks the result."));
    let mut text = comment(&header, "");
    text += if uses_math { "\nimport math\n" } else { "\n" };
    text += "from dataclasses import dataclass\n";
    text += match library {
        Library::Math => "",
        Library::NumPy => "\nimport numpy as np\n",
        Library::SymPy => "\nimport sympy as sp\n",
        Library::Ufl => "\nimport ufl\n",
    };
    let _ = write!(text, "\nDIMENSION = {}\n", port.dimension());
    if library == Library::SymPy {
        text += "PI = sp.pi\n";
    }
    let claims = port.claims(|face, claim| format!("    \"{face}\": \"{claim}\","));
    if !claims.is_empty() {
        let _ = write!(text, "\n# {}\nFACES = {{\n{claims}}}\n", faces::DOC);
    }
    let motion =
        port.motion(|end, numbers| format!("{} = {}", end.to_ascii_uppercase(), tuple(numbers)));
    if !motion.is_empty() {
        let _ = write!(text, "\n{}{motion}", comment(&[motion::DOC.into()], ""));
    }
    for block in &support {
        let _ = write!(text, "\n\n{block}\n");
    }
    text + &classes
}

/// Paragraphs as lines of a comment.
pub(crate) fn comment(paragraphs: &[String], indent: &str) -> String {
    let paragraphs: Vec<Vec<String>> =
        paragraphs.iter().map(|text| wrapped(text, 96 - indent.len())).collect();
    let lines = paragraphs.join(&String::new());
    let lines = lines.iter().map(|line| format!("{indent}# {line}").trim_end().to_string() + "\n");
    lines.collect()
}

fn defaults(port: &Port<'_>, library: Library, body: &Body) -> String {
    let mut text = String::new();
    // Names are introduced only if there is something to compute.
    let values: Vec<String> = if body.statements.is_empty() {
        body.results.clone()
    } else {
        text += "\n\ndef _defaults():\n";
        text += &indented(&body.statements, 4);
        text +=
            &format!("    return ({},)\n\n\n_DEFAULTS = _defaults()\n", body.results.join(", "));
        (0..body.results.len()).map(|index| format!("_DEFAULTS[{index}]")).collect()
    };
    text += "\n\n@dataclass(frozen=True)\nclass Parameters:\n    \
             \"\"\"The parameters; their defaults come from the field file, or were set.\"\"\"\n";
    for ((index, name), value) in port.parameters.iter().zip(values) {
        text += "\n";
        text += &comment(&[port.parameter_doc(*index)], "    ");
        let _ = writeln!(text, "    {name}: {} = {value}", parameter_type(library));
    }
    if library == Library::SymPy && !port.parameters.is_empty() {
        let names: Vec<&str> = port.parameters.values().map(String::as_str).collect();
        let _ = write!(
            text,
            "\n\ndef symbols():\n    \"\"\"The parameters as symbols of their names.\"\"\"\n    \
             return Parameters(\n        *sp.symbols(\n            [\n                {},\n            ],\n            real=True,\n        )\n    )\n",
            listed(&names.iter().map(|name| format!("\"{name}\"")).collect::<Vec<_>>(), 76)
                .join("\n                ")
        );
    }
    text
}

fn parameter_type(library: Library) -> &'static str {
    match library {
        Library::Math | Library::NumPy => "float",
        Library::SymPy => "sp.Expr",
        Library::Ufl => "object",
    }
}

fn field(port: &Port<'_>, library: Library, bodies: &Bodies, calls: &mut Calls) -> String {
    let body = &bodies.prepare;
    let mut text = "\n\nclass Field:\n    \
                    \"\"\"The values that depend only on the parameters.\"\"\"\n\n    \
                    def __init__(self, parameters=Parameters()):\n        \
                    self.parameters = parameters\n"
        .to_string();
    text += &indented(&body.statements, 8);
    for (value, result) in port.kept.iter().zip(&body.results) {
        let _ = writeln!(text, "        self._{} = {result}", local(*value, false));
    }
    for value in &port.kept_wide {
        let wide = local(*value, true);
        let _ = writeln!(text, "        self._{wide} = {wide}");
    }
    text += "\n    def at_time(self, t):\n        \
             \"\"\"The field at one time.\"\"\"\n        return Instant(self, t)\n";
    text + &methods(port, library, bodies, false, calls)
}

fn instant(port: &Port<'_>, library: Library, bodies: &Bodies, calls: &mut Calls) -> String {
    let body = &bodies.at_time;
    let mut text = "\n\nclass Instant:\n    \
                    \"\"\"The values that depend only on the parameters and the time.\"\"\"\n\n    \
                    def __init__(self, field, t):\n        \
                    self.field = field\n        self.time = t\n"
        .to_string();
    if library == Library::SymPy {
        text += "        t = sp.sympify(t)\n";
    }
    text += &indented(&body.statements, 8);
    for (value, result) in port.kept_at_times.iter().zip(&body.results) {
        let _ = writeln!(text, "        self._{} = {result}", local(*value, false));
    }
    text + &methods(port, library, bodies, true, calls)
}

fn prepare() -> String {
    "\n\ndef prepare(parameters=Parameters()):\n    \
     \"\"\"Computes once what only the parameters determine.\"\"\"\n    return Field(parameters)\n"
        .into()
}

fn methods(
    port: &Port<'_>,
    library: Library,
    bodies: &Bodies,
    timed: bool,
    calls: &mut Calls,
) -> String {
    let of_it = port.with_bodies(bodies).filter(|(callable, _)| callable.time == timed);
    of_it.map(|(callable, body)| method(port, library, callable, body, calls)).collect()
}

fn method(
    port: &Port<'_>,
    library: Library,
    callable: &Callable,
    body: &Body,
    calls: &mut Calls,
) -> String {
    let inputs = callable.input_names();
    let arguments: Vec<String> =
        std::iter::once("self".to_string()).chain(inputs.iter().cloned()).collect();
    let doc = callable.documentation();
    let doc = wrapped(&doc, 88).join("\n        ");
    let mut text = format!(
        "\n    def {}({}):\n        \"\"\"{doc}\"\"\"\n",
        callable.name,
        arguments.join(", ")
    );
    if library == Library::SymPy {
        for input in &inputs {
            let _ = writeln!(text, "        {input} = sp.sympify({input})");
        }
    }
    // A prepared field reads itself.
    let own = |line: &String| line.replace("field._", "self._");
    text += &indented(&body.statements.iter().map(own).collect::<Vec<_>>(), 8);
    let results: Vec<String> = body.results.iter().map(own).collect();
    text += &match library {
        Library::NumPy if callable.is_of_points() => {
            shaped(callable, &results, &inputs, port.rows(), calls)
        }
        Library::SymPy | Library::Ufl => expression(library, callable, &results, port.rows()),
        _ => plain(callable, &results, port.rows()),
    };
    text
}

/// A float, a tuple, or a tuple of rows.
fn plain(callable: &Callable, results: &[String], rows: usize) -> String {
    let tuple = |items: &[String]| match items {
        [item] => format!("({item},)"),
        items => format!("({})", items.join(", ")),
    };
    let value = match callable.shape {
        Some(Shape::Scalar) => results[0].clone(),
        Some(Shape::Tensor) => tuple(&results.chunks(rows).map(tuple).collect::<Vec<_>>()),
        Some(Shape::Vector) | None => tuple(results),
    };
    let line = format!("        return {value}\n");
    if line.len() <= 100 {
        return line;
    }
    let items = value.trim_start_matches('(').trim_end_matches(')');
    let items: Vec<&str> = items.split(", ").collect();
    let open = value.len() - value.trim_start_matches('(').len();
    let close = value.len() - value.trim_end_matches(')').len();
    format!(
        "        return {}\n            {}\n        {}\n",
        "(".repeat(open),
        listed(&items, 84).join("\n            "),
        ")".repeat(close)
    )
}

/// An expression, a vector or a matrix.
fn expression(library: Library, callable: &Callable, results: &[String], rows: usize) -> String {
    let components = listed(results, 80).join("\n            ");
    match (callable.shape, library) {
        (Some(Shape::Scalar), Library::SymPy) => format!("        return {}\n", results[0]),
        (Some(Shape::Scalar), _) => format!("        return ufl.as_ufl({})\n", results[0]),
        (Some(Shape::Tensor), Library::SymPy) => format!(
            "        return sp.Matrix({rows}, {rows}, [\n            {components}\n        ])\n"
        ),
        (_, Library::SymPy) => {
            format!("        return sp.Matrix([\n            {components}\n        ])\n")
        }
        (Some(Shape::Tensor), _) => {
            let lines: Vec<String> = (results.chunks(rows))
                .map(|row| format!("            [{}],\n", listed(row, 78).join("\n             ")))
                .collect();
            format!("        return ufl.as_matrix([\n{}        ])\n", lines.join(""))
        }
        (_, _) => format!("        return ufl.as_vector([\n            {components}\n        ])\n"),
    }
}

/// An array: the components first, in their shape.
fn shaped(
    callable: &Callable,
    results: &[String],
    inputs: &[String],
    rows: usize,
    calls: &mut Calls,
) -> String {
    let components = listed(results, 80).join("\n            ");
    let array = format!("{}([{components}], {})", calls.to("_shaped"), inputs.join(", "));
    match callable.shape {
        Some(Shape::Scalar) => format!("        return {array}[0]\n"),
        Some(Shape::Tensor) => format!(
            "        out = {array}\n        return out.reshape(({rows}, {rows}) + out.shape[1:])\n"
        ),
        Some(Shape::Vector) | None => format!("        return {array}\n"),
    }
}
