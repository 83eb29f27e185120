//! Convected particle domain interpolation: a particle is a parallelepiped that follows F.
//!
//! Sadeghirad, Brannon, Burghardt, "A convected particle domain interpolation technique to extend
//! applicability of the material point method for problems involving massive deformations", Int. J.
//! Numer. Meth. Engng 86 (2011), doi 10.1002/nme.3110. The hat functions N_i are replaced by their
//! multilinear interpolants between the corners x_c of x_p + R xi, |xi_a| <= 1, R = F R_0, and averaged:
//!
//! w = 2^-D sum_c N_i(x_c),   grad w = 2^-D sum_c N_i(x_c) R^-T s_c,   s_c the signs of xi at the corner.

use super::{Shape, linear};
use crate::stencil::{Stencil, Tensor};
use crate::tensor::{deformation_gradient, matrix_is_finite};
use crate::{Cause, Lattice, Matrix, Real, Vector};

/// GIMP on parallelepipeds: shear and rotation are followed, without gaps or overlaps in a uniform F.
pub struct Cpdi;

/// The corners of a parallelepiped in three dimensions.
const MOST_CORNERS: usize = 8;

/// Every corner's hat functions, and what their gradient is along.
#[derive(Clone, Debug)]
pub struct Corners<T, const D: usize> {
    /// The first 2^D mean something.
    hats: [Tensor<T, D, 2>; MOST_CORNERS],
    /// 2^-D R^-T s_c.
    direction: [Vector<T, D>; MOST_CORNERS],
}

impl Shape for Cpdi {
    const FOLLOWS: bool = true;
    type Domain<T: Real, const D: usize> = Matrix<T, D>;
    type Stencil<T: Real, const D: usize> = Corners<T, D>;

    fn domain<T: Real, const D: usize>(half_edges: &Matrix<T, D>) -> Matrix<T, D> {
        *half_edges
    }

    fn stencil<T: Real, const D: usize>(
        lattice: &Lattice<T, D>,
        position: &Vector<T, D>,
        half_edges: &Matrix<T, D>,
        displacement_gradient: &Matrix<T, D>,
    ) -> Result<Corners<T, D>, Cause> {
        let present = deformation_gradient(displacement_gradient) * half_edges;
        let inverse = present.try_inverse().filter(matrix_is_finite).ok_or(Cause::FlatDomain)?;
        let share = T::ratio(1, 1 << D);
        let hats_at = |corner: &Vector<T, D>| {
            let cells = lattice.in_cells(corner);
            Tensor::new(lattice, |a| linear::hats(cells[a])).ok_or_else(|| Cause::lost(corner))
        };
        let mut corners = Corners {
            hats: [hats_at(position)?; MOST_CORNERS],
            direction: [Vector::zeros(); MOST_CORNERS],
        };
        for c in 0..1 << D {
            let sign = |a: usize| if c >> a & 1 == 0 { -T::one() } else { T::one() };
            let signs = Vector::from_fn(|a, _| sign(a));
            corners.hats[c] = hats_at(&(position + present * signs))?;
            corners.direction[c] = inverse.tr_mul(&signs) * share;
        }
        Ok(corners)
    }
}

impl<T: Real, const D: usize> Stencil<T, D> for Corners<T, D> {
    #[inline(always)]
    fn each(&self, mut visit: impl FnMut(usize, T, Vector<T, D>)) {
        let share = T::ratio(1, 1 << D);
        for (hats, direction) in self.hats.iter().zip(&self.direction).take(1 << D) {
            hats.each(|node, w, _| visit(node, w * share, direction * w));
        }
    }
}
