//! Points spread evenly over the declared body and time window of a field.

use mms_program::interpret::{Interpreter, Number};

use crate::extent::{Extent, between, halton};
use crate::output::{Bound, Output, Program, body};

/// A reference position and a time.
#[derive(Clone, Debug)]
pub struct Sample<T> {
    /// X, `dimension` components.
    pub coordinates: Vec<T>,
    /// t.
    pub time: T,
}

/// The body of a field with these parameters, and the two ends of its time window.
pub fn domain<T: Number>(program: &Program, parameters: &[T]) -> (Extent<T>, [T; 2]) {
    let interpreter = Interpreter::new(program, parameters);
    let bound = |bound: Bound| interpreter.output(Output::Bound(bound));
    let time = bound(Bound::Time);
    let extent = body(|part| {
        let output = Output::Bound(part);
        program.outputs.contains_key(&output).then(|| interpreter.output(output))
    });
    (extent, [time[0].clone(), time[1].clone()])
}

/// The first `count` points of the Halton sequence, mapped to the domain of a field with these
/// parameters.
pub fn samples<T: Number>(program: &Program, parameters: &[T], count: usize) -> Vec<Sample<T>> {
    let (extent, time) = domain(program, parameters);
    (1..=count)
        .map(|index| {
            let fractions = halton(index);
            let coordinates = extent.point(&fractions);
            Sample { coordinates, time: between(&time[0], &time[1], &fractions[3]) }
        })
        .collect()
}
