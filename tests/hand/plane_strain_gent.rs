//! The square of Gent material on rollers, derived by hand.
//!
//! ```text
//! W   = -mu Jm/2 ln (1 - x) + kappa/2 (J - 1)^2,   x = (J^(-2/3) I1 - 3)/Jm
//! P   = m F + q cof F,   m = mu J^(-2/3)/(1 - x),   q = kappa (J - 1) - m I1/(3 J)
//! x,J = J^(-2/3) (I1,J - 2/3 I1 J,J/J)/Jm
//! m,J = m (x,J/(1 - x) - 2/3 J,J/J)
//! q,J = kappa J,J - (m,J I1 + m I1,J)/(3 J) + m I1 J,J/(3 J^2)
//! ```

use mms::gallery::plane_strain_gent::Parameters;

use crate::plane::{Moduli, Paper, Strained, compare};

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
    let Moduli { mu, kappa, .. } = Moduli::new(p.young, p.nu);
    let (j, i1) = (strained.jacobian(), strained.first_invariant());
    let (j_slope, i1_slope) = (strained.jacobian_slope(), strained.first_invariant_slope());
    let isochoric = j.powf(-2.0 / 3.0);
    let left = 1.0 - (isochoric * i1 - 3.0) / p.limit;
    let m = mu * isochoric / left;
    let m_slope = [0, 1].map(|axis| {
        let slope = isochoric * (i1_slope[axis] - 2.0 / 3.0 * i1 * j_slope[axis] / j) / p.limit;
        m * (slope / left - 2.0 / 3.0 * j_slope[axis] / j)
    });
    let q = kappa * (j - 1.0) - m * i1 / (3.0 * j);
    let q_slope = [0, 1].map(|axis| {
        kappa * j_slope[axis] - (m_slope[axis] * i1 + m * i1_slope[axis]) / (3.0 * j)
            + m * i1 * j_slope[axis] / (3.0 * j * j)
    });
    let solid = strained.solid(m, m_slope, q, q_slope);
    let frequency = k * speed;
    let acceleration = [a * sx * cy, b * cx * sy].map(|u: f64| -frequency * frequency * u);
    Paper { jacobian: strained.jacobian(), acceleration, solid, rho0: p.rho0 }
}

#[test]
fn the_generated_square_is_the_square_on_paper() {
    let varied =
        Parameters { length: 0.3, young: 2e4, nu: 0.1, rho0: 70.0, amplitude: 0.02, limit: 5.0 };
    compare!(plane_strain_gent, varied, on_paper);
}
