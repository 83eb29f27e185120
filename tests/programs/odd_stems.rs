//! Files whose names are no names in Rust.
#![deny(warnings)]

mms_macros::field!("tests/programs/2d.toml");
mms_macros::field!("tests/programs/fn.toml");
mms_macros::field!("tests/programs/self.toml");

#[test]
fn a_file_may_have_any_name() {
    let upper: [f64; 1] = field_2d::prepare::<f64>(&field_2d::Parameters::default()).upper();
    assert_eq!(upper, r#fn::prepare::<f64>(&r#fn::Parameters::default()).upper());
    assert_eq!(upper, self_::prepare::<f64>(&self_::Parameters::default()).upper());
}
