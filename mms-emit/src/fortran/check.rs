//! The program that checks the module: test vectors, and a comparison.

use std::fmt::Write as _;

use super::{comment, continued};
use crate::port::Port;
use crate::port::callable::Callable;
use crate::port::check::Check;

/// The text of `FIELD_check.f90`. Numbers are given in statements, as bits: a compiler takes its time for
/// long tables.
pub(super) fn text(port: &Port<'_>) -> String {
    let (name, checks) = (&port.name, port.checks());
    let (sets, points) = (port.subject.vectors().sets.len(), port.points());
    let mut text = comment(&port.check_header(&format!("{name}.f90")), "");
    let _ = write!(
        text,
        "program {name}_check\n  use, intrinsic :: iso_fortran_env, only: real64, int64\n  \
         use {name}\n  use {name}_c\n"
    );
    if points > 0 {
        text += "  use, intrinsic :: iso_c_binding, only: c_size_t\n";
    }
    let _ = write!(
        text,
        "  implicit none\n\n  integer, parameter :: sets_count = {sets}\n  \
         real(real64) :: worst = 0.0_real64\n  integer :: failures = 0\n\n  \
         type(field_type) :: fields(sets_count)\n"
    );
    if !port.parameters.is_empty() {
        let _ = writeln!(text, "  real(real64) :: given({}, sets_count)", port.parameters.len());
    }
    if points > 0 {
        let dimension = port.dimension();
        let width = 1 + 2 * dimension + dimension * dimension;
        let _ = write!(
            text,
            "  integer, parameter :: points_count = {points}\n  \
             type(instant_type) :: now(points_count, sets_count)\n  \
             real(real64) :: at({width}, points_count, sets_count) ! t, X, N and H\n"
        );
    }
    text += "\n  call prepare_all()\n";
    if !port.parameters.is_empty() {
        text += "  call check_defaults()\n";
    }
    for check in &checks {
        let _ = writeln!(text, "  call check_{}()", short(&check.callable.name));
    }
    let _ = write!(
        text,
        "  print '(a, es9.3, a)', '{name}: worst error ', worst, ' eps'\n  \
         if (failures > 0) error stop 1\n\n"
    );
    text += include_str!("support/check.f90");
    text += &prepared(port);
    text += &defaults(port);
    checks.iter().for_each(|check| text += &checked(port, check));
    text + &format!("end program {name}_check\n")
}

/// The name of a function in that of a procedure of 63 characters.
fn short(name: &str) -> &str {
    &name[..name.len().min(57)]
}

/// A double as its bits.
fn bits(value: f64) -> String {
    format!("real(z'{:016x}', real64)", value.to_bits())
}

/// The statement that gives numbers to a part of an array, three to a line.
fn assigned(part: &str, values: &[f64]) -> String {
    let items: Vec<String> = values.iter().map(|value| bits(*value)).collect();
    let lines: Vec<String> = items.chunks(3).map(|chunk| chunk.join(", ")).collect();
    format!("    {part} = [ &\n      {}]\n", lines.join(", &\n      "))
}

/// The subroutine that prepares each set of parameters and its points.
fn prepared(port: &Port<'_>) -> String {
    let mut text =
        "  subroutine prepare_all()\n    type(parameters_type) :: parameters\n    integer :: set\n"
            .to_string();
    if port.points() > 0 {
        text += "    integer :: point\n";
    }
    for (set, values) in port.subject.vectors().sets.iter().enumerate() {
        if !values.is_empty() {
            text += &assigned(&format!("given(:, {})", set + 1), values);
        }
    }
    for (set, samples) in port.samples().into_iter().enumerate() {
        for (point, sample) in samples.iter().enumerate() {
            let part = format!("at(:, {}, {})", point + 1, set + 1);
            text += &assigned(&part, &sample.numbers());
        }
    }
    text += "    parameters = default_parameters()\n    do set = 1, sets_count\n";
    for (index, parameter) in port.parameters.values().enumerate() {
        let _ =
            writeln!(text, "      parameters%{parameter} = real(given({}, set), wp)", index + 1);
    }
    text += "      fields(set) = prepare(parameters)\n";
    if port.points() > 0 {
        text += "      do point = 1, points_count\n        \
                 now(point, set) = at_time(fields(set), real(at(1, point, set), wp))\n      end do\n";
    }
    text + "    end do\n  end subroutine prepare_all\n\n"
}

