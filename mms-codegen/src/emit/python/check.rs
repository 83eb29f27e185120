//! The program that checks the module: test vectors, and a comparison.

use std::fmt::Write as _;

use super::dialect::Form;
use super::module::comment;
use crate::emit::port::Port;
use crate::emit::port::callable::Callable;
use crate::emit::port::number::hexadecimal;
use crate::emit::port::once::Once;
use crate::emit::port::vectors::Vectors;

/// The text of `FIELD_check.py`.
pub(super) fn text(port: &Port<'_>, form: Form) -> String {
    let vectors = port.subject.vectors();
    let name = &port.name;
    let mut header = port.header();
    header.push(format!(
        "Checks {name}.py: runs every function at the points below, prints its worst error, and fails where that is not accepted. {}",
        vectors.meaning()
    ));
    let mut text = comment(&header, "");
    text += "\nimport math\nimport sys\n\n";
    text += match form {
        Form::Math => "",
        Form::NumPy => "import numpy as np\n\n",
        Form::SymPy => "import sympy as sp\n\n",
        Form::Ufl => "import ufl\nfrom ufl.corealg.traversal import unique_post_traversal\n\n",
    };
    let _ = write!(text, "import {name} as field\n\n");
    text += match form {
        Form::NumPy => {
            "# What is computed in: double precision, or what the first argument says, such as float32.\n\
            KIND = np.dtype(sys.argv[1] if len(sys.argv) > 1 else \"float64\")\n\
            EPS, LEAST = float(np.finfo(KIND).eps), float(np.finfo(KIND).tiny)\n\n"
        }
        _ => "EPS, LEAST = sys.float_info.epsilon, sys.float_info.min\n\n",
    };
    text += &tables(port, vectors);
    text += include_str!("support/check.py");
    text += match form {
        Form::Math | Form::NumPy => "",
        Form::SymPy => include_str!("support/sympy_check.py"),
        Form::Ufl => include_str!("support/ufl_check.py"),
    };
    text += &program(port, form, vectors);
    text
}

/// The test vectors, as names of Python: `SETS`, `SAMPLES` and `EXPECTED`.
pub(in crate::emit) fn tables(port: &Port<'_>, vectors: &Vectors) -> String {
    let mut text = String::new();
    text += "# Parameters: the defaults, others, and extremes.\n";
    text += "SETS = [\n";
    for set in &vectors.sets {
        let numbers: Vec<String> = set.iter().map(|value| hexadecimal(*value)).collect();
        let _ = writeln!(text, "    \"{}\",", numbers.join(" "));
    }
    text += "]\n\n# Points: which set of parameters, t, X, N and H.\nSAMPLES = \"\"\"\\\n";
    for sample in &vectors.samples {
        let numbers = [&sample.coordinates, &sample.normal, &sample.gradient].into_iter().flatten();
        let numbers = std::iter::once(&sample.time).chain(numbers).map(|value| hexadecimal(*value));
        let _ = writeln!(text, "{:#x} {}", sample.set, numbers.collect::<Vec<_>>().join(" "));
    }
    text += "\"\"\"\n\n# What each function gives: at each point, or for each set of parameters.\nEXPECTED = {\n";
    for (callable, expected) in port.callables.iter().zip(&vectors.expected) {
        if expected.is_empty() {
            continue;
        }
        let _ = writeln!(text, "    \"{}\": \"\"\"\\", callable.name);
        for row in expected {
            let numbers: Vec<String> = row.iter().map(|value| hexadecimal(*value)).collect();
            let _ = writeln!(text, "{}", numbers.join(" "));
        }
        text += "\"\"\",\n";
    }
    text + "}\n\n"
}

/// The accepted errors of what a form computes: what the formulas lose in one precision is up to a port
/// that has no other, and exact numbers lose nothing.
fn accepted(port: &Port<'_>, form: Form, vectors: &Vectors) -> Vec<String> {
    match form {
        Form::Math | Form::NumPy => vectors.accepted.iter().map(u32::to_string).collect(),
        Form::SymPy => vec!["1".into(); vectors.accepted.len()],
        Form::Ufl => {
            let accepted = port.accepted_once::<Once<f64>>().into_iter();
            accepted.map(|it| it.map_or("None".into(), |it| it.to_string())).collect()
        }
    }
}

