//! Fault injection: the quantities of a step that defects replace. Without the feature `defects` each function returns the
//! right one.

use mms_math::simd::Simd;

use crate::defect::{Defect, on};
use crate::real::Real;

/// The columns of the velocity gradients of a pack.
#[inline(always)]
pub(super) fn velocity_gradient<T: Real, M: Simd<T>, const D: usize>(
    simd: M,
    gradient: [[M::Eight; D]; D],
) -> [[M::Eight; D]; D] {
    if on(Defect::TransposedGradient) {
        return transposed(gradient);
    }
    if on(Defect::LostSpin) {
        let (mut sum, other) = (gradient, transposed(gradient));
        let half = simd.splat(T::ratio(1, 2));
        for (i, j) in (0..D).flat_map(|i| (0..D).map(move |j| (i, j))) {
            sum[j][i] = simd.times(half, simd.plus(gradient[j][i], other[j][i]));
        }
        return sum;
    }
    gradient
}

/// The velocities that move the particles of a pack: the interpolated velocities of the nodes.
#[inline(always)]
pub(super) fn carrier<F: Copy, const D: usize>(mapped: [F; D], own: [F; D]) -> [F; D] {
    if on(Defect::OwnVelocity) { own } else { mapped }
}

/// The linear velocities of APIC for splines of this degree.
#[inline(always)]
pub(super) fn affine<T: Real, M: Simd<T>, const D: usize>(
    simd: M,
    affine: [[M::Eight; D]; D],
    degree: usize,
) -> [[M::Eight; D]; D] {
    if on(Defect::AffineTransposed) {
        return transposed(affine);
    }
    if on(Defect::AffineFactor) && degree == 2 {
        let factor = simd.splat(T::ratio(3, 4));
        return affine.map(|column| column.map(|number| simd.times(number, factor)));
    }
    affine
}

fn transposed<F: Copy, const D: usize>(columns: [[F; D]; D]) -> [[F; D]; D] {
    std::array::from_fn(|j| std::array::from_fn(|i| columns[i][j]))
}

/// The columns of the stress, each of which multiplies the gradient along its axis.
#[inline(always)]
pub(super) fn stress<F: Copy, const D: usize>(mut columns: [F; D]) -> [F; D] {
    if on(Defect::StressIndex) {
        columns.rotate_left(1);
    }
    columns
}
