//! Update stress first.
//!
//! Bardenhagen, "Energy conservation error in the material point method for solid mechanics", J. Comput.
//! Phys. 180 (2002) 383-403. First order in time.

use super::{Integrator, Operations, Sum, Update};
use crate::failure::Failure;
use crate::real::Real;

/// Updates the deformation from the grid's velocity at t^n, then computes forces from the stress at t^(n+1).
pub struct Usf;

impl Integrator for Usf {
    const FORMAL_ORDER: i32 = 1;
    const KEEPS_WEIGHTS: bool = true;

    fn step<T: Real>(solver: &mut dyn Operations<T>) -> Result<(), Failure> {
        let (t, dt) = (solver.time(), solver.time_step());
        // m_i = sum w m,  v_i = sum w m v / m_i
        solver.map(&[Sum::Mass, Sum::Velocity(t)])?;
        // H += dt L F,  L = sum v_i (x) grad w
        solver.advance(&[Update::Deformation(dt)])?;
        // a_i = (- sum V0 tau grad w + sum w m b) / m_i
        // v_i += dt a_i
        solver.map(&[Sum::Acceleration(t), Sum::Kick(dt, t + dt)])?;
        // v += dt sum w a_i,  d += dt sum w v_i
        solver.advance(&[Update::Velocity(dt), Update::Position(dt)])
    }
}
