//! The conformal sector, derived by hand with complex numbers: z = X + iY goes to z + k z^2/2.
//!
//! ```text
//! F    = rotation and stretch by f = 1 + k z (Cauchy-Riemann), J = |f|^2
//! P    = mu F + (lambda ln J - mu) F^-T = phi(J) F, since F^-T = F/J;  phi = mu + (lambda ln J - mu)/J
//! DivP = phi'(J) F grad J, since Div F = Lap u = 0;  phi' = (lambda (1 - ln J) + mu)/J^2
//! b    = k'' z^2/2 - DivP/rho0,  k'' = -w^2 k
//! ```
//!
//! The gradient of |f|^2 by X and Y is 2 k (Re f, Im f), which as a complex number is 2 k f; F turns
//! and stretches it by f, so that F grad J is 2 k f^2.

use std::f64::consts::PI;

use mms_gallery::conformal_sector_2d::{Parameters, prepare};

use crate::support::{NeoHookean, TOLERANCE, Values, assert_agree, generated, in_ring};

/// The square of a complex number.
fn square([re, im]: [f64; 2]) -> [f64; 2] {
    [re * re - im * im, 2.0 * re * im]
}

#[test]
fn the_generated_sector_is_the_sector_on_paper() {
    let odd = Parameters::<f64> { outer: 1.4, nu: 0.2, amplitude: -0.2, ..Parameters::default() };
    for parameters in [Parameters::default(), odd] {
        let Parameters { inner, outer, young, nu, rho0, amplitude } = parameters;
        let (law, w) = (NeoHookean::of(young, nu), (young / rho0).sqrt() * PI / outer);
        let by_hand = |z: [f64; 2], t: f64| {
            let k = 2.0 * amplitude * (w * t).cos() / (outer * outer);
            let f = [1.0 + k * z[0], k * z[1]];
            let jacobian = f[0] * f[0] + f[1] * f[1];
            let phi = law.mu + (law.lambda * jacobian.ln() - law.mu) / jacobian;
            let (squared, slope) = (square(f), law.cofactor_slope(jacobian));
            let force = std::array::from_fn::<_, 2, _>(|i| {
                let acceleration = -w * w * k * square(z)[i] / 2.0;
                acceleration - 2.0 * k * slope * squared[i] / rho0
            });
            Values {
                jacobian,
                stress: [f[0], -f[1], f[1], f[0]].map(|entry| phi * entry).to_vec(),
                force: force.to_vec(),
            }
        };
        let points = in_ring(inner, outer, [0.0, 2.0 * PI / w]);
        assert_agree(TOLERANCE, &points, generated!(prepare(&parameters)), by_hand);
    }
}
