//! Modified update stress last.
//!
//! Sulsky, Zhou, Schreyer, Comput. Phys. Commun. 87 (1995) 236-252 (the second map of the momentum);
//! Nairn, "Material point method calculations with explicit cracks", CMES 4 (2003) 649-663,
//! compares it with USL and USF. First order in time.

use super::{Integrator, Operations};
use crate::{Failure, Real};

/// USL, but the deformation follows the particles' new velocities, mapped to the grid once more.
pub struct Musl;

impl Integrator for Musl {
    const FORMAL_ORDER: i32 = 1;

    fn step<T: Real>(solver: &mut dyn Operations<T>) -> Result<(), Failure> {
        let (t, dt) = (solver.time(), solver.time_step());
        solver.map_mass()?; //            m_i = sum w m
        solver.map_velocity(t); //        v_i = sum w m v / m_i
        solver.map_acceleration(t)?; //   a_i = (- sum V0 tau grad w + sum w m b) / m_i
        solver.kick(dt, t + dt); //       v_i += dt a_i
        solver.move_particles(dt, dt); // v += dt sum w a_i,  d += dt sum w v_i
        solver.map_velocity(t + dt); //   v_i = sum w m v / m_i, with the new v
        solver.deform(dt); //             H += dt L F,  L = sum v_i (x) grad w
        solver.update_stress() //         tau = tau(H)
    }
}
