//! The program that checks the blocks: it reads them, and evaluates their formulas.

use std::fmt::Write as _;

use crate::emit::port::Port;
use crate::emit::port::once::Once;
use crate::emit::python::check::tables;
use crate::emit::python::module::comment;

/// The text of `FIELD_check.py`.
pub(super) fn text(port: &Port<'_>) -> String {
    let vectors = port.subject.vectors();
    let name = &port.name;
    let mut header = port.header();
    header.push(format!(
        "Checks {name}.i: evaluates every function in double precision at the points below, prints its worst error, and fails where that is not accepted. {} Formulas are evaluated in one precision throughout; where that loses more than half of it, four times that loss is accepted.",
        vectors.meaning()
    ));
    let mut text = comment(&header, "");
    let _ = write!(
        text,
        "\nimport math\nimport pathlib\nimport re\nimport sys\n\nFIELD = \"{name}\"\n\
         EPS, LEAST = sys.float_info.epsilon, sys.float_info.min\n\n"
    );
    text += &tables(port, vectors);
    text += &functions(port, port.accepted_once::<Once<f64>>());
    text += include_str!("../python/support/check.py");
    text + include_str!("support/check.py")
}

/// The names of the parameters with their defaults, and what is checked.
pub(in crate::emit) fn functions(port: &Port<'_>, accepted: Vec<Option<u32>>) -> String {
    let vectors = port.subject.vectors();
    let mut text = "# The parameters and their defaults.\nDEFAULTS = {\n".to_string();
    for (parameter, default) in port.parameters.values().zip(&vectors.defaults) {
        let _ = writeln!(text, "    \"{parameter}\": {default:?},");
    }
    text += "}\n\n# Name, whether it is of points, its components, and the accepted error.\nFUNCTIONS = [\n";
    for (place, callable) in port.callables.iter().enumerate() {
        if !callable.is_of_places() || vectors.expected[place].is_empty() {
            continue;
        }
        let suffixes: Vec<String> =
            callable.suffixes(port.dimension()).iter().map(|it| format!("\"{it}\"")).collect();
        let of_points = if callable.is_of_points() { "True" } else { "False" };
        let accepted = accepted[place].map_or("None".into(), |it| it.to_string());
        let _ = writeln!(
            text,
            "    (\"{}\", {of_points}, [{}], {accepted}),",
            callable.name,
            suffixes.join(", ")
        );
    }
    text + "]\n\n"
}
