//! Standing waves along the axes of a square; derived in `axis_aligned.rs`.

use mms_gallery::axis_aligned_2d::{Parameters, prepare};

use crate::axis_aligned::Waves;
use crate::support::generated;

#[test]
fn the_generated_waves_are_those_on_paper() {
    let odd = Parameters::<f64> { length: 1.7, nu: 0.21, amplitude: 0.11, ..Parameters::default() };
    for parameters in [Parameters::default(), odd] {
        let Parameters { length, young, nu, rho0, amplitude, .. } = parameters;
        let waves = Waves { length, young, nu, rho0, amplitude };
        waves.assert_are(generated!(prepare(&parameters)));
    }
}
