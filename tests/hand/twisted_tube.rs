//! A quarter of a tube on a rigid core, twisted by a load on its outer surface, derived by hand in cylindrical coordinates.
//!
//! ```text
//! x     = R e_r + Z e_z,  e_r and e_t being the polar basis at Theta + psi
//! psi   = A (R^2 - ri^2)/(ro^2 - ri^2),  A = a cos(w t),  w = 2 c/ro
//! F     = Q (I + g E_T E_R),  g = R psi',  Q the rotation by psi;  J = 1
//! P     = mu (F - F^-T) = mu g (e_t E_R + e_r E_T)
//! Div P = mu (g' + 2 g/R) e_t - mu g psi' e_r,  since e_t,R = -psi' e_r and e_r,T = e_t, E_R,T = E_T
//! a     = R (psi,tt e_t - psi,t^2 e_r)
//! ```
//!
//! The ends are free, for P E_Z = 0, and the outer surface carries mu g e_t.

use mms_gallery::twisted_tube::{Parameters, prepare};
use mms_runtime::{Matrix, Vector};

use crate::support::{NeoHookean, TOLERANCE, Values, assert_agree, generated, in_box};

/// Points between two radii, and between 0 and a height.
fn points(inner: f64, outer: f64, height: f64, end: f64) -> Vec<([f64; 3], f64)> {
    let turn = std::f64::consts::FRAC_PI_2;
    let round = in_box([inner, 0.0, 0.0], [outer, turn, height], [0.0, end]).into_iter();
    round.map(|([r, theta, z], t)| ([r * theta.cos(), r * theta.sin(), z], t)).collect()
}

#[test]
fn the_generated_tube_is_the_tube_on_paper() {
    let odd =
        Parameters::<f64> { inner: 0.9, outer: 1.6, amplitude: -0.7, ..Parameters::default() };
    for parameters in [Parameters::default(), odd] {
        let Parameters { inner, outer, height, young, nu, rho0, amplitude } = parameters;
        let mu = NeoHookean::of(young, nu).mu;
        let c = (young / rho0).sqrt();
        let w = 2.0 * c / outer;
        let span = outer * outer - inner * inner;
        let by_hand = |[x, y, _]: [f64; 3], t: f64| {
            let r = x.hypot(y);
            let part = (r * r - inner * inner) / span;
            let (sin, cos) = (w * t).sin_cos();
            let (angle, speed) = (amplitude * cos * part, -amplitude * w * sin * part);
            let slope = amplitude * cos * 2.0 * r / span;
            let (shear, growth) = (r * slope, 2.0 * slope);
            let turned = |theta: f64| Vector::<f64, 3>::new(theta.cos(), theta.sin(), 0.0);
            let quarter = std::f64::consts::FRAC_PI_2;
            let theta = y.atan2(x);
            let [big_r, big_t] = [0.0, quarter].map(|more| turned(theta + more));
            let [e_r, e_t] = [0.0, quarter].map(|more| turned(theta + angle + more));
            let stress: Matrix<f64, 3> =
                (e_t * big_r.transpose() + e_r * big_t.transpose()) * (mu * shear);
            // g = 2 A R^2/span: g' = 4 A R/span, which is twice psi'.
            let div_p = e_t * (mu * (growth + 2.0 * shear / r)) - e_r * (mu * shear * slope);
            let acceleration = e_t * (-w * w * angle * r) - e_r * (speed * speed * r);
            Values::leading::<3>(1.0, &stress, (acceleration - div_p / rho0).into())
        };
        let points = points(inner, outer, height, outer / c);
        assert_agree(TOLERANCE, &points, generated!(prepare(&parameters)), by_hand);
    }
}

#[test]
fn the_load_on_the_outer_surface_is_the_shear_stress() {
    let parameters = Parameters::<f64>::default();
    let field = prepare(&parameters);
    let Parameters { outer, young, nu, rho0, amplitude, inner, height } = parameters;
    let mu = NeoHookean::of(young, nu).mu;
    let c = (young / rho0).sqrt();
    for ([x, y, z], t) in points(outer, outer, height, outer / c) {
        let angle = amplitude * (2.0 * c * t / outer).cos();
        let shear = 2.0 * angle * outer * outer / (outer * outer - inner * inner);
        let theta = y.atan2(x) + angle;
        let expected = [-theta.sin() * mu * shear, theta.cos() * mu * shear, 0.0];
        let found = field.at_time(t).outer_traction([x, y, z]);
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-12 * young, "{found} {expected}");
        }
    }
}
