//! Karamelo: variables of its input language, and a program that checks them.
//!
//! Each variable is one operation. The language reads numbers in single precision and has few functions:
//! the others are written out.

mod check;
mod dialect;

use std::fmt::Write as _;

use self::dialect::Karamelo;
use crate::port::Port;
use crate::port::body::Context;
use crate::port::callable::Callable;
use crate::port::names::Rules;
use crate::python::module::comment;
use crate::target::{Bundle, Subject, Target};
use mms_program::Value;
use mms_symbolic::expr::Function;
use mms_symbolic::sorted::SortedMap;

/// Karamelo.
pub const TARGET: Target = Target {
    name: "karamelo",
    alias: None,
    doc: "Karamelo: variables of its input language, in single precision, and a check program in Python",
    emit: bundle,
    words: RULES.words,
};

/// Emitted names begin with the name of the field, so that no word has to be avoided.
const RULES: Rules = Rules { words: &[], modules: &[], folds_case: false, longest: 120 };

/// The functions that all versions of Karamelo have.
const HAS: &[Function] =
    &[Function::Sqrt, Function::Exp, Function::Ln, Function::Sin, Function::Cos, Function::Tan];

/// Versions of Karamelo that substitute formulas for names are slow at longer texts.
const LONG: u64 = 1_000_000;

fn bundle(subject: &Subject<'_>) -> Bundle {
    let mut port = Port::once(subject, &RULES, HAS);
    make_way(&mut port);
    port.bundle(
        [(".kar", text(&port)), ("_check.py", check::text(&port))],
        "python3 -W error FIELD_check.py",
    )
}

/// Renames parameters that are called like a result: all variables have one space of names.
fn make_way(port: &mut Port<'_>) {
    let results = port.callables.iter().flat_map(|callable| {
        let suffixes = callable.suffixes().into_iter();
        suffixes.map(|suffix| format!("{}{suffix}", callable.name))
    });
    let mut taken: Vec<String> = results.chain(port.parameters.values().cloned()).collect();
    for name in port.parameters.values_mut() {
        while taken.iter().filter(|other| *other == name).count() > 1 {
            name.push('_');
            taken.push(name.clone());
        }
    }
}

fn text(port: &Port<'_>) -> String {
    let name = &port.name;
    let callables: Vec<&Callable> =
        port.callables.iter().filter(|callable| callable.is_of_places()).collect();
    let roots: Vec<Value> =
        callables.iter().flat_map(|callable| port.values(callable.output)).copied().collect();
    let body = port.body(&Karamelo(name), &roots, Context::Everything);
    let mut header = port.header();
    header.push(format!(
        "Variables for an input file. Quantities are functions of the reference position x0, y0, z0 and of the time, and come last; names with a number are intermediate values. Karamelo computes them in single precision. {name}_check.py checks the formulas."
    ));
    let longest = longest(port, &roots);
    if longest > LONG {
        header.push(format!(
            "Versions of Karamelo without expressions (before class Expression) substitute formulas for names: here up to {longest} names in one formula, which is more than they can store. Choose quantities with --quantity, or freeze parameters."
        ));
    }
    let mut text = comment(&header, "");
    let defaults = &port.subject.vectors().defaults;
    for ((index, parameter), default) in port.parameters.iter().zip(defaults) {
        text += "\n";
        text += &comment(&[port.parameter_doc(*index)], "");
        let _ = writeln!(text, "{name}_{parameter} = {default}");
    }
    text += "\n";
    for statement in &body.statements {
        let _ = writeln!(text, "{statement}");
    }
    let mut results = body.results.iter();
    for callable in callables {
        text += "\n";
        text += &comment(&[callable.documentation()], "");
        for (suffix, result) in callable.suffixes().iter().zip(&mut results) {
            let _ = writeln!(text, "{name}_{}{suffix} = {result}", callable.name);
        }
    }
    text
}

/// The number of names in the longest formula after all names are replaced by their formulas.
fn longest(port: &Port<'_>, roots: &[Value]) -> u64 {
    let mut lengths: SortedMap<Value, u64> = SortedMap::new();
    for (index, instr) in port.program().instrs.iter().enumerate() {
        let operands = instr.op.operands().map(|operand| lengths[&operand]);
        let length = operands.fold(1_u64, u64::saturating_add);
        lengths.insert(Value(index as u32), length);
    }
    roots.iter().map(|root| lengths[root]).max().unwrap_or(0)
}
