//! Cubic B-splines: the particle is a point, and its weights have two continuous derivatives.
//!
//! Steffen, Kirby, Berzins, "Analysis and reduction of quadrature errors in the material point method
//! (MPM)", Int. J. Numer. Meth. Engng 76 (2008), doi 10.1002/nme.2360. Nodes are those of [`Lattice`], and
//! knots end at the faces of a body that do not move ([`crate::spline`]).

use super::{MAX_NODES, PointStencil, Shape};
use crate::stencil::Tensor;
use crate::{Cause, Lattice, Matrix, Real, Vector, spline};

/// Cubic B-splines, 4 nodes per axis.
pub struct CubicBspline;

impl Shape for CubicBspline {
    const DEGREE: usize = 3;
    type Domain<T: Real, const D: usize> = ();
    type Stencil<T: Real, const D: usize> = Tensor<T, D, 4>;

    fn domain<T: Real, const D: usize>(_: &Matrix<T, D>) {}

    fn stencil<T: Real, const D: usize>(
        lattice: &Lattice<T, D>,
        position: &Vector<T, D>,
        (): &(),
        _: &Matrix<T, D>,
    ) -> Result<Tensor<T, D, 4>, Cause> {
        spline::stencil::<T, D, 3, 4>(lattice, position)
    }

    fn point<T: Real, const D: usize>(
        lattice: &Lattice<T, D>,
        position: &Vector<T, D>,
    ) -> Result<PointStencil<T, D>, Cause> {
        spline::stencil::<T, D, 3, MAX_NODES>(lattice, position)
    }
}
