//! B-splines on the knots of one axis, by the recurrence of Cox and de Boor.
//!
//! de Boor, "A practical guide to splines", 1978, chapter X. Knots are integers, one cell apart, and
//! every knot beyond the ends lies on the end: splines are "open" there, reproduce linear functions up
//! to it, and only one of them is not zero on it. So walls need no images.

use crate::stencil::{AxisWeights, Tensor};
use crate::{Cause, Lattice, Real, Vector};

/// How far beyond the ends a particle may come, in cells: it has no business there.
const SLACK: f64 = 0.5;

/// The products of splines of degree P along the axes, at a point.
///
/// # Errors
/// The point is off the grid, or beyond the ends of the knots.
pub fn stencil<T: Real, const D: usize, const P: usize, const N: usize>(
    lattice: &Lattice<T, D>,
    position: &Vector<T, D>,
) -> Result<Tensor<T, D, N>, Cause> {
    let cells = lattice.in_cells(position);
    let ends = |a: usize| lattice.axes[a].ends;
    let within = |a: usize| {
        let [first, last] = ends(a).map(|end| end as f64);
        (first - SLACK..=last + SLACK).contains(&cells[a].to_f64())
    };
    let stencil = Tensor::new(lattice, |a| weights::<T, P, N>(cells[a], ends(a)));
    stencil.filter(|_| (0..D).all(within)).ok_or_else(|| Cause::lost(position))
}

/// The P + 1 splines of degree P at `position` (in cells), with knots held between the `ends`.
///
/// Outside the ends the polynomials of the last cell go on.
pub fn weights<T: Real, const P: usize, const N: usize>(
    position: T,
    ends: [i64; 2],
) -> AxisWeights<T, N> {
    const { assert!(P < N) };
    let cell = (position.floor().to_f64() as i64).clamp(ends[0], ends[1] - 1);
    // The knot k after the one at the lower end of the cell; differences of knots are exact.
    let knot = |k: i64| (cell + k).clamp(ends[0], ends[1]);
    let (mut weight, mut slope) = ([T::zero(); N], [T::zero(); N]);
    weight[0] = T::one();
    for degree in 1..=P {
        let (mut from_left, mut slope_from_left) = (T::zero(), T::zero());
        for r in 0..degree {
            let (left, right) = (knot(1 + r as i64 - degree as i64), knot(1 + r as i64));
            let share = weight[r] / T::of((right - left) as f64);
            let rate = share * T::of(degree as f64);
            weight[r] = from_left + (T::of(right as f64) - position) * share;
            from_left = (position - T::of(left as f64)) * share;
            slope[r] = slope_from_left - rate;
            slope_from_left = rate;
        }
        weight[degree] = from_left;
        slope[degree] = slope_from_left;
    }
    AxisWeights { first: cell, count: P + 1, weight, slope }
}
