//! A view of a solver's state for measurements. Its type depends on neither shape function nor formulation, so measurements are
//! compiled once per dimension and precision for all solvers.

use crate::failure::{Cause, Failure};
use crate::particle::Particles;
use crate::real::Real;
use crate::tensor::components;

/// The state after a step, borrowed from a solver.
#[derive(Clone, Copy)]
pub struct StateView<'a, T, const D: usize, F: ?Sized> {
    /// The field that drives the run.
    pub field: &'a F,
    /// The particles.
    pub particles: &'a Particles<T, D>,
    /// The number of completed steps.
    pub step: usize,
    /// The time t^n of the particles' positions.
    pub time: f64,
    /// The time of the particles' velocities.
    pub time_of_velocity: f64,
    /// The time that the body force was last evaluated at.
    pub time_of_force: T,
    /// dt.
    pub time_step: f64,
    /// Whether the body moves through the grid.
    pub moves: bool,
}

impl<T: Real, const D: usize, F: ?Sized> StateView<'_, T, D, F> {
    /// A failure of one particle, now.
    pub(crate) fn failure(&self, particle: usize, cause: Cause) -> Failure {
        Failure {
            step: self.step,
            time: self.time,
            particle: Some(self.particles.id[particle] as usize),
            reference_position: components(&self.particles.reference_position[particle]),
            cause,
        }
    }

    /// A failure of no particular particle, now.
    pub(crate) fn failed(&self, cause: Cause) -> Failure {
        let (step, time) = (self.step, self.time);
        Failure { step, time, particle: None, reference_position: Vec::new(), cause }
    }

    /// A run that an observer stopped, now.
    pub(crate) fn stopped(&self, reason: String) -> Failure {
        self.failed(Cause::Stopped { reason })
    }
}
