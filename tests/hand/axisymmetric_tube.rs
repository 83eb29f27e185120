//! The tube whose wall swells and sways: u_R = s R cos(k Z) and u_Z = s R^2/a sin(k Z), s = A sin(w t), k = pi/L, w = k sqrt(E/rho0).

use std::f64::consts::PI;

use mms_gallery::axisymmetric_tube::{Parameters, prepare};

use crate::axisymmetric::{Motion, Profile, values};
use crate::support::{NeoHookean, TOLERANCE, assert_agree, generated, in_box};

#[test]
fn the_generated_tube_is_the_tube_on_paper() {
    let odd = Parameters::<f64> { inner: 0.7, length: 1.3, nu: 0.4, ..Parameters::default() };
    for parameters in [Parameters::default(), odd] {
        let Parameters { A: amplitude, inner, length, young, nu, rho0 } = parameters;
        let law = NeoHookean::of(young, nu);
        let (k, w) = (PI / length, (young / rho0).sqrt() * PI / length);
        let by_hand = |[r, z]: [f64; 2], t: f64| {
            let pulse = amplitude * (w * t).sin();
            let (sin, cos) = (k * z).sin_cos();
            let spread = Profile {
                value: pulse * cos,
                over_z: -pulse * k * sin,
                over_zz: -pulse * k * k * cos,
                ..Profile::default()
            };
            let along = Profile {
                value: pulse / inner * r * r * sin,
                over_s: pulse / inner * sin,
                over_z: pulse / inner * r * r * k * cos,
                over_sz: pulse / inner * k * cos,
                over_zz: -pulse / inner * r * r * k * k * sin,
                ..Profile::default()
            };
            let acceleration = [spread.value * r, along.value].map(|u| -w * w * u);
            values(r, &law, rho0, &Motion { spread, along, acceleration })
        };
        let points = in_box([inner, 0.0], [2.0 * inner, length], [0.0, 0.5 * PI / w]);
        assert_agree(TOLERANCE, &points, generated!(prepare(&parameters)), by_hand);
    }
}
