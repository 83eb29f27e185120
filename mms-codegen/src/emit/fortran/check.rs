//! The program that checks the module: test vectors, and a comparison.

use std::fmt::Write as _;

use super::comment;
use crate::emit::port::Port;
use crate::emit::port::callable::Callable;
use crate::emit::port::vectors::{Sample, Vectors};

/// The text of `FIELD_check.f90`. Numbers are read from text, as bits: a compiler takes its time for
/// long tables.
pub(super) fn text(port: &Port<'_>) -> String {
    let vectors = port.subject.vectors();
    let name = &port.name;
    let mut header = port.header();
    header.push(format!(
        "Checks {name}.f90: runs every function at the points below, prints its worst error, and fails where that is not accepted. {}",
        vectors.meaning()
    ));
    let (sets, samples) = (vectors.sets.len(), vectors.samples.len());
    let dimension = port.dimension();
    let of_points = samples > 0 && port.callables.iter().any(Callable::is_of_points);
    let of_c = match of_points {
        true => "  use, intrinsic :: iso_c_binding, only: c_size_t\n",
        false => "",
    };
    let mut text = comment(&header, "");
    let _ = write!(
        text,
        "program {name}_check\n  use, intrinsic :: iso_fortran_env, only: real64, int64\n  use {name}\n  use {name}_c\n{of_c}  implicit none\n\n  \
         integer, parameter :: sets_count = {sets}, samples_count = {samples}\n  \
         real(real64) :: errors(sets_count) = 0.0_real64, magnitudes(sets_count) = 0.0_real64\n  \
         real(real64) :: worst = 0.0_real64\n  character(40) :: worst_name = 'nothing'\n  \
         integer :: failures = 0\n\n  type(field_type) :: fields(sets_count)\n"
    );
    if !port.parameters.is_empty() {
        let _ = writeln!(text, "  real(real64) :: given({}, sets_count)", port.parameters.len());
    }
    let points = 1 + 2 * dimension + dimension * dimension;
    let _ = write!(
        text,
        "  integer, parameter :: set_of(samples_count) = [ &\n    {}]\n  \
         real(wp) :: at({points}, samples_count) ! t, X, N and H\n\n",
        wrapped_integers(vectors)
    );
    text += "  call prepare_fields()\n  call set_points()\n";
    if !port.parameters.is_empty() {
        text += "  call check_defaults()\n";
    }
    for (callable, expected) in port.callables.iter().zip(&vectors.expected) {
        if !expected.is_empty() {
            let _ = writeln!(text, "  call check_{}()", short(&callable.name));
        }
    }
    let _ = write!(
        text,
        "  print '(a, es9.3, a, a)', &\n    '{name}: worst error ', worst, ' eps, of ', trim(worst_name)\n  \
         if (failures > 0) error stop 1\n\n"
    );
    text += include_str!("support/check.f90");
    text += &prepared(port, vectors);
    text += &points_set(vectors, points);
    text += &defaults(port, vectors);
    for (place, callable) in port.callables.iter().enumerate() {
        if !vectors.expected[place].is_empty() {
            text += &check(port, callable, vectors, place);
        }
    }
    let _ = writeln!(text, "end program {name}_check");
    text
}

/// The name of a function in that of a procedure of 63 characters.
fn short(name: &str) -> &str {
    &name[..name.len().min(57)]
}

fn wrapped_integers(vectors: &Vectors) -> String {
    let sets: Vec<String> =
        vectors.samples.iter().map(|sample| (sample.set + 1).to_string()).collect();
    let lines: Vec<String> = sets.chunks(24).map(|chunk| chunk.join(", ")).collect();
    lines.join(", &\n    ")
}

/// A double as its bits.
fn bits(value: f64) -> String {
    format!("real(z'{:016x}', real64)", value.to_bits())
}

/// Numbers as an array, three to a line.
fn array(values: &[f64], indent: &str) -> String {
    let items: Vec<String> = values.iter().map(|value| bits(*value)).collect();
    let lines: Vec<String> = items.chunks(3).map(|chunk| chunk.join(", ")).collect();
    format!("[ &\n{indent}  {}]", lines.join(&format!(", &\n{indent}  ")))
}

fn prepared(port: &Port<'_>, vectors: &Vectors) -> String {
    let mut text =
        "  subroutine prepare_fields()\n    type(parameters_type) :: parameters\n".to_string();
    text += "    parameters = default_parameters()\n";
    for (set, values) in vectors.sets.iter().enumerate() {
        for (parameter, value) in port.parameters.values().zip(values) {
            let _ = writeln!(text, "    parameters%{parameter} = real({}, wp)", bits(*value));
        }
        if !values.is_empty() {
            let _ = writeln!(text, "    given(:, {}) = {}", set + 1, array(values, "    "));
        }
        let _ = writeln!(text, "    fields({}) = prepare(parameters)", set + 1);
    }
    text + "  end subroutine prepare_fields\n\n"
}

