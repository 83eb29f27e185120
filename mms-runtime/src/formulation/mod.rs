//! Formulations: in which configuration the grid lives.

use crate::extension::extension_list;
use crate::{Matrix, Real};

extension_list! {
    /// The formulations.
    FormulationName, FormulationVisitor: Formulation, "formulation";
    updated::Updated,
    total::Total,
}

/// In which configuration weights and stresses are taken.
pub trait Formulation: 'static {
    /// Whether weights follow the present positions; otherwise they are those of the reference
    /// positions, and computed once.
    const MOVES: bool;

    /// The stress that works on grad w per reference volume, from tau and H; `None` where F is singular.
    fn stress<T: Real, const D: usize>(
        kirchhoff: &Matrix<T, D>,
        displacement_gradient: &Matrix<T, D>,
    ) -> Option<Matrix<T, D>>;

    /// dF/dt, from sum_i v_i (x) grad w and H.
    fn rate<T: Real, const D: usize>(
        velocity_gradient: &Matrix<T, D>,
        displacement_gradient: &Matrix<T, D>,
    ) -> Matrix<T, D>;
}
