//! The clamped square with fibres across it, derived by hand. With f = F a0, I4 = f.f and constant a0,
//!
//! ```text
//! P         = mu F + q cof F + 2 k (I4 - 1) f x a0,   q = (lambda ln J - mu)/J
//! q,J       = (lambda (1 - ln J) + mu) J,J/J^2
//! (Div P)_i = mu Lap u_i + cof_iJ q,J + 2 k (f_i I4,J a0_J + (I4 - 1) f_i,J a0_J)
//! f_i,J = u_i,KJ a0_K,   I4,J = 2 f_i f_i,J
//! ```

use mms_gallery::plane_strain_transversely_isotropic::Parameters;

use crate::plane::{Strained, Waves, compare, sine};
use crate::support::{NeoHookean, Values};

fn on_paper(p: &Parameters<f64>, [x, y]: [f64; 2], time: f64) -> Values {
    let waves = Waves::new(p.length, p.young, p.rho0, p.amplitude, time);
    let k = waves.k;
    let strained = Strained::product(
        waves.amplitudes,
        [[sine(k, x), sine(k, y)], [sine(k, x), sine(2.0 * k, y)]],
    );
    let NeoHookean { lambda, mu } = NeoHookean::of(p.young, p.nu);
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
    waves.values(&strained, solid, p.rho0)
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
