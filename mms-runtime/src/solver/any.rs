//! A solver whose shape function and integrator are chosen by name.

use super::{Residual, Seconds, Solver, State, StateView};
use crate::failure::{Failure, Refusal};
use crate::field::ManufacturedField;
use crate::grid::Grid;
use crate::integrator::IntegratorName;
use crate::integrator::{Integrator, IntegratorVisitor};
use crate::method::{Division, Method};
use crate::real::Real;
use crate::shape::{Shape, ShapeVisitor};

/// A solver of a [`Method`] with any shape function and integrator. The solvers of [`Solve`](crate::Solve) are compiled in this
/// crate, so that callers compile none.
pub trait AnySolver<'f, T: Real, const D: usize>: Send {
    /// Advances by one time step and checks the new state.
    ///
    /// # Errors
    /// The step failed, or led to an invalid state.
    fn step(&mut self) -> Result<(), Failure>;

    /// Checks the state, as [`Solver::check`] does.
    ///
    /// # Errors
    /// The first invalid particle.
    fn check(&self) -> Result<(), Failure>;

    /// Tests that a wave of this speed crosses no edge of a cell in a time step.
    ///
    /// # Errors
    /// The wave crosses an edge.
    fn check_time_step(&self, fastest_wave: f64) -> Result<(), Failure>;

    /// The state, for measurements.
    fn present(&self) -> StateView<'_, T, D, dyn ManufacturedField<T, D> + 'f>;

    /// The grid after the last step.
    fn grid(&self) -> &Grid<T, D>;

    /// The number of steps of the time window.
    fn steps(&self) -> usize;

    /// The number of time steps by which the particles' velocities are behind their positions, once the first step is done.
    fn lag(&self) -> f64;

    /// sum m v.v/2 of the nodes, with the v_i that the last step moved particles by.
    fn kinetic_energy(&self) -> f64;

    /// Sets the velocities of all particles to 0.
    fn halt(&mut self);

    /// The distance of the body from equilibrium in its present state.
    ///
    /// # Errors
    /// The errors of a step.
    fn out_of_balance(&mut self) -> Result<Residual, Failure>;

    /// The times of the parts of all steps so far.
    fn seconds(&self) -> Seconds;

    /// The state after the last step, from which a run can be resumed.
    fn state(&self) -> State<'_, T, D>;

    /// Resumes from a state of the same scene.
    ///
    /// # Errors
    /// The state is of another scene.
    fn restore(&mut self, state: State<'_, T, D>) -> Result<(), Refusal>;
}

/// The solver of a method, with the body divided into `cells`.
///
/// # Errors
/// The scene cannot be started.
pub(crate) fn of_method<'f, T: Real, const D: usize>(
    field: &'f dyn ManufacturedField<T, D>,
    method: &Method,
    cells: &Division,
) -> Result<Box<dyn AnySolver<'f, T, D> + 'f>, Refusal> {
    method.validate()?;
    method.shape.visit(WithShape { field, method, cells })
}

struct WithShape<'a, 'f, T, const D: usize> {
    field: &'f dyn ManufacturedField<T, D>,
    method: &'a Method,
    cells: &'a Division,
}

impl<'f, T: Real, const D: usize> ShapeVisitor for WithShape<'_, 'f, T, D> {
    type Output = Result<Box<dyn AnySolver<'f, T, D> + 'f>, Refusal>;

    fn visit<S: Shape>(self) -> Self::Output {
        let Method { formulation, setup, integrator, .. } = self.method;
        let solver = Solver::new::<S>(self.field, *formulation, setup, self.cells)?;
        Ok(Box::new(Chosen { solver, integrator: *integrator }))
    }
}

struct Chosen<'f, T: Real, const D: usize> {
    solver: Solver<'f, T, D, dyn ManufacturedField<T, D> + 'f>,
    integrator: IntegratorName,
}

impl<'f, T: Real, const D: usize> AnySolver<'f, T, D> for Chosen<'f, T, D> {
    fn step(&mut self) -> Result<(), Failure> {
        self.integrator.visit(Step(&mut self.solver))
    }

    fn check(&self) -> Result<(), Failure> {
        self.solver.check()
    }

    fn check_time_step(&self, fastest_wave: f64) -> Result<(), Failure> {
        self.solver.check_time_step(fastest_wave)
    }

    fn present(&self) -> StateView<'_, T, D, dyn ManufacturedField<T, D> + 'f> {
        self.solver.present()
    }

    fn grid(&self) -> &Grid<T, D> {
        self.solver.grid()
    }

    fn steps(&self) -> usize {
        self.solver.steps()
    }

    fn lag(&self) -> f64 {
        self.integrator.visit(Lag)
    }

    fn kinetic_energy(&self) -> f64 {
        self.solver.kinetic_energy()
    }

    fn halt(&mut self) {
        self.solver.halt();
    }

    fn out_of_balance(&mut self) -> Result<Residual, Failure> {
        self.solver.out_of_balance()
    }

    fn seconds(&self) -> Seconds {
        self.solver.seconds()
    }

    fn state(&self) -> State<'_, T, D> {
        self.solver.state()
    }

    fn restore(&mut self, state: State<'_, T, D>) -> Result<(), Refusal> {
        self.solver.restore(state)
    }
}

struct Step<'s, S>(&'s mut S);

impl<T: Real, const D: usize, F> IntegratorVisitor for Step<'_, Solver<'_, T, D, F>>
where
    F: ManufacturedField<T, D> + ?Sized,
{
    type Output = Result<(), Failure>;

    fn visit<I: Integrator>(self) -> Self::Output {
        self.0.step::<I>()
    }
}

struct Lag;

impl IntegratorVisitor for Lag {
    type Output = f64;

    fn visit<I: Integrator>(self) -> f64 {
        I::LAG
    }
}
