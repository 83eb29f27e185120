//! b derived on paper from the structure of each field, typed with care: terms in time are computed once,
//! points one at a time, with the standard library's functions.

use std::f64::consts::PI;

use crate::single::Single;
use crate::{COUNT, Case, Contender};

/// b = K (1 + F^-2 + pi^2 X (X - 2L)), K = E A/(rho0 L^2), for A'' = -(E/rho0) pi^2 A.
fn bar(parameters: &[f64], time: f64, points: &[Vec<f64>], out: &mut [Vec<f64>]) {
    let &[length, young, rho0, amplitude] = parameters else { unreachable!("four parameters") };
    let motion = amplitude * ((young / rho0).sqrt() * PI * time).cos();
    let (scale, slope) =
        (young * motion / (rho0 * length * length), 2.0 * motion / (length * length));
    for (b, x) in out[0].iter_mut().zip(&points[0]) {
        let stretch = 1.0 + slope * (length - x);
        *b = scale * (1.0 + 1.0 / (stretch * stretch) + PI * PI * x * (x - 2.0 * length));
    }
}

/// b_i = u_i (-(c pi)^2 + 4 pi^2/rho0 (mu + (lambda (1 - ln J) + mu) / F_i^2)).
fn waves(parameters: &[f64], time: f64, points: &[Vec<f64>], out: &mut [Vec<f64>]) {
    let &[lambda, mu, rho0, c, amplitude] = parameters else { unreachable!("five parameters") };
    let heights: [f64; 3] =
        core::array::from_fn(|i| amplitude * (c * PI * time + 2.0 * PI / 3.0 * i as f64).sin());
    let (inertia, stiffness) = ((c * PI) * (c * PI), 4.0 * PI * PI / rho0);
    for index in 0..COUNT {
        let angles: [f64; 3] = core::array::from_fn(|i| 2.0 * PI * points[i][index]);
        let stretch: [f64; 3] =
            core::array::from_fn(|i| 1.0 + 2.0 * PI * heights[i] * angles[i].cos());
        let pressure = lambda * (1.0 - (stretch[0] * stretch[1] * stretch[2]).ln()) + mu;
        for i in 0..3 {
            let elastic = stiffness * (mu + pressure / (stretch[i] * stretch[i]));
            out[i][index] = heights[i] * angles[i].sin() * (elastic - inertia);
        }
    }
}

/// b = Rot(g h) (c1 X + c2 X_perp) with d = R - 1, w = 1 - 16 d^2, h = w^2, m = mu/rho0,
/// c1 = h (256 m g^2 (1 - w) - g'^2 h), c2 = g'' h - m g (128 - 384 w + 192 w/R).
fn vortex(parameters: &[f64], time: f64, points: &[Vec<f64>], out: &mut [Vec<f64>]) {
    let &[_, mu, rho0] = parameters else { unreachable!("three parameters") };
    let (g, rate, m) = ((PI * time).sin(), PI * (PI * time).cos(), mu / rho0);
    for index in 0..COUNT {
        let (x, y) = (points[0][index], points[1][index]);
        let radius = (x * x + y * y).sqrt();
        let d = radius - 1.0;
        let w = 1.0 - 16.0 * d * d;
        let h = w * w;
        let along = h * (256.0 * m * g * g * (1.0 - w) - rate * rate * h);
        let across = -PI * PI * g * h - m * g * (128.0 - 384.0 * w + 192.0 * w / radius);
        let (sine, cosine) = (g * h).sin_cos();
        let (first, second) = (along * x - across * y, along * y + across * x);
        out[0][index] = cosine * first - sine * second;
        out[1][index] = sine * first + cosine * second;
    }
}

/// The contender for a field.
pub fn contender(case: &Case) -> Box<dyn Contender> {
    let forcing = match case.name {
        "A" => bar,
        "B" => waves,
        _ => vortex,
    };
    Single::contender("hand-derived", case, forcing)
}
