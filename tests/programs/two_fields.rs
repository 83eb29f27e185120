//! Two fields in one crate, in one module, and a third in another.
#![deny(warnings)]

mms_macros::field!("fields/bar_1d.toml");
mms_macros::field!("tests/programs/plain.toml");

mod inner {
    mms_macros::field!("fields/bar_1d.toml");
}

#[test]
fn fields_share_a_module() {
    let (outer, inner) = (bar_1d::Parameters::default(), inner::bar_1d::Parameters::default());
    let b = bar_1d::prepare(&outer).at_time(0.013_f64).body_force([0.37]);
    let same = inner::bar_1d::prepare(&inner).at_time(0.013_f64).body_force([0.37]);
    assert_eq!(b, same);
    let other = plain::prepare(&plain::Parameters::default());
    assert_ne!(b, other.at_time(0.013_f64).body_force([0.37]));
}
