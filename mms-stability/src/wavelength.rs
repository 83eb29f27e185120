//! The shortest wavelength of a motion, which determines how fine a mesh has to be.

use std::f64::consts::TAU;

use mms_codegen::compile::Compiled;
use mms_mechanics::sample::samples;
use mms_program::interpret::{Interpreter, Point};
use mms_program::schedule::schedule_plainly;
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::Symbol;
use mms_symbolic::pass::differentiate::differentiate;
use mms_symbolic::sorted::SortedMap;

/// The number of points of body and window.
const POINTS: usize = 256;

/// The budget, in the steps of [`mms_symbolic::work`].
const STEPS: u64 = 30_000_000;

/// The highest order of the derivatives of u along one axis.
const ORDERS: usize = 3;

/// The fraction of the largest derivative of an order below which a derivative is ignored: its wavelength is due to rounding.
const NEGLIGIBLE: f64 = 1e-9;

/// The shortest wavelength of a displacement over samples of body and window, at the defaults of the parameters: for each
/// component and axis, the wavelength of the sine with the largest sampled derivatives, first and second, second and third. If
/// u is a sine, it is the period. `None` if u is linear along all axes, or too large to differentiate.
pub fn shortest_wavelength(compiled: &Compiled) -> Option<f64> {
    let largest = largest_derivatives(compiled)?;
    let mut shortest = f64::INFINITY;
    for of_axis in &largest {
        for pair in of_axis.windows(2) {
            let most = pair[1].iter().fold(0.0, |most, value| f64::max(most, *value));
            let lengths =
                pair[0].iter().zip(&pair[1]).filter(|(_, next)| **next > NEGLIGIBLE * most);
            shortest = lengths.map(|(this, next)| TAU * this / next).fold(shortest, f64::min);
        }
    }
    (shortest.is_finite() && shortest > 0.0).then_some(shortest)
}

/// The largest sampled magnitudes: by axis, by order, by component.
fn largest_derivatives(compiled: &Compiled) -> Option<Vec<Vec<Vec<f64>>>> {
    let mut graph = compiled.graph.clone();
    graph.make_room();
    graph.work().allow(STEPS);
    let dimension = compiled.field.dimension;
    let displacement = &compiled.derived.quantities[&Quantity::Displacement];
    let mut outputs = SortedMap::new();
    for axis in 0..dimension {
        let mut derivative = displacement.clone();
        for order in 0..ORDERS {
            derivative = differentiate(&mut graph, &derivative, Symbol::Coordinate(axis));
            outputs.insert((axis, order), derivative.clone());
        }
    }
    if graph.is_exhausted() || graph.work().is_over() {
        return None;
    }
    let program = schedule_plainly(&graph, &outputs);
    let parameters = compiled.parameters::<f64>(&SortedMap::new());
    let mut interpreter = Interpreter::within(graph.work(), &program, &parameters);
    let keys: Vec<_> = outputs.keys().copied().collect();
    let plan = interpreter.plan(&keys);
    let components = displacement.len();
    let mut largest = vec![vec![vec![0.0_f64; components]; ORDERS]; dimension];
    for sample in samples(&compiled.program, &parameters, POINTS) {
        interpreter.set_time(&sample.time);
        interpreter.set_point(&plan, Point::at(&sample.coordinates));
        for (axis, order) in &keys {
            let values = interpreter.output((*axis, *order));
            let known = largest[*axis][*order].iter_mut();
            known.zip(values).for_each(|(known, value)| *known = known.max(value.abs()));
        }
    }
    (!graph.work().is_over()).then_some(largest)
}
