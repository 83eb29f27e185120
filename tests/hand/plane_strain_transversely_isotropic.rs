//! The clamped square with fibres across it, derived by hand. With f = F a0, I4 = f.f and constant a0,
//!
//! ```text
//! P         = mu F + q cof F + 2 k (I4 - 1) f x a0,   q = (lambda ln J - mu)/J
//! q,J       = (lambda (1 - ln J) + mu) J,J/J^2
//! (Div P)_i = mu Lap u_i + cof_iJ q,J + 2 k (f_i I4,J a0_J + (I4 - 1) f_i,J a0_J)
//! f_i,J = u_i,KJ a0_K,   I4,J = 2 f_i f_i,J
//! ```

use mms::gallery::plane_strain_transversely_isotropic::Parameters;

use crate::plane::{Moduli, Paper, Strained, compare};

fn on_paper(p: &Parameters<f64>, [x, y]: [f64; 2], time: f64) -> Paper {
    let speed = (p.young / p.rho0).sqrt();
    let k = std::f64::consts::PI / p.length;
    let a = p.amplitude * (k * speed * time).cos();
    let b = p.amplitude / 2.0 * (k * speed * time + std::f64::consts::PI / 3.0).cos();
    let (sx, cx) = (k * x).sin_cos();
    let (s1, c1) = (k * y).sin_cos();
    let (s2, c2) = (2.0 * k * y).sin_cos();
    let kk = k * k;
    // u1 = a sx sin(k Y), u2 = b sx sin(2 k Y).
    let strained = Strained {
        gradient: [[a * k * cx * s1, a * k * sx * c1], [b * k * cx * s2, 2.0 * b * k * sx * c2]],
        second: [
            [[-a * kk * sx * s1, a * kk * cx * c1], [a * kk * cx * c1, -a * kk * sx * s1]],
            [
                [-b * kk * sx * s2, 2.0 * b * kk * cx * c2],
                [2.0 * b * kk * cx * c2, -4.0 * b * kk * sx * s2],
            ],
        ],
    };
    let Moduli { lambda, mu, .. } = Moduli::new(p.young, p.nu);
    let (j, j_slope) = (strained.jacobian(), strained.jacobian_slope());
    let q = (lambda * j.ln() - mu) / j;
    let q_slope = j_slope.map(|slope| (lambda * (1.0 - j.ln()) + mu) * slope / (j * j));
    let mut solid = strained.solid(mu, [0.0; 2], q, q_slope);
    let (f, second) = (strained.deformation(), strained.second);
    let fibre = [0.8, 0.6];
    let present = [0, 1].map(|i| f[i][0] * fibre[0] + f[i][1] * fibre[1]);
    let stretch = present[0] * present[0] + present[1] * present[1] - 1.0;
    // f_i,J a0_J, and I4,J a0_J.
    let bent = [0, 1].map(|i| {
        let row = |j: usize| second[i][0][j] * fibre[0] + second[i][1][j] * fibre[1];
        row(0) * fibre[0] + row(1) * fibre[1]
    });
    let along = 2.0 * (present[0] * bent[0] + present[1] * bent[1]);
    for i in 0..2 {
        let pull = 2.0 * p.reinforcement;
        for (stress, fibre) in solid.stress[i].iter_mut().zip(fibre) {
            *stress += pull * stretch * present[i] * fibre;
        }
        solid.divergence[i] += pull * (present[i] * along + stretch * bent[i]);
    }
    let frequency = k * speed;
    let acceleration = [a * sx * s1, b * sx * s2].map(|u: f64| -frequency * frequency * u);
    Paper { jacobian: strained.jacobian(), acceleration, solid, rho0: p.rho0 }
}

#[test]
fn the_generated_square_is_the_square_on_paper() {
    let varied = Parameters {
        length: 0.3,
        young: 2e4,
        nu: 0.1,
        rho0: 70.0,
        amplitude: 0.02,
        reinforcement: 9e4,
    };
    compare!(plane_strain_transversely_isotropic, varied, on_paper);
}
