//! A material of the user's own, found relative to the field file.
#![deny(warnings)]

mms_macros::field!("tests/programs/own.toml");

#[test]
fn a_material_may_lie_beside_its_field() {
    // P = kappa (F - 1), and F - 1 = (1 - X)/2 cos(t).
    let field = own::prepare(&own::Parameters { kappa: 8.0_f64 });
    let stress = field.at_time(0.0).first_piola_kirchhoff([0.25]);
    assert!((stress[0][0] - 3.0).abs() < 1e-14, "{stress:?}");
}
