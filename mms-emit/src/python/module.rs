//! The module: parameters, a prepared field, a field at a time, and what Python lacks.

use std::fmt::Write as _;

use super::dialect::Form;
use crate::port::Port;
use crate::port::body::{Place, local};
use crate::port::callable::Callable;
use crate::port::faces::DOC;
use crate::port::support::Support;
use crate::text::{listed, wrapped};
use mms_mechanics::Output;
use mms_spec::quantity::Shape;

const WIDE: &str = include_str!("support/wide.py");
const MATH: &str = include_str!("support/point.py");
const NUMPY: &str = include_str!("support/numpy_point.py");

/// The text of `FIELD.py`.
pub(super) fn text(port: &Port<'_>, form: Form) -> String {
    let name = &port.name;
    let classes = defaults(port, form) + &field(port, form) + &instant(port, form) + &prepare();
    let needed = |text| Support::new(text, &["#"]).needed(&classes).join("\n\n\n");
    let support = match form {
        Form::Math => vec![needed(WIDE), needed(MATH)],
        Form::NumPy => vec![needed(WIDE), needed(NUMPY)],
        Form::SymPy | Form::Ufl => Vec::new(),
    };
    let mut header = port.header();
    let usage = match form {
        Form::Math => {
            "Functions take numbers, and return a float, a tuple, or a tuple of rows. Where a formula has no value they raise an error, as the module math does."
        }
        Form::NumPy => {
            "Functions take numbers or arrays that broadcast, and return an array: the places of the component come first, those of the inputs last."
        }
        Form::SymPy => {
            "Functions take symbols, expressions or numbers, and return an expression or a matrix. All numbers are exact."
        }
        Form::Ufl => {
            "Functions take components of coordinates, and return an expression, a vector or a matrix of UFL; parameters and t are numbers or constants of UFL. Logarithms and exponentials near 1 are written out, without a difference that optimisers may take for 0."
        }
    };
    header.push(format!("{usage} {name}_check.py checks the result."));
    let mut text = comment(&header, "");
    text += "\nimport math\nfrom dataclasses import dataclass\n";
    text += match form {
        Form::Math => "",
        Form::NumPy => "\nimport numpy as np\n",
        Form::SymPy => "\nimport sympy as sp\n",
        Form::Ufl => "\nimport ufl\n",
    };
    let _ = write!(text, "\nDIMENSION = {}\n", port.dimension());
    if form == Form::SymPy {
        text += "PI = sp.pi\n";
    }
    let claims = port.claims(|face, claim| format!("    \"{face}\": \"{claim}\","));
    if !claims.is_empty() {
        let _ = write!(text, "\n# {DOC}\nFACES = {{\n{claims}}}\n");
    }
    for part in support.iter().filter(|part| !part.is_empty()) {
        let _ = write!(text, "\n\n{part}\n");
    }
    text += &classes;
    match text.contains("math.") {
        true => text,
        false => text.replacen("import math\n", "", 1),
    }
}

/// Paragraphs as lines of a comment.
pub(crate) fn comment(paragraphs: &[String], indent: &str) -> String {
    let paragraphs: Vec<Vec<String>> =
        paragraphs.iter().map(|text| wrapped(text, 96 - indent.len())).collect();
    let lines = paragraphs.join(&String::new());
    let lines = lines.iter().map(|line| format!("{indent}# {line}").trim_end().to_string() + "\n");
    lines.collect()
}

fn indented(statements: &[String], by: usize) -> String {
    statements.iter().map(|statement| format!("{:by$}{statement}\n", "")).collect()
}

