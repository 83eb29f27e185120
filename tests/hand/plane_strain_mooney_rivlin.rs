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
//! and u1 = a X Y/L^2, u2 = b X Y/L^2 have no Laplacian.

use mms_gallery::plane_strain_mooney_rivlin::Parameters;

use crate::plane::{Strained, Waves, compare, linear};
use crate::support::{NeoHookean, Values};

fn on_paper(p: &Parameters<f64>, [x, y]: [f64; 2], time: f64) -> Values {
    let waves = Waves::new(p.length, p.young, p.rho0, p.amplitude, time);
    let product = [linear(p.length, x), linear(p.length, y)];
    let strained = Strained::product(waves.amplitudes, [product; 2]);
    let NeoHookean { lambda, mu } = NeoHookean::of(p.young, p.nu);
    let (c1, c2) = (3.0 * mu / 8.0, mu / 8.0);
    let c3 = lambda / 2.0 - 2.0 * c2;
    let d = 2.0 * c1 + 4.0 * c2;
    let (j, j_slope) = (strained.jacobian(), strained.jacobian_slope());
    let q = 2.0 * c2 * j + 2.0 * c3 * (j - 1.0) - d / j;
    let q_slope = j_slope.map(|slope| (2.0 * c2 + 2.0 * c3 + d / (j * j)) * slope);
    let solid = strained.solid(2.0 * (c1 + c2), [0.0; 2], q, q_slope);
    waves.values(&strained, solid, p.rho0)
}

#[test]
fn the_generated_square_is_the_square_on_paper() {
    let varied = Parameters { length: 0.3, young: 2e4, nu: 0.1, rho0: 70.0, amplitude: 0.02 };
    compare!(plane_strain_mooney_rivlin, varied, on_paper);
}
