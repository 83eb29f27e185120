//! The square of Saint Venant-Kirchhoff material that is turned and strained, derived by hand.
//!
//! ```text
//! x = Q(t) y,  y = X + w(X, t),   F = Q G,  G = I + grad w
//! E = (G^T G - I)/2,   S = lambda tr E I + 2 mu E,   P = Q G S
//! (G S)_iJ,J = w_i,KJ S_KJ + G_iK (lambda E_LL,K + 2 mu E_KJ,J)
//! E_KJ,L = (w_m,KL G_mJ + G_mK w_m,JL)/2
//! a = Q'' y + 2 Q' w' + Q w'',   Div P = Q Div (G S)
//! ```
//!
//! With Q' = alpha' R Q for the quarter turn R, Q'' = (alpha'' R - alpha'^2) Q.

use mms_gallery::plane_strain_saint_venant_kirchhoff::Parameters;

use crate::plane::{Matrix, Solid, Strained, Waves, compare, sine};
use crate::support::{NeoHookean, Values};

/// G S and its divergence, with the trace of E in the plane, which is that in space.
fn strained_solid(strained: &Strained, young: f64, nu: f64) -> Solid {
    let NeoHookean { lambda, mu } = NeoHookean::of(young, nu);
    let (g, second) = (strained.deformation(), strained.second);
    let product = |k: usize, j: usize| g[0][k] * g[0][j] + g[1][k] * g[1][j];
    let unit = |k: usize, j: usize| if k == j { 1.0 } else { 0.0 };
    let strain = [0, 1].map(|k| [0, 1].map(|j| (product(k, j) - unit(k, j)) / 2.0));
    let slope = |k: usize, j: usize, l: usize| {
        let part = |m: usize| second[m][k][l] * g[m][j] + g[m][k] * second[m][j][l];
        (part(0) + part(1)) / 2.0
    };
    let trace = strain[0][0] + strain[1][1];
    let second_stress: Matrix =
        [0, 1].map(|k| [0, 1].map(|j| lambda * trace * unit(k, j) + 2.0 * mu * strain[k][j]));
    let stress = [0, 1]
        .map(|i| [0, 1].map(|j| g[i][0] * second_stress[0][j] + g[i][1] * second_stress[1][j]));
    let inner = [0, 1].map(|k| {
        let pressure = lambda * (slope(0, 0, k) + slope(1, 1, k));
        pressure + 2.0 * mu * (slope(k, 0, 0) + slope(k, 1, 1))
    });
    let divergence = [0, 1].map(|i| {
        let bent = |k: usize| {
            second[i][k][0] * second_stress[k][0] + second[i][k][1] * second_stress[k][1]
        };
        bent(0) + bent(1) + g[i][0] * inner[0] + g[i][1] * inner[1]
    });
    Solid { stress, divergence }
}

fn on_paper(p: &Parameters<f64>, [x, y]: [f64; 2], time: f64) -> Values {
    let waves = Waves::new(p.length, p.young, p.rho0, p.amplitude, time);
    let product = [sine(waves.k, x), sine(waves.k, y)];
    let strained = Strained::product(waves.amplitudes, [product; 2]);
    let solid = strained_solid(&strained, p.young, p.nu);
    let frequency = waves.frequency;
    let phase = frequency * time + std::f64::consts::FRAC_PI_4;
    let (sin, cos) = (p.turn * phase.sin()).sin_cos();
    let spin = p.turn * frequency * phase.cos();
    let spin_rate = -p.turn * frequency * frequency * phase.sin();
    let turned = |v: [f64; 2]| [cos * v[0] - sin * v[1], sin * v[0] + cos * v[1]];
    let quarter = |v: [f64; 2]| [-v[1], v[0]];
    let [w1, w2] = strained.displacement;
    let place = turned([x + w1, y + w2]);
    let velocity = turned(Strained::product(waves.rates, [product; 2]).displacement);
    let own = turned(waves.acceleration(&strained));
    let (across, coriolis) = (quarter(place), quarter(velocity));
    let acceleration = [0, 1].map(|i| {
        spin_rate * across[i] - spin * spin * place[i] + 2.0 * spin * coriolis[i] + own[i]
    });
    let columns = [0, 1].map(|j| turned([solid.stress[0][j], solid.stress[1][j]]));
    let stress = [0, 1].map(|i| [columns[0][i], columns[1][i]]);
    let solid = Solid { stress, divergence: turned(solid.divergence) };
    solid.values(strained.jacobian(), acceleration, p.rho0)
}

#[test]
fn the_generated_square_is_the_square_on_paper() {
    let varied =
        Parameters { length: 0.3, young: 2e4, nu: 0.1, rho0: 70.0, amplitude: 0.02, turn: 2.0 };
    compare!(plane_strain_saint_venant_kirchhoff, varied, on_paper);
}
