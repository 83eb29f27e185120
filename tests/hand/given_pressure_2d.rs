//! A square of incompressible material whose pressure is given, derived by hand.
//!
//! ```text
//! u = (A sin(k X) cos(k Y), -A cos(k X) sin(k Y)),  A = a cos(w t),  w = k c
//! p = p0 cos(k X) cos(k Y) sin(w t)
//! P = mu F - p cof F,  Div P = mu Lap u - cof F grad p   (Div cof F = 0, Piola)
//! ```

use std::f64::consts::PI;

use mms_gallery::given_pressure_2d::{Parameters, prepare};

use crate::plane::{Strained, cosine, sine};
use crate::support::{TOLERANCE, assert_agree, generated, in_box};

#[test]
fn the_generated_square_is_the_square_on_paper() {
    let odd = Parameters::<f64> { length: 0.7, amplitude: 0.08, p0: -3e5, ..Parameters::default() };
    for parameters in [Parameters::default(), odd] {
        let Parameters { length, mu, rho0, amplitude, p0 } = parameters;
        let (k, c) = (PI / length, (mu / rho0).sqrt());
        let w = k * c;
        let strained = |[x, y]: [f64; 2], t: f64| {
            let size = amplitude * (w * t).cos();
            let profiles = [[sine(k, x), cosine(k, y)], [cosine(k, x), sine(k, y)]];
            Strained::product([size, -size], profiles)
        };
        let pressure = |[x, y]: [f64; 2], t: f64| {
            let ([cx, sx, _], [cy, sy, _]) = (cosine(k, x), cosine(k, y));
            let size = p0 * (w * t).sin();
            (size * cx * cy, [size * sx * cy, size * cx * sy])
        };
        let by_hand = |at: [f64; 2], t: f64| {
            let (strained, (p, slope)) = (strained(at, t), pressure(at, t));
            let solid = strained.solid(mu, [0.0; 2], -p, slope.map(|it| -it));
            let acceleration = strained.displacement.map(|u| -w * w * u);
            solid.values(strained.jacobian(), acceleration, rho0)
        };
        let points = in_box([0.0; 2], [length; 2], [0.0, length / (2.0 * c)]);
        let field = prepare(&parameters);
        assert_agree(TOLERANCE, &points, generated!(field), by_hand);
        for (x, t) in points {
            let (at, (p, slope)) = (field.at_time(t), pressure(x, t));
            assert!((at.p(x) - p).abs() <= TOLERANCE * p0.abs());
            for (found, expected) in at.p_gradient(x).into_iter().zip(slope) {
                assert!((found - expected).abs() <= TOLERANCE * p0.abs() * k);
            }
            let volume = strained(x, t).jacobian() - 1.0;
            assert!((at.volume_residual(x) - volume).abs() <= TOLERANCE);
        }
    }
}
