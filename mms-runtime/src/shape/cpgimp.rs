//! Contiguous-particle GIMP: particle domains follow the stretch, without gaps or overlaps.
//!
//! Wallstedt, Guilkey, "An evaluation of explicit time integration schemes for use with the
//! generalized interpolation material point method", J. Comput. Phys. 227 (2008), doi
//! 10.1016/j.jcp.2008.07.019: the weights of GIMP with l_a = l0_a F_aa, no sum over the axis a. Shear and rotation are not followed.

use super::{AxisWeights, Shape, ugimp};
use crate::{Matrix, Real, Vector};

/// GIMP with half widths that follow the diagonal of F.
pub struct Cpgimp;

impl Shape for Cpgimp {
    fn half_width<T: Real, const D: usize>(
        initial: &Vector<T, D>,
        displacement_gradient: &Matrix<T, D>,
    ) -> Vector<T, D> {
        initial + initial.component_mul(&displacement_gradient.diagonal())
    }

    fn axis_weights<T: Real>(position: T, half_width: T) -> AxisWeights<T> {
        ugimp::averages_of_hat(position, half_width)
    }
}
