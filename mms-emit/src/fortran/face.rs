//! The face for C: procedures over arrays, which iso_c_binding makes callable from C.

use std::fmt::Write as _;

use super::{comment, continued, documented};
use crate::port::Port;
use crate::port::callable::Callable;

/// The name of the module.
pub(super) fn module(port: &Port<'_>) -> String {
    format!("{}_c", port.name)
}

/// The text of `FIELD_c.f90`.
pub(super) fn text(port: &Port<'_>) -> String {
    let (name, module) = (&port.name, module(port));
    let mut header = port.header();
    header.push(format!(
        "The functions of {name}.f90 for C, and for what can call C: at n points, each of which has its numbers side by side, tensors by rows.{} The line above a procedure declares it in C.",
        parameters_meaning(port)
    ));
    let mut text = comment(&header, "");
    let of_points = port.callables.iter().any(Callable::is_of_points);
    let kinds = if of_points { "c_double, c_size_t" } else { "c_double" };
    let _ = write!(
        text,
        "module {module}\n  use, intrinsic :: iso_c_binding, only: {kinds}\n  use {name}\n  implicit none\n  private\n\n"
    );
    if !port.parameters.is_empty() {
        text += "  public :: default_parameters_c\n";
    }
    for callable in &port.callables {
        let _ = writeln!(text, "  public :: {}_c", callable.name);
    }
    text += "\ncontains\n";
    if !port.parameters.is_empty() {
        text += &defaults(port);
    }
    for callable in &port.callables {
        text += &procedure(port, callable);
    }
    if !port.parameters.is_empty() {
        text += &given(port);
    }
    let _ = writeln!(text, "\nend module {module}");
    text
}

fn parameters_meaning(port: &Port<'_>) -> String {
    let names: Vec<&str> = port.parameters.values().map(String::as_str).collect();
    match names.as_slice() {
        [] => String::new(),
        names => format!(" Parameters are an array of {}.", names.join(", ")),
    }
}

fn defaults(port: &Port<'_>) -> String {
    let (name, count) = (&port.name, port.parameters.len());
    let mut text = format!(
        "\n  !> void {name}_default_parameters_c(double parameters[{count}]);\n  \
         subroutine default_parameters_c(parameters) &\n      \
         bind(c, name='{name}_default_parameters_c')\n    \
         real(c_double), intent(out) :: parameters({count})\n    \
         type(parameters_type) :: defaults\n    defaults = default_parameters()\n"
    );
    for (place, parameter) in port.parameters.values().enumerate() {
        let place = place + 1;
        let _ = writeln!(text, "    parameters({place}) = real(defaults%{parameter}, c_double)");
    }
    text + "  end subroutine default_parameters_c\n"
}

/// The parameters of an array.
fn given(port: &Port<'_>) -> String {
    let mut text = format!(
        "\n  pure function given(values) result(parameters)\n    \
         real(c_double), intent(in) :: values({})\n    type(parameters_type) :: parameters\n",
        port.parameters.len()
    );
    for (place, parameter) in port.parameters.values().enumerate() {
        let _ = writeln!(text, "    parameters%{parameter} = real(values({}), wp)", place + 1);
    }
    text + "  end function given\n"
}

/// The name of an argument that is an array: N and H are renamed, because Fortran does not distinguish N from n.
fn array(name: &str) -> &str {
    match name {
        "N" => "normal",
        "H" => "gradient",
        name => name,
    }
}

/// The arguments of a procedure but `out`: each with its declarations in C and in Fortran.
fn arguments(port: &Port<'_>, callable: &Callable) -> Vec<[String; 3]> {
    let mut all = Vec::new();
    let mut add = |name: &str, c: String, fortran: String| all.push([name.into(), c, fortran]);
    if callable.is_of_points() {
        add("n", "size_t n".into(), "integer(c_size_t), value :: n".into());
    }
    let count = port.parameters.len();
    if count > 0 {
        let declared = format!("real(c_double), intent(in) :: parameters({count})");
        add("parameters", format!("const double parameters[{count}]"), declared);
    }
    if callable.time {
        add("t", "double t".into(), "real(c_double), value :: t".into());
    }
    for (name, count) in callable.arrays() {
        let name = array(name);
        let declared = format!("real(c_double), intent(in) :: {name}({count}, n)");
        add(name, format!("const double *{name}"), declared);
    }
    all
}

/// A function of the module as a procedure for C.
fn procedure(port: &Port<'_>, callable: &Callable) -> String {
    let (function, count) = (&callable.name, callable.components.len());
    let own = format!("{function}_c");
    let mut arguments = arguments(port, callable);
    let (c, fortran) = match callable.is_of_points() {
        true => ("double *out".to_string(), format!("out({count}, n)")),
        false => (format!("double out[{count}]"), format!("out({count})")),
    };
    arguments.push(["out".into(), c, format!("real(c_double), intent(out) :: {fortran}")]);
    let column = |column: usize| -> Vec<String> {
        arguments.iter().map(|argument| argument[column].clone()).collect()
    };
    let prototype = format!("void {}_{own}({});", port.name, column(1).join(", "));
    let mut text = "\n".to_string() + &documented(&callable.documentation(), "  ");
    text += &documented(&prototype, "  ");
    text += &continued(&format!("  subroutine {own}"), &column(0), " &");
    let _ = writeln!(text, "      bind(c, name='{}_{own}')", port.name);
    for declaration in column(2) {
        let _ = writeln!(text, "    {declaration}");
    }
    text += &body(port, callable);
    text + &format!("  end subroutine {own}\n")
}

fn body(port: &Port<'_>, callable: &Callable) -> String {
    let parameters = match port.parameters.is_empty() {
        true => "parameters_type()",
        false => "given(parameters)",
    };
    let (subject, kind, value) = match callable.time {
        true => ("now", "instant_type", format!("at_time(prepare({parameters}), real(t, wp))")),
        false => ("field", "field_type", format!("prepare({parameters})")),
    };
    let (function, count) = (&callable.name, callable.components.len());
    let mut text = format!("    type({kind}) :: {subject}\n");
    if !callable.is_of_points() {
        let result = if callable.is_scalar() { "[real(y, c_double)]" } else { "real(y, c_double)" };
        let shape = if callable.is_scalar() { String::new() } else { format!("({count})") };
        let _ = write!(
            text,
            "    real(wp) :: y{shape}\n    {subject} = {value}\n    y = {function}({subject})\n    out = {result}\n"
        );
        return text;
    }
    let mut items = vec![subject.to_string()];
    for (name, count) in callable.arrays() {
        items.extend((1..=count).map(|index| format!("real({}({index}, i), wp)", array(name))));
    }
    let start = match callable.is_scalar() {
        true => format!("      y = {function}"),
        false => {
            items.extend((1..=count).map(|index| format!("y({index})")));
            format!("      call {function}")
        }
    };
    let shape = if callable.is_scalar() { String::new() } else { format!("({count})") };
    let _ = write!(
        text,
        "    real(wp) :: y{shape}\n    integer(c_size_t) :: i\n    {subject} = {value}\n    do i = 1, n\n{}      \
         out(:, i) = real(y, c_double)\n    end do\n",
        continued(&start, &items, "")
    );
    text
}
