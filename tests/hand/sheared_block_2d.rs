//! A block on a fixed base, sheared by tractions; F and its slopes derived by hand, Div P by the
//! product rule on P = mu F + (lambda ln J - mu) F^-T (`support.rs`).
//!
//! ```text
//! u_x = A Y/L (1 + X/(2 L)),  u_y = -B X Y^2/L^3
//! A   = a cos(w t),  B = a/2 sin(w t + pi/4),  w = c pi/L,  A'' = -w^2 A,  B'' = -w^2 B
//! F   = [1 + A Y/(2 L^2), A/L (1 + X/(2 L)); -B Y^2/L^3, 1 - 2 B X Y/L^3]
//! F,X = [0, A/(2 L^2); 0, -2 B Y/L^3],  F,Y = [A/(2 L^2), 0; -2 B Y/L^3, -2 B X/L^3]
//! ```

use std::f64::consts::PI;

use mms_gallery::sheared_block_2d::{Parameters, prepare};
use mms_runtime::Matrix;

use crate::support::{NeoHookean, TOLERANCE, Values, assert_agree, generated, in_box};

/// A tensor of plane strain in three dimensions.
fn plane(xx: f64, xy: f64, yx: f64, yy: f64, zz: f64) -> Matrix<f64, 3> {
    Matrix::<f64, 3>::new(xx, xy, 0.0, yx, yy, 0.0, 0.0, 0.0, zz)
}

#[test]
fn the_generated_block_is_the_block_on_paper() {
    let odd = Parameters::<f64> { length: 1.6, nu: 0.4, amplitude: -0.3, ..Parameters::default() };
    for parameters in [Parameters::default(), odd] {
        let Parameters { length, young, nu, rho0, amplitude } = parameters;
        let law = NeoHookean::of(young, nu);
        let c = (young / rho0).sqrt();
        let w = c * PI / length;
        let by_hand = |[x, y]: [f64; 2], t: f64| {
            let a = amplitude * (w * t).cos();
            let b = amplitude / 2.0 * (w * t + PI / 4.0).sin() / length.powi(3);
            let [lean, stretch] = [a / length, a / (2.0 * length * length)];
            let u = [lean * y + stretch * x * y, -b * x * y * y];
            let f = plane(
                1.0 + stretch * y,
                lean + stretch * x,
                -b * y * y,
                1.0 - 2.0 * b * x * y,
                1.0,
            );
            let along_x = plane(0.0, stretch, 0.0, -2.0 * b * y, 0.0);
            let along_y = plane(stretch, 0.0, -2.0 * b * y, -2.0 * b * x, 0.0);
            let div_p = law.divergence(&f, &[along_x, along_y, Matrix::zeros()]);
            let force = [0, 1].map(|row| -w * w * u[row] - div_p[row] / rho0);
            let force = [force[0], force[1], 0.0];
            Values::leading::<2>(f.determinant(), &law.stress(&f), force)
        };
        let points = in_box([0.0; 2], [length; 2], [0.0, 2.0 * length / c]);
        assert_agree(TOLERANCE, &points, generated!(prepare(&parameters)), by_hand);
    }
}

#[test]
fn its_sides_carry_tractions() {
    let parameters = Parameters::default();
    let field = prepare(&parameters);
    let mut largest = [0.0_f64; 3];
    for ([x, _], t) in in_box([0.0; 2], [parameters.length; 2], [0.0, 0.06]) {
        let sides = [([0.0, x], [-1.0, 0.0]), ([1.0, x], [1.0, 0.0]), ([x, 1.0], [0.0, 1.0])];
        for (largest, (point, normal)) in largest.iter_mut().zip(sides) {
            let traction = field.at_time(t).traction(point, normal);
            *largest = largest.max(traction[0].hypot(traction[1]));
        }
    }
    assert!(largest.iter().all(|largest| *largest > 0.01 * parameters.young), "{largest:?}");
}
