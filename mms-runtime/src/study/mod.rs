//! Convergence studies: one method on levels of refinement, its errors, orders and verdict.

mod errors;
mod order;
mod verdict;

pub use errors::Errors;
pub use order::{Orders, observed_order, orders};
pub use verdict::{Judgement, TOLERANCE, Verdict, judge};

use std::time::Instant;

use crate::integrator::{Integrator, IntegratorName, IntegratorVisitor};
use crate::shape::{Shape, ShapeName, ShapeVisitor};
use crate::{Failure, ManufacturedField, Real, Refusal, Resolution, Solver};

/// A method: what stays the same on all levels of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct Method {
    /// The shape function.
    pub shape: ShapeName,
    /// The time integrator.
    pub integrator: IntegratorName,
    /// Particles per cell along each axis.
    pub particles_per_cell: usize,
    /// time_step * c0 / cell_size, c0 being the fastest wave speed at F = I.
    pub courant: f64,
}

impl Default for Method {
    /// Contiguous-particle GIMP and leapfrog, 2 particles per cell and axis, Courant number 0.4.
    fn default() -> Self {
        Self {
            shape: ShapeName::Cpgimp,
            integrator: IntegratorName::Leapfrog,
            particles_per_cell: 2,
            courant: 0.4,
        }
    }
}

/// One level of a study: a run at one resolution.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// Cells along the longest edge of the body.
    pub cells: usize,
    /// Grid spacing h.
    pub cell_size: f64,
    /// Time step dt.
    pub time_step: f64,
    /// Steps that the time window takes.
    pub steps: usize,
    /// Particles.
    pub particles: usize,
    /// The errors, or why the run stopped.
    pub errors: Result<Errors, Failure>,
    /// Wall-clock seconds, everything included.
    pub seconds: f64,
}

/// Runs one level: the whole time window, with `cells` along the longest edge of the body.
///
/// Calls `progress(step, steps)` after each step. A run that stops is a level with a [`Failure`]; a
/// scene that cannot be started is a [`Refusal`].
pub fn run_level<T: Real, const D: usize>(
    field: &dyn ManufacturedField<T, D>,
    method: &Method,
    cells: usize,
    progress: &mut dyn FnMut(usize, usize),
) -> Result<Level, Refusal> {
    method.shape.visit(WithShape { field, method, cells, progress })
}

/// From the names of shape function and integrator to the solver compiled for them: the first half,
struct WithShape<'a, T, const D: usize> {
    field: &'a dyn ManufacturedField<T, D>,
    method: &'a Method,
    cells: usize,
    progress: &'a mut dyn FnMut(usize, usize),
}

impl<T: Real, const D: usize> ShapeVisitor for WithShape<'_, T, D> {
    type Output = Result<Level, Refusal>;

    fn visit<S: Shape>(self) -> Self::Output {
        let Self { field, method, cells, progress } = self;
        let start = Instant::now();
        let Method { particles_per_cell, courant, .. } = *method;
        let resolution = Resolution { cells, particles_per_cell, courant };
        let solver = Solver::<T, D, _, S>::new(field, &resolution)?;
        let mut level = Level {
            cells,
            cell_size: solver.grid().cell_size.to_f64(),
            time_step: solver.time_step().to_f64(),
            steps: solver.steps(),
            particles: solver.particles().len(),
            errors: Ok(Errors::default()),
            seconds: 0.0,
        };
        level.errors = method.integrator.visit(WithIntegrator { solver, progress });
        level.seconds = start.elapsed().as_secs_f64();
        Ok(level)
    }
}

/// and the second half.
struct WithIntegrator<'a, T: Real, const D: usize, S> {
    solver: Solver<'a, T, D, dyn ManufacturedField<T, D> + 'a, S>,
    progress: &'a mut dyn FnMut(usize, usize),
}

impl<T: Real, const D: usize, S: Shape> IntegratorVisitor for WithIntegrator<'_, T, D, S> {
    type Output = Result<Errors, Failure>;

    fn visit<I: Integrator>(mut self) -> Self::Output {
        self.solver.run::<I>(self.progress)
    }
}
