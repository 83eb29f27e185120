//! Contiguous-particle GIMP: particle domains follow the stretch, without gaps or overlaps.
//!
//! Wallstedt, Guilkey, "An evaluation of explicit time integration schemes for use with the generalized interpolation material
//! point method", J. Comput. Phys. 227 (2008), doi 10.1016/j.jcp.2008.07.019: the weights of GIMP with l_a = l0_a F_aa, no sum
//! over the axis a. If F is not diagonal, F_aa is replaced by U_aa of F = R U (Charlton, Coombs, Augarde, Comput. Struct. 190
//! (2017)), which a rotation does not change. Boxes follow neither shear nor rotation.

use crate::gimp::Gimp;

/// Weights averaged over boxes that follow the stretch along the axes, 2 to 4 nodes per axis.
pub type Cpgimp = Gimp<true>;
