//! A square that is heated and cooled, derived by hand.
//!
//! ```text
//! u = (A sin(k X) cos(k Y), A/2 cos(k X) sin(k Y)),  A = a cos(w t),  w = k c
//! theta = T cos(k X) cos(k Y) sin(w t),  B = (3 lambda + 2 mu) alpha
//! P = mu F + q cof F,  q = (lambda ln J - mu - B theta)/J
//! q,J = (lambda J,J/J - B theta,J)/J - q J,J/J
//! Q = -k J C^-1 grad theta,  source = rho0 c theta' + Div Q
//! ```
//!
//! Div Q is a central difference of Q here, in place of its product rule.

use std::f64::consts::PI;

use mms_gallery::heated_square_2d::{Parameters, prepare};

use crate::plane::{Strained, cosine, sine};
use crate::support::{NeoHookean, TOLERANCE, assert_agree, generated, in_box};

#[test]
fn the_generated_square_is_the_square_on_paper() {
    let odd = Parameters::<f64> { length: 0.7, nu: 0.2, warmth: -50.0, ..Parameters::default() };
    for parameters in [Parameters::default(), odd] {
        let Parameters { length, young, nu, rho0, amplitude, .. } = parameters;
        let Parameters { expansion, warmth, capacity, conductivity, .. } = parameters;
        let NeoHookean { lambda, mu } = NeoHookean::of(young, nu);
        let coupling = (3.0 * lambda + 2.0 * mu) * expansion;
        let (k, c) = (PI / length, (young / rho0).sqrt());
        let w = k * c;
        let strained = |[x, y]: [f64; 2], t: f64| {
            let size = amplitude * (w * t).cos();
            let profiles = [[sine(k, x), cosine(k, y)], [cosine(k, x), sine(k, y)]];
            Strained::product([size, size / 2.0], profiles)
        };
        let temperature = |[x, y]: [f64; 2], t: f64| {
            let ([cx, sx, _], [cy, sy, _]) = (cosine(k, x), cosine(k, y));
            let size = warmth * (w * t).sin();
            (size * cx * cy, [size * sx * cy, size * cx * sy], warmth * w * (w * t).cos() * cx * cy)
        };
        let by_hand = |at: [f64; 2], t: f64| {
            let (strained, (theta, slope, _)) = (strained(at, t), temperature(at, t));
            let (j, j_slope) = (strained.jacobian(), strained.jacobian_slope());
            let q = (lambda * j.ln() - mu - coupling * theta) / j;
            let q_slope = [0, 1].map(|axis| {
                (lambda * j_slope[axis] / j - coupling * slope[axis]) / j - q * j_slope[axis] / j
            });
            let solid = strained.solid(mu, [0.0; 2], q, q_slope);
            let acceleration = strained.displacement.map(|u| -w * w * u);
            solid.values(j, acceleration, rho0)
        };
        let points = in_box([0.0; 2], [length; 2], [0.0, length / (2.0 * c)]);
        let field = prepare(&parameters);
        assert_agree(TOLERANCE, &points, generated!(field), by_hand);
        let flux = |at: [f64; 2], t: f64| {
            let ([[f11, f12], [f21, f22]], slope) =
                (strained(at, t).deformation(), temperature(at, t).1);
            let (c11, c12, c22) =
                (f11 * f11 + f21 * f21, f11 * f12 + f21 * f22, f12 * f12 + f22 * f22);
            let factor = -conductivity / (f11 * f22 - f12 * f21);
            [factor * (c22 * slope[0] - c12 * slope[1]), factor * (c11 * slope[1] - c12 * slope[0])]
        };
        let scale = conductivity * warmth.abs() * k;
        for (x, t) in points {
            let (at, (theta, _, rate)) = (field.at_time(t), temperature(x, t));
            assert!((at.theta(x) - theta).abs() <= TOLERANCE * warmth.abs());
            assert!((at.theta_rate(x) - rate).abs() <= TOLERANCE * warmth.abs() * w);
            for (found, expected) in at.heat_flux(x).into_iter().zip(flux(x, t)) {
                assert!((found - expected).abs() <= TOLERANCE * scale);
            }
            let step = 1e-4 * length;
            let slope = |axis: usize| {
                let [ahead, behind] = [step, -step].map(|step| {
                    let mut place = x;
                    place[axis] += step;
                    flux(place, t)[axis]
                });
                (ahead - behind) / (2.0 * step)
            };
            let source = rho0 * capacity * rate + slope(0) + slope(1);
            let found = at.heat_source(x);
            let largest = rho0 * capacity * warmth.abs() * w;
            // The difference errs by (k step)^2 of the divergence.
            let bound = TOLERANCE * largest + 1e-6 * scale * k;
            assert!((found - source).abs() <= bound, "{found:e}, {source:e} at {x:?}, {t}");
        }
    }
}
