//! MOOSE: blocks of an input file, one ParsedFunction for each component, and a program that checks them.
//!
//! The Function Parser for C++ reads the formulas, and its optimiser rearranges sums: the compiler writes no difference
//! that the optimiser could take for 0.

mod check;
mod dialect;

use std::fmt::Write as _;

pub(super) use self::check::functions;
use self::dialect::Moose;
use crate::port::Port;
use crate::port::body::{Context, local};
use crate::port::names::Rules;
use crate::port::number::decimal;
use crate::python::module::comment;
use crate::target::{Bundle, Subject, Target};
use crate::text::listed;
use mms_program::{Op, Value};
use mms_symbolic::expr::{Function, Symbol};
use mms_symbolic::sorted::SortedSet;

/// MOOSE.
pub const TARGET: Target = Target {
    name: "moose",
    alias: None,
    doc: "MOOSE: ParsedFunction blocks of an input file, and a check program in Python",
    emit: bundle,
    words: RULES.words,
};

/// Emitted names begin with the name of the field, so that no word has to be avoided.
const RULES: Rules = Rules { words: &[], modules: &[], folds_case: false, longest: 120 };

/// The functions of the parser, and the ones that can be written in one formula.
const HAS: &[Function] = &[
    Function::Sqrt,
    Function::Cbrt,
    Function::Exp,
    Function::Ln,
    Function::Sin,
    Function::Cos,
    Function::SinPi,
    Function::CosPi,
    Function::Tan,
    Function::Sinh,
    Function::Cosh,
    Function::Tanh,
    Function::Asin,
    Function::Acos,
    Function::Atan,
    Function::Atan2,
    Function::Powf,
];

fn bundle(subject: &Subject<'_>) -> Bundle {
    let port = Port::once(subject, &RULES, HAS);
    port.bundle(
        [(".i", text(&port)), ("_check.py", check::text(&port))],
        "python3 -W error FIELD_check.py",
    )
}

/// The limit of operations in a formula after names are replaced by formulas. The optimiser of the parser takes time at
/// least in proportion to this number, and shared values can double it at every step.
const LONGEST: u32 = 400;

fn text(port: &Port<'_>) -> String {
    let name = &port.name;
    let places = port.callables.iter().filter(|callable| callable.is_of_places());
    let roots: Vec<Value> =
        places.clone().flat_map(|callable| port.values(callable.output)).copied().collect();
    let apart = apart(port, &roots);
    let (mut blocks, mut read) = (String::new(), SortedSet::new());
    for value in (0..apart.len()).filter(|index| apart[*index]) {
        blocks += &block(port, &format!("q{value}"), "", Value(value as u32), &apart, &mut read);
    }
    for callable in places {
        let doc = callable.documentation();
        let values = port.values(callable.output);
        for (suffix, value) in callable.suffixes().iter().zip(values) {
            blocks += &block(
                port,
                &format!("{}{suffix}", callable.name),
                &doc,
                *value,
                &apart,
                &mut read,
            );
        }
    }
    let mut header = port.header();
    header.push(format!(
        "For `!include {name}.i` at the top level of an input file. Functions depend on the coordinates of the undeformed mesh and on the time; functions called {name}_q are intermediate values. A parameter is changed in its line, or on the command line. {name}_check.py checks the formulas."
    ));
    if port.compiled.field.space.is_axisymmetric() {
        header.push("For blocks with coord_type = RZ: x is R and y is Z, and the components 1, 2 and 3 are along R, Z and the hoop, in the order of MOOSE.".into());
    }
    let mut text = comment(&header, "");
    let defaults = &port.subject.vectors().defaults;
    for ((index, parameter), default) in port.parameters.iter().zip(defaults) {
        // MOOSE refuses parameters that no block reads.
        if read.contains(index) {
            text += "\n";
            text += &comment(&[port.parameter_doc(*index)], "");
            let _ = writeln!(text, "{name}_{parameter} = {}", decimal(*default));
        }
    }
    text + "\n[Functions]\n" + &blocks + "[]\n"
}

/// Marks the values that become functions of their own, so that no formula is too long. A formula computes a function
/// that it names once, however often the name occurs.
fn apart(port: &Port<'_>, roots: &[Value]) -> Vec<bool> {
    let program = port.program();
    let needed = program.needed_for(roots.iter().copied());
    let mut apart = vec![false; program.instrs.len()];
    let mut lengths = vec![1; program.instrs.len()];
    for (index, instr) in program.instrs.iter().enumerate() {
        let operands = instr.op.operands().map(|operand| lengths[operand.index()]);
        let length = operands.fold(1, u32::saturating_add);
        apart[index] = needed[index] && length > LONGEST;
        lengths[index] = if apart[index] { 1 } else { length };
    }
    apart
}

/// The block of one value, which adds the parameters that it reads.
fn block(
    port: &Port<'_>,
    name: &str,
    doc: &str,
    value: Value,
    apart: &[bool],
    read: &mut SortedSet<usize>,
) -> String {
    let program = port.program();
    let mut needed = vec![false; program.instrs.len()];
    let mut open: Vec<Value> = vec![value];
    // A quantity may be such a step itself.
    let is_known =
        |other: Value| apart[other.index()] && (other != value || !name.starts_with('q'));
    let mut known: Vec<Value> = Vec::new();
    while let Some(value) = open.pop() {
        if is_known(value) {
            known.push(value);
        } else if !std::mem::replace(&mut needed[value.index()], true) {
            open.extend(program.instr(value).op.operands());
        }
    }
    known.sort();
    known.dedup();
    let here = program.instrs.iter().zip(&needed).filter(|(_, needed)| **needed);
    let parameters = here.filter_map(|(instr, _)| match instr.op {
        Op::Input(Symbol::Parameter(index)) => Some(index),
        _ => None,
    });
    let field = &port.name;
    let (mut symbols, mut values) = (Vec::new(), Vec::new());
    for index in parameters {
        read.insert(index);
        symbols.push(format!("p_{}", port.parameters[&index]));
        values.push(format!("${{{field}_{}}}", port.parameters[&index]));
    }
    symbols.extend(known.iter().map(|value| local(*value, false)));
    values.extend(known.iter().map(|value| format!("{field}_{}", local(*value, false))));
    let body = port.body_of(&Moose, &[value], Context::Everything, needed);
    let mut text = format!("  [{field}_{name}]\n");
    if !doc.is_empty() {
        text += &comment(&[doc.to_string()], "    ");
    }
    text += "    type = ParsedFunction\n    expression = '";
    for statement in &body.statements {
        let _ = write!(text, "{statement}\n                  ");
    }
    let _ = writeln!(text, "{}'", body.results[0]);
    if !symbols.is_empty() {
        let list = |items: Vec<String>, start: &str| {
            let lines = listed(&items, 80).join(&format!("\n{:start$}", "", start = start.len()));
            format!("{start}{}'\n", lines.replace(',', ""))
        };
        text += &list(symbols, "    symbol_names = '");
        text += &list(values, "    symbol_values = '");
    }
    text + "  []\n"
}
