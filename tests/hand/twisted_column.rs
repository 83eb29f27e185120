//! A column twisted about its axis, derived by hand in cylindrical coordinates.
//!
//! ```text
//! x     = r e_r + Z e_z,  e_r and e_t being the polar basis at Theta + alpha
//! alpha = A sin(k Z) cos(w t + pi/6),  k = pi/(2 L),  w = c pi/L
//! F     = Q (I + gamma E_T E_Z),  gamma = r alpha,Z,  Q the rotation by alpha;  J = 1
//! P     = mu (F - F^-T) = mu gamma (e_t E_Z + e_z E_T)
//! Div P = mu r (alpha,ZZ e_t - alpha,Z^2 e_r),  since e_t,Z = -alpha,Z e_r
//! a     = r (alpha,tt e_t - alpha,t^2 e_r)
//! ```
//!
//! At the top alpha,Z = 0, so that P E_Z = 0; the sides carry mu gamma (E_T.N) e_z.

use std::f64::consts::PI;

use mms_gallery::twisted_column::{Parameters, prepare};
use mms_runtime::{Matrix, Vector};

use crate::support::{NeoHookean, TOLERANCE, Values, assert_agree, generated, in_box};

#[test]
fn the_generated_column_is_the_column_on_paper() {
    let odd = Parameters::<f64> { width: 0.9, height: 1.6, twist: -2.0, ..Parameters::default() };
    for parameters in [Parameters::default(), odd] {
        let Parameters { width, height, young, nu, rho0, twist } = parameters;
        let mu = NeoHookean::of(young, nu).mu;
        let (k, c) = (PI / (2.0 * height), (young / rho0).sqrt());
        let w = c * PI / height;
        let by_hand = |[x, y, z]: [f64; 3], t: f64| {
            let (sin, cos) = (w * t + PI / 6.0).sin_cos();
            let angle = twist * (k * z).sin() * cos;
            let slope = twist * k * (k * z).cos() * cos;
            let speed = -twist * w * (k * z).sin() * sin;
            let (turn_sin, turn_cos) = angle.sin_cos();
            let present = |x: f64, y: f64| {
                Vector::<f64, 3>::new(x * turn_cos - y * turn_sin, x * turn_sin + y * turn_cos, 0.0)
            };
            // r times the basis vectors, which are not defined on the axis.
            let (r_e_r, r_e_t, r_big_t) =
                (present(x, y), present(-y, x), Vector::<f64, 3>::new(-y, x, 0.0));
            let e_z = Vector::<f64, 3>::z();
            let stress: Matrix<f64, 3> =
                (r_e_t * e_z.transpose() + e_z * r_big_t.transpose()) * (mu * slope);
            let div_p = (r_e_t * (-k * k * angle) - r_e_r * (slope * slope)) * mu;
            let acceleration = r_e_t * (-w * w * angle) - r_e_r * (speed * speed);
            Values::leading::<3>(1.0, &stress, (acceleration - div_p / rho0).into())
        };
        let half = width / 2.0;
        let points = in_box([-half, -half, 0.0], [half, half, height], [0.0, 2.0 * height / c]);
        assert_agree(TOLERANCE, &points, generated!(prepare(&parameters)), by_hand);
    }
}
