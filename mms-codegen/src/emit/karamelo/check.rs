//! The program that checks the variables: it reads them, and evaluates them as Karamelo does.

use std::fmt::Write as _;

use crate::emit::moose::functions;
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
        "Checks {name}.kar: evaluates every variable in single precision at the points below, prints its worst error, and fails where that is not accepted. {} Here an eps is that of single precision, every step is rounded to it, and where that loses more than half of what is accepted, four times that loss is; None is accepted where nothing is left.",
        vectors.meaning()
    ));
    let mut text = comment(&header, "");
    let _ = write!(
        text,
        "\nimport ctypes\nimport math\nimport pathlib\nimport re\nimport sys\n\nFIELD = \"{name}\"\n\
         EPS, LEAST = 2.0**-23, 2.0**-126\n\n"
    );
    text += &tables(port, vectors);
    text += &functions(port, port.accepted_once::<Once<f32>>());
    text += include_str!("../python/support/check.py");
    text + include_str!("support/check.py")
}
