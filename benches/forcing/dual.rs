//! Differentiation at run time: b from u and P alone, by hyper-dual numbers of num-dual.

use std::f64::consts::PI;

use num_dual::{DualNum, HyperDual64};

use crate::single::{Forcing, Single};
use crate::{COUNT, Case, Contender};

type Number = HyperDual64;

/// u at a place and a time.
type Displacement<const D: usize> = fn(&[f64], [Number; D], Number) -> [Number; D];

/// b = a - Div P/rho0 by Div P_i = mu Lap u_i + (lambda (1 - ln J) + mu) F^-1_Ji (ln J),J, with the first
/// and second derivatives of u from one hyper-dual evaluation for each pair of directions.
fn body_force<const D: usize>(
    displacement: Displacement<D>,
    parameters: &[f64],
    [lambda, mu, rho0]: [f64; 3],
    time: f64,
    place: [f64; D],
) -> [f64; D] {
    let at = |first: usize, second: usize| {
        let seeded = |axis: usize, value: f64| {
            let mut number = Number::from_re(value);
            number.eps1 = f64::from(u8::from(axis == first));
            number.eps2 = f64::from(u8::from(axis == second));
            number
        };
        let position = core::array::from_fn(|axis| seeded(axis, place[axis]));
        displacement(parameters, position, seeded(D, time))
    };
    let mut gradient = [[0.0; D]; D];
    let mut second = [[[0.0; D]; D]; D];
    let pairs = (0..D).flat_map(|first| (first..D).map(move |other| (first, other)));
    for (first, other) in pairs {
        for (i, u) in at(first, other).into_iter().enumerate() {
            second[i][first][other] = u.eps1eps2;
            second[i][other][first] = u.eps1eps2;
            gradient[i][first] = u.eps1;
        }
    }
    for (i, row) in gradient.iter_mut().enumerate() {
        row[i] += 1.0;
    }
    let (jacobian, inverse) = inverse(gradient);
    let pressure = lambda * (1.0 - jacobian.ln()) + mu;
    let slope: [f64; D] = core::array::from_fn(|axis| {
        (0..D)
            .flat_map(|m| (0..D).map(move |k| (m, k)))
            .map(|(m, k)| inverse[k][m] * second[m][k][axis])
            .sum()
    });
    let motion = at(D, D);
    core::array::from_fn(|i| {
        let laplacian: f64 = (0..D).map(|axis| second[i][axis][axis]).sum();
        let pushed: f64 = (0..D).map(|axis| inverse[axis][i] * slope[axis]).sum();
        motion[i].eps1eps2 - (mu * laplacian + pressure * pushed) / rho0
    })
}

/// Computes det F and F^-1.
fn inverse<const D: usize>(f: [[f64; D]; D]) -> (f64, [[f64; D]; D]) {
    let minor = |i: usize, j: usize| match D {
        1 => 1.0,
        2 => {
            let sign = if i == j { 1.0 } else { -1.0 };
            sign * f[1 - i][1 - j]
        }
        _ => {
            let (a, b) = ((i + 1) % 3, (i + 2) % 3);
            let (c, d) = ((j + 1) % 3, (j + 2) % 3);
            f[a][c] * f[b][d] - f[a][d] * f[b][c]
        }
    };
    let jacobian = (0..D).map(|j| f[0][j] * minor(0, j)).sum::<f64>();
    (jacobian, core::array::from_fn(|i| core::array::from_fn(|j| minor(j, i) / jacobian)))
}

fn bar(parameters: &[f64], [x]: [Number; 1], t: Number) -> [Number; 1] {
    let &[length, young, rho0, amplitude] = parameters else { unreachable!("four parameters") };
    let motion = (t * ((young / rho0).sqrt() * PI)).cos() * amplitude;
    [x * (Number::from_re(2.0 * length) - x) * motion / (length * length)]
}

fn waves(parameters: &[f64], place: [Number; 3], t: Number) -> [Number; 3] {
    let (c, amplitude) = (parameters[3], parameters[4]);
    core::array::from_fn(|i| {
        let phase = 2.0 * PI / 3.0 * i as f64;
        (place[i] * (2.0 * PI)).sin() * (t * (c * PI) + phase).sin() * amplitude
    })
}

fn vortex(_: &[f64], [x, y]: [Number; 2], t: Number) -> [Number; 2] {
    let d = (x * x + y * y).sqrt() - 1.0;
    let square = d * d;
    let angle = (t * PI).sin() * (square * square * 256.0 - square * 32.0 + 1.0);
    let (sine, cosine) = (angle.sin(), angle.cos());
    [x * cosine - y * sine - x, x * sine + y * cosine - y]
}

fn every_point<const D: usize>(
    displacement: Displacement<D>,
    parameters: &[f64],
    material: [f64; 3],
    time: f64,
    points: &[Vec<f64>],
    out: &mut [Vec<f64>],
) {
    for index in 0..COUNT {
        let place = core::array::from_fn(|axis| points[axis][index]);
        let b = body_force(displacement, parameters, material, time, place);
        for (column, value) in out.iter_mut().zip(b) {
            column[index] = value;
        }
    }
}

/// The contender for a field.
pub fn contender(case: &Case) -> Box<dyn Contender> {
    let forcing: Forcing = match case.name {
        "A" => |p, t, x, b| every_point(bar, p, [0.0, p[1] / 2.0, p[2]], t, x, b),
        "B" => |p, t, x, b| every_point(waves, p, [p[0], p[1], p[2]], t, x, b),
        _ => |p, t, x, b| every_point(vortex, p, [p[0], p[1], p[2]], t, x, b),
    };
    Single::contender("num-dual", case, forcing)
}
