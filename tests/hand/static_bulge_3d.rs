//! A cube held in a bulge, derived by hand: of rank one, see `rank_one.rs`.
//!
//! ```text
//! u   = d phi,  d = a (1, 1/2, -1/3),  phi = sin(k X) sin(k Y) sin(k Z),  k = pi/L
//! phi,XX = -k^2 phi,  phi,XY = k^2 cos(k X) cos(k Y) sin(k Z), and so on
//! b   = -Div P/rho0, since nothing moves
//! ```

use std::f64::consts::PI;

use mms_gallery::static_bulge_3d::{Parameters, prepare};
use mms_runtime::{Matrix, Vector};

use crate::rank_one::RankOne;
use crate::support::{NeoHookean, TOLERANCE, Values, assert_agree, generated, in_box};

#[test]
fn the_generated_bulge_is_the_bulge_on_paper() {
    let odd = Parameters::<f64> { length: 2.2, nu: 0.0, amplitude: 0.3, ..Parameters::default() };
    for parameters in [Parameters::default(), odd] {
        let Parameters { length, young, nu, rho0, amplitude } = parameters;
        let law = NeoHookean::of(young, nu);
        let k = PI / length;
        let by_hand = |at: [f64; 3], _| {
            let sin = at.map(|x| (k * x).sin());
            let cos = at.map(|x| (k * x).cos());
            // The product of sines, with the cosine along the axes that are differentiated once.
            let product = |once: &[usize]| -> f64 {
                (0..3)
                    .map(|axis| if once.contains(&axis) { cos[axis] } else { sin[axis] })
                    .product()
            };
            let motion = RankOne {
                direction: Vector::<f64, 3>::new(1.0, 0.5, -1.0 / 3.0) * amplitude,
                gradient: Vector::<f64, 3>::from_fn(|i, _| k * product(&[i])),
                hessian: Matrix::<f64, 3>::from_fn(|i, j| {
                    k * k * if i == j { -product(&[]) } else { product(&[i, j]) }
                }),
            };
            let force = -motion.divergence(&law) / rho0;
            Values::leading::<3>(motion.jacobian(), &motion.stress(&law), force.into())
        };
        let points = in_box([0.0; 3], [length; 3], [0.0, 1.0]);
        assert_agree(TOLERANCE, &points, generated!(prepare(&parameters)), by_hand);
    }
}
