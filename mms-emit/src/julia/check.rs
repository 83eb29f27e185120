//! The program that checks the module: a list of functions, and a comparison in both precisions.

use std::fmt::Write as _;

use crate::port::Port;
use crate::python::module::comment;

/// The text of `FIELD_check.jl`.
pub(super) fn text(port: &Port<'_>) -> String {
    let name = &port.name;
    let mut text = comment(&port.check_header(&format!("{name}.jl")), "");
    let _ = write!(
        text,
        "\ninclude(\"{name}.jl\")\nimport .{name} as field\n\nconst NAME = \"{name}\"\n\n\
         # Name, function, its owner, and columns of its inputs.\nconst FUNCTIONS = [\n"
    );
    for check in port.checks() {
        let (callable, table) = (check.callable, check.table);
        let owner = callable.owner(["alone", "field", "now"]);
        let columns: Vec<usize> = callable.columns().iter().map(|it| it + 1).collect();
        let _ =
            writeln!(text, "    (\"{table}\", field.{}, :{owner}, Int{columns:?}),", callable.name);
    }
    let has_single = port.subject.vectors().accepted_in_single.is_some();
    let precisions = if has_single { "(Float64, Float32)" } else { "(Float64,)" };
    let sets = port.subject.vectors().sets.len();
    let _ = write!(text, "]\n\nconst SETS = {sets}\n\nconst PRECISIONS = {precisions}\n\n");
    text + include_str!("support/check.jl")
}
