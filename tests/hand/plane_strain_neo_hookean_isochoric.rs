//! The clamped square of neo-Hookean material with the volume apart, derived by hand.
//!
//! ```text
//! W   = mu/2 (J^(-2/3) I1 - 3) + kappa/2 (J - 1)^2
//! P   = m F + q cof F,   m = mu J^(-2/3),   q = kappa (J - 1) - m I1/(3 J)
//! m,J = -2/3 m J,J/J
//! q,J = kappa J,J - (m,J I1 + m I1,J)/(3 J) + m I1 J,J/(3 J^2)
//! ```

use mms_gallery::plane_strain_neo_hookean_isochoric::Parameters;

use crate::plane::{Strained, Waves, compare, sine};
use crate::support::{NeoHookean, Values};

fn on_paper(p: &Parameters<f64>, [x, y]: [f64; 2], time: f64) -> Values {
    let waves = Waves::new(p.length, p.young, p.rho0, p.amplitude, time);
    let k = waves.k;
    let strained =
        Strained::product(waves.amplitudes, [[sine(k, x), sine(k, y)], [sine(k, x), sine(k, y)]]);
    let law = NeoHookean::of(p.young, p.nu);
    let (mu, kappa) = (law.mu, law.bulk());
    let (j, j_slope) = (strained.jacobian(), strained.jacobian_slope());
    let m = mu * j.powf(-2.0 / 3.0);
    let m_slope = j_slope.map(|slope| -2.0 / 3.0 * m * slope / j);
    let (q, q_slope) = strained.isochoric_pressure(kappa, m, m_slope);
    let solid = strained.solid(m, m_slope, q, q_slope);
    waves.values(&strained, solid, p.rho0)
}

#[test]
fn the_generated_square_is_the_square_on_paper() {
    let varied = Parameters { length: 0.3, young: 2e4, nu: 0.1, rho0: 70.0, amplitude: 0.02 };
    compare!(plane_strain_neo_hookean_isochoric, varied, on_paper);
}
