//! A poroelastic column whose pore pressure is given, derived by hand.
//!
//! ```text
//! u = A sin(k X) cos(w t),  p = p0 cos(k X) sin(w t),  k = pi/(3 L),  w = k c
//! F = 1 + A k cos(k X) cos(w t),  F' = -k^2 u
//! P = mu (F - 1/F) + lambda ln F/F - a p
//! P' = (mu (1 + F^-2) + lambda (1 - ln F) F^-2) F' - a p'
//! b = -w^2 u - P'/rho0
//! storage a (F - 1) + s p,  Q = -m p'/F,  Q' = -m (p'' - p' F'/F)/F
//! ```

use std::f64::consts::PI;

use mms_gallery::consolidating_block_1d::{Parameters, prepare};

use crate::support::{NeoHookean, TOLERANCE, Values, assert_agree, generated, in_box};

#[test]
fn the_generated_column_is_the_column_on_paper() {
    let odd = Parameters::<f64> { length: 1.9, biot: 0.3, p0: -4e4, ..Parameters::default() };
    for parameters in [Parameters::default(), odd] {
        let Parameters { length, young, nu, rho0, amplitude, biot, p0, mobility, storativity } =
            parameters;
        let NeoHookean { lambda, mu } = NeoHookean::of(young, nu);
        let (k, c) = (PI / (3.0 * length), (young / rho0).sqrt());
        let w = k * c;
        let state = |x: f64, t: f64| {
            let (sin, cos) = (k * x).sin_cos();
            let (rising, moving) = (w * t).sin_cos();
            let (u, f) = (amplitude * sin * moving, 1.0 + amplitude * k * cos * moving);
            let p = [p0 * cos * rising, -p0 * k * sin * rising, -p0 * k * k * cos * rising];
            let rates = [-amplitude * k * w * cos * rising, p0 * w * cos * moving];
            (u, f, p, rates)
        };
        let by_hand = |[x]: [f64; 1], t: f64| {
            let (u, f, [p, p_slope, _], _) = state(x, t);
            let stress = mu * (f - 1.0 / f) + lambda * f.ln() / f - biot * p;
            let stiffness = mu * (1.0 + 1.0 / (f * f)) + lambda * (1.0 - f.ln()) / (f * f);
            let divergence = -stiffness * k * k * u - biot * p_slope;
            Values {
                jacobian: f,
                stress: vec![stress],
                force: vec![-w * w * u - divergence / rho0],
            }
        };
        let points = in_box([0.0], [length], [0.0, length / c]);
        let field = prepare(&parameters);
        assert_agree(TOLERANCE, &points, generated!(field), by_hand);
        for ([x], t) in points {
            let (u, f, [p, p_slope, p_curve], [f_rate, p_rate]) = state(x, t);
            let at = field.at_time(t);
            let flux = -mobility * p_slope / f;
            let divergence = -mobility * (p_curve + p_slope * k * k * u / f) / f;
            let source = biot * f_rate + storativity * p_rate + divergence;
            let scale = biot * amplitude * k * w + p0.abs() * (storativity * w + mobility * k * k);
            assert!((at.p([x]) - p).abs() <= TOLERANCE * p0.abs());
            assert!((at.p_gradient([x])[0] - p_slope).abs() <= TOLERANCE * p0.abs() * k);
            assert!((at.p_rate([x]) - p_rate).abs() <= TOLERANCE * p0.abs() * w);
            assert!((at.fluid_flux([x])[0] - flux).abs() <= TOLERANCE * mobility * p0.abs() * k);
            assert!(
                (at.fluid_normal_flux([x], [-1.0]) + flux).abs()
                    <= TOLERANCE * mobility * p0.abs() * k
            );
            assert!((at.fluid_source([x]) - source).abs() <= TOLERANCE * scale, "{x} {t}");
        }
    }
}
