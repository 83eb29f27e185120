//! A bar graded in stiffness and density, derived by hand.
//!
//! ```text
//! u     = A sin(k X),  A = a cos(c pi t/L),  k = pi/(2 L),  c^2 = E(0)/rho0(0)
//! F     = 1 + k A cos(k X),  F,X = -k^2 u
//! P     = E S(F),  S = m (F - 1/F) + l ln F/F,  with lambda = l E and mu = m E
//! Div P = E,X S + E [m (1 + F^-2) + l (1 - ln F) F^-2] F,X
//! b     = -(c pi/L)^2 u - Div P/rho0(X)
//! ```

use std::f64::consts::PI;

use mms_gallery::graded_bar::{Parameters, prepare};

use crate::support::{NeoHookean, TOLERANCE, Values, assert_agree, generated, in_box};

#[test]
fn the_generated_bar_is_the_bar_on_paper() {
    let odd =
        Parameters::<f64> { length: 1.9, stiffer: -0.7, denser: 3.0, ..Parameters::default() };
    for parameters in [Parameters::default(), odd] {
        let Parameters { length, young, stiffer, nu, rho0, denser, amplitude } = parameters;
        let NeoHookean { lambda: l, mu: m } = NeoHookean::of(1.0, nu);
        let (k, c) = (PI / (2.0 * length), (young / rho0).sqrt());
        let w = c * PI / length;
        let by_hand = |[x]: [f64; 1], t: f64| {
            let a = amplitude * (w * t).cos();
            let (u, f) = (a * (k * x).sin(), 1.0 + k * a * (k * x).cos());
            let stiffness = young * (1.0 + stiffer * x / length);
            let density = rho0 * (1.0 + denser * (x / length).powi(2));
            let shape = m * (f - 1.0 / f) + l * f.ln() / f;
            let slope = m * (1.0 + 1.0 / (f * f)) + l * (1.0 - f.ln()) / (f * f);
            let div_p = young * stiffer / length * shape - stiffness * slope * k * k * u;
            Values {
                jacobian: f,
                stress: vec![stiffness * shape],
                force: vec![-w * w * u - div_p / density],
            }
        };
        let points = in_box([0.0], [length], [0.0, 2.0 * length / c]);
        assert_agree(TOLERANCE, &points, generated!(prepare(&parameters)), by_hand);
    }
}
