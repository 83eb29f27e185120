//! Parameters whose names mean something in Rust or in generated code.
#![deny(warnings)]

mms_macros::field!("tests/programs/odd_names.toml");

use odd_names::{NAMES, Parameters, prepare};

#[test]
fn a_parameter_may_have_any_name() {
    // In the field file each parameter has its place, counted from 1, as its value.
    let places: [f64; NAMES.len()] = std::array::from_fn(|index| (index + 1) as f64);
    assert_eq!(Parameters::from_array(places), Parameters::default());
    let sum: f64 = places.iter().sum();
    let u = prepare(&Parameters::from_array(places)).at_time(0.0_f64).displacement([1.0]);
    assert!((u[0] - sum / 1e4).abs() < 1e-14, "{u:?}");
}
