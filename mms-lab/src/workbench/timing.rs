//! The time of emitted code: medians of rounds in which all contenders take turns, so that all see the same machine.

use std::fmt::Write as _;

use anyhow::Context as _;
use mms_analysis::accuracy::{Input, SampleRegion, inputs};
use mms_codegen::Compiled;
use mms_program::precision::Precision;
use mms_spec::quantity::Quantity;

use super::Workbench;
use super::module::{Call, Module, ModuleForm, scalar};

/// The number of points in an evaluation of a batch.
const POINTS: usize = 4096;

/// The number of turns of every contender.
const ROUNDS: usize = 21;

/// The source text of the timing program before the modules and contenders.
const HEAD: &str = include_str!("timing_head.rs");

/// The time of one contender.
#[derive(Clone, Debug, PartialEq)]
pub struct Time {
    /// The module.
    pub module: String,
    /// The quantity.
    pub quantity: Quantity,
    /// The precision.
    pub precision: Precision,
    /// The form of the called function.
    pub way: ModuleForm,
    /// The median, in nanoseconds.
    pub ns_per_point: f64,
}

/// The times of every quantity of some modules, in each of the given precisions and forms.
pub fn time(
    bench: &Workbench,
    modules: &[Module<'_>],
    ways: &[(Precision, ModuleForm)],
) -> anyhow::Result<Vec<Time>> {
    let mut source = HEAD.to_string();
    let (mut input, mut contenders) = (String::new(), String::new());
    let mut calls = Vec::new();
    for (index, module) in modules.iter().enumerate() {
        module.write(bench)?;
        input += &points(module.compiled);
        writeln!(source, "mod {};", module.name)?;
        writeln!(contenders, "    let input = &inputs[{index}];")?;
        for call in ways.iter().flat_map(|(precision, way)| Call::all(module, *precision, *way)) {
            contenders += &contender(&call);
            calls.push(call);
        }
    }
    writeln!(
        source,
        "\nfn main() {{\n    let inputs = Input::read();\n    let mut turns = Vec::new();"
    )?;
    writeln!(source, "{contenders}    run(turns, {ROUNDS});\n}}")?;
    bench.write("timing.rs", &source)?;
    let output = bench.run("timing.rs", &input)?;
    let numbers = output.lines().map(|line| line.trim().parse::<f64>());
    let numbers = numbers.collect::<Result<Vec<_>, _>>().context("no times were printed")?;
    let times = calls.into_iter().zip(numbers).map(|(call, ns_per_point)| Time {
        module: call.module.name.to_string(),
        quantity: call.quantity,
        precision: call.precision,
        way: call.way,
        ns_per_point,
    });
    Ok(times.collect())
}

/// The statement that adds a contender.
fn contender(call: &Call<'_>) -> String {
    let (name, scalar, function) = (call.module.name, scalar(call.precision), call.function());
    let (dimension, components) = (call.module.dimension(), call.components());
    let inputs = if call.way.is_batch() { "columns" } else { "rows" };
    let (given, argument) = match call.way {
        ModuleForm::Single => ("points", "given[index]"),
        ModuleForm::SingleKept => ("points.map(|point| field.at_point(point))", "&given[index]"),
        ModuleForm::Batch => ("points", "slices(&given)"),
        ModuleForm::BatchKept => ("field.at_points(slices(&points))", "&given"),
    };
    let normal = match (call.takes_normals(), call.way.is_batch()) {
        (false, _) => "",
        (true, false) => ", normals[index]",
        (true, true) => ", slices(&normals)",
    };
    let turn = if call.way.is_batch() {
        format!(
            "batch(input.count(), move |out: [&mut [{scalar}]; {components}]| {{
            field.at_time(black_box(time)).{function}({argument}{normal}, out);
        }})"
        )
    } else {
        format!(
            "single(move || {{
            let now = field.at_time(black_box(time));
            for index in 0..FEW {{
                black_box(now.{function}({argument}{normal}));
            }}
        }})"
        )
    };
    format!(
        "    turns.push({{
        let field: {name}::Field<{scalar}> = {name}::prepare(&Default::default());
        let time = <{scalar} as Scalar>::from_f64(input.time);
        let points = input.{inputs}::<{scalar}, {dimension}>(0);
        let normals = input.{inputs}::<{scalar}, {dimension}>({dimension});
        let given = {given};
        {turn}
    }});\n"
    )
}

/// A time in the middle of the window, and as many points as a batch has: a line for each, and an empty line.
fn points(compiled: &Compiled) -> String {
    let parameters = compiled.parameters::<f64>(&Default::default());
    let all = inputs(compiled, &parameters, SampleRegion::Body, POINTS);
    let time = all.iter().map(|input| input.time).sum::<f64>() / all.len().max(1) as f64;
    let mut text = format!("{time:?}\n");
    for Input { coordinates, normal, .. } in all {
        let numbers = coordinates.iter().chain(&normal).map(|number| format!("{number:?}"));
        text += &(numbers.collect::<Vec<_>>().join(" ") + "\n");
    }
    text + "\n"
}
