//! A vortex cell, nearly incompressible, derived by hand.
//!
//! ```text
//! u      = A (sin(k X) cos(k Y), -cos(k X) sin(k Y)),  A = a cos(w t),  k = pi/L,  w = c k
//! F      = [1 + e, -s; s, 1 - e],  e = k A cos(k X) cos(k Y),  s = k A sin(k X) sin(k Y)
//! J      = 1 - e^2 + s^2 = 1 - (k A)^2 (cos(2 k X) + cos(2 k Y))/2
//! cof F  = [1 - e, -s; s, 1 + e],  Lap u = -2 k^2 u
//! P      = mu F + (lambda ln J - mu)/J cof F
//! Div P  = mu Lap u + m' cof F grad J,  grad J = (k A)^2 k (sin(2 k X), sin(2 k Y))
//! ```
//!
//! Here c^2 = (lambda + 2 mu)/rho0, and m' as for the other fields.

use std::f64::consts::PI;

use mms_gallery::nearly_incompressible_2d::{Parameters, prepare};

use crate::support::{NeoHookean, TOLERANCE, Values, assert_agree, generated, in_box};

#[test]
fn the_generated_cell_is_the_cell_on_paper() {
    let odd = Parameters::<f64> { length: 0.6, nu: 0.49, amplitude: 0.02, ..Parameters::default() };
    for parameters in [Parameters::default(), odd] {
        let Parameters { length, young, nu, rho0, amplitude } = parameters;
        let law = NeoHookean::of(young, nu);
        let NeoHookean { lambda, mu } = law;
        let (k, c) = (PI / length, ((lambda + 2.0 * mu) / rho0).sqrt());
        let by_hand = |[x, y]: [f64; 2], t: f64| {
            let pulse = amplitude * (c * k * t).cos();
            let ((sin_x, cos_x), (sin_y, cos_y)) = ((k * x).sin_cos(), (k * y).sin_cos());
            let u = [pulse * sin_x * cos_y, -pulse * cos_x * sin_y];
            let (e, s) = (k * pulse * cos_x * cos_y, k * pulse * sin_x * sin_y);
            let dilation = s * s - e * e;
            let jacobian = 1.0 + dilation;
            let pressure = (lambda * dilation.ln_1p() - mu) / jacobian;
            let (f, cofactor) = ([1.0 + e, -s, s, 1.0 - e], [1.0 - e, -s, s, 1.0 + e]);
            let slope = (k * pulse).powi(2) * k;
            let gradient = [slope * (2.0 * k * x).sin(), slope * (2.0 * k * y).sin()];
            let force = |row: usize| {
                let bent = cofactor[2 * row] * gradient[0] + cofactor[2 * row + 1] * gradient[1];
                let div_p = -2.0 * k * k * mu * u[row] + law.cofactor_slope(jacobian) * bent;
                -(c * k).powi(2) * u[row] - div_p / rho0
            };
            Values {
                jacobian,
                stress: (0..4).map(|entry| mu * f[entry] + pressure * cofactor[entry]).collect(),
                force: vec![force(0), force(1)],
            }
        };
        let points = in_box([0.0; 2], [length; 2], [0.0, 2.0 * length / c]);
        // P is of the size of mu, and a rounding of J - 1 is multiplied by lambda.
        let tolerance = TOLERANCE * (1.0 + lambda / mu * (k * amplitude).powi(2));
        assert_agree(tolerance, &points, generated!(prepare(&parameters)), by_hand);
    }
}
