//! Dual numbers: known slopes.

use mms_math::Scalar as _;
use mms_program::dual::Dual;
use mms_program::interpret::Number as _;

#[test]
fn slopes_of_known_functions() {
    let x = Dual::variable(0.5_f64);
    let close = |found: f64, expected: f64| {
        assert!((found - expected).abs() <= 4.0 * f64::EPSILON, "{found} {expected}");
    };
    close((x * x * x).slope, 0.75);
    close((Dual::constant(1.0) / x).slope, -4.0);
    close(x.square().slope, 1.0);
    close(x.sqrt().slope, 0.5_f64.sqrt());
    close(x.powf(x).slope, 0.5_f64.sqrt() * (1.0 - core::f64::consts::LN_2));
    close(x.atan2(Dual::constant(1.0)).slope, 0.8);
    close(Dual::constant(1.0).atan2(x).slope, -0.8);
    close(x.asin().slope, 2.0 / 3.0_f64.sqrt());
    close(x.exp_m1().slope, 0.5_f64.exp());
}

#[test]
fn duals_of_duals_give_second_derivatives() {
    let x = Dual::variable(Dual::variable(0.5_f64));
    let cube = x * x * x;
    assert_eq!((cube.slope.value, cube.slope.slope), (0.75, 3.0));
    let wave = x.sin();
    assert!((wave.slope.slope + 0.5_f64.sin()).abs() < 1e-16);
}
