//! A bar that repeats itself, derived by hand.
//!
//! ```text
//! u     = a sin(k X) cos(w t),  k = 2 pi/L,  w = c pi/L,  c^2 = E/rho0
//! F     = 1 + k a cos(k X) cos(w t),  F,X = -k^2 u
//! P     = E/2 (F - 1/F)                       (nu = 0: lambda = 0, mu = E/2)
//! Div P = E/2 (1 + F^-2) F,X = -2 E pi^2/L^2 (1 + F^-2) u
//! b     = -w^2 u - Div P/rho0 = w^2 u (1 + 2 F^-2)
//! ```

use std::f64::consts::PI;

use mms_gallery::periodic_bar::{Parameters, prepare};

use crate::support::{TOLERANCE, Values, assert_agree, generated, in_box};

#[test]
fn the_generated_bar_is_the_bar_on_paper() {
    let odd =
        Parameters::<f64> { length: 0.3, young: 7e4, amplitude: 0.02, ..Parameters::default() };
    for parameters in [Parameters::default(), odd] {
        let Parameters { length, young, rho0, amplitude } = parameters;
        let (k, c) = (2.0 * PI / length, (young / rho0).sqrt());
        let w = c * PI / length;
        let by_hand = |[x]: [f64; 1], t: f64| {
            let pulse = amplitude * (w * t).cos();
            let (u, f) = (pulse * (k * x).sin(), 1.0 + k * pulse * (k * x).cos());
            Values {
                jacobian: f,
                stress: vec![young / 2.0 * (f - 1.0 / f)],
                force: vec![w * w * u * (1.0 + 2.0 / (f * f))],
            }
        };
        let points = in_box([0.0], [length], [0.0, 2.0 * length / c]);
        assert_agree(TOLERANCE, &points, generated!(prepare(&parameters)), by_hand);
    }
}
