//! A square held in a bulge without time, derived by hand: of rank one, see `rank_one.rs`.
//!
//! ```text
//! u   = d phi,  d = a (1, -1/2),  phi = sin(k X) sin(k Y),  k = pi/L
//! phi,XX = phi,YY = -k^2 phi,  phi,XY = k^2 cos(k X) cos(k Y)
//! b   = -Div P/rho0, since nothing moves
//! ```

use std::f64::consts::PI;

use mms_gallery::static_square::{Parameters, prepare};
use mms_runtime::{Matrix, Vector};

use crate::rank_one::RankOne;
use crate::support::{NeoHookean, TOLERANCE, Values, assert_agree, generated, in_box};

#[test]
fn the_generated_square_is_the_square_on_paper() {
    let odd = Parameters::<f64> { length: 2.2, nu: 0.0, amplitude: 0.3, ..Parameters::default() };
    for parameters in [Parameters::default(), odd] {
        let Parameters { length, young, nu, rho0, amplitude } = parameters;
        let law = NeoHookean::of(young, nu);
        let k = PI / length;
        let by_hand = |at: [f64; 2], _| {
            let [[sin_x, cos_x], [sin_y, cos_y]] = at.map(|x| [(k * x).sin(), (k * x).cos()]);
            let (straight, mixed) = (-k * k * sin_x * sin_y, k * k * cos_x * cos_y);
            let motion = RankOne {
                direction: Vector::<f64, 3>::new(1.0, -0.5, 0.0) * amplitude,
                gradient: Vector::<f64, 3>::new(cos_x * sin_y, sin_x * cos_y, 0.0) * k,
                hessian: Matrix::<f64, 3>::new(
                    straight, mixed, 0.0, mixed, straight, 0.0, 0.0, 0.0, 0.0,
                ),
            };
            let force = -motion.divergence(&law) / rho0;
            Values::leading::<2>(motion.jacobian(), &motion.stress(&law), force.into())
        };
        let points = in_box([0.0; 2], [length; 2], [0.0, 1.0]);
        assert_agree(TOLERANCE, &points, generated!(prepare(&parameters)), by_hand);
    }
}
