//! The total Lagrangian formulation: the grid is in the reference configuration.
//!
//! de Vaucorbeil, Nguyen, Hutchinson, "A Total-Lagrangian Material Point Method for solid mechanics problems involving large
//! deformations", Comput. Methods Appl. Mech. Engrg. 360 (2020), doi 10.1016/j.cma.2019.112783. Weights are evaluated once, at
//! the reference positions: f_i = - sum_p V0 P grad0 w, and dF/dt = sum_i v_i (x) grad0 w.

use super::Formulation;
use crate::column::PACK;
use crate::column::{Matrices, Pack as _};
use crate::defect::{Defect, on};
use crate::real::Real;
use crate::tensor::inverse_deformation_gradient;

/// The total formulation: particles stay where they are in the grid, and nothing crosses a cell.
pub struct Total;

impl Formulation for Total {
    const MOVES: bool = false;

    fn stress<T: Real, const D: usize>(
        displacement_gradient: &[Matrices<T, D>],
        stress: &mut [Matrices<T, D>],
    ) -> Result<(), usize> {
        for (b, (h, stress)) in displacement_gradient.iter().zip(stress).enumerate() {
            for k in 0..PACK {
                let inverse = inverse_deformation_gradient(&h.get(k)).ok_or(PACK * b + k)?;
                let mut first = stress.get(k) * inverse.transpose();
                if on(Defect::TransposedStress) {
                    first.transpose_mut();
                }
                stress.set(k, &first);
            }
        }
        Ok(())
    }
}
