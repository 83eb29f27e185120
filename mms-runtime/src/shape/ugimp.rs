//! Generalised interpolation material point method with particle domains that keep their size.
//!
//! Bardenhagen, Kober, "The generalized interpolation material point method", CMES 5 (2004)
//! 477-496, doi 10.3970/cmes.2004.005.477, with a box as characteristic function: weight and weight
//! gradient are the averages of the hat function and of its slope over the particle's domain,
//!
//! w = 1/(2 l) int hat(x) dx,  grad w = 1/(2 l) int hat'(x) dx,  x from x_p - l to x_p + l.

use super::{AxisWeights, Shape};
use crate::{Matrix, Real, Vector};

/// GIMP with half widths fixed at their initial values (undeformed, "uniform" GIMP).
///
/// Gaps and overlaps appear between stretched particles, so that the order is lost on fine grids.
pub struct Ugimp;

impl Shape for Ugimp {
    fn half_width<T: Real, const D: usize>(
        initial: &Vector<T, D>,
        _: &Matrix<T, D>,
    ) -> Vector<T, D> {
        *initial
    }

    fn axis_weights<T: Real>(position: T, half_width: T) -> AxisWeights<T> {
        averages_of_hat(position, half_width)
    }
}

/// The averages of the hat functions, and of their slopes, over [position - l, position + l].
pub(super) fn averages_of_hat<T: Real>(position: T, half_width: T) -> AxisWeights<T> {
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
