//! The errors that mistakes make in runs of this project's own solver.

use std::fmt;
use std::sync::OnceLock;

use mms_runtime::body::bounding_box;
use mms_runtime::study::{Checkpoint, Frame as State, Observer, Solve, Watch};
use mms_runtime::{
    Condition, Division, FormulationName, IntegratorName, ManufacturedField, Method, Refusal,
    Setup, ShapeName, Transfer, Vector,
};

use crate::changed::{Changed, Without};
use crate::evidence::{ComparisonFrame, Mesh, Snapshot, nearest};
use crate::exact::{Exact, Quantity, vectors};
use crate::follow::Follow;
use crate::hypothesis::{Change, Given, Hypothesis};
use crate::sample::Sampling;
use crate::smooth::less;

/// The least and the most cells along the longest edge, in one to three dimensions.
const CELLS: [[usize; 2]; 3] = [[16, 64], [8, 32], [4, 8]];

/// The reasons why results cannot be diagnosed.
#[derive(Clone, Debug, PartialEq)]
pub enum Obstacle {
    /// A value of the exact solution at a point of the results is not finite.
    NotFinite,
    /// A run of our own would take this many steps even on the coarsest grid.
    TooManySteps(f64),
    /// Results have too few points to separate mistakes.
    TooFewPoints {
        /// The number of points.
        found: usize,
        /// The least number of points.
        least: usize,
    },
    /// All results are at the start of the time window.
    AtStart,
    /// A stress of the field is not finite at a row of a table.
    SingularDeformation,
    /// Evidence of this kind is not supported for axisymmetric fields.
    Axisymmetric(&'static str),
    /// Nothing holds a body at rest, or it is unstable.
    NotHeld,
    /// The body has no extent.
    Refused(Refusal),
    /// The error of the method that the user named falls with this order on this field, or, if `None`, a run of it stops.
    Diverges(Option<f64>),
    /// Every method of the built-in solver that was tried stops on this field.
    AllStop,
    /// The follower has ended the diagnosis.
    Stopped,
}

impl std::error::Error for Obstacle {}

impl From<Refusal> for Obstacle {
    fn from(refusal: Refusal) -> Self {
        Obstacle::Refused(refusal)
    }
}

impl fmt::Display for Obstacle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Obstacle::NotFinite => {
                write!(f, "the exact solution is not finite at a point of the results")
            }
            Obstacle::TooFewPoints { found, least } => write!(
                f,
                "{found} points are too few to distinguish mistakes; expected {least} at least, over all of \
                 the body"
            ),
            Obstacle::AtStart => write!(
                f,
                "all results are at the start of the time window, where the state is given: expected results at a later \
                 time"
            ),
            Obstacle::SingularDeformation => {
                write!(f, "the exact stress is not finite in a row: is det F <= 0 there?")
            }
            Obstacle::Refused(refusal) => refusal.fmt(f),
            Obstacle::Axisymmetric(what) => write!(
                f,
                "the field is axisymmetric, and {what} of such a field are not diagnosed: expected u, v or F of a motion, \
                 at times after its start"
            ),
            Obstacle::NotHeld => write!(
                f,
                "the field is at rest, and its equilibrium is not unique or not stable: expected faces that hold the \
                 body; give residuals at nodes with `--residual nodal`"
            ),
            Obstacle::Diverges(Some(order)) => write!(
                f,
                "the error of this method falls with order {order:.2} on this field, so it is no standard for your results: \
                 expected a method that converges"
            ),
            Obstacle::Diverges(None) => write!(
                f,
                "this method stops on this field, so it is no standard for your results: expected a method that converges"
            ),
            Obstacle::AllStop => {
                write!(
                    f,
                    "every method that `mms` tried stops on this field, on a grid no finer than yours"
                )
            }
            Obstacle::Stopped => write!(f, "stopped on request"),
            Obstacle::TooManySteps(steps) => write!(
                f,
                "waves cross the body so often until then that each run would take {steps:.0} steps: give results of an \
                 earlier time, or accelerations at an exact state"
            ),
        }
    }
}

