//! How long emitted code takes: medians of rounds in which all contenders take turns, so that all see
//! the same machine.

use std::fmt::Write as _;

use anyhow::Context as _;
use mms_codegen::accuracy::{Input, Place, Precision, inputs};
use mms_codegen::emit::rust;
use mms_codegen::quantity::Quantity;
use mms_codegen::{Compiled, program::Output};

use super::Workbench;

/// How many points an evaluation of a batch has, and how many one by one.
const POINTS: [usize; 2] = [4096, 256];

/// How often every contender takes a turn.
const ROUNDS: usize = 21;

/// What the program that is compiled has beside the contenders.
const HEAD: &str = include_str!("timing_head.rs");

/// Emitted code that takes part, as a module of its own.
pub struct Module<'a> {
    /// The name of the module.
    pub name: &'a str,
    /// The field, or a part of it.
    pub compiled: &'a Compiled,
}

/// How code is called.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Point by point.
    Single,
    /// All points at once.
    Batch,
}

/// The time of one contender.
#[derive(Clone, Debug, PartialEq)]
pub struct Time {
    /// The module.
    pub module: String,
    /// The quantity.
    pub quantity: Quantity,
    /// The precision.
    pub precision: Precision,
    /// The median, in nanoseconds.
    pub ns_per_point: f64,
}

/// The times of every quantity of some modules of one dimension: in each way a precision.
pub fn time(
    bench: &Workbench,
    modules: &[Module<'_>],
    ways: &[(Precision, Way)],
) -> anyhow::Result<Vec<Time>> {
    let mut source = HEAD.to_string();
    let mut contenders = String::new();
    let mut expected = Vec::new();
    for Module { name, compiled } in modules {
        bench.write(&format!("{name}.rs"), &rust::file(compiled).text)?;
        writeln!(source, "mod {name};")?;
        for (precision, way) in ways {
            for quantity in timed(compiled) {
                expected.push((name.to_string(), quantity, *precision));
                contenders +=
                    &contender(name, compiled.field.dimension, quantity, *precision, *way);
            }
        }
    }
    writeln!(
        source,
        "\nfn main() {{\n    let input = Input::read();\n    let mut turns: Turns = Vec::new();"
    )?;
    writeln!(source, "{contenders}    run(turns, {ROUNDS});\n}}")?;
    bench.write("timing.rs", &source)?;
    let first = modules.first().context("nothing to time")?.compiled;
    let output = bench.run("timing.rs", &points(first))?;
    let numbers = output.lines().map(|line| line.trim().parse::<f64>());
    let numbers = numbers.collect::<Result<Vec<_>, _>>().context("no times were printed")?;
    let times = expected.into_iter().zip(numbers);
    Ok(times
        .map(|((module, quantity, precision), ns_per_point)| Time {
            module,
            quantity,
            precision,
            ns_per_point,
        })
        .collect())
}

/// The quantities that a program computes.
fn timed(compiled: &Compiled) -> impl Iterator<Item = Quantity> {
    let outputs = &compiled.program.outputs;
    let known = |quantity: &Quantity| outputs.contains_key(&Output::Quantity(*quantity));
    Quantity::ALL.iter().copied().filter(known)
}

fn contender(
    module: &str,
    dimension: usize,
    quantity: Quantity,
    precision: Precision,
    way: Way,
) -> String {
    let scalar = match precision {
        Precision::F32 => "f32",
        Precision::F64 => "f64",
        Precision::Wide => "Double",
    };
    let normals = if quantity == Quantity::Traction { ", normals" } else { "" };
    let components = quantity.shape().components(dimension);
    let name = quantity.name();
    match way {
        Way::Single => format!(
            "    single!(turns, input, {module}, {scalar}, {dimension}, {name}, {});\n",
            normals.trim_start_matches(", ")
        ),
        Way::Batch => format!(
            "    batch!(turns, input, {module}, {scalar}, {dimension}, {components}, {name}_batch{normals});\n"
        ),
    }
}

/// A time in the middle of the window, and as many points as a batch has: a line for each.
fn points(compiled: &Compiled) -> String {
    let parameters = compiled.parameters::<f64>(&Default::default());
    let all = inputs(compiled, &parameters, Place::Body, POINTS[0]);
    let time = all.iter().map(|input| input.time).sum::<f64>() / all.len().max(1) as f64;
    let mut text = format!("{time:?} {}\n", POINTS[1]);
    for Input { coordinates, normal, .. } in all {
        let numbers = coordinates.iter().chain(&normal).map(|number| format!("{number:?}"));
        text += &(numbers.collect::<Vec<_>>().join(" ") + "\n");
    }
    text
}
