//! The updated Lagrangian formulation: the grid is in space.
//!
//! Sulsky, Chen, Schreyer, "A particle method for history-dependent materials", Comput. Methods Appl. Mech. Engrg. 118 (1994)
//! 179-196. Weights are evaluated at the present positions, in every step: f_i = - sum_p V0 tau grad w, since V sigma = V0 tau,
//! and dF/dt = L F.

use super::Formulation;
use crate::column::PACK;
use crate::column::{Matrices, Pack as _};
use crate::defect::{Defect, on};
use crate::real::Real;
use crate::tensor::jacobian;

/// The updated formulation: particles move through the grid.
pub struct Updated;

impl Formulation for Updated {
    const MOVES: bool = true;

    fn stress<T: Real, const D: usize>(
        displacement_gradient: &[Matrices<T, D>],
        stress: &mut [Matrices<T, D>],
    ) -> Result<(), usize> {
        if on(Defect::KirchhoffForCauchy) {
            for (h, stress) in displacement_gradient.iter().zip(stress) {
                for k in 0..PACK {
                    stress.set(k, &(stress.get(k) * jacobian(&h.get(k))));
                }
            }
        }
        Ok(())
    }
}