fn program(port: &Port<'_>, form: Form, vectors: &Vectors) -> String {
    let dimension = port.dimension();
    let accepted = accepted(port, form, vectors);
    let mut text = "\n\ndefaults = field.Parameters()\n".to_string();
    for (parameter, value) in port.parameters.values().zip(&vectors.defaults) {
        let value = hexadecimal(*value);
        let _ = write!(
            text,
            "compare(0, [float.fromhex(\"{value}\")], [float(defaults.{parameter})])\n\
             settle(\"default of {parameter}\", 1)\n"
        );
    }
    text += match (port.parameters.is_empty(), form) {
        (true, _) => "fields = [field.prepare() for _ in SETS]\n",
        (false, Form::SymPy) => {
            "fields = [field.prepare(field.Parameters(*exact(rows(values)[0]))) for values in SETS]\n"
        }
        (false, _) => {
            "fields = [field.prepare(field.Parameters(*rows(values)[0])) for values in SETS]\n"
        }
    };
    text += "samples = rows(SAMPLES)\n";
    text += match form {
        Form::Math | Form::NumPy => {
            "instants = [fields[int(sample[0])].at_time(sample[1]) for sample in samples]\n"
        }
        Form::SymPy => {
            "instants = [fields[int(sample[0])].at_time(*exact(sample[1:2])) for sample in samples]\n"
        }
        Form::Ufl => "instants = [one.at_time(LEAVES[1]) for one in fields]\n",
    };
    text += "\n# Name, whether it is of a time, what it takes of a point, and the accepted error.\nFUNCTIONS = [\n";
    for (place, callable) in port.callables.iter().enumerate() {
        if vectors.expected[place].is_empty() {
            continue;
        }
        let columns = columns(callable, dimension);
        let of = match (callable.is_of_points(), callable.time) {
            (true, true) => "instants",
            (true, false) => "fields",
            (false, _) => "domain",
        };
        let accepted = &accepted[place];
        let _ = writeln!(text, "    (\"{}\", \"{of}\", {columns}, {accepted}),", callable.name);
    }
    text += "]\n";
    text += match form {
        Form::Math => {
            "\nfor name, kind, columns, accepted in FUNCTIONS:\n    \
            for row, expected in enumerate(rows(EXPECTED[name])):\n        \
            which = row if kind == \"domain\" else int(samples[row][0])\n        \
            owner = instants[row] if kind == \"instants\" else fields[which]\n        \
            inputs = [samples[row][column] for column in columns]\n        \
            compare(which, expected, flat(getattr(owner, name)(*inputs)))\n    \
            settle(name, accepted)\n"
        }
        Form::SymPy => {
            "\nfor name, kind, columns, accepted in FUNCTIONS:\n    \
            for row, expected in enumerate(rows(EXPECTED[name])):\n        \
            which = row if kind == \"domain\" else int(samples[row][0])\n        \
            owner = instants[row] if kind == \"instants\" else fields[which]\n        \
            inputs = exact(samples[row][column] for column in columns)\n        \
            compare(which, expected, numbers(getattr(owner, name)(*inputs)))\n    \
            settle(name, accepted)\n"
        }
        Form::Ufl => {
            "\nfor name, kind, columns, accepted in FUNCTIONS:\n    \
            if accepted is None:\n        \
            print(f\"{name}: not checked, one precision has no digit of it\")\n        \
            continue\n    \
            owners = instants if kind == \"instants\" else fields\n    \
            expressions = [getattr(one, name)(*(LEAVES[column] for column in columns)) for one in owners]\n    \
            for row, expected in enumerate(rows(EXPECTED[name])):\n        \
            which = row if kind == \"domain\" else int(samples[row][0])\n        \
            sample = [] if kind == \"domain\" else samples[row]\n        \
            compare(which, expected, evaluated(expressions[which], sample))\n    \
            settle(name, accepted)\n"
        }
        Form::NumPy => {
            "\nfor name, kind, columns, accepted in FUNCTIONS:\n    \
            for row, expected in enumerate(rows(EXPECTED[name])):\n        \
            which = row if kind == \"domain\" else int(samples[row][0])\n        \
            owner = instants[row] if kind == \"instants\" else fields[which]\n        \
            # Arrays of other shapes, which broadcast to one of two rows and three columns.\n        \
            shapes = [(2, 1), (3,), (2, 3)]\n        \
            inputs = [np.full(shapes[k % 3], samples[row][column], KIND) for k, column in enumerate(columns)]\n        \
            found = getattr(owner, name)(*inputs)\n        \
            if columns:\n            \
            assert found.dtype == KIND\n            \
            found = np.reshape(found, (len(expected), -1))\n            \
            assert np.all(found == found[:, :1])\n            \
            found = [float(value) for value in found[:, 0]]\n        \
            compare(which, expected, flat(found))\n    \
            settle(name, accepted)\n"
        }
    };
    let _ = write!(
        text,
        "\nprint(f\"{}: worst error {{worst:.3g}} eps, of {{worst_name}}\")\nsys.exit(1 if failures else 0)\n",
        port.name
    );
    text
}

/// The places of what a function takes, in the rows of `SAMPLES`.
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
    format!("{columns:?}")
}
