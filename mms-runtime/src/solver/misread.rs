//! What a defect takes for a quantity of a step. Without the feature `defects` each is what it is.

use mms_math::machine::Machine;

use crate::defect::{Defect, on};
use crate::nodal::{columns, four, matrix};
use crate::{Matrix, Real, Vector};

/// The columns of a velocity gradient.
#[inline(always)]
pub(super) fn velocity_gradient<T: Real, M: Machine<T>, const D: usize>(
    machine: M,
    gradient: [M::Four; D],
) -> [M::Four; D] {
    let whole = || matrix::<T, M, D>(machine, gradient);
    if on(Defect::TransposedGradient) {
        return columns(machine, &whole().transpose());
    }
    if on(Defect::LostSpin) {
        return columns(machine, &((whole() + whole().transpose()) * T::ratio(1, 2)));
    }
    gradient
}

/// The velocity that moves the particle `k`: that of the nodes.
#[inline(always)]
pub(super) fn carrier<T: Real, M: Machine<T>, const D: usize>(
    machine: M,
    mapped: M::Four,
    own: &[Vector<T, D>],
    k: usize,
) -> M::Four {
    if on(Defect::OwnVelocity) { four(machine, &own[k], T::zero()) } else { mapped }
}

/// The linear velocity of APIC, of splines of this degree.
#[inline(always)]
pub(super) fn affine<T: Real, const D: usize>(affine: Matrix<T, D>, degree: usize) -> Matrix<T, D> {
    if on(Defect::AffineTransposed) {
        return affine.transpose();
    }
    if on(Defect::AffineFactor) && degree == 2 {
        return affine * T::ratio(3, 4);
    }
    affine
}

/// The columns of the stress, each of which works on the gradient along its axis.
#[inline(always)]
pub(super) fn stress<F: Copy, const D: usize>(mut columns: [F; D]) -> [F; D] {
    if on(Defect::StressIndex) {
        columns.rotate_left(1);
    }
    columns
}
