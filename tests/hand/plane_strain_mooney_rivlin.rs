//! The square of Mooney-Rivlin material that is drawn over its corner, derived by hand.
//!
//! In the plane C^2 = (tr C) C - J^2 I (Cayley & Hamilton), so that with I1 = tr C + 1
//!
//! ```text
//! I1 F - F C = F + J cof F
//! P     = 2 (c1 + c2) F + q cof F,   q = 2 c2 J + 2 c3 (J - 1) - d/J,   d = 2 c1 + 4 c2
//! Div P = 2 (c1 + c2) Lap u + q' cof F grad J,   q' = 2 c2 + 2 c3 + d/J^2
//! ```
//!
//! and u1 = a X Y, u2 = b X Y have no Laplacian.

use mms::gallery::plane_strain_mooney_rivlin::Parameters;

use crate::plane::{Moduli, Paper, Strained, compare};

fn on_paper(p: &Parameters<f64>, [x, y]: [f64; 2], time: f64) -> Paper {
    let speed = (p.young / p.rho0).sqrt();
    let k = std::f64::consts::PI / p.length;
    let a = p.amplitude * (k * speed * time).cos();
    let b = p.amplitude / 2.0 * (k * speed * time + std::f64::consts::PI / 3.0).cos();
    let square = p.length * p.length;
    let (a, b) = (a / square, b / square);
    let strained = Strained {
        gradient: [[a * y, a * x], [b * y, b * x]],
        second: [[[0.0, a], [a, 0.0]], [[0.0, b], [b, 0.0]]],
    };
    let Moduli { lambda, mu, .. } = Moduli::new(p.young, p.nu);
    let (c1, c2) = (3.0 * mu / 8.0, mu / 8.0);
    let c3 = lambda / 2.0 - 2.0 * c2;
    let d = 2.0 * c1 + 4.0 * c2;
    let (j, j_slope) = (strained.jacobian(), strained.jacobian_slope());
    let q = 2.0 * c2 * j + 2.0 * c3 * (j - 1.0) - d / j;
    let q_slope = j_slope.map(|slope| (2.0 * c2 + 2.0 * c3 + d / (j * j)) * slope);
    let solid = strained.solid(2.0 * (c1 + c2), [0.0; 2], q, q_slope);
    let frequency = k * speed;
    let acceleration = [a * x * y, b * x * y].map(|u: f64| -frequency * frequency * u);
    Paper { jacobian: strained.jacobian(), acceleration, solid, rho0: p.rho0 }
}

#[test]
fn the_generated_square_is_the_square_on_paper() {
    let varied = Parameters { length: 0.3, young: 2e4, nu: 0.1, rho0: 70.0, amplitude: 0.02 };
    compare!(plane_strain_mooney_rivlin, varied, on_paper);
}
