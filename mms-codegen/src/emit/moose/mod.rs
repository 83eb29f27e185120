//! MOOSE: blocks of an input file, one ParsedFunction for each component, and a program that checks them.
//!
//! Their formulas are those of the Function Parser for C++, whose optimiser rearranges sums: what the
//! compiler writes has no difference that it could take for 0.

mod check;
mod dialect;

use std::fmt::Write as _;

pub(super) use self::check::functions;
use self::dialect::Moose;
use crate::emit::port::Port;
use crate::emit::port::body::Place;
use crate::emit::port::callable::{Callable, input};
use crate::emit::port::names::Rules;
use crate::emit::port::number::decimal;
use crate::emit::python::module::comment;
use crate::emit::text::listed;
use crate::emit::{Bundle, File, Subject, Target};
use crate::expr::{Function, Symbol};
use crate::program::{Op, Value};

/// MOOSE.
pub const TARGET: Target = Target {
    name: "moose",
    doc: "MOOSE: ParsedFunction blocks of an input file, and a check program in Python",
    emit: bundle,
    words: RULES.words,
};

/// Names stand behind those of the field, so that no word is in the way.
const RULES: Rules = Rules { words: &[], modules: &[], folds_case: false, longest: 120 };

/// The functions of the parser, and those that can be written in one formula.
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
    let name = &port.name;
    Bundle {
        files: vec![
            File { name: format!("{name}.i"), text: text(&port) },
            File { name: format!("{name}_check.py"), text: check::text(&port) },
        ],
        verify: Some(format!("python3 -W error {name}_check.py")),
    }
}

fn text(port: &Port<'_>) -> String {
    let name = &port.name;
    let mut blocks = String::new();
    for callable in port.callables.iter().filter(|callable| callable.is_of_places()) {
        let values = port.values(callable.output).to_vec();
        for (suffix, value) in callable.suffixes(port.dimension()).iter().zip(values) {
            blocks += &block(port, callable, suffix, value);
        }
    }
    let mut header = port.header();
    header.push(format!(
        "For `!include {name}.i` at the top level of an input file. Functions are of the coordinates of the undeformed mesh and of the time. A parameter is changed in its line, or on the command line. {name}_check.py checks the formulas."
    ));
    let mut text = comment(&header, "");
    let defaults = &port.subject.vectors().defaults;
    for ((index, parameter), default) in port.parameters.iter().zip(defaults) {
        let variable = format!("${{{name}_{parameter}}}");
        // MOOSE refuses what nobody reads.
        if blocks.contains(&variable) {
            text += "\n";
            text += &comment(&[port.parameter_doc(*index)], "");
            let _ = writeln!(text, "{name}_{parameter} = {}", decimal(*default));
        }
    }
    text + "\n[Functions]\n" + &blocks + "[]\n"
}

/// The block of one component.
fn block(port: &Port<'_>, callable: &Callable, suffix: &str, value: Value) -> String {
    let name = &port.name;
    let body = port.body(&Moose, &[value], Place::Everything);
    let needed = port.program().needed_for([value]);
    let read = port.program().instrs.iter().zip(&needed).filter(|(_, needed)| **needed);
    let parameters: Vec<&String> = read
        .filter_map(|(instr, _)| match instr.op {
            Op::Input(Symbol::Parameter(index)) => Some(&port.parameters[&index]),
            _ => None,
        })
        .collect();
    let mut text = format!("  [{name}_{}{suffix}]\n", callable.name);
    let doc = format!("{} Unit: {}.", callable.doc, callable.unit);
    text += &comment(&[doc], "    ");
    text += "    type = ParsedFunction\n    expression = '";
    for statement in &body.statements {
        let _ = write!(text, "{statement}\n                  ");
    }
    let _ = writeln!(text, "{}'", body.results[0]);
    if !parameters.is_empty() {
        let list = |items: Vec<String>, start: &str| {
            let lines = listed(&items, 80).join(&format!("\n{:start$}", "", start = start.len()));
            format!("{start}{}'\n", lines.replace(',', ""))
        };
        let symbols = parameters.iter().map(|it| format!("p_{it}")).collect();
        text += &list(symbols, "    symbol_names = '");
        let values = parameters.iter().map(|it| format!("${{{name}_{it}}}")).collect();
        text += &list(values, "    symbol_values = '");
    }
    text + "  []\n"
}

/// The name of a leaf in a formula.
fn leaf(name: &str) -> String {
    let is = |symbol| input(symbol) == name;
    let axis = (0..3).find(|axis| is(Symbol::Coordinate(*axis)));
    axis.map_or(name.into(), |axis| ["x", "y", "z"][axis].into())
}
