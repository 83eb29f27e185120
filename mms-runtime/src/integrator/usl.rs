//! Update stress last.
//!
//! Sulsky, Zhou, Schreyer, "Application of a particle-in-cell method to solid mechanics", Comput. Phys. Commun. 87 (1995)
//! 236-252; named and compared with USF by Bardenhagen, "Energy conservation error in the material point method for solid
//! mechanics", J. Comput. Phys. 180 (2002) 383-403. First order in time: particle velocities start at the exact initial time,
//! half a step off from where the scheme is centred.

use super::{Integrator, Operations, Sum, Update};
use crate::failure::Failure;
use crate::real::Real;

/// Computes forces from the stress at t^n, then updates the deformation from the grid's new velocity.
pub struct Usl;

impl Integrator for Usl {
    const FORMAL_ORDER: i32 = 1;

    fn step<T: Real>(solver: &mut dyn Operations<T>) -> Result<(), Failure> {
        let (t, dt) = (solver.time(), solver.time_step());
        // m_i = sum w m,  v_i = sum w m v / m_i,  a_i = (- sum V0 tau grad w + sum w m b) / m_i
        // v_i += dt a_i
        let kick = Sum::Kick(dt, t + dt);
        solver.map(&[Sum::Mass, Sum::Velocity(t), Sum::Acceleration(t), kick])?;
        // v += dt sum w a_i,  d += dt sum w v_i,  H += dt L F,  L = sum v_i (x) grad w
        solver.advance(&[Update::Velocity(dt), Update::Position(dt), Update::Deformation(dt)])
    }
}
