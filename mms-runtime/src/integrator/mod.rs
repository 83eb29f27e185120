//! Explicit time integrators: the order in which one step does its sums and updates.
//!
//! To add one, write `integrator/name.rs` with a type that implements [`Integrator`] in terms of
//! [`Operations`], and its source, and add `name::Type` to the list below. The property tests and the
//! `mms` command then find it by itself.
//!
//! All map mass m_i = sum w m and momentum (mv)_i = sum w m v to the grid, and evaluate the body force
//! at the beginning of the step, b(X, t^n). They differ in when the deformation follows, and from which
//! velocity.

use crate::extension::extension_list;
use crate::{Failure, Real};

extension_list! {
    /// The time integrators.
    IntegratorName, IntegratorVisitor: Integrator, "time integrator";
    usl::Usl,
    usf::Usf,
    musl::Musl,
    leapfrog::Leapfrog,
}

/// A time integrator.
pub trait Integrator: 'static {
    /// Order of the displacement in time, by theory; a test measures it.
    const FORMAL_ORDER: i32;

    /// How many time steps the particles' velocities are behind their positions, once the first step is
    /// done.
    const LAG: f64 = 0.0;

    /// Advances particles and grid from t^n = `solver.time()` by one time step dt.
    ///
    /// The solver has checked the state before, and checks it afterwards.
    ///
    /// # Errors
    /// A particle that the grid does not hold.
    fn step<T: Real>(solver: &mut dyn Operations<T>) -> Result<(), Failure>;
}

/// What integrators are made of; w = w_ip and grad w = grad w_ip are those at t^n throughout a step.
///
/// It does not depend on dimension, shape function or field: an integrator is compiled once.
pub trait Operations<T> {
    /// The present time t^n.
    fn time(&self) -> T;

    /// dt.
    fn time_step(&self) -> T;

    /// How many steps have been made.
    fn step_number(&self) -> usize;

    /// Weights at the present positions, and m_i = sum_p w m_p.
    ///
    /// # Errors
    /// A particle that the grid does not hold.
    fn map_mass(&mut self) -> Result<(), Failure>;

    /// v_i = sum_p w m_p v_p / m_i, with the boundary's velocity at `time`.
    fn map_velocity(&mut self, time: T);

    /// a_i = (- sum_p V0 S grad w + sum_p w m_p b(X_p, time) + tractions) / m_i, with the boundary's
    /// acceleration; S is tau, or P in the total formulation.
    ///
    /// # Errors
    /// A piece of a face that the grid does not hold.
    fn map_acceleration(&mut self, time: T) -> Result<(), Failure>;

    /// v_i += `time_step` a_i, with the boundary's velocity at `time`.
    fn kick(&mut self, time_step: T, time: T);

    /// v += `kick` sum_i w a_i as the transfer has it, d += `time_step` sum_i w v_i.
    fn move_particles(&mut self, kick: T, time_step: T);

    /// H += `time_step` L F, L = sum_i v_i (x) grad w; without F in the total formulation.
    fn deform(&mut self, time_step: T);

    /// The stress of H.
    ///
    /// # Errors
    /// F is singular, where the stress needs its inverse.
    fn update_stress(&mut self) -> Result<(), Failure>;
}
