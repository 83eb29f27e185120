//! Long waves: the growth of a disturbance of the exact motion over the window.
//!
//! At each time the growth rate follows from the least eigenvalue w^2 of the tangent about the exact state, on a coarse mesh of
//! the body with the field's constraints: exp(t sqrt(-w^2)) if it is negative. Loads are dead, coefficients frozen, and
//! unconstrained rigid motions are excluded.

use mms_codegen::compile::Compiled;

use crate::mesh::Mesh;
use crate::modes::Modes;
use crate::subject::Subject;

/// The number of times, evenly over the window, by dimension.
const TIMES: [usize; 3] = [17, 9, 5];
/// The factor by which there are more times where something grows.
const BETWEEN: usize = 2;

/// The fraction of (c/L)^2 by which an eigenvalue may be less than 0 and still counts as 0, with the shear wave speed c and the
/// size L of the body.
const ROUNDING: f64 = 1e-6;

/// The growth of a disturbance.
#[derive(Clone, Debug, PartialEq)]
pub struct Growth {
    /// The factor over the window; 1 if no disturbance grows.
    pub factor: f64,
    /// The least eigenvalue, 1/s^2.
    pub least: f64,
    /// The time of the least eigenvalue.
    pub time: f64,
    /// The number of elements along each axis.
    pub elements: Vec<usize>,
    /// The number of times.
    pub times: usize,
}

/// The growth over the window; `None` if no displacement is free, or a state is not finite.
pub fn growth<const D: usize>(compiled: &Compiled, subject: &mut Subject<'_, D>) -> Option<Growth> {
    let mesh = Mesh::new(compiled, &subject.chart);
    let modes = Modes::new(&mesh);
    if modes.free() == 0 {
        return None;
    }
    let window = subject.window[1] - subject.window[0];
    let intervals = if subject.is_static { 1 } else { TIMES[D - 1] - 1 };
    let mut rates = sampled(&modes, subject, intervals)?;
    if !subject.is_static && rates.iter().any(|rate| rate.square < 0.0) {
        rates = sampled(&modes, subject, BETWEEN * intervals)?;
    }
    let least = rates.iter().min_by(|a, b| a.square.total_cmp(&b.square))?;
    let exponent: f64 = rates
        .windows(2)
        .map(|pair| (pair[0].growing() + pair[1].growing()) / 2.0 * (pair[1].time - pair[0].time))
        .sum();
    let exponent = if subject.is_static { least.growing() * window } else { exponent };
    Some(Growth {
        factor: exponent.exp(),
        least: least.square,
        time: least.time,
        elements: mesh.elements.to_vec(),
        times: rates.len(),
    })
}

/// The least eigenvalue at a time.
struct Rate {
    time: f64,
    square: f64,
}

impl Rate {
    /// The growth rate of a disturbance, 1/s.
    fn growing(&self) -> f64 {
        (-self.square).max(0.0).sqrt()
    }
}

/// The least eigenvalues at the ends of equal intervals of the window; only at its start if the field is static.
fn sampled<const D: usize>(
    modes: &Modes<'_, D>,
    subject: &mut Subject<'_, D>,
    intervals: usize,
) -> Option<Vec<Rate>> {
    let last = if subject.is_static { 0 } else { intervals };
    (0..=last)
        .map(|index| {
            let time = subject.time(index as f64 / intervals as f64);
            let (square, natural) = least(modes, subject, time)?;
            let square = if square.abs() <= ROUNDING * natural { 0.0 } else { square };
            Some(Rate { time, square })
        })
        .collect()
}

/// The least eigenvalue, and its natural unit.
fn least<const D: usize>(
    modes: &Modes<'_, D>,
    subject: &mut Subject<'_, D>,
    time: f64,
) -> Option<(f64, f64)> {
    let pencil = modes.pencil(subject, time)?;
    let apart = modes.rigid(subject, time, &pencil);
    let middle = subject.state(&subject.chart.place(&[0.5; D]), time)?;
    let natural = middle.modulus / (middle.density * subject.chart.size().powi(2));
    Some((pencil.least(&apart, natural)?, natural))
}
