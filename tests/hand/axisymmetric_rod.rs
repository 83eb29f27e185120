//! The rod inside a rigid tube: u_R = R (1 - R^2/a^2) s and u_Z = L (1 - R^2/a^2) s, s = A sin(pi Z/L) sin(w t), with c = sqrt(E/rho0) and w = c pi/L.

use std::f64::consts::PI;

use mms_gallery::axisymmetric_rod::{Parameters, prepare};

use crate::axisymmetric::{Motion, Profile, values};
use crate::support::{NeoHookean, TOLERANCE, assert_agree, generated, in_box};

#[test]
fn the_generated_rod_is_the_rod_on_paper() {
    let odd = Parameters::<f64> { radius: 0.7, length: 1.3, nu: 0.4, ..Parameters::default() };
    for parameters in [Parameters::default(), odd] {
        let Parameters { A: amplitude, radius, length, young, nu, rho0 } = parameters;
        let law = NeoHookean::of(young, nu);
        let (k, w) = (PI / length, (young / rho0).sqrt() * PI / length);
        let by_hand = |[r, z]: [f64; 2], t: f64| {
            let pulse = amplitude * (w * t).sin();
            let (sin, cos) = (k * z).sin_cos();
            // (1 + c s) sin(k Z) times a size.
            let profile = |size: f64, c: f64| Profile {
                value: size * (1.0 + c * r * r) * sin,
                over_s: size * c * sin,
                over_ss: 0.0,
                over_z: size * (1.0 + c * r * r) * k * cos,
                over_sz: size * c * k * cos,
                over_zz: -size * (1.0 + c * r * r) * k * k * sin,
            };
            let per_square = -1.0 / (radius * radius);
            let spread = profile(pulse, per_square);
            let along = profile(pulse * length, per_square);
            let acceleration = [spread.value * r, along.value].map(|u| -w * w * u);
            values(r, &law, rho0, &Motion { spread, along, acceleration })
        };
        let points = in_box([0.0; 2], [radius, length], [0.0, 0.5 * PI / w]);
        assert_agree(TOLERANCE, &points, generated!(prepare(&parameters)), by_hand);
        // On the axis, too.
        let points: Vec<_> = points.into_iter().map(|([_, z], t)| ([0.0, z], t)).collect();
        assert_agree(TOLERANCE, &points, generated!(prepare(&parameters)), by_hand);
    }
}
