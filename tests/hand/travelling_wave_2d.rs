//! A wave that runs through a square, derived by hand: of rank one, see `rank_one.rs`.
//!
//! ```text
//! u = d sin(theta),  theta = k.X - w t,  k = pi/L (1, 2),  w = c pi/L,  d = a (1, 1/4)
//! grad phi = k cos(theta),  grad grad phi = -k k sin(theta),  a = -w^2 u
//! ```

use std::f64::consts::PI;

use mms_gallery::travelling_wave_2d::{Parameters, prepare};
use mms_runtime::Vector;

use crate::rank_one::RankOne;
use crate::support::{NeoHookean, TOLERANCE, Values, assert_agree, generated, in_box};

#[test]
fn the_generated_wave_is_the_wave_on_paper() {
    let odd =
        Parameters::<f64> { length: 1.4, nu: 0.15, amplitude: -0.09, ..Parameters::default() };
    for parameters in [Parameters::default(), odd] {
        let Parameters { length, young, nu, rho0, amplitude } = parameters;
        let law = NeoHookean::of(young, nu);
        let wave_vector = Vector::<f64, 3>::new(1.0, 2.0, 0.0) * (PI / length);
        let direction = Vector::<f64, 3>::new(amplitude, amplitude / 4.0, 0.0);
        let c = (young / rho0).sqrt();
        let w = c * PI / length;
        let by_hand = |[x, y]: [f64; 2], t: f64| {
            let (sin, cos) = (wave_vector.x * x + wave_vector.y * y - w * t).sin_cos();
            let motion = RankOne {
                direction,
                gradient: wave_vector * cos,
                hessian: wave_vector * wave_vector.transpose() * -sin,
            };
            let force = direction * (-w * w * sin) - motion.divergence(&law) / rho0;
            Values::leading::<2>(motion.jacobian(), &motion.stress(&law), force.into())
        };
        let points = in_box([0.0; 2], [length; 2], [0.0, 2.0 * length / c]);
        assert_agree(TOLERANCE, &points, generated!(prepare(&parameters)), by_hand);
    }
}
