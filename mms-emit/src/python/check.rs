//! The program that checks the module: test vectors, and a comparison.

use std::fmt::Write as _;

use super::dialect::Library;
use super::module::comment;
use crate::port::Port;
use crate::port::number::hexadecimal;
use crate::port::once::Once;

/// What check programs in Python begin with: what compares.
pub(crate) const CHECK: &str = include_str!("support/check.py");

/// The text of `FIELD_check.py`.
pub(super) fn text(port: &Port<'_>, library: Library) -> String {
    let name = &port.name;
    let mut text = comment(&port.check_header(&format!("{name}.py")), "");
    text += "\nimport math\nimport sys\n\n";
    text += match library {
        Library::Math => "",
        Library::NumPy => "import numpy as np\n\n",
        Library::SymPy => "import sympy as sp\n\n",
        Library::Ufl => {
            "import functools\n\nimport ufl\nfrom ufl.corealg.traversal import unique_post_traversal\n\n"
        }
    };
    let _ = write!(text, "import {name} as field\n\n");
    text += match library {
        Library::NumPy => {
            "# What is computed in: double precision, or what the first argument says, such as float32.\n\
            KIND = np.dtype(sys.argv[1] if len(sys.argv) > 1 else \"float64\")\n\
            EPS, LEAST = float(np.finfo(KIND).eps), float(np.finfo(KIND).tiny)\n\n"
        }
        _ => "EPS, LEAST = sys.float_info.epsilon, sys.float_info.min\n\n",
    };
    text += CHECK;
    text += &tables(port);
    text += match library {
        Library::Math => "\n",
        Library::NumPy => include_str!("support/numpy_check.py"),
        Library::SymPy => include_str!("support/sympy_check.py"),
        Library::Ufl => include_str!("support/ufl_check.py"),
    };
    text + &functions(port, library) + &program(port, library)
}

/// The test vectors, as names of Python: `SETS`, `POINTS` and `EXPECTED`.
pub(crate) fn tables(port: &Port<'_>) -> String {
    let line = |values: Vec<f64>| {
        let numbers: Vec<String> = values.iter().map(|value| hexadecimal(*value)).collect();
        numbers.join(" ") + "\n"
    };
    let mut text = "\n\n# Parameters: the defaults, others, and extremes.\nSETS = [\n".to_string();
    for set in &port.subject.vectors().sets {
        let _ = writeln!(text, "    \"{}\",", line(set.clone()).trim_end());
    }
    text += "]\n\n# The points of each set of parameters: t, X, N and H.\nPOINTS = [\n";
    let mut samples = port.samples().into_iter();
    for _ in &port.subject.vectors().sets {
        let lines = samples.next().unwrap_or_default().iter().map(|it| line(it.numbers()));
        let _ = writeln!(text, "    \"\"\"\\\n{}\"\"\",", lines.collect::<String>());
    }
    text += "]\n\n# What each function gives: at each point, or for each set of parameters.\nEXPECTED = [\n";
    for set in 0..port.subject.vectors().sets.len() {
        text += "    {\n";
        for check in port.checks() {
            let lines: String = check.expected[set].iter().cloned().map(line).collect();
            let _ = writeln!(text, "        \"{}\": \"\"\"\\\n{lines}\"\"\",", check.callable.name);
        }
        text += "    },\n";
    }
    text + "]\n"
}

/// The accepted errors of what a library computes: what the formulas lose in one precision is up to a port
/// that has no other, and exact numbers lose nothing.
fn accepted(port: &Port<'_>, library: Library) -> Vec<Option<u32>> {
    let accepted = &port.subject.vectors().accepted;
    match library {
        Library::Math | Library::NumPy => accepted.iter().copied().map(Some).collect(),
        Library::SymPy => vec![Some(1); accepted.len()],
        Library::Ufl => port.accepted_once::<Once<f64>>(),
    }
}

/// The list of functions.
fn functions(port: &Port<'_>, library: Library) -> String {
    let accepted = accepted(port, library);
    let mut text =
        "# Name, what it is of, what it takes of a point, and the accepted error.\nFUNCTIONS = [\n"
            .to_string();
    let mut unchecked = Vec::new();
    for check in port.checks() {
        let callable = check.callable;
        let of = match (callable.is_of_points(), callable.time) {
            (true, true) => "now",
            (true, false) => "field",
            (false, _) => "domain",
        };
        let (name, columns) = (&callable.name, callable.columns(port.dimension()));
        match accepted[check.place] {
            Some(accepted) => {
                let _ = writeln!(text, "    (\"{name}\", \"{of}\", {columns:?}, {accepted}),");
            }
            None => unchecked.push(format!("\"{name}\"")),
        }
    }
    text += "]\n";
    if !unchecked.is_empty() {
        let _ = write!(
            text,
            "\nfor name in [{}]:\n    print(f\"{{name}}: not checked, one precision has no digit of it\")\n",
            unchecked.join(", ")
        );
    }
    text
}

/// The program itself.
fn program(port: &Port<'_>, library: Library) -> String {
    let mut text = "\ndefaults = field.Parameters()\n".to_string();
    for (parameter, value) in port.parameters.values().zip(&port.subject.vectors().defaults) {
        let value = hexadecimal(*value);
        let _ = writeln!(
            text,
            "check(\"default of {parameter}\", 1, float.fromhex(\"{value}\"), float(defaults.{parameter}))"
        );
    }
    let values = "flat(rows(values))";
    let [parameters, instant, call] = match library {
        Library::Math => [
            values,
            "[one.at_time(point[0]) for point in points]",
            "getattr(owner, name)(*(point[k] for k in columns))",
        ],
        Library::NumPy => [
            values,
            "[one.at_time(point[0]) for point in points]",
            "at_arrays(getattr(owner, name), [point[k] for k in columns])",
        ],
        Library::SymPy => [
            "exact(flat(rows(values)))",
            "[one.at_time(*exact(point[:1])) for point in points]",
            "numbers(getattr(owner, name)(*exact(point[k] for k in columns)))",
        ],
        Library::Ufl => [
            values,
            "[one.at_time(leaf) for leaf in LEAVES[:1]] * len(points)",
            "evaluated(expression(owner, name, *columns), point)",
        ],
    };
    text + &include_str!("support/main.py")
        .replace("PARAMETERS", parameters)
        .replace("INSTANTS", instant)
        .replace("CALL", call)
        .replace("field_", &port.name)
}