fn points_set(vectors: &Vectors, points: usize) -> String {
    let mut text = "  subroutine set_points()\n".to_string();
    let _ = writeln!(text, "    real(real64) :: numbers({points})");
    for (index, sample) in vectors.samples.iter().enumerate() {
        let Sample { time, coordinates, normal, gradient, .. } = sample;
        let numbers: Vec<f64> =
            [*time].iter().chain(coordinates).chain(normal).chain(gradient).copied().collect();
        let _ = writeln!(text, "    numbers = {}", array(&numbers, "    "));
        let _ = writeln!(text, "    at(:, {}) = real(numbers, wp)", index + 1);
    }
    text + "  end subroutine set_points\n\n"
}

fn defaults(port: &Port<'_>, vectors: &Vectors) -> String {
    if port.parameters.is_empty() {
        return String::new();
    }
    let mut text =
        "  subroutine check_defaults()\n    type(parameters_type) :: defaults\n".to_string();
    text += "    defaults = default_parameters()\n";
    for (parameter, value) in port.parameters.values().zip(&vectors.defaults) {
        let _ = write!(
            text,
            "    call compare(1, [{}], [defaults%{parameter}])\n    call settle('default', 1)\n",
            bits(*value)
        );
    }
    text + "  end subroutine check_defaults\n\n"
}

fn check(port: &Port<'_>, callable: &Callable, vectors: &Vectors, place: usize) -> String {
    let name = &callable.name;
    let count = callable.components.len();
    let rows = &vectors.expected[place];
    let mut text = format!("  subroutine check_{}()\n", short(name));
    let _ = write!(
        text,
        "    real(real64) :: expected({count}, {}), of_c({count})\n    real(wp) :: out({count})\n    integer :: s\n",
        rows.len()
    );
    for (index, values) in rows.iter().enumerate() {
        let _ = writeln!(text, "    expected(:, {}) = {}", index + 1, array(values, "    "));
    }
    let dimension = port.dimension();
    let (limit, set, subject) = match (callable.is_of_points(), callable.time) {
        (true, true) => ("samples_count", "set_of(s)", "at_time(fields(set_of(s)), at(1, s))"),
        (true, false) => ("samples_count", "set_of(s)", "fields(set_of(s))"),
        (false, _) => ("sets_count", "s", "fields(s)"),
    };
    let mut arguments = vec![subject.to_string()];
    for (array, count) in callable.arrays() {
        let first = first_row(array, dimension);
        arguments.extend((first..first + count).map(|row| format!("at({row}, s)")));
    }
    let _ = writeln!(text, "    do s = 1, {limit}");
    let call = match (callable.is_of_points(), callable.is_scalar()) {
        (true, false) => {
            arguments.extend((1..=count).map(|index| format!("out({index})")));
            super::continued(&format!("      call {name}"), &arguments, "")
        }
        (_, true) => super::continued(&format!("      out(1) = {name}"), &arguments, ""),
        (false, false) => super::continued(&format!("      out = {name}"), &arguments, ""),
    };
    text += &call;
    text += &format!("      call compare({set}, expected(:, s), out)\n");
    text += &through_c(port, callable, set);
    let accepted = vectors.accepted[place];
    let _ = write!(
        text,
        "      call compare({set}, expected(:, s), real(of_c, wp))\n    end do\n    \
         call settle('{name}', {accepted})\n  end subroutine check_{}\n\n",
        short(name)
    );
    text
}

/// The call of the procedure for C, of one point.
fn through_c(port: &Port<'_>, callable: &Callable, set: &str) -> String {
    let dimension = port.dimension();
    let mut arguments = Vec::new();
    if callable.is_of_points() {
        arguments.push("1_c_size_t".to_string());
    }
    if !port.parameters.is_empty() {
        arguments.push(format!("given(:, {set})"));
    }
    if callable.time {
        arguments.push("real(at(1, s), real64)".into());
    }
    for (array, count) in callable.arrays() {
        let first = first_row(array, dimension);
        arguments.push(format!("real(at({first}:{}, s), real64)", first + count - 1));
    }
    arguments.push("of_c".into());
    super::continued(&format!("      call {}_c", callable.name), &arguments, "")
}

/// Where the numbers of an array begin among those of a point.
fn first_row(array: &str, dimension: usize) -> usize {
    match array {
        "N" => 2 + dimension,
        "H" => 2 + 2 * dimension,
        _ => 2,
    }
}
