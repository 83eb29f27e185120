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
pub trait Formulation: Send + Sync + 'static {
    /// Whether weights follow the present positions, and dF/dt = L F with L = sum_i v_i (x) grad w;
    /// otherwise weights are those of the reference positions, computed once, and dF/dt is that sum.
    const MOVES: bool;

    /// The stress that works on grad w per reference volume, from tau and H; `None` where F is singular.
    fn stress<T: Real, const D: usize>(
        kirchhoff: &Matrix<T, D>,
        displacement_gradient: &Matrix<T, D>,
    ) -> Option<Matrix<T, D>>;
}
