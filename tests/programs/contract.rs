//! A field behind the interface that a solver uses, in either precision.
#![deny(warnings)]

mms_macros::field!("fields/bar_1d.toml");

use mms_runtime::{ManufacturedField, Real, Vector};

/// u at the free end at t = 0, by a batch of one point.
fn end_displacement<T: Real>(field: &dyn ManufacturedField<T, 1>) -> f64 {
    let mut out = [Vector::zeros()];
    field.displacement(T::of(0.0), &[Vector::from([T::of(1.0)])], &mut out);
    out[0][0].to_f64()
}

#[test]
fn a_solver_takes_either_precision() {
    let double = bar_1d::prepare(&bar_1d::Parameters::<f64>::default()).boxed();
    let single = bar_1d::prepare(&bar_1d::Parameters::<f32>::default()).boxed();
    assert_eq!(end_displacement(double.as_ref()), 0.2);
    assert_eq!(end_displacement(single.as_ref()), f64::from(0.2_f32));
}
