//! Linear shape functions: the particle is a point.
//!
//! Sulsky, Chen, Schreyer, "A particle method for history-dependent materials", Comput. Methods Appl.
//! Mech. Engrg. 118 (1994) 179-196: w = 1 - |x - x_i| / h. The gradient jumps where a particle crosses a
//! cell's border, so that the method does not converge for large motions.

use super::{AxisWeights, Shape};
use crate::{Matrix, Real, Vector};

/// Linear weights ("hat functions"), two nodes per axis.
pub struct Linear;

impl Shape for Linear {
    fn half_width<T: Real, const D: usize>(
        initial: &Vector<T, D>,
        _: &Matrix<T, D>,
    ) -> Vector<T, D> {
        *initial // unused by the weights
    }

    fn axis_weights<T: Real>(position: T, _: T) -> AxisWeights<T> {
        AxisWeights::new(position, position.floor(), 2, |offset| {
            if offset >= T::zero() {
                (T::one() - offset, -T::one())
            } else {
                (T::one() + offset, T::one())
            }
        })
    }
}