/// The errors that right and wrong solvers make at the points of a user's results.
pub trait Responses<'a, const D: usize>: Sync {
    /// h of the solvers.
    fn cell_size(&self) -> f64;
    /// The number of methods.
    fn methods(&self) -> usize;
    /// Describes a method in the words of its options; `None` if users cannot name it.
    fn described(&self, method: usize) -> Option<String>;
    /// Whether a method is of second order in time.
    fn is_of_second_order(&self, method: usize) -> bool;
    /// The errors of a right solver, for each time and quantity; `None` if it stops.
    fn right(&self, method: usize) -> Option<Vec<Vec<f64>>>;
    /// The errors of a solver with a mistake; `None` if it stops.
    fn wrong(
        &self,
        method: usize,
        hypothesis: &Hypothesis<D>,
        size: &[f64],
    ) -> Option<Vec<Vec<f64>>>;
    /// The linearised errors with a mistake, where they are cheaper.
    fn roughly(&self, _: &Hypothesis<D>, _: &[f64]) -> Option<Vec<Vec<f64>>> {
        None
    }
    /// These solvers with cells that are twice as large.
    fn coarser(&self) -> Box<dyn Responses<'a, D> + 'a>;
}

/// Runs of this project's own solver.
pub struct SolverRuns<'a, const D: usize> {
    exact: &'a Exact<'a, D>,
    frame: &'a ComparisonFrame<D>,
    mesh: &'a Mesh,
    without: Without,
    cells: usize,
    methods: Vec<Method>,
    /// The maps from the particles of each method to the points of the user's results, at each time.
    samplings: Vec<OnceLock<Vec<Sampling>>>,
}

/// The indices of the methods with which a response is computed again: none of them is near the first.
pub const OTHERS: [usize; 3] = [1, 4, 8];

/// Right methods that differ from each other. The first has particles at quadrature points: finite elements. The second is
/// smooth, and damps. The others have particles anywhere in cells.
fn methods(setup: &Setup, may_be_offset: bool) -> Vec<Method> {
    let integrated = |integrator, shape, formulation, transfer, offset: f64, jitter| Method {
        shape,
        integrator,
        formulation,
        setup: Setup {
            transfer,
            offset: if may_be_offset { [offset; 3] } else { [0.0; 3] },
            jitter,
            ..setup.clone()
        },
    };
    let method = |shape, formulation, transfer, offset, jitter| {
        integrated(IntegratorName::Leapfrog, shape, formulation, transfer, offset, jitter)
    };
    use FormulationName::{Total, Updated};
    use ShapeName::{Cpgimp, Linear, QuadraticBspline, Ugimp};
    vec![
        method(Linear, Total, Transfer::FLIP, 0.0, 0.0),
        method(QuadraticBspline, Total, Transfer::Apic, 0.0, 0.0),
        method(Linear, Total, Transfer::FLIP, 0.4, 0.3),
        method(Linear, Updated, Transfer::FLIP, 0.0, 0.0),
        method(Linear, Updated, Transfer::FLIP, 0.4, 0.3),
        method(Linear, Updated, Transfer::Apic, 0.0, 0.3),
        method(Ugimp, Updated, Transfer::FLIP, 0.0, 0.0),
        method(Cpgimp, Updated, Transfer::Apic, 0.4, 0.0),
        method(QuadraticBspline, Updated, Transfer::FLIP, 0.4, 0.3),
        integrated(IntegratorName::Usl, Linear, Total, Transfer::FLIP, 0.0, 0.0),
        integrated(IntegratorName::Musl, QuadraticBspline, Updated, Transfer::FLIP, 0.0, 0.0),
    ]
}

/// The states of a run at the wanted times.
struct States<'a> {
    follow: &'a dyn Follow,
    times: &'a [f64],
    window: [f64; 2],
    seen: Vec<State>,
}

impl Observer for States<'_> {
    fn step(&mut self, _: usize, _: usize) {}

    /// Asks for the state where the run has to end.
    fn keeps(&self, _: usize, _: usize) -> bool {
        self.follow.is_stopped()
    }

    fn keep(&mut self, _: &dyn Checkpoint) -> Result<(), String> {
        Err(Obstacle::Stopped.to_string())
    }

    fn wants(&self, step: usize, steps: usize) -> bool {
        let [start, end] = self.window;
        let at = |time: &f64| ((time - start) / (end - start) * steps as f64).round() as usize;
        self.times.iter().any(|time| at(time) == step)
    }

    fn see(&mut self, frame: &State) -> Result<(), String> {
        self.seen.push(frame.clone());
        Ok(())
    }
}