fn defaults(port: &Port<'_>, form: Form) -> String {
    let roots: Vec<_> =
        (port.parameters.keys()).map(|index| port.values(Output::Parameter(*index))[0]).collect();
    let body = port.body(&form, &roots, Place::Parameters);
    let mut text = String::new();
    // Names of their own only where there is something to compute.
    let values: Vec<String> = if body.statements.is_empty() {
        body.results.clone()
    } else {
        text += "\n\ndef _defaults():\n";
        text += &indented(&body.statements, 4);
        text +=
            &format!("    return ({},)\n\n\n_DEFAULTS = _defaults()\n", body.results.join(", "));
        (0..roots.len()).map(|index| format!("_DEFAULTS[{index}]")).collect()
    };
    text += "\n\n@dataclass(frozen=True)\nclass Parameters:\n    \
             \"\"\"The parameters; their defaults are those of the field file, or set.\"\"\"\n";
    for ((index, name), value) in port.parameters.iter().zip(values) {
        text += "\n";
        text += &comment(&[port.parameter_doc(*index)], "    ");
        let _ = writeln!(text, "    {name}: {} = {value}", parameter_type(form));
    }
    if form == Form::SymPy && !port.parameters.is_empty() {
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

fn parameter_type(form: Form) -> &'static str {
    match form {
        Form::Math | Form::NumPy => "float",
        Form::SymPy => "sp.Expr",
        Form::Ufl => "object",
    }
}

fn field(port: &Port<'_>, form: Form) -> String {
    let roots: Vec<_> = port.kept.iter().chain(&port.kept_wide).copied().collect();
    let body = port.body(&form, &roots, Place::Parameters);
    let mut text = "\n\nclass Field:\n    \
                    \"\"\"What only the parameters determine.\"\"\"\n\n    \
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
    for callable in port.callables.iter().filter(|callable| !callable.time) {
        text += &method(port, form, callable);
    }
    text
}

fn instant(port: &Port<'_>, form: Form) -> String {
    let body = port.body(&form, &port.kept_at_times, Place::Times);
    let mut text = "\n\nclass Instant:\n    \
                    \"\"\"What the parameters and the time determine.\"\"\"\n\n    \
                    def __init__(self, field, t):\n        \
                    self.field = field\n        self.time = t\n"
        .to_string();
    if form == Form::SymPy {
        text += "        t = sp.sympify(t)\n";
    }
    text += &indented(&body.statements, 8);
    for (value, result) in port.kept_at_times.iter().zip(&body.results) {
        let _ = writeln!(text, "        self._{} = {result}", local(*value, false));
    }
    for callable in port.callables.iter().filter(|callable| callable.time) {
        text += &method(port, form, callable);
    }
    text
}

fn prepare() -> String {
    "\n\ndef prepare(parameters=Parameters()):\n    \
     \"\"\"Computes once what only the parameters determine.\"\"\"\n    return Field(parameters)\n"
        .into()
}

fn method(port: &Port<'_>, form: Form, callable: &Callable) -> String {
    let place = Place::Points { timed: callable.time };
    let body = port.body(&form, port.values(callable.output), place);
    let inputs = callable.input_names();
    let arguments: Vec<String> =
        std::iter::once("self".to_string()).chain(inputs.iter().cloned()).collect();
    let doc = callable.documentation(port.dimension());
    let doc = wrapped(&doc, 88).join("\n        ");
    let mut text = format!(
        "\n    def {}({}):\n        \"\"\"{doc}\"\"\"\n",
        callable.name,
        arguments.join(", ")
    );
    if form == Form::SymPy {
        for input in &inputs {
            let _ = writeln!(text, "        {input} = sp.sympify({input})");
        }
    }
    // A prepared field reads itself.
    let own = |line: &String| line.replace("field._", "self._");
    text += &indented(&body.statements.iter().map(own).collect::<Vec<_>>(), 8);
    let results: Vec<String> = body.results.iter().map(own).collect();
    text += &match form {
        Form::NumPy if callable.is_of_points() => {
            shaped(callable, &results, &inputs, port.dimension())
        }
        Form::SymPy | Form::Ufl => expression(form, callable, &results, port.dimension()),
        _ => plain(callable, &results, port.dimension()),
    };
    text
}

/// A float, a tuple, or a tuple of rows.
fn plain(callable: &Callable, results: &[String], dimension: usize) -> String {
    let tuple = |items: &[String]| match items {
        [item] => format!("({item},)"),
        items => format!("({})", items.join(", ")),
    };
    let value = match callable.shape {
        Some(Shape::Scalar) => results[0].clone(),
        Some(Shape::Tensor) => tuple(&results.chunks(dimension).map(tuple).collect::<Vec<_>>()),
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
fn expression(form: Form, callable: &Callable, results: &[String], dimension: usize) -> String {
    let components = listed(results, 80).join("\n            ");
    match (callable.shape, form) {
        (Some(Shape::Scalar), Form::SymPy) => format!("        return {}\n", results[0]),
        (Some(Shape::Scalar), _) => format!("        return ufl.as_ufl({})\n", results[0]),
        (Some(Shape::Tensor), Form::SymPy) => format!(
            "        return sp.Matrix({dimension}, {dimension}, [\n            {components}\n        ])\n"
        ),
        (_, Form::SymPy) => {
            format!("        return sp.Matrix([\n            {components}\n        ])\n")
        }
        (Some(Shape::Tensor), _) => {
            let rows: Vec<String> = (results.chunks(dimension))
                .map(|row| format!("            [{}],\n", listed(row, 78).join("\n             ")))
                .collect();
            format!("        return ufl.as_matrix([\n{}        ])\n", rows.join(""))
        }
        (_, _) => format!("        return ufl.as_vector([\n            {components}\n        ])\n"),
    }
}

/// An array: the components first, in their shape.
fn shaped(callable: &Callable, results: &[String], inputs: &[String], dimension: usize) -> String {
    let components = listed(results, 80).join("\n            ");
    let array = format!("_shaped([{components}], {})", inputs.join(", "));
    match callable.shape {
        Some(Shape::Scalar) => format!("        return {array}[0]\n"),
        Some(Shape::Tensor) => format!(
            "        out = {array}\n        return out.reshape(({dimension}, {dimension}) + out.shape[1:])\n"
        ),
        Some(Shape::Vector) | None => format!("        return {array}\n"),
    }
}
