//! Generalised interpolation material point method with particle domains that keep their size.
//!
//! Bardenhagen, Kober, "The generalized interpolation material point method", CMES 5 (2004)
//! 477-496, doi 10.3970/cmes.2004.005.477, with a box as characteristic function: weight and weight
//! gradient are the averages of the hat function and of its slope over the particle's domain,
//!
//! w = 1/(2 l) int hat(x) dx,  grad w = 1/(2 l) int hat'(x) dx,  x from x_p - l to x_p + l.

use super::{MAX_NODES, Shape, gimp_stencil, half_widths};
use crate::stencil::{AxisWeights, Tensor};
use crate::{Cause, Lattice, Matrix, Real, Vector};

/// GIMP with half widths fixed at their initial values (undeformed, "uniform" GIMP).
///
/// Gaps and overlaps appear between stretched particles, so that the order is lost on fine grids. In the
/// total formulation there are none.
pub struct Ugimp;

impl Shape for Ugimp {
    type Domain<T: Real, const D: usize> = Vector<T, D>;
    type Stencil<T: Real, const D: usize> = Tensor<T, D, MAX_NODES>;

    fn domain<T: Real, const D: usize>(half_edges: &Matrix<T, D>) -> Vector<T, D> {
        half_widths(half_edges)
    }

    fn stencil<T: Real, const D: usize>(
        lattice: &Lattice<T, D>,
        position: &Vector<T, D>,
        half_width: &Vector<T, D>,
        _: &Matrix<T, D>,
    ) -> Result<Tensor<T, D, MAX_NODES>, Cause> {
        gimp_stencil(lattice, position, half_width)
    }
}

/// The averages of the hat functions, and of their slopes, over [position - l, position + l].
pub(super) fn averages_of_hat<T: Real>(position: T, half_width: T) -> AxisWeights<T, MAX_NODES> {
    let first = (position - half_width).floor();
    let last = (position + half_width).floor() + T::one();
    let count = (last - first).to_f64() as usize + 1;
    AxisWeights::new(position, first, count, |offset| average_of_hat(offset, half_width))
}

/// The average of the hat 1 - |x|, and of its slope, over [offset - l, offset + l]: on either side
/// of the node, the length of the overlap times the hat at its middle. Nothing cancels, whatever l.
fn average_of_hat<T: Real>(offset: T, half_width: T) -> (T, T) {
    let (zero, one, half) = (T::zero(), T::one(), T::ratio(1, 2));
    let (from, to) = (offset - half_width, offset + half_width);

    let (left, right) = (from.max(-one), to.min(zero));
    let rising = (right - left).max(zero);
    let rising_hat = one + half * (left + right);

    let (left, right) = (from.max(zero), to.min(one));
    let falling = (right - left).max(zero);
    let falling_hat = one - half * (left + right);

    let width = half_width + half_width;
    ((rising * rising_hat + falling * falling_hat) / width, (rising - falling) / width)
}
