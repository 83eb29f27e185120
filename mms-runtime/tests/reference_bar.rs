//! A second opinion: the bar with contiguous-particle GIMP and leapfrog as one plain 1-D program that shares no code with the
//! runtime, and computes the same errors.

use crate::common::{Bar, levels};
use mms_runtime::Method;

/// Bardenhagen & Kober's weight and gradient at distance x from a node, l <= h/2, case by case.
fn weight(x: f64, l: f64, h: f64) -> (f64, f64) {
    let (r, sign) = (x.abs(), x.signum());
    if r < l {
        (1.0 - (x * x + l * l) / (2.0 * h * l), -x / (h * l))
    } else if r <= h - l {
        (1.0 - r / h, -sign / h)
    } else if r < h + l {
        ((h + l - r).powi(2) / (4.0 * h * l), -sign * (h + l - r) / (2.0 * h * l))
    } else {
        (0.0, 0.0)
    }
}

/// l1, l2 and linf of E = 1e6, rho0 = 1e3, L = 1, a = 0.2, t = 0 .. 2 L/c, Courant number 0.4.
fn plain_bar(cells: usize) -> [f64; 3] {
    let (young, rho0, a) = (1e6_f64, 1e3, 0.2);
    let c = (young / rho0).sqrt();
    let omega = c * std::f64::consts::PI;
    let h = 1.0 / cells as f64;
    let steps = 5 * cells;
    let dt = 2.0 / c / steps as f64;
    let shape = |x: f64| x * (2.0 - x);

    // Particles: X, x, v, F. Node i is at (i - 1) h: the wall is node 1, its ghost node 0.
    let n = 2 * cells;
    let l0 = h / 4.0;
    let xx: Vec<f64> = (0..n).map(|p| (2 * p + 1) as f64 * l0).collect();
    let mut x: Vec<f64> = xx.iter().map(|&xx| xx + shape(xx) * a).collect();
    let mut v = vec![0.0; n];
    let mut f: Vec<f64> = xx.iter().map(|&xx| 1.0 + 2.0 * (1.0 - xx) * a).collect();
    let m = rho0 * 2.0 * l0;
    let nodes = cells + cells / 2 + 4;
    let mut worst = [0.0_f64; 3];

    for step in 0..=steps {
        let amplitude = a * (omega * step as f64 * dt).cos();
        let mut now = [0.0_f64; 3];
        for p in 0..n {
            let error = ((x[p] - xx[p]) - shape(xx[p]) * amplitude).abs();
            now = [now[0] + error, now[1] + error * error, now[2].max(error)];
        }
        let now = [now[0] / n as f64, (now[1] / n as f64).sqrt(), now[2]];
        worst = std::array::from_fn(|k| worst[k].max(now[k]));

        let mut mass = vec![0.0; nodes];
        let mut momentum = vec![0.0; nodes];
        let mut force = vec![0.0; nodes];
        let near = |x: f64| {
            let first = (x / h) as usize; // the node before the particle's cell
            first..(first + 4).min(nodes)
        };
        let node = |i: usize| (i as f64 - 1.0) * h;
        for p in 0..n {
            let exact_f = 1.0 + 2.0 * (1.0 - xx[p]) * amplitude;
            let b = -omega * omega * amplitude * shape(xx[p])
                + young / rho0 * (1.0 + 1.0 / (exact_f * exact_f)) * amplitude;
            let cauchy = young / 2.0 * (f[p] - 1.0 / f[p]);
            for i in near(x[p]) {
                let (w, dw) = weight(x[p] - node(i), l0 * f[p], h);
                mass[i] += w * m;
                momentum[i] += w * m * v[p];
                force[i] += w * m * b - 2.0 * l0 * f[p] * cauchy * dw;
            }
        }
        mass[2] += mass[0];
        momentum[2] -= momentum[0];
        force[2] -= force[0];
        let kick = if step == 0 { dt / 2.0 } else { dt };
        let mut acceleration = vec![0.0; nodes];
        let mut velocity = vec![0.0; nodes];
        for i in 2..nodes {
            if mass[i] > 1e-25 * m {
                acceleration[i] = force[i] / mass[i];
                velocity[i] = momentum[i] / mass[i] + kick * acceleration[i];
            }
        }
        (acceleration[0], velocity[0]) = (-acceleration[2], -velocity[2]);
        for p in 0..n {
            let (mut dx, mut dv, mut gradient) = (0.0, 0.0, 0.0);
            for i in near(x[p]) {
                let (w, dw) = weight(x[p] - node(i), l0 * f[p], h);
                dx += w * velocity[i];
                dv += w * acceleration[i];
                gradient += dw * velocity[i];
            }
            x[p] += dt * dx;
            v[p] += kick * dv;
            f[p] *= 1.0 + dt * gradient;
        }
    }
    worst
}

#[test]
fn plain_program_gives_the_same_errors() {
    let cells = [8, 16, 32, 64];
    for (level, &cells) in
        levels::<f64, 1>(&Bar::default(), &Method::default(), &cells).iter().zip(&cells)
    {
        let errors = level.errors.as_ref().unwrap();
        for (error, plain) in [errors.l1, errors.l2, errors.linf].iter().zip(plain_bar(cells)) {
            assert!((error / plain - 1.0).abs() < 1e-10, "{cells} cells: {error:e}, {plain:e}");
        }
    }
}