impl<'a, const D: usize> SolverRuns<'a, D>
where
    f64: Solve<D>,
{
    /// Plans runs for the results of a mesh, on a coarser grid if a run would need more than `most_work` steps times particles.
    ///
    /// # Errors
    /// Runs that would take too long on any grid.
    pub fn new(
        exact: &'a Exact<'a, D>,
        frame: &'a ComparisonFrame<D>,
        mesh: &'a Mesh,
        without: Without,
        like: Option<&Method>,
        most_work: f64,
    ) -> Result<Self, Obstacle> {
        let [lower, upper] = bounding_box(&exact.domain.body).map_err(|_| Obstacle::NotFinite)?;
        let longest = (upper - lower).max();
        let [least, most] = CELLS[D - 1];
        let wanted = (longest / mesh.cell_size).round().clamp(least as f64, most as f64) as usize;
        let [start, stop] = [
            exact.domain.time[0],
            frame.times.iter().copied().fold(exact.domain.time[0], f64::max),
        ];
        let steps = |cells: usize| {
            (stop - start) * exact.wave_speed()
                / (Setup::default().courant * longest / cells as f64)
        };
        let particles = |cells: usize| {
            let along = |edge: f64| (2.0 * cells as f64 * edge / longest).max(1.0);
            (upper - lower).iter().copied().map(along).product::<f64>()
        };
        let fits = |cells: &usize| steps(*cells) * particles(*cells) <= most_work;
        let cells =
            (least..=wanted).rev().find(fits).ok_or(Obstacle::TooManySteps(steps(least)))?;
        let end = frame.times.iter().copied().fold(exact.domain.time[0], f64::max);
        // Walls are at nodes.
        let is_wall = |it: &Condition| matches!(it, Condition::Fixed | Condition::Roller);
        let may_be_offset = !exact.domain.faces.iter().any(|(_, it)| is_wall(it));
        let setup = Setup { end_time: Some(end), ..Setup::default() };
        let mut methods = methods(&setup, may_be_offset);
        methods.extend(like.map(|like| {
            let setup = Setup { end_time: Some(end), threads: 1, ..like.setup.clone() };
            Method { setup, ..like.clone() }
        }));
        let samplings = methods.iter().map(|_| OnceLock::new()).collect();
        Ok(SolverRuns { exact, frame, mesh, without, cells, methods, samplings })
    }

    /// Whether half as many cells along an edge are still enough.
    pub fn may_be_coarser(&self) -> bool {
        self.cells.div_ceil(2) >= CELLS[D - 1][0]
    }

    /// The cells along each axis: nearly cubes, with the last one ending at the end of the body.
    fn division(&self) -> Division {
        let mut numbers = [1; 3];
        if let Ok([lower, upper]) = bounding_box(&self.exact.domain.body) {
            let along = |edge: f64| (edge / self.cell_size()).round().max(1.0) as usize;
            let edges = (upper - lower).iter().copied().map(along).collect::<Vec<_>>();
            numbers.iter_mut().zip(edges).for_each(|(number, own)| *number = own);
        }
        Division::PerAxis(numbers, D)
    }

    fn errors(&self, index: usize, field: &Changed<'_, D>) -> Option<Vec<Vec<f64>>> {
        let [start, _] = self.exact.domain.time;
        let method = &self.methods[index];
        let end = method.setup.end_time?;
        if end <= start {
            return None;
        }
        let (follow, times) = (self.exact.follow, &self.frame.times);
        let mut states = States { follow, times, window: [start, end], seen: Vec::new() };
        let field: &dyn ManufacturedField<f64, D> = field;
        let cells = self.division();
        let run = f64::run(field, method, &cells, Watch::Displacement, &mut states).ok()?;
        run.level.errors.ok()?;
        let state = |time: f64| {
            let away = |state: &&State| (state.time - time).abs();
            states.seen.iter().min_by(|a, b| away(a).total_cmp(&away(b)))
        };
        let states: Vec<&State> =
            self.frame.times.iter().map(|time| state(*time)).collect::<Option<_>>()?;
        // Leapfrog has velocities half a step earlier.
        let is_leapfrog = method.integrator == IntegratorName::Leapfrog;
        let before = if is_leapfrog { run.level.time_step / 2.0 } else { 0.0 };
        let samplings = self.samplings[index].get_or_init(|| self.samplings(&states));
        let one = |(at, quantity): (usize, Quantity)| {
            samplings[at].values(&self.error(states[at], quantity, before), quantity.components(D))
        };
        Some(self.frame.each().map(one).collect())
    }

    /// The maps from the particles of states to the points of the user's results at their times.
    fn samplings(&self, states: &[&State]) -> Vec<Sampling> {
        let box_around = bounding_box(&self.exact.domain.body);
        let measure = box_around.map_or(1.0, |[lower, upper]| (upper - lower).product());
        let points = self.frame.times.iter().map(|time| nearest(self.mesh, *time));
        let pairs = states.iter().zip(points);
        let one = |(state, snapshot): (&&State, Option<&Snapshot>)| {
            let points = snapshot.map_or(Vec::new(), |it| vectors::<D>(&it.reference));
            Sampling::new(&reference(state), &points, measure)
        };
        pairs.map(one).collect()
    }

    /// The errors of a state at its particles; its velocities belong to a time earlier by `before`.
    fn error(&self, state: &State, quantity: Quantity, before: f64) -> Vec<f64> {
        let (computed, time): (Vec<f64>, f64) = match quantity {
            Quantity::Displacement => (state.displacement.clone(), state.time),
            Quantity::Velocity => (state.velocity.clone(), state.time - before),
            Quantity::DisplacementGradient => {
                let is_diagonal = |at: usize| (at % (D * D)).is_multiple_of(D + 1);
                let f = state.deformation_gradient.iter().enumerate();
                (f.map(|(at, f)| if is_diagonal(at) { f - 1.0 } else { *f }).collect(), state.time)
            }
        };
        let right = self.exact.values(quantity, time, &reference(state));
        computed.iter().zip(right).map(|(a, b)| a - b).collect()
    }
}

