//! Linear shape functions: the particle is a point.
//!
//! Sulsky, Chen, Schreyer, "A particle method for history-dependent materials", Comput. Methods Appl.
//! Mech. Engrg. 118 (1994) 179-196: w = 1 - |x - x_i| / h. The gradient jumps where a particle crosses a
//! cell's border, so that the method does not converge for large motions of particles through cells. In
//! the total formulation nothing crosses.

use super::Shape;
use crate::stencil::{AxisWeights, Tensor};
use crate::{Cause, Lattice, Matrix, Real, Vector};

/// Linear weights ("hat functions"), two nodes per axis.
pub struct Linear;

impl Shape for Linear {
    type Domain<T: Real, const D: usize> = ();
    type Stencil<T: Real, const D: usize> = Tensor<T, D, 2>;

    fn domain<T: Real, const D: usize>(_: &Matrix<T, D>) {}

    fn stencil<T: Real, const D: usize>(
        lattice: &Lattice<T, D>,
        position: &Vector<T, D>,
        (): &(),
        _: &Matrix<T, D>,
    ) -> Result<Tensor<T, D, 2>, Cause> {
        let cells = lattice.in_cells(position);
        Tensor::new(lattice, |a| hats(cells[a])).ok_or_else(|| Cause::lost(position))
    }
}

/// The two hat functions at `position`, in cells.
pub(super) fn hats<T: Real, const N: usize>(position: T) -> AxisWeights<T, N> {
    AxisWeights::new(position, position.floor(), 2, |offset| {
        if offset >= T::zero() {
            (T::one() - offset, -T::one())
        } else {
            (T::one() + offset, T::one())
        }
    })
}
