//! A field without parameters, in a crate that allows no warning.
#![deny(warnings, missing_docs, unsafe_code, clippy::all)]

mms_macros::field!("tests/programs/plain.toml");

#[test]
fn there_may_be_no_parameter() {
    let field = plain::prepare(&plain::Parameters::default());
    assert_eq!(plain::NAMES.len(), 0);
    assert_eq!(plain::Parameters::from_array::<f64>([]), plain::Parameters::default());
    let u: [f64; 1] = field.at_time(0.0).displacement([0.5]);
    assert!((u[0] - 0.075).abs() < 1e-16, "{u:?}");
}
