//! The program that checks the module: calls of every function, and a comparison.

use std::fmt::Write as _;

use super::{comment, continued};
use crate::port::Port;
use crate::port::callable::Callable;
use crate::port::check::Check;

/// The text of `FIELD_check.f90`.
pub(super) fn text(port: &Port<'_>) -> String {
    let (name, checks) = (&port.name, port.checks());
    let mut text = comment(&port.check_header(&format!("{name}.f90")), "");
    let _ = write!(
        text,
        "program {name}_check\n  use, intrinsic :: iso_fortran_env, only: real64\n  use {name}\n  use {name}_c\n"
    );
    if port.points() > 0 {
        text += "  use, intrinsic :: iso_c_binding, only: c_size_t\n";
    }
    let calls = checks.iter().map(|it| format!("    call check_{}()\n", short(&it.callable.name)));
    let set = |(place, name)| format!("    parameters%{name} = real(given({}), wp)\n", place + 1);
    let default = |(place, name)| {
        let place = place + 1;
        format!(
            "    call compare('default of {name}', &\n      \
             expected({place}:{place}, :), reshape([defaults%{name}], [1, 1]))\n"
        )
    };
    let parameters = || port.parameters.values().enumerate();
    text += &include_str!("support/check.f90")
        .replace("SETS", &port.subject.vectors().sets.len().to_string())
        .replace("POINTS", &port.points().to_string())
        .replace("PARAMETERS", &port.parameters.len().to_string())
        .replace("WIDTH", &port.width().to_string())
        .replace("VECTORS", &port.vectors_name())
        .replace("NAME", name)
        .replace("    FUNCTIONS\n", &calls.collect::<String>())
        .replace("    DEFAULTS\n", &parameters().map(default).collect::<String>())
        .replace("    GIVEN\n", &parameters().map(set).collect::<String>());
    checks.iter().for_each(|check| text += &checked(port, check));
    text + &format!("end program {name}_check\n")
}

/// The name of a function, shortened so that a procedure named after it has at most 63 characters.
fn short(name: &str) -> &str {
    &name[..name.len().min(57)]
}

/// The subroutine that checks a function.
fn checked(port: &Port<'_>, check: &Check<'_>) -> String {
    let (callable, table) = (check.callable, check.table);
    let (name, count) = (&callable.name, callable.components.len());
    let rows = if callable.is_of_points() { "points_count" } else { "1" };
    let mut text = format!(
        "  subroutine check_{}()\n    real(real64) :: expected({count}, {rows}), of_c({count}, {rows})\n    \
         real(wp) :: found({count}, {rows})\n{}    call check_table('{table}', expected)\n",
        short(name),
        if callable.time { "    integer :: point\n" } else { "" }
    );
    let mut arguments = vec![if callable.time { "now" } else { "field" }.to_string()];
    let columns = callable.columns();
    arguments.extend(columns.iter().map(|it| format!("real(at({}, :), wp)", it + 1)));
    text += &match (callable.is_of_points(), callable.is_scalar()) {
        (true, false) => {
            arguments.extend((1..=count).map(|index| format!("found({index}, :)")));
            continued(&format!("    call {name}"), &arguments, "")
        }
        (true, true) => continued(&format!("    found(1, :) = {name}"), &arguments, ""),
        (false, true) => continued(&format!("    found(1, 1) = {name}"), &arguments, ""),
        (false, false) => continued(&format!("    found(:, 1) = {name}"), &arguments, ""),
    };
    let _ = write!(
        text,
        "    call compare('{table}', expected, found)\n{}    \
         call compare('{table}_c', expected, real(of_c, wp))\n  end subroutine check_{}\n\n",
        through_c(port, callable),
        short(name)
    );
    text
}

/// The call of the procedure for C: of all points at once; or, if times differ, of each point and all before it, where only
/// the last result is compared.
fn through_c(port: &Port<'_>, callable: &Callable) -> String {
    let (indent, which) = if callable.time { ("      ", ":point") } else { ("    ", ":") };
    let mut arguments = Vec::new();
    if callable.is_of_points() {
        arguments.push(
            if callable.time { "int(point, c_size_t)" } else { "int(points_count, c_size_t)" }
                .to_string(),
        );
    }
    if !port.parameters.is_empty() {
        arguments.push("given".into());
    }
    if callable.time {
        arguments.push("at(1, point)".into());
    }
    let mut columns = callable.columns().into_iter().map(|it| it + 1);
    for (_, count) in callable.arrays() {
        let first = columns.by_ref().take(count).min().unwrap_or(1);
        arguments.push(format!("at({first}:{}, {which})", first + count - 1));
    }
    arguments.push(format!("of_c(:, {which})"));
    let call = continued(&format!("{indent}call {}_c", callable.name), &arguments, "");
    match callable.time {
        true => format!("    do point = points_count, 1, -1\n{call}    end do\n"),
        false => call,
    }
}