impl<'a, const D: usize> Responses<'a, D> for SolverRuns<'a, D>
where
    f64: Solve<D>,
{
    fn cell_size(&self) -> f64 {
        self.exact.length() / self.cells as f64
    }

    fn methods(&self) -> usize {
        self.methods.len()
    }

    fn described(&self, method: usize) -> Option<String> {
        let Method { shape, integrator, formulation, setup } = &self.methods[method];
        let mut said = format!(
            "shape={shape},integrator={integrator},formulation={formulation},transfer={}",
            setup.transfer
        );
        for (option, part) in [("offset", setup.offset[0]), ("jitter", setup.jitter)] {
            if part != 0.0 {
                said += &format!(",{option}={part}");
            }
        }
        Some(said)
    }

    fn is_of_second_order(&self, method: usize) -> bool {
        self.methods[method].integrator == IntegratorName::Leapfrog
    }

    fn right(&self, method: usize) -> Option<Vec<Vec<f64>>> {
        self.errors(method, &Changed::right(self.exact, self.without))
    }

    fn wrong(
        &self,
        method: usize,
        hypothesis: &Hypothesis<D>,
        size: &[f64],
    ) -> Option<Vec<Vec<f64>>> {
        self.errors(method, &Changed::with(self.exact, self.without, hypothesis, size))
    }

    fn coarser(&self) -> Box<dyn Responses<'a, D> + 'a> {
        let samplings = self.methods.iter().map(|_| OnceLock::new()).collect();
        let (cells, methods) = (self.cells.div_ceil(2), self.methods.clone());
        Box::new(SolverRuns { cells, methods, samplings, ..*self })
    }
}

/// X of the particles of a state.
fn reference<const D: usize>(state: &State) -> Vec<Vector<f64, D>> {
    let pairs = state.position.iter().zip(&state.displacement);
    vectors(&pairs.map(|(x, u)| x - u).collect::<Vec<_>>())
}

/// The errors that a mistake in written results makes at a user's points, by time and quantity; `None` for other mistakes.
pub fn written<const D: usize>(
    exact: &Exact<'_, D>,
    frame: &ComparisonFrame<D>,
    mesh: &Mesh,
    hypothesis: &Hypothesis<D>,
    size: &[f64],
) -> Option<Vec<Vec<f64>>> {
    let Change::Output(change) = hypothesis.change else { return None };
    let one = |(at, quantity): (usize, Quantity)| {
        let snapshot = nearest(mesh, frame.times[at])?;
        let points = vectors(&snapshot.reference);
        let given = Given { exact, size, time: snapshot.time, reference: &points, gradient: &[] };
        let wrong = change(&given, quantity);
        let right = exact.values(quantity, snapshot.time, &points);
        Some(less(&wrong, 1.0, &right))
    };
    frame.each().map(one).collect()
}
