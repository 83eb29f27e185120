//! A bump that no boundary affects, derived by hand: of rank one, see `rank_one.rs`.
//!
//! ```text
//! u   = d(t) s(X) s(Y),  s(X) = (4 X (L - X)/L^2)^4
//! d   = a (cos(w t), sin(w t + pi/3)/2),  w = c pi/L,  d'' = -w^2 d
//! s'  = 4 q^3 q',  s'' = 12 q^2 q'^2 + 4 q^3 q'',  q = 4 X (L - X)/L^2
//! ```
//!
//! At the sides q = 0 and q' does not vanish, so that s and its first three derivatives do.

use std::f64::consts::PI;

use mms_gallery::quiet_boundary_2d::{Parameters, prepare};
use mms_runtime::{Matrix, Vector};

use crate::rank_one::RankOne;
use crate::support::{NeoHookean, TOLERANCE, Values, assert_agree, generated, in_box};

/// s, s' and s''.
fn profile(length: f64, x: f64) -> [f64; 3] {
    let squared = length * length;
    let [q, slope, curvature] =
        [4.0 * x * (length - x) / squared, 4.0 * (length - 2.0 * x) / squared, -8.0 / squared];
    let second = 12.0 * q * q * slope * slope + 4.0 * q.powi(3) * curvature;
    [q.powi(4), 4.0 * q.powi(3) * slope, second]
}

#[test]
fn the_generated_bump_is_the_bump_on_paper() {
    let odd = Parameters::<f64> { length: 0.8, nu: 0.45, amplitude: 0.05, ..Parameters::default() };
    for parameters in [Parameters::default(), odd] {
        let Parameters { length, young, nu, rho0, amplitude } = parameters;
        let law = NeoHookean::of(young, nu);
        let c = (young / rho0).sqrt();
        let w = c * PI / length;
        let by_hand = |[x, y]: [f64; 2], t: f64| {
            let ([p, dp, ddp], [q, dq, ddq]) = (profile(length, x), profile(length, y));
            let (cos, sin) = ((w * t).cos(), (w * t + PI / 3.0).sin());
            let motion = RankOne {
                direction: Vector::<f64, 3>::new(cos, sin / 2.0, 0.0) * amplitude,
                gradient: Vector::<f64, 3>::new(dp * q, p * dq, 0.0),
                hessian: Matrix::<f64, 3>::new(
                    ddp * q,
                    dp * dq,
                    0.0, //
                    dp * dq,
                    p * ddq,
                    0.0, //
                    0.0,
                    0.0,
                    0.0,
                ),
            };
            let inertia = motion.direction * (-w * w * p * q);
            let force = inertia - motion.divergence(&law) / rho0;
            Values::leading::<2>(motion.jacobian(), &motion.stress(&law), force.into())
        };
        let points = in_box([0.0; 2], [length; 2], [0.0, 2.0 * length / c]);
        assert_agree(TOLERANCE, &points, generated!(prepare(&parameters)), by_hand);
    }
}

#[test]
fn nothing_is_felt_at_the_sides() {
    let parameters = Parameters::default();
    let field = prepare(&parameters);
    for ([x, _], t) in in_box([0.0; 2], [parameters.length; 2], [0.0, 0.06]) {
        for point in [[x, 0.0], [x, parameters.length], [0.0, x], [parameters.length, x]] {
            let at = field.at_time(t);
            assert_eq!(at.displacement(point), [0.0; 2]);
            assert_eq!(at.displacement_gradient(point), [[0.0; 2]; 2]);
            assert_eq!(at.body_force(point), [0.0; 2]);
        }
    }
}
