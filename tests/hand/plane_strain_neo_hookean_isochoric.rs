//! The clamped square of neo-Hookean material with the volume apart, derived by hand.
//!
//! ```text
//! W   = mu/2 (J^(-2/3) I1 - 3) + kappa/2 (J - 1)^2
//! P   = m F + q cof F,   m = mu J^(-2/3),   q = kappa (J - 1) - m I1/(3 J)
//! m,J = -2/3 m J,J/J
//! q,J = kappa J,J - (m,J I1 + m I1,J)/(3 J) + m I1 J,J/(3 J^2)
//! ```

use mms::gallery::plane_strain_neo_hookean_isochoric::Parameters;

use crate::plane::{Moduli, Paper, Strained, compare};

fn on_paper(p: &Parameters<f64>, [x, y]: [f64; 2], time: f64) -> Paper {
    let speed = (p.young / p.rho0).sqrt();
    let k = std::f64::consts::PI / p.length;
    let a = p.amplitude * (k * speed * time).cos();
    let b = p.amplitude / 2.0 * (k * speed * time + std::f64::consts::PI / 3.0).cos();
    let (sx, cx) = (k * x).sin_cos();
    let (sy, cy) = (k * y).sin_cos();
    let kk = k * k;
    // u1 = a sx sy, u2 = b sx sy.
    let strained = Strained {
        gradient: [[a * k * cx * sy, a * k * sx * cy], [b * k * cx * sy, b * k * sx * cy]],
        second: [
            [[-a * kk * sx * sy, a * kk * cx * cy], [a * kk * cx * cy, -a * kk * sx * sy]],
            [[-b * kk * sx * sy, b * kk * cx * cy], [b * kk * cx * cy, -b * kk * sx * sy]],
        ],
    };
    let Moduli { mu, kappa, .. } = Moduli::new(p.young, p.nu);
    let (j, i1) = (strained.jacobian(), strained.first_invariant());
    let (j_slope, i1_slope) = (strained.jacobian_slope(), strained.first_invariant_slope());
    let m = mu * j.powf(-2.0 / 3.0);
    let m_slope = j_slope.map(|slope| -2.0 / 3.0 * m * slope / j);
    let q = kappa * (j - 1.0) - m * i1 / (3.0 * j);
    let q_slope = [0, 1].map(|axis| {
        kappa * j_slope[axis] - (m_slope[axis] * i1 + m * i1_slope[axis]) / (3.0 * j)
            + m * i1 * j_slope[axis] / (3.0 * j * j)
    });
    let solid = strained.solid(m, m_slope, q, q_slope);
    let frequency = k * speed;
    let acceleration = [a * sx * sy, b * sx * sy].map(|u: f64| -frequency * frequency * u);
    Paper { jacobian: strained.jacobian(), acceleration, solid, rho0: p.rho0 }
}

#[test]
fn the_generated_square_is_the_square_on_paper() {
    let varied = Parameters { length: 0.3, young: 2e4, nu: 0.1, rho0: 70.0, amplitude: 0.02 };
    compare!(plane_strain_neo_hookean_isochoric, varied, on_paper);
}
