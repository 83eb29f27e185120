//! The program that checks the file: a list of functions, and a comparison in both precisions.

use std::fmt::Write as _;

use super::comment;
use crate::port::Port;

/// The text of `FIELD_check.m`.
pub(super) fn text(port: &Port<'_>) -> String {
    let name = &port.name;
    let names: Vec<String> = port.parameters.values().map(|name| format!("'{name}'")).collect();
    let mut text = format!(
        "function {name}_check()\n{}\n  names = {{{}}};\n\n  \
         % Name, function, its owner, and columns of its inputs.\n  functions = {{ ...\n",
        comment(&port.check_header(&format!("{name}.m")), "  "),
        names.join(", ")
    );
    for check in port.checks() {
        let callable = check.callable;
        let of = callable.owner(["alone", "field", "now"]);
        let columns: Vec<usize> = callable.columns().iter().map(|it| it + 1).collect();
        let _ =
            writeln!(text, "    '{}', '{}', '{of}', {columns:?}; ...", check.table, callable.name);
    }
    let has_single = port.subject.vectors().accepted_in_single.is_some();
    let precisions = if has_single { "'double', 'single'" } else { "'double'" };
    let sets = port.subject.vectors().sets.len();
    let _ = writeln!(text, "  }};\n  sets = {sets};\n  precisions = {{{precisions}}};");
    text + &include_str!("support/check.m").replace("field_", name)
}
