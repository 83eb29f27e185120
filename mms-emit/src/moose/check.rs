//! The program that checks the blocks: it reads them, and evaluates their formulas.

use std::fmt::Write as _;

use crate::port::Port;
use crate::port::once::Once;
use crate::python::check::{DOUBLE, checked};
use crate::python::module::comment;

/// The text of `FIELD_check.py`.
pub(super) fn text(port: &Port<'_>) -> String {
    let name = &port.name;
    let mut header = port.check_header(&format!("{name}.i"));
    if let Some(last) = header.last_mut() {
        *last += " Formulas are evaluated in one precision throughout; where that loses more than half of it, four times that loss is accepted.";
    }
    let mut text = comment(&header, "");
    let _ = write!(
        text,
        "\nimport math\nimport pathlib\nimport re\nimport sys\n\n{}",
        checked(port, DOUBLE)
    );
    text += &functions(port, port.accepted_once::<Once<f64>>());
    text + include_str!("support/check.py")
}

/// The names of the parameters with their defaults, and the list of functions to check.
pub(crate) fn functions(port: &Port<'_>, accepted: Vec<Option<u32>>) -> String {
    let names: Vec<_> = port.parameters.values().collect();
    let (axes, _) = "txyz".split_at(1 + port.dimension());
    let mut text = format!(
        "\n# The parameters and their defaults.\nDEFAULTS = dict(zip({names:?}, FIRST[\"defaults\"][0]))\n\n\
         # The names of the numbers of a point that functions take.\nAXES = \"{axes}\"\n\n\
         # Name, whether it is of points, its components, and the accepted error.\nFUNCTIONS = [\n"
    );
    let mut unchecked = Vec::new();
    for check in port.checks() {
        let callable = check.callable;
        if !callable.is_of_places() {
            continue;
        }
        let suffixes = callable.suffixes();
        let of_points = if callable.is_of_points() { "True" } else { "False" };
        match accepted[check.place] {
            Some(accepted) => {
                let _ = writeln!(
                    text,
                    "    (\"{}\", {of_points}, {suffixes:?}, {accepted}),",
                    callable.name
                );
            }
            None => unchecked.push(&callable.name),
        }
    }
    text + &format!(
        "]\n\n# In the precision of the formulas no digit is left of these.\nUNCHECKED = {unchecked:?}\n\n"
    )
}
