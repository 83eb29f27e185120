//! Modified update stress last.
//!
//! Sulsky, Zhou, Schreyer, Comput. Phys. Commun. 87 (1995) 236-252 (the second map of the momentum);
//! Nairn, "Material point method calculations with explicit cracks", CMES 4 (2003) 649-663,
//! compares it with USL and USF. First order in time.

use super::{Integrator, Operations, Sum, Update};
use crate::failure::Failure;
use crate::real::Real;

/// USL, except that the deformation follows the particles' new velocities, mapped to the grid once more.
pub struct Musl;

impl Integrator for Musl {
    const FORMAL_ORDER: i32 = 1;
    const KEEPS_WEIGHTS: bool = true;

    fn step<T: Real>(solver: &mut dyn Operations<T>) -> Result<(), Failure> {
        let (t, dt) = (solver.time(), solver.time_step());
        // m_i = sum w m,  v_i = sum w m v / m_i,  a_i = (- sum V0 tau grad w + sum w m b) / m_i
        // v_i += dt a_i
        let kick = Sum::Kick(dt, t + dt);
        solver.map(&[Sum::Mass, Sum::Velocity(t), Sum::Acceleration(t), kick])?;
        // v += dt sum w a_i,  d += dt sum w v_i
        solver.advance(&[Update::Velocity(dt), Update::Position(dt)])?;
        // v_i = sum w m v / m_i, with the new v
        solver.map(&[Sum::Velocity(t + dt)])?;
        // H += dt L F,  L = sum v_i (x) grad w
        solver.advance(&[Update::Deformation(dt)])
    }
}
