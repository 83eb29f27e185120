//! Contiguous-particle GIMP: particle domains follow the stretch, without gaps or overlaps.
//!
//! Wallstedt, Guilkey, "An evaluation of explicit time integration schemes for use with the
//! generalized interpolation material point method", J. Comput. Phys. 227 (2008), doi
//! 10.1016/j.jcp.2008.07.019: the weights of GIMP with l_a = l0_a F_aa, no sum over the axis a. Where F is not
//! diagonal, F_aa is replaced by U_aa of F = R U (Charlton, Coombs, Augarde, Comput. Struct. 190 (2017)),
//! which a rotation leaves alone. Boxes follow neither shear nor rotation.

use super::{MAX_NODES, Shape, gimp_stencil, half_widths};
use crate::stencil::Tensor;
use crate::tensor::right_stretch;
use crate::{Cause, Lattice, Matrix, Real, Vector};

/// GIMP with half widths that follow the stretch along the axes.
pub struct Cpgimp;

impl Shape for Cpgimp {
    const FOLLOWS: bool = true;
    type Domain<T: Real, const D: usize> = Vector<T, D>;
    type Stencil<T: Real, const D: usize> = Tensor<T, D, MAX_NODES>;

    fn domain<T: Real, const D: usize>(half_edges: &Matrix<T, D>) -> Vector<T, D> {
        half_widths(half_edges)
    }

    fn stencil<T: Real, const D: usize>(
        lattice: &Lattice<T, D>,
        position: &Vector<T, D>,
        initial: &Vector<T, D>,
        displacement_gradient: &Matrix<T, D>,
    ) -> Result<Tensor<T, D, MAX_NODES>, Cause> {
        let stretch = right_stretch(displacement_gradient).ok_or(Cause::FlatDomain)?;
        gimp_stencil(lattice, position, &initial.component_mul(&stretch.diagonal()))
    }
}
