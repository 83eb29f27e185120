//! A bar that a load sets in motion; derived in `starting.rs`.

use std::f64::consts::PI;

use mms_gallery::starting_bar::{Parameters, prepare};

use crate::starting::{CONSTANT, Start, sine};
use crate::support::generated;

#[test]
fn the_generated_start_is_the_one_on_paper() {
    let odd = Parameters::<f64> { length: 1.7, nu: 0.21, amplitude: 0.11, ..Parameters::default() };
    for parameters in [Parameters::default(), odd] {
        let Parameters { length, young, nu, rho0, amplitude } = parameters;
        let direction = [1.0, 0.0, 0.0];
        let start = Start { length, young, nu, rho0, amplitude, direction };
        let k = 2.0 * PI / (3.0 * length);
        start.assert_is(generated!(prepare(&parameters)), |[x]| [sine(k, x), CONSTANT, CONSTANT]);
    }
}
