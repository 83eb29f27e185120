//! The square of linear elastic material on rollers, derived by hand.
//!
//! ```text
//! P_iJ      = lambda tr H delta_iJ + mu (H_iJ + H_Ji)
//! (Div P)_i = (lambda + mu) (u_1,1 + u_2,2),i + mu Lap u_i      (Navier)
//! ```

use mms_gallery::plane_strain_linear_elastic::Parameters;

use crate::plane::{Solid, Strained, Waves, compare, cosine, sine};
use crate::support::{NeoHookean, Values};

fn on_paper(p: &Parameters<f64>, [x, y]: [f64; 2], time: f64) -> Values {
    let waves = Waves::new(p.length, p.young, p.rho0, p.amplitude, time);
    let k = waves.k;
    let strained = Strained::product(
        waves.amplitudes,
        [[sine(k, x), cosine(k, y)], [cosine(k, x), sine(k, y)]],
    );
    let NeoHookean { lambda, mu } = NeoHookean::of(p.young, p.nu);
    let (h, second, laplacian) = (strained.gradient, strained.second, strained.laplacian());
    let pressure = lambda * (h[0][0] + h[1][1]);
    let shear = mu * (h[0][1] + h[1][0]);
    let stress = [[pressure + 2.0 * mu * h[0][0], shear], [shear, pressure + 2.0 * mu * h[1][1]]];
    let divergence =
        [0, 1].map(|i| (lambda + mu) * (second[0][0][i] + second[1][1][i]) + mu * laplacian[i]);
    let solid = Solid { stress, divergence };
    waves.values(&strained, solid, p.rho0)
}

#[test]
fn the_generated_square_is_the_square_on_paper() {
    let varied = Parameters { length: 0.3, young: 2e4, nu: 0.1, rho0: 70.0, amplitude: 0.02 };
    compare!(plane_strain_linear_elastic, varied, on_paper);
}
