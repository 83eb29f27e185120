//! The updated Lagrangian formulation: the grid is in space.
//!
//! Sulsky, Chen, Schreyer, "A particle method for history-dependent materials", Comput. Methods Appl.
//! Mech. Engrg. 118 (1994) 179-196. Weights are those of the present positions, and change with them:
//! f_i = - sum_p V0 tau grad w, since V sigma = V0 tau, and dF/dt = L F.

use super::Formulation;
use crate::defect::{Defect, on};
use crate::tensor::jacobian;
use crate::{Matrix, Real};

/// Particles move through the grid.
pub struct Updated;

impl Formulation for Updated {
    const MOVES: bool = true;

    fn stress<T: Real, const D: usize>(
        displacement_gradient: &[Matrix<T, D>],
        stress: &mut [Matrix<T, D>],
    ) -> Result<(), usize> {
        if on(Defect::KirchhoffForCauchy) {
            let particles = displacement_gradient.iter().zip(stress);
            particles.for_each(|(h, stress)| *stress *= jacobian(h));
        }
        Ok(())
    }
}
