//! The expanding ring (Wallstedt & Guilkey, JCP 227, 2008), derived by hand along the radius.
//!
//! ```text
//! u_R  = T f(R),  T = a sin(w t),  w = c pi/(ri + ro),  f = c3 R^3 + c2 R^2 + c1 R
//! D    = ro^2 (ro - 3 ri),  c1 = -6 ri ro/D,  c2 = 3 (ri + ro)/D,  c3 = -2/D
//! p    = 1 + T f',  q = 1 + T f/R: the stretches along and across the radius;  J = p q
//! P_RR = mu (p - 1/p),  P_TT = mu (q - 1/q)          (nu = 0: lambda = 0, mu = E/2)
//! b_R  = -w^2 T f - [P_RR,R + (P_RR - P_TT)/R]/rho0,  P_RR,R = mu (1 + p^-2) T f''
//! ```
//!
//! f' vanishes at both radii, so that p = 1 and P_RR = 0 there.

use std::f64::consts::PI;

use mms_gallery::expanding_ring::{Parameters, prepare};

use crate::support::{TOLERANCE, Values, assert_agree, generated, in_ring};

#[test]
fn the_generated_ring_is_the_ring_on_paper() {
    let odd = Parameters::<f64> { inner: 0.9, outer: 1.6, young: 3e5, ..Parameters::default() };
    for parameters in [Parameters::default(), odd] {
        let Parameters { inner, outer, young, rho0, amplitude } = parameters;
        let (mu, w) = (young / 2.0, (young / rho0).sqrt() * PI / (inner + outer));
        let d = outer * outer * (outer - 3.0 * inner);
        let (c1, c2, c3) = (-6.0 * inner * outer / d, 3.0 * (inner + outer) / d, -2.0 / d);
        let by_hand = |[x, y]: [f64; 2], t: f64| {
            let (r, pulse) = (x.hypot(y), amplitude * (w * t).sin());
            let f = ((c3 * r + c2) * r + c1) * r;
            let [slope, curvature] = [(3.0 * c3 * r + 2.0 * c2) * r + c1, 6.0 * c3 * r + 2.0 * c2];
            let (p, q) = (1.0 + pulse * slope, 1.0 + pulse * f / r);
            let (along, across) = (mu * (p - 1.0 / p), mu * (q - 1.0 / q));
            let div_p = mu * (1.0 + 1.0 / (p * p)) * pulse * curvature + (along - across) / r;
            let force = -w * w * pulse * f - div_p / rho0;
            let (cos, sin) = (x / r, y / r);
            let shear = (along - across) * cos * sin;
            Values {
                jacobian: p * q,
                stress: vec![
                    along * cos * cos + across * sin * sin,
                    shear,
                    shear,
                    along * sin * sin + across * cos * cos,
                ],
                force: vec![force * cos, force * sin],
            }
        };
        let points = in_ring(inner, outer, [0.0, 2.0 * PI / w]);
        assert_agree(TOLERANCE, &points, generated!(prepare(&parameters)), by_hand);
    }
}

#[test]
fn both_surfaces_are_free() {
    let parameters = Parameters::default();
    let field = prepare(&parameters);
    for radius in [parameters.inner, parameters.outer] {
        for ([x, y], t) in in_ring(radius, radius, [0.0, 0.06]) {
            let traction = field.at_time(t).traction([x, y], [x / radius, y / radius]);
            let bound = 1e-13 * parameters.young;
            assert!(traction.iter().all(|component| component.abs() < bound), "{traction:?}");
        }
    }
}
