//! Leapfrog: USL with velocities half a step between the positions.
//!
//! Wallstedt, Guilkey, "An evaluation of explicit time integration schemes for use with the generalized
//! interpolation material point method", J. Comput. Phys. 227 (2008), doi
//! 10.1016/j.jcp.2008.07.019: with v at t^(n+1/2), and x, F and forces at t^n, every update is centred,
//! and USL is of second order in time.

use super::{Integrator, Operations, Sum, Update};
use crate::defect::{Defect, on};
use crate::failure::Failure;
use crate::real::Real;

/// USL whose first kick is half a step, from the exact initial velocity to v at dt/2.
pub struct Leapfrog;

impl Integrator for Leapfrog {
    const FORMAL_ORDER: i32 = 2;
    const LAG: f64 = 0.5;

    fn step<T: Real>(solver: &mut dyn Operations<T>) -> Result<(), Failure> {
        let (t, dt) = (solver.time(), solver.time_step());
        let half = T::ratio(1, 2) * dt;
        let first = if on(Defect::FullFirstKick) { dt } else { half };
        let (t_velocity, kick) =
            if solver.step_number() == 0 { (t, first) } else { (t - half, dt) };
        // m_i = sum w m,  v_i = sum w m v / m_i at t^(n-1/2),  a_i = (- sum V0 tau grad w + sum w m b) / m_i
        // v_i += dt a_i, at t^(n+1/2)
        let (velocity, kicked) = (Sum::Velocity(t_velocity), Sum::Kick(kick, t + half));
        solver.map(&[Sum::Mass, velocity, Sum::Acceleration(t), kicked])?;
        // v += dt sum w a_i,  d += dt sum w v_i,  H += dt L F,  L = sum v_i (x) grad w
        solver.advance(&[Update::Velocity(kick), Update::Position(dt), Update::Deformation(dt)])
    }
}
