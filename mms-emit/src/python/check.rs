//! The program that checks the module: test vectors, and a comparison.

use std::fmt::Write as _;

use super::dialect::Library;
use super::module::comment;
use crate::port::Port;
use crate::port::once::Once;

/// The text of `FIELD_check.py`.
pub(super) fn text(port: &Port<'_>, library: Library) -> String {
    let name = &port.name;
    let mut text = comment(&port.check_header(&format!("{name}.py")), "");
    text += "\nimport math\nimport pathlib\nimport sys\n\n";
    text += match library {
        Library::Math => "",
        Library::NumPy => "import numpy as np\n\n",
        Library::SymPy => "import sympy as sp\n\n",
        Library::Ufl => {
            "import functools\n\nimport ufl\nfrom ufl.corealg.traversal import unique_post_traversal\n\n"
        }
    };
    let _ = write!(text, "import {name} as field\n\n");
    text += &checked(
        port,
        match library {
            Library::NumPy => {
                "# The precision: double, or the one that the first argument names, such as float32.\n\
            KIND = np.dtype(sys.argv[1] if len(sys.argv) > 1 else \"float64\")\n\
            EPS, LEAST = float(np.finfo(KIND).eps), float(np.finfo(KIND).tiny)\n"
            }
            _ => DOUBLE,
        },
    );
    text += match library {
        Library::Math => "",
        Library::NumPy => include_str!("support/numpy_check.py"),
        Library::SymPy => include_str!("support/sympy_check.py"),
        Library::Ufl => include_str!("support/ufl_check.py"),
    };
    text + "\n" + &functions(port, library) + &program(library).replace("field_", name)
}

/// The precision of Python.
pub(crate) const DOUBLE: &str = "EPS, LEAST = sys.float_info.epsilon, sys.float_info.min\n";

/// The comparison in a precision, and the test vectors: `FIRST` has the defaults, `SETS` the tables of each set.
pub(crate) fn checked(port: &Port<'_>, precision: &str) -> String {
    let (name, count) = (&port.name, port.subject.vectors().sets.len());
    format!("FIELD, COUNT = \"{name}\", {count}\n{precision}\n{}", include_str!("support/check.py"))
}

/// The accepted errors of a library. If the library has one precision only, the loss of the formulas in it is accepted;
/// exact numbers lose nothing.
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
        "# Table, name, what it is of, what it takes of a point, and the accepted error.\nFUNCTIONS = [\n"
            .to_string();
    let mut unchecked = Vec::new();
    for check in port.checks() {
        let callable = check.callable;
        let of = callable.owner(["domain", "field", "now"]);
        let (name, table) = (&callable.name, check.table);
        let columns = callable.columns();
        match accepted[check.place] {
            Some(accepted) => {
                let _ = writeln!(
                    text,
                    "    (\"{table}\", \"{name}\", \"{of}\", {columns:?}, {accepted}),"
                );
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
fn program(library: Library) -> String {
    let [parameters, instant, call] = match library {
        Library::Math => [
            "values",
            "[one.at_time(point[0]) for point in points]",
            "getattr(owner, name)(*(point[k] for k in columns))",
        ],
        Library::NumPy => [
            "values",
            "[one.at_time(point[0]) for point in points]",
            "at_arrays(getattr(owner, name), [point[k] for k in columns])",
        ],
        Library::SymPy => [
            "exact(values)",
            "[one.at_time(*exact(point[:1])) for point in points]",
            "numbers(getattr(owner, name)(*exact(point[k] for k in columns)))",
        ],
        Library::Ufl => [
            "values",
            "[one.at_time(leaf) for leaf in LEAVES[:1]] * len(points)",
            "evaluated(expression(owner, name, *columns), point)",
        ],
    };
    include_str!("support/main.py")
        .replace("PARAMETERS", parameters)
        .replace("INSTANTS", instant)
        .replace("CALL", call)
}
