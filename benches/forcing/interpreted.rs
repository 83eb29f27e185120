//! The fields interpreted from their texts, in blocks of points, as for a user without a compiler.

use std::error::Error;
use std::sync::Arc;

use mms_codegen::Compiled;
use mms_codegen::compile;
use mms_mechanics::Output;
use mms_program::block::{BlockMode, BlockPlan, Blockwise, Inputs, Outputs, Prepared, Scratch};
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::Symbol;

use crate::{COUNT, Case, Contender, Run, timed};

struct Interpreted<T: Blockwise> {
    mode: &'static str,
    precision: &'static str,
    prepared: Prepared<T>,
    scratch: Scratch<T>,
    time: T,
    points: Vec<Vec<T>>,
    out: Vec<Vec<T>>,
    seconds: Vec<f64>,
}

impl<T: Blockwise> Interpreted<T> {
    fn evaluate(&mut self) {
        let Interpreted { prepared, scratch, time, points, out, .. } = self;
        let mut write_inputs = |start: usize, inputs: &mut Inputs<'_, T>| {
            for (symbol, column) in inputs.columns() {
                if let Symbol::Coordinate(axis) = symbol {
                    column.copy_from_slice(&points[axis][start..start + column.len()]);
                }
            }
        };
        let mut read_outputs = |start: usize, outputs: &Outputs<'_, T>| {
            for (column, component) in out.iter_mut().zip(outputs.components(0)) {
                component.write(column[start..start + outputs.count()].iter_mut());
            }
        };
        prepared.run(scratch, *time, COUNT, &mut write_inputs, &mut read_outputs);
    }
}

impl<T: Blockwise + Into<f64>> Contender for Interpreted<T> {
    fn round(&mut self) -> Result<(), Box<dyn Error>> {
        let seconds = timed(|| self.evaluate());
        self.seconds.push(seconds);
        Ok(())
    }

    fn finish(self: Box<Self>) -> Run {
        let widened = |column: &Vec<T>| column.iter().map(|value| (*value).into()).collect();
        Run {
            contender: "interpreted",
            precision: self.precision,
            mode: self.mode,
            seconds: self.seconds,
            slots: None,
            results: self.out.iter().map(widened).collect(),
        }
    }
}

fn contenders_in<T: Blockwise + Into<f64> + 'static>(
    compiled: &Compiled,
    case: &Case,
    precision: &'static str,
) -> Vec<Box<dyn Contender>> {
    let plan = Arc::new(BlockPlan::new(
        &compiled.program,
        &[Output::Quantity(Quantity::BodyForce)],
        Output::is_quantity,
    ));
    let numbers = |values: &[f64]| -> Vec<T> { values.iter().map(|it| T::from_f64(*it)).collect() };
    let ways = [("batch", BlockMode::fused()), ("portable", BlockMode::portable())];
    let contender = |(mode, way)| {
        let contender: Box<dyn Contender> = Box::new(Interpreted {
            mode,
            precision,
            prepared: Prepared::new(plan.clone(), way, &numbers(case.parameters)),
            scratch: Scratch::default(),
            time: T::from_f64(case.time),
            points: case.points.iter().map(|column| numbers(column)).collect(),
            out: vec![vec![T::from_f64(0.0); COUNT]; case.points.len()],
            seconds: Vec::new(),
        });
        contender
    };
    ways.map(contender).into()
}

/// The contenders with the bits of compiled loops, and with rounded products (`portable`), in both precisions.
pub fn contenders(case: &Case) -> Result<Vec<Box<dyn Contender>>, Box<dyn Error>> {
    let compiled = compile(case.name, "field", case.text, &|_| Err("no such file".into()))?;
    let mut all = contenders_in::<f64>(&compiled, case, "f64");
    all.extend(contenders_in::<f32>(&compiled, case, "f32"));
    Ok(all)
}
