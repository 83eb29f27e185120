//! The state of a compiled field at a place and a time, with the defaults of its parameters.

use mms_codegen::compile::Compiled;
use mms_mechanics::sample::domain;
use mms_mechanics::{Response, at_rest, is_spherical, pressures};
use mms_program::Program;
use mms_program::dual::Dual;
use mms_program::interpret::{Interpreter, Number, Point};
use mms_program::schedule::schedule_plainly;
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::{Expr, Graph, Symbol};
use mms_symbolic::pass::differentiate::differentiate;
use mms_symbolic::sorted::SortedMap;
use mms_symbolic::work::Work;
use nalgebra::{SMatrix, SVector};

use crate::chart::Chart;
use crate::elasticity::Elasticity;

/// The budget for all states of a field together, in the steps of [`mms_symbolic::work`].
const STEPS: u64 = 100_000_000;

/// The outputs of the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum StateOutput {
    Position,
    Gradient,
    Density,
    /// P at a supplied gradient.
    Stress,
    /// P and dP/dF in space at F = I.
    RestStress,
    RestTangent,
}

/// The program that computes states of a field, with its budget.
#[derive(Debug)]
pub struct Formulas {
    program: Program<StateOutput>,
    parameters: Vec<f64>,
    /// The budget of all evaluations together.
    work: Work,
    /// Whether u does not depend on t.
    is_static: bool,
    is_frame_indifferent: bool,
    /// Whether given fields balance a spherical stress at rest.
    has_balanced_pressure: bool,
}

impl Formulas {
    /// Compiles the program for a field.
    pub fn new(compiled: &Compiled) -> Self {
        let mut graph = compiled.graph.clone();
        graph.make_room();
        graph.work().allow(STEPS);
        let derived = &compiled.derived;
        let quantity = |quantity| derived.quantities[&quantity].clone();
        let response = |response| derived.responses[&response].clone();
        let [stress, tangent] = at_rest(&mut graph, &compiled.model);
        let (field, material, model) = (&compiled.field, &compiled.material, &compiled.model);
        let has_balanced_pressure = !model.givens.is_empty()
            && !graph.is_zero(stress[0])
            && is_spherical(&graph, &stress)
            && !pressures(&mut graph, field, material, model).is_empty();
        let position = quantity(Quantity::Position);
        let is_static = is_static(&mut graph, &position);
        let outputs = SortedMap::from([
            (StateOutput::Position, position),
            (StateOutput::Gradient, quantity(Quantity::DisplacementGradient)),
            (StateOutput::Density, response(Response::Density)),
            (StateOutput::Stress, response(Response::FirstPiolaKirchhoff)),
            (StateOutput::RestStress, stress),
            (StateOutput::RestTangent, tangent),
        ]);
        let program = schedule_plainly(&graph, &outputs);
        let work = graph.work().share();
        let is_frame_indifferent = compiled.material.frame_indifferent;
        let parameters = compiled.parameters(&SortedMap::new());
        Formulas {
            program,
            parameters,
            work,
            is_static,
            is_frame_indifferent,
            has_balanced_pressure,
        }
    }

    /// Whether the budget is spent: then no state has a value.
    pub fn is_spent(&self) -> bool {
        self.work.is_over()
    }
}

fn is_static(graph: &mut Graph, position: &[Expr]) -> bool {
    let velocity = differentiate(graph, position, Symbol::Time);
    velocity.iter().all(|component| graph.is_zero(*component))
}

/// A state of the body.
#[derive(Clone, Debug)]
pub struct State<const D: usize> {
    /// F.
    pub deformation: SMatrix<f64, D, D>,
    /// P.
    pub stress: SMatrix<f64, D, D>,
    /// dP/dF.
    pub elasticity: Elasticity<D>,
    /// rho0.
    pub density: f64,
    /// The unit of moduli: mu at rest, or lambda if mu is 0.
    pub modulus: f64,
}

/// The material at F = I, in space.
#[derive(Clone, Debug, PartialEq)]
pub struct Resting {
    /// P, row-major.
    pub stress: Vec<f64>,
    /// dP/dF, the last index fastest.
    pub tangent: Elasticity<3>,
    /// Whether rotations cost no energy: a stress at rest then contributes to dP/dF.
    pub is_frame_indifferent: bool,
    /// Whether given fields balance a spherical stress at rest.
    pub has_balanced_pressure: bool,
}

/// A compiled field, evaluated.
pub struct Subject<'a, const D: usize> {
    /// The body.
    pub chart: Chart<D>,
    /// The time window.
    pub window: [f64; 2],
    /// Whether u does not depend on t.
    pub is_static: bool,
    is_frame_indifferent: bool,
    has_balanced_pressure: bool,
    work: &'a Work,
    field: Evaluated<'a, f64>,
    material: Evaluated<'a, Dual<f64>>,
}

struct Evaluated<'a, T: Number> {
    interpreter: Interpreter<'a, T, StateOutput>,
    /// The time of the last evaluation.
    time: Option<T>,
    plans: SortedMap<StateOutput, Vec<bool>>,
}

