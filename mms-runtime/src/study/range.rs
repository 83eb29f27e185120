//! Numbers beyond the range of a precision: a run that stops for them looks unstable, but is not.

use crate::axisymmetric::{hoop_strain, kirchhoff_stress};
use crate::failure::{Cause, Failure};
use crate::field::ManufacturedField;
use crate::real::{Matrix, Real, Vector};
use crate::solver::StateView;

/// Replaces the cause of a failure by a number beyond the range of the precision, if there is one.
pub(super) fn explained<T: Real, const D: usize>(
    present: &StateView<'_, T, D, dyn ManufacturedField<T, D> + '_>,
    cell_size: f64,
    failure: Failure,
) -> Failure {
    match failure.cause {
        Cause::UnstableStep { .. } | Cause::NotRelaxed { .. } | Cause::Stopped { .. } => failure,
        _ => match beyond(&sizes(present, cell_size), range::<T>()) {
            Some(cause) => Failure { cause, ..failure },
            None => failure,
        },
    }
}

/// The least positive number with all digits, and the greatest number.
fn range<T: Real>() -> [f64; 2] {
    let most = T::max_value().map_or(f64::INFINITY, Real::to_f64);
    // As IEEE 754 balances exponents.
    [4.0 / most, most]
}

/// The largest value, over all particles, of a number that steps compute with, and whether it cannot be 0.
type Size = (&'static str, f64, bool);

/// The cause for the first size outside the range.
fn beyond(sizes: &[Size], [least, most]: [f64; 2]) -> Option<Cause> {
    let is_beyond = |&&(_, value, is_positive): &&Size| {
        value > most || (value < least && (value > 0.0 || is_positive))
    };
    let &(quantity, value, _) = sizes.iter().find(is_beyond)?;
    Some(Cause::OutOfRange { quantity, value, least, most })
}

/// The sizes of the field's values at the present time.
fn sizes<T: Real, const D: usize>(
    present: &StateView<'_, T, D, dyn ManufacturedField<T, D> + '_>,
    cell_size: f64,
) -> Vec<Size> {
    let StateView { field, particles, .. } = present;
    let (reference, now) = (&particles.reference_position, T::of(present.time));
    let mut vectors = vec![Vector::<T, D>::zeros(); particles.len()];
    field.velocity(now, reference, &mut vectors);
    let velocity = largest(vectors.iter().flat_map(Vector::iter));
    field.body_force(now, reference, &mut vectors);
    let force = largest(vectors.iter().flat_map(Vector::iter));
    let mut gradients = vec![Matrix::<T, D>::zeros(); particles.len()];
    field.displacement_gradient(now, reference, &mut gradients);
    let mut stresses = vec![Matrix::<T, D>::zeros(); particles.len()];
    let strains = hoop_strain(*field, now, reference);
    let mut hoop_stresses = strains.clone();
    let all = (&mut stresses[..], &mut hoop_stresses[..]);
    kirchhoff_stress(*field, now, reference, (&gradients, &strains), all);
    let stress = largest(stresses.iter().flat_map(Matrix::iter).chain(&hoop_stresses));
    let [mass, volume] =
        [&particles.mass, &particles.reference_volume].map(|it| largest(it.iter()));
    vec![
        ("time step", present.time_step, true),
        ("volume of a particle", volume, true),
        ("field's velocity", velocity, false),
        ("field's body force", force, false),
        ("field's stress", stress, false),
        ("momentum of a particle", mass * velocity, false),
        ("body force on a particle", mass * force, false),
        ("force of the stress of a particle", volume * stress / cell_size, false),
    ]
}

/// The largest magnitude; NaN if one number is NaN.
fn largest<'a, T: Real>(numbers: impl Iterator<Item = &'a T>) -> f64 {
    let magnitudes = numbers.map(|number| number.to_f64().abs());
    magnitudes.fold(0.0, |most, it| if it > most || it.is_nan() { it } else { most })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_has_no_number_is_named_and_nothing_else() {
        let [least, most] = range::<f32>();
        assert_eq!(most as f32, f32::MAX);
        assert!((least / f64::from(f32::MIN_POSITIVE) - 1.0).abs() < 1e-6, "{least:e}");
        let of = |value: f64, is_positive| beyond(&[("size", value, is_positive)], [least, most]);
        for value in [1.0, 1e-37, 3e38] {
            assert_eq!(of(value, true), None);
        }
        for value in [1e-39, 1e39, f64::INFINITY] {
            let named = |cause| matches!(cause, Cause::OutOfRange { quantity: "size", .. });
            assert!(of(value, false).is_some_and(named), "{value}");
        }
        // NaN has another cause.
        assert_eq!([of(0.0, false), of(f64::NAN, false)], [None, None]);
        assert!(of(0.0, true).is_some());
    }
}
