//! The program that checks the variables: it reads them, and evaluates them as Karamelo does.

use std::fmt::Write as _;

use crate::moose::functions;
use crate::port::Port;
use crate::port::once::Once;
use crate::python::check::checked;
use crate::python::module::comment;

/// The text of `FIELD_check.py`.
pub(super) fn text(port: &Port<'_>) -> String {
    let name = &port.name;
    let mut header = port.check_header(&format!("{name}.kar"));
    if let Some(last) = header.last_mut() {
        *last += " Here eps is the one of single precision, and every step is rounded to it. Where this rounding loses more than half of the accepted error, four times the loss is accepted.";
    }
    let mut text = comment(&header, "");
    let _ = write!(
        text,
        "\nimport ctypes\nimport math\nimport pathlib\nimport re\nimport sys\n\n{}",
        checked(port, "EPS, LEAST = 2.0**-23, 2.0**-126\n")
    );
    text += &functions(port, port.accepted_once::<Once<f32>>());
    text + include_str!("support/check.py")
}
