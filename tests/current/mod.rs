//! The current frame: x is the independent variable, and X is found from it.

use mms_mechanics::invariant::InvariantKind;
use mms_spec::quantity::Quantity;

use super::support::kernel::{Kernel, compiled, sample};
use super::{largest, rows, spreading};

/// The relative size of the last correction: rounding, enlarged by F^-1, may allow no smaller one, and the next would be its
/// square.
const NEGLIGIBLE: f64 = 1e-12;

/// The largest number of Newton iterations.
const ITERATIONS: usize = 50;

/// F = (I - grad_x u)^-1 and div sigma = dsigma_ij/dx_j, with central differences at fixed x, evaluated at the point X that
/// moves to x: the difference from the derivation must fall with the square of the step.
pub fn both_frames<K: Kernel>() {
    let points = sample(compiled(K::NAME), 16);
    let size = largest(points.iter().flat_map(|point| &point.coordinates).copied());
    let errors = |step: f64| {
        let at = points.iter().map(|point| differences::<K>(&point.coordinates, point.time, step));
        at.fold([[0.0_f64; 2]; 2], |worst, found| {
            [0, 1].map(|what| [0, 1].map(|k| worst[what][k].max(found[what][k])))
        })
    };
    let (coarse, fine) = (errors(size / 1024.0), errors(size / 2048.0));
    for (what, name) in ["F = (I - grad_x u)^-1", "div sigma = Div P / J"].iter().enumerate() {
        let ([coarse, scale], [fine, _]) = (coarse[what], fine[what]);
        // If the differences are exact, only the rounding of them and of Newton's method is left.
        if coarse > 1e-9 * scale {
            let order = (coarse / fine).log2();
            assert!((order - 2.0).abs() < 0.3, "{name}: {coarse:e}, then {fine:e}: order {order}");
        }
        assert!(fine <= 0.02 * scale, "{name}: the error is {fine:e}, the terms are {scale:e}");
    }
}

/// The error and the size of F, and of div sigma, at one point.
fn differences<K: Kernel>(at: &[f64], time: f64, step: f64) -> [[f64; 2]; 2] {
    let (dimension, width) = (K::DIMENSION, rows::<K>());
    let place = K::quantity(Quantity::Position, time, at);
    let mut gradient = vec![0.0; dimension * dimension];
    let mut divergence = vec![0.0; dimension];
    let mut parts = Vec::new();
    if width > dimension {
        // At small strain the radius is in the reference configuration.
        let radius = if compiled(K::NAME).model.kind == InvariantKind::SmallStrain {
            at[0]
        } else {
            place[0]
        };
        divergence = spreading(&K::quantity(Quantity::CauchyStress, time, at), radius).to_vec();
        parts.extend_from_slice(&divergence);
    }
    // At small strain the divergence of sigma is over X.
    let is_small = compiled(K::NAME).model.kind == InvariantKind::SmallStrain;
    for axis in 0..dimension {
        let beside = |sign: f64| {
            let mut shifted = place.clone();
            shifted[axis] += sign * step;
            let reference = invert::<K>(&shifted, at, time);
            let mut beside = at.to_vec();
            beside[axis] += sign * step;
            let stressed = if is_small { &beside } else { &reference };
            (
                K::quantity(Quantity::Displacement, time, &reference),
                K::quantity(Quantity::CauchyStress, time, stressed),
            )
        };
        let (ahead, behind) = (beside(1.0), beside(-1.0));
        for (row, divergence) in divergence.iter_mut().enumerate() {
            gradient[row * dimension + axis] = (ahead.0[row] - behind.0[row]) / (2.0 * step);
            let k = row * width + axis;
            let slope = (ahead.1[k] - behind.1[k]) / (2.0 * step);
            *divergence += slope;
            parts.push(slope);
        }
    }
    let deformation = of_coordinates::<K>(&K::quantity(Quantity::DeformationGradient, time, at));
    // F (I - grad_x u) - I, so that no matrix is inverted.
    let residual = (0..dimension * dimension).map(|k| {
        let (row, column) = (k / dimension, k % dimension);
        let product: f64 = (0..dimension)
            .map(|j| {
                let inner = f64::from(j == column) - gradient[j * dimension + column];
                deformation[row * dimension + j] * inner
            })
            .sum();
        product - f64::from(row == column)
    });
    let derived = K::quantity(Quantity::DivSigma, time, at);
    let errors = derived.iter().zip(&divergence).map(|(derived, found)| derived - found);
    let scale = largest(parts.into_iter().chain(derived.clone()));
    [[largest(residual), largest(deformation.clone())], [largest(errors), scale]]
}

/// The components of a tensor along the coordinates: all but those around the axis of an axisymmetric field.
fn of_coordinates<K: Kernel>(tensor: &[f64]) -> Vec<f64> {
    let kept = tensor.chunks_exact(rows::<K>()).take(K::DIMENSION);
    kept.flat_map(|row| &row[..K::DIMENSION]).copied().collect()
}

/// X with X + u(X, t) = x, by Newton's method from `start`.
fn invert<K: Kernel>(place: &[f64], start: &[f64], time: f64) -> Vec<f64> {
    let mut reference = start.to_vec();
    for _ in 0..ITERATIONS {
        let reached = K::quantity(Quantity::Position, time, &reference);
        let missing: Vec<f64> = place.iter().zip(&reached).map(|(x, found)| x - found).collect();
        let gradient = K::quantity(Quantity::DeformationGradient, time, &reference);
        let gradient = of_coordinates::<K>(&gradient);
        let correction = solve(gradient, missing);
        let size = largest(place.iter().copied());
        let is_found = largest(correction.iter().copied()) <= NEGLIGIBLE * size;
        for (coordinate, correction) in reference.iter_mut().zip(correction) {
            *coordinate += correction;
        }
        if is_found {
            return reference;
        }
    }
    panic!("no X moves to {place:?} at t = {time}: {reference:?}");
}

/// The solution of a few linear equations, by Gauss-Jordan elimination with pivots.
fn solve(mut matrix: Vec<f64>, mut right: Vec<f64>) -> Vec<f64> {
    let count = right.len();
    for column in 0..count {
        let pivot = (column..count)
            .max_by(|a, b| {
                let size = |row: usize| matrix[row * count + column].abs();
                size(*a).total_cmp(&size(*b))
            })
            .expect("a row");
        for k in 0..count {
            matrix.swap(pivot * count + k, column * count + k);
        }
        right.swap(pivot, column);
        for row in (0..count).filter(|row| *row != column) {
            let factor = matrix[row * count + column] / matrix[column * count + column];
            for k in column..count {
                matrix[row * count + k] -= factor * matrix[column * count + k];
            }
            right[row] -= factor * right[column];
        }
    }
    (0..count).map(|row| right[row] / matrix[row * count + row]).collect()
}
