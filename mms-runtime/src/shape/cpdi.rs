//! Convected particle domain interpolation: a particle is a parallelepiped that follows F.
//!
//! Sadeghirad, Brannon, Burghardt, "A convected particle domain interpolation technique to extend
//! applicability of the material point method for problems involving massive deformations", Int. J.
//! Numer. Meth. Engng 86 (2011), doi 10.1002/nme.3110. The hat functions N_i are replaced by their
//! multilinear interpolants between the corners x_c of x_p + R xi, |xi_a| <= 1, R = F R_0, and averaged:
//!
//! w = 2^-D sum_c N_i(x_c),   grad w = 2^-D sum_c N_i(x_c) R^-T s_c,   s_c the signs of xi at the corner.

use mms_math::machine::Machine;

use super::Shape;
use crate::defect::{Defect, on};
use crate::nodal::{Nodal, Window};
use crate::spline;
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
    /// R s_c, from the particle to the corner.
    apart: [Vector<T, D>; MOST_CORNERS],
}

impl Shape for Cpdi {
    const FOLLOWS: bool = true;
    const NEAR: bool = false;
    type Domain<T: Real, const D: usize> = Matrix<T, D>;
    type Stencil<T: Real, const D: usize> = Corners<T, D>;

    fn domain<T: Real, const D: usize>(half_edges: &Matrix<T, D>) -> Matrix<T, D> {
        *half_edges
    }

    #[inline(always)]
    fn place<T: Real, M: Machine<T>, const D: usize>(
        machine: M,
        corners: &mut Corners<T, D>,
        lattice: &Lattice<T, D>,
        position: &Vector<T, D>,
        half_edges: &Matrix<T, D>,
        displacement_gradient: &Matrix<T, D>,
    ) -> Result<(), Cause> {
        let present = deformation_gradient(displacement_gradient) * half_edges;
        let present = if on(Defect::CornersKept) { *half_edges } else { present };
        let inverse = present.try_inverse().filter(matrix_is_finite).ok_or(Cause::FlatDomain)?;
        let transposed = on(Defect::CornersTransposed);
        let inverse = if transposed { inverse.transpose() } else { inverse };
        let share = T::ratio(1, 1 << D);
        for c in 0..1 << D {
            let sign = |a: usize| if c >> a & 1 == 0 { -T::one() } else { T::one() };
            let signs = Vector::from_fn(|a, _| sign(a));
            let apart = present * signs;
            let corner = position + apart;
            spline::place::<T, M, D, 1, 2>(machine, &mut corners.hats[c], lattice, &corner)?;
            corners.direction[c] = inverse.tr_mul(&signs) * share;
            corners.apart[c] = apart;
        }
        Ok(())
    }
}

impl<T: Real, const D: usize> Default for Corners<T, D> {
    fn default() -> Self {
        Self {
            hats: [Tensor::new(); MOST_CORNERS],
            direction: [Vector::zeros(); MOST_CORNERS],
            apart: [Vector::zeros(); MOST_CORNERS],
        }
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

    fn span(&self) -> [usize; 2] {
        let spans = self.hats.iter().take(1 << D).map(Stencil::span);
        spans.fold([usize::MAX, 0], |[first, after], [from, to]| [first.min(from), after.max(to)])
    }

    #[inline(always)]
    fn spread_value<M: Machine<T>>(&self, machine: M, value: M::Four, mut nodes: Window<'_, T>) {
        let of_corner = machine.times(machine.splat(T::ratio(1, 1 << D)), value);
        for hats in self.hats.iter().take(1 << D) {
            hats.spread_value(machine, of_corner, nodes.reborrow());
        }
    }

    #[inline(always)]
    fn spread<M: Machine<T>>(
        &self,
        machine: M,
        value: M::Four,
        slopes: [M::Four; D],
        mut nodes: Window<'_, T>,
    ) {
        let share = machine.times(machine.splat(T::ratio(1, 1 << D)), value);
        for (hats, direction) in self.hats.iter().zip(&self.direction).take(1 << D) {
            let mut of_corner = share;
            for a in 0..D {
                of_corner = machine.times_plus(machine.splat(direction[a]), slopes[a], of_corner);
            }
            hats.spread_value(machine, of_corner, nodes.reborrow());
        }
    }

    #[inline(always)]
    fn collect_value<M: Machine<T>>(&self, machine: M, nodes: &[Nodal<T>]) -> M::Four {
        self.collect(machine, nodes).0
    }

    #[inline(always)]
    fn collect<M: Machine<T>>(&self, machine: M, nodes: &[Nodal<T>]) -> (M::Four, [M::Four; D]) {
        let nothing = machine.splat(T::zero());
        let (mut value, mut slopes) = (nothing, [nothing; D]);
        let share = machine.splat(T::ratio(1, 1 << D));
        for (hats, direction) in self.hats.iter().zip(&self.direction).take(1 << D) {
            let of_corner = hats.collect_value(machine, nodes);
            value = machine.times_plus(share, of_corner, value);
            for a in 0..D {
                slopes[a] = machine.times_plus(machine.splat(direction[a]), of_corner, slopes[a]);
            }
        }
        (value, slopes)
    }

    /// Corner by corner: hat functions have moments around the corner that they are taken at, and the corner
    /// has its own from the particle.
    #[inline(always)]
    fn spread_moments<M: Machine<T>>(
        &self,
        machine: M,
        lattice: &Lattice<T, D>,
        value: M::Four,
        slopes: [M::Four; D],
        mut nodes: Window<'_, T>,
    ) {
        let share = machine.splat(T::ratio(1, 1 << D));
        let mut of_node = slopes;
        for a in 0..D {
            of_node[a] = machine.times(share, slopes[a]);
        }
        for (hats, edges) in self.hats.iter().zip(&self.apart).take(1 << D) {
            let mut of_corner = machine.times(share, value);
            for a in 0..D {
                of_corner = machine.times_plus(machine.splat(edges[a]), of_node[a], of_corner);
            }
            hats.spread_moments(machine, lattice, of_corner, of_node, nodes.reborrow());
        }
    }

    /// The gradient: hat functions know no nearer linear function.
    #[inline(always)]
    fn collect_slopes<M: Machine<T>>(
        &self,
        machine: M,
        _: &Lattice<T, D>,
        nodes: &[Nodal<T>],
    ) -> [M::Four; D] {
        self.collect(machine, nodes).1
    }
}
