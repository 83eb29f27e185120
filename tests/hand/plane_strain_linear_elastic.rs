//! The square of linear elastic material on rollers, derived by hand.
//!
//! ```text
//! P_iJ      = lambda tr H delta_iJ + mu (H_iJ + H_Ji)
//! (Div P)_i = (lambda + mu) (u_1,1 + u_2,2),i + mu Lap u_i      (Navier)
//! ```
//!
//! At small strain there is one stress, P, and rho = rho0.

use mms_gallery::plane_strain_linear_elastic::Parameters;

use crate::plane::{Solid, Strained, Waves, compare, cosine, sine};
use crate::support::{NeoHookean, TOLERANCE, Values};

fn strained(p: &Parameters<f64>, [x, y]: [f64; 2], time: f64) -> (Waves, Strained, Solid) {
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
    (waves, strained, Solid { stress, divergence })
}

fn on_paper(p: &Parameters<f64>, place: [f64; 2], time: f64) -> Values {
    let (waves, strained, solid) = strained(p, place, time);
    waves.values(&strained, solid, p.rho0)
}

#[test]
fn the_generated_square_is_the_square_on_paper() {
    let varied = Parameters { length: 0.3, young: 2e4, nu: 0.1, rho0: 70.0, amplitude: 0.02 };
    compare!(plane_strain_linear_elastic, varied, on_paper);
}

/// sigma = tau = P^T = P, div sigma = Div P, rho = rho0 and rho b = rho0 a - Div P.
#[test]
fn the_small_strain_has_one_stress_and_one_density() {
    let p = Parameters::<f64>::default();
    let field = mms_gallery::plane_strain_linear_elastic::prepare(&p);
    let points = crate::support::in_box([0.0; 2], [p.length; 2], [0.0, 0.02]);
    for (place, time) in points {
        let (waves, strained, solid) = strained(&p, place, time);
        let at = field.at_time(time);
        let close = |what: &str, found: &[f64], expected: &[f64], scale: f64| {
            let is_close = |(a, b): (&f64, &f64)| (a - b).abs() <= TOLERANCE * scale;
            assert!(
                found.iter().zip(expected).all(is_close),
                "{what} at {place:?}: {found:?}, by hand {expected:?}"
            );
        };
        // The strain is 0.16 at most, and Div P that times the modulus and k.
        let stress = solid.stress.concat();
        let found = [at.cauchy_stress(place), at.kirchhoff_stress(place), at.nominal_stress(place)];
        for (name, found) in ["sigma", "tau", "P^T"].into_iter().zip(found) {
            close(name, &found.concat(), &stress, p.young);
        }
        let force = p.young * waves.k;
        close("div sigma", &at.div_sigma(place), &solid.divergence, force);
        close("rho", &[at.mass_density(place)], &[p.rho0], p.rho0);
        let acceleration = waves.acceleration(&strained);
        let per_volume = [0, 1].map(|i| p.rho0 * acceleration[i] - solid.divergence[i]);
        close("rho b", &at.current_body_force_density(place), &per_volume, force);
    }
}
