//! The square of Gent material on rollers, derived by hand.
//!
//! ```text
//! W   = -mu Jm/2 ln (1 - x) + kappa/2 (J - 1)^2,   x = (J^(-2/3) I1 - 3)/Jm
//! P   = m F + q cof F,   m = mu J^(-2/3)/(1 - x),   q = kappa (J - 1) - m I1/(3 J)
//! x,J = J^(-2/3) (I1,J - 2/3 I1 J,J/J)/Jm
//! m,J = m (x,J/(1 - x) - 2/3 J,J/J)
//! q,J = kappa J,J - (m,J I1 + m I1,J)/(3 J) + m I1 J,J/(3 J^2)
//! ```

use mms_gallery::plane_strain_gent::Parameters;

use crate::plane::{Strained, Waves, compare, cosine, sine};
use crate::support::{NeoHookean, Values};

fn on_paper(p: &Parameters<f64>, [x, y]: [f64; 2], time: f64) -> Values {
    let waves = Waves::new(p.length, p.young, p.rho0, p.amplitude, time);
    let k = waves.k;
    let strained = Strained::product(
        waves.amplitudes,
        [[sine(k, x), cosine(k, y)], [cosine(k, x), sine(k, y)]],
    );
    let law = NeoHookean::of(p.young, p.nu);
    let (mu, kappa) = (law.mu, law.bulk());
    let (j, i1) = (strained.jacobian(), strained.first_invariant());
    let (j_slope, i1_slope) = (strained.jacobian_slope(), strained.first_invariant_slope());
    let isochoric = j.powf(-2.0 / 3.0);
    let left = 1.0 - (isochoric * i1 - 3.0) / p.limit;
    let m = mu * isochoric / left;
    let m_slope = [0, 1].map(|axis| {
        let slope = isochoric * (i1_slope[axis] - 2.0 / 3.0 * i1 * j_slope[axis] / j) / p.limit;
        m * (slope / left - 2.0 / 3.0 * j_slope[axis] / j)
    });
    let (q, q_slope) = strained.isochoric_pressure(kappa, m, m_slope);
    let solid = strained.solid(m, m_slope, q, q_slope);
    waves.values(&strained, solid, p.rho0)
}

#[test]
fn the_generated_square_is_the_square_on_paper() {
    let varied =
        Parameters { length: 0.3, young: 2e4, nu: 0.1, rho0: 70.0, amplitude: 0.02, limit: 5.0 };
    compare!(plane_strain_gent, varied, on_paper);
}
