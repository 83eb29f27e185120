//! The square of linear elastic material on rollers, derived by hand.
//!
//! ```text
//! P_iJ      = lambda tr H delta_iJ + mu (H_iJ + H_Ji)
//! (Div P)_i = (lambda + mu) (u_1,1 + u_2,2),i + mu Lap u_i      (Navier)
//! ```

use mms::gallery::plane_strain_linear_elastic::Parameters;

use crate::plane::{Moduli, Paper, Solid, Strained, compare};

fn on_paper(p: &Parameters<f64>, [x, y]: [f64; 2], time: f64) -> Paper {
    let speed = (p.young / p.rho0).sqrt();
    let k = std::f64::consts::PI / p.length;
    let a = p.amplitude * (k * speed * time).cos();
    let b = p.amplitude / 2.0 * (k * speed * time + std::f64::consts::PI / 3.0).cos();
    let (sx, cx) = (k * x).sin_cos();
    let (sy, cy) = (k * y).sin_cos();
    let kk = k * k;
    // u1 = a sx cy, u2 = b cx sy.
    let strained = Strained {
        gradient: [[a * k * cx * cy, -a * k * sx * sy], [-b * k * sx * sy, b * k * cx * cy]],
        second: [
            [[-a * kk * sx * cy, -a * kk * cx * sy], [-a * kk * cx * sy, -a * kk * sx * cy]],
            [[-b * kk * cx * sy, -b * kk * sx * cy], [-b * kk * sx * cy, -b * kk * cx * sy]],
        ],
    };
    let Moduli { lambda, mu, .. } = Moduli::new(p.young, p.nu);
    let (h, second, laplacian) = (strained.gradient, strained.second, strained.laplacian());
    let pressure = lambda * (h[0][0] + h[1][1]);
    let shear = mu * (h[0][1] + h[1][0]);
    let stress = [[pressure + 2.0 * mu * h[0][0], shear], [shear, pressure + 2.0 * mu * h[1][1]]];
    let divergence =
        [0, 1].map(|i| (lambda + mu) * (second[0][0][i] + second[1][1][i]) + mu * laplacian[i]);
    let solid = Solid { stress, divergence };
    let frequency = k * speed;
    let acceleration = [a * sx * cy, b * cx * sy].map(|u: f64| -frequency * frequency * u);
    Paper { jacobian: strained.jacobian(), acceleration, solid, rho0: p.rho0 }
}

#[test]
fn the_generated_square_is_the_square_on_paper() {
    let varied = Parameters { length: 0.3, young: 2e4, nu: 0.1, rho0: 70.0, amplitude: 0.02 };
    compare!(plane_strain_linear_elastic, varied, on_paper);
}
