//! Explicit time integrators: the order of a step's sums and updates.
//!
//! To add one, write `integrator/name.rs` with a type that implements [`Integrator`] in terms of [`Operations`], and its
//! source, and add `name::Type` to the list below. The property tests and the `mms` command then find it automatically.
//!
//! All map mass m_i = sum w m and momentum (mv)_i = sum w m v to the grid, and evaluate the body force at the beginning of the
//! step, b(X, t^n). They differ in when the deformation is updated, and from which velocity.
//!
//! | integrator | order in time | |
//! |---|---|---|
//! | `usl`, `usf`, `musl` | 1 | start from the exact initial velocity, half a step from the time where the scheme is centred |
//! | `leapfrog` | 2 | USL whose first kick is half a step |

use crate::extension::extension_list;
use crate::failure::Failure;
use crate::real::Real;

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
    /// Theoretical order of the displacement in time; a test measures it.
    const FORMAL_ORDER: i32;

    /// The number of time steps by which the particles' velocities are behind their positions, once the first step is done.
    const LAG: f64 = 0.0;

    /// Whether a step uses weights after it has moved or deformed the particles (one after the other, with different
    /// velocities). Weights belong to t^n throughout a step, so the solver then keeps the displacements and gradients of t^n.
    /// It stores no weights: computing them again takes less time than reading them.
    const KEEPS_WEIGHTS: bool = false;

    /// Advances particles and grid from t^n = `solver.time()` by one time step dt.
    ///
    /// The solver has checked the state before, and checks it afterwards.
    ///
    /// # Errors
    /// A particle is outside the grid.
    fn step<T: Real>(solver: &mut dyn Operations<T>) -> Result<(), Failure>;
}

/// A quantity of the nodes, computed from sums over particles; w = w_ip and grad w = grad w_ip are evaluated at t^n throughout
/// a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sum<T> {
    /// m_i = sum_p w m_p, with weights at the present positions.
    Mass,
    /// v_i = sum_p w m_p v_p / m_i, with the boundary's velocity at this time.
    Velocity(T),
    /// a_i = (- sum_p V0 S grad w + sum_p w m_p b(X_p, t) + tractions) / m_i at this time, with the boundary's
    /// acceleration; S is tau(H), or P(H) in the total formulation.
    Acceleration(T),
    /// v_i += dt a_i with the first number as dt, then the boundary's velocity at the second, a time; a_i and v_i are computed
    /// before the kick or with it. If particles read neither a_i nor v_i before the kick, momentum and force are one sum.
    Kick(T, T),
}

/// A change of the particles' state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Update<T> {
    /// v += dt sum_i w a_i, or the transfer's own update.
    Velocity(T),
    /// d += dt sum_i w v_i.
    Position(T),
    /// H += dt L F, L = sum_i v_i (x) grad w; without F in the total formulation.
    Deformation(T),
}

/// The operations that integrators consist of.
///
/// The trait does not depend on dimension, shape function or field: an integrator is compiled once.
pub trait Operations<T> {
    /// The present time t^n.
    fn time(&self) -> T;

    /// dt.
    fn time_step(&self) -> T;

    /// The number of completed steps.
    fn step_number(&self) -> usize;

    /// Computes these quantities of the nodes, in one pass over the particles.
    ///
    /// # Errors
    /// A particle, or a piece of a face, is outside the grid; a particle has no stress.
    fn map(&mut self, sums: &[Sum<T>]) -> Result<(), Failure>;

    /// Applies these changes, in one pass over the particles.
    ///
    /// # Errors
    /// A particle is outside the grid.
    fn advance(&mut self, updates: &[Update<T>]) -> Result<(), Failure>;
}