fn defaults(port: &Port<'_>) -> String {
    if port.parameters.is_empty() {
        return String::new();
    }
    let mut text = "  subroutine check_defaults()\n    type(parameters_type) :: defaults\n    \
         real(real64) :: expected(1, 1)\n    real(wp) :: found(1, 1)\n    \
         defaults = default_parameters()\n"
        .to_string();
    for (parameter, value) in port.parameters.values().zip(&port.subject.vectors().defaults) {
        let _ = write!(
            text,
            "    expected = {}\n    found = defaults%{parameter}\n    call compare( &\n      \
             'default of {parameter}', 1, expected, found)\n",
            bits(*value)
        );
    }
    text + "  end subroutine check_defaults\n\n"
}

/// The subroutine that checks a function.
fn checked(port: &Port<'_>, check: &Check<'_>) -> String {
    let callable = check.callable;
    let (name, count, accepted) = (&callable.name, callable.components.len(), check.accepted);
    let rows = if callable.is_of_points() { "points_count" } else { "1" };
    let mut text = format!(
        "  subroutine check_{}()\n    real(real64) :: expected({count}, {rows}, sets_count), of_c({count}, {rows})\n    \
         real(wp) :: found({count}, {rows})\n    integer :: set{}\n",
        short(name),
        if callable.time { ", point" } else { "" }
    );
    for (set, rows) in check.expected.iter().enumerate() {
        for (row, values) in rows.iter().enumerate() {
            text += &assigned(&format!("expected(:, {}, {})", row + 1, set + 1), values);
        }
    }
    text += "    do set = 1, sets_count\n";
    let mut arguments = vec![if callable.time { "now(:, set)" } else { "fields(set)" }.to_string()];
    let columns = callable.columns(port.dimension());
    arguments.extend(columns.iter().map(|it| format!("real(at({}, :, set), wp)", it + 1)));
    text += &match (callable.is_of_points(), callable.is_scalar()) {
        (true, false) => {
            arguments.extend((1..=count).map(|index| format!("found({index}, :)")));
            continued(&format!("      call {name}"), &arguments, "")
        }
        (true, true) => continued(&format!("      found(1, :) = {name}"), &arguments, ""),
        (false, true) => continued(&format!("      found(1, 1) = {name}"), &arguments, ""),
        (false, false) => continued(&format!("      found(:, 1) = {name}"), &arguments, ""),
    };
    let _ = write!(
        text,
        "      call compare('{name}', {accepted}, expected(:, :, set), found)\n{}      \
         call compare('{name}_c', {accepted}, expected(:, :, set), real(of_c, wp))\n    end do\n  \
         end subroutine check_{}\n\n",
        through_c(port, callable),
        short(name)
    );
    text
}

/// The call of the procedure for C: of all points; or where they have times of each and all before it, so that what is
/// compared is the last of them.
fn through_c(port: &Port<'_>, callable: &Callable) -> String {
    let (indent, which) = if callable.time { ("        ", ":point") } else { ("      ", ":") };
    let mut arguments = Vec::new();
    if callable.is_of_points() {
        arguments.push(
            if callable.time { "int(point, c_size_t)" } else { "int(points_count, c_size_t)" }
                .to_string(),
        );
    }
    if !port.parameters.is_empty() {
        arguments.push("given(:, set)".into());
    }
    if callable.time {
        arguments.push("at(1, point, set)".into());
    }
    let mut columns = callable.columns(port.dimension()).into_iter().map(|it| it + 1);
    for (_, count) in callable.arrays() {
        let first = columns.by_ref().take(count).min().unwrap_or(1);
        arguments.push(format!("at({first}:{}, {which}, set)", first + count - 1));
    }
    arguments.push(format!("of_c(:, {which})"));
    let call = continued(&format!("{indent}call {}_c", callable.name), &arguments, "");
    match callable.time {
        true => format!("      do point = points_count, 1, -1\n{call}      end do\n"),
        false => call,
    }
}