impl<'a, T: Number> Evaluated<'a, T> {
    fn new(formulas: &'a Formulas, parameters: &[T]) -> Self {
        let interpreter = Interpreter::within(&formulas.work, &formulas.program, parameters);
        let plan = |output: &StateOutput| (*output, interpreter.plan(&[*output]));
        let plans = formulas.program.outputs.keys().map(plan).collect();
        Evaluated { interpreter, time: None, plans }
    }

    fn at(&mut self, output: StateOutput, point: Point<'_, T>) -> Vec<T> {
        self.interpreter.set_point(&self.plans[&output], point);
        self.interpreter.output(output)
    }
}

impl<'a, const D: usize> Subject<'a, D> {
    /// Prepares a compiled field of this dimension.
    pub fn new(compiled: &Compiled, formulas: &'a Formulas) -> Self {
        let (extent, window) = domain(&compiled.program, &formulas.parameters);
        let duals: Vec<_> = formulas.parameters.iter().copied().map(Dual::constant).collect();
        Subject {
            chart: Chart::new(extent),
            window,
            is_static: formulas.is_static,
            is_frame_indifferent: formulas.is_frame_indifferent,
            has_balanced_pressure: formulas.has_balanced_pressure,
            work: &formulas.work,
            field: Evaluated::new(formulas, &formulas.parameters),
            material: Evaluated::new(formulas, &duals),
        }
    }

    /// The time at a fraction of the window.
    pub fn time(&self, fraction: f64) -> f64 {
        self.window[0] + (self.window[1] - self.window[0]) * fraction
    }

    /// x.
    pub fn position(&mut self, place: &SVector<f64, D>, time: f64) -> SVector<f64, D> {
        SVector::from_vec(self.value(StateOutput::Position, place, time))
    }

    /// The state at X and t; `None` if it is not finite.
    pub fn state(&mut self, place: &SVector<f64, D>, time: f64) -> Option<State<D>> {
        if self.work.is_over() {
            return None;
        }
        let gradient = self.value(StateOutput::Gradient, place, time);
        let (stress, elasticity) = self.response(place, time, &gradient);
        let density = self.value(StateOutput::Density, place, time)[0];
        let modulus = self.at_rest(place)?.modulus();
        let is_finite = elasticity.is_finite() && density.is_finite() && modulus > 0.0;
        is_finite.then(|| State {
            deformation: SMatrix::identity() + SMatrix::from_row_slice(&gradient),
            stress,
            elasticity,
            density,
            modulus,
        })
    }

    /// The material at rest at X; `None` if it is not finite.
    pub fn at_rest(&mut self, place: &SVector<f64, D>) -> Option<Resting> {
        let stress = self.value(StateOutput::RestStress, place, self.window[0]);
        let tangent = self.value(StateOutput::RestTangent, place, self.window[0]);
        let at = |[i, j, k, l]: [usize; 4]| tangent[((i * 3 + j) * 3 + k) * 3 + l];
        let (is_frame_indifferent, has_balanced_pressure) =
            (self.is_frame_indifferent, self.has_balanced_pressure);
        let tangent = Elasticity::from_fn(at);
        let resting = Resting { stress, tangent, is_frame_indifferent, has_balanced_pressure };
        let is_finite =
            resting.tangent.is_finite() && resting.stress.iter().all(|it| it.is_finite());
        is_finite.then_some(resting)
    }

    /// P and dP/dF at a displacement gradient, by dual numbers in each of its entries.
    pub fn response(
        &mut self,
        place: &SVector<f64, D>,
        time: f64,
        gradient: &[f64],
    ) -> (SMatrix<f64, D, D>, Elasticity<D>) {
        let coordinates: Vec<_> = place.iter().copied().map(Dual::constant).collect();
        self.material.interpreter.set_time(&Dual::constant(time));
        let mut stress = SMatrix::zeros();
        let mut columns = Vec::with_capacity(D * D);
        for entry in 0..D * D {
            let moved = |(at, value): (usize, &f64)| match at == entry {
                true => Dual::variable(*value),
                false => Dual::constant(*value),
            };
            let gradient: Vec<_> = gradient.iter().enumerate().map(moved).collect();
            let point = Point { coordinates: &coordinates, normal: &[], gradient: &gradient };
            let components = self.material.at(StateOutput::Stress, point);
            stress = SMatrix::from_fn(|row, column| components[row * D + column].value);
            columns.push(components);
        }
        let slope = |[i, j, k, l]: [usize; 4]| columns[k * D + l][i * D + j].slope;
        (stress, Elasticity::from_fn(slope))
    }

    fn value(&mut self, output: StateOutput, place: &SVector<f64, D>, time: f64) -> Vec<f64> {
        if self.field.time != Some(time) {
            self.field.interpreter.set_time(&time);
            self.field.time = Some(time);
        }
        self.field.at(output, Point::at(place.as_slice()))
    }
}
