//! Diagnosis of a law alone by its tangent at given F.
//!
//! The tangent is DDSDDE of Abaqus' UMAT: it maps the rate of deformation D, with engineering shears, to the Jaumann rate of
//! tau over J. Differences of tau give it for any law ([`slopes`](crate::slopes)).

use mms_runtime::{Matrix, Vector};

use crate::answer::Diagnosis;
use crate::exact::Exact;
use crate::hypothesis::{Change, Given, Hypothesis, Of, of_tangent, voigt_orders};
use crate::slopes::{Slopes, slopes};
use crate::smooth::size;
use crate::table::{Measure, to_round_off};

/// Tangents that a law gave.
#[derive(Clone, Debug)]
pub struct TangentTable<const D: usize> {
    /// X; only needed where moduli depend on it.
    pub reference: Vec<Vector<f64, D>>,
    /// H.
    pub gradient: Vec<Matrix<f64, D>>,
    /// The tangents row by row, of the components 11, 22, 12 or 11, 22, 33, 12, 13, 23.
    pub tangent: Vec<f64>,
    /// The uncertainty of each number, from how it was stored.
    pub rounding: f64,
}

/// The largest error of a right tangent, relative to its largest number: the error of differences of stresses in double
/// precision, which many laws use. The exact tangents here have errors of 1e-10.
const DIFFERENCES: f64 = 1e-6;

/// The components of Abaqus' vectors, in their order.
fn components(dimension: usize) -> &'static [[usize; 2]] {
    match dimension {
        1 => &[[0, 0]],
        2 => &[[0, 0], [1, 1], [0, 1]],
        _ => &[[0, 0], [1, 1], [2, 2], [0, 1], [0, 2], [1, 2]],
    }
}

/// The rows of a tangent, from the stress rate that it gives for a rate of deformation.
fn rows<const D: usize>(of: impl Fn(&Matrix<f64, D>) -> Matrix<f64, D>) -> Vec<f64> {
    let places = components(D);
    let columns: Vec<Matrix<f64, D>> = places
        .iter()
        .map(|&[k, l]| {
            let mut rate = Matrix::zeros();
            rate[(k, l)] += 0.5;
            rate[(l, k)] += 0.5;
            of(&rate)
        })
        .collect();
    let entries = |[i, j]: &[usize; 2]| columns.iter().map(|it| it[(*i, *j)]).collect::<Vec<_>>();
    places.iter().flat_map(entries).collect()
}

/// A tangent in space with permuted shear components.
fn reordered(tangent: &[f64], order: [usize; 3]) -> Vec<f64> {
    let at = |k: usize| if k < 3 { k } else { 3 + order[k - 3] };
    (0..36).map(|k| tangent[6 * at(k / 6) + at(k % 6)]).collect()
}

/// The slopes of tau at each H, changed by `change`. At small strain, the slopes of P as if F were I, because P does not rotate
/// with the body.
fn slopes_of<const D: usize>(
    exact: &Exact<'_, D>,
    table: &TangentTable<D>,
    at: &[Matrix<f64, D>],
    change: impl Fn(&[Matrix<f64, D>], &mut [Matrix<f64, D>]),
) -> Vec<Slopes<D>> {
    let tau = |gradient: &[Matrix<f64, D>]| {
        let mut tau = exact.stress(exact.domain.time[0], &table.reference, gradient);
        change(gradient, &mut tau);
        tau
    };
    if !exact.field.is_small_strain() {
        return slopes(at, tau);
    }
    slopes(&vec![Matrix::zeros(); at.len()], |more| {
        let gradient: Vec<_> = at.iter().zip(more).map(|(at, more)| at + more).collect();
        let first = tau(&gradient);
        let pairs = gradient.iter().zip(&first);
        pairs.map(|(h, tau)| Measure::FirstPiola.of(&(h + Matrix::identity()), tau)).collect()
    })
}

/// Diagnoses a law by its tangent. `None` if the exact tangent is not finite.
pub fn diagnose<const D: usize>(
    exact: &Exact<'_, D>,
    table: &TangentTable<D>,
    mut hypotheses: Vec<Hypothesis<D>>,
) -> Option<Diagnosis> {
    hypotheses.retain(|it| matches!(it.change, Change::Stress(Of::Law, _)));
    let hypotheses: Vec<Hypothesis<D>> =
        [of_tangent(), voigt_orders(), hypotheses].into_iter().flatten().collect();
    let still = vec![Matrix::zeros(); table.gradient.len()];
    let right_law = |_: &[Matrix<f64, D>], _: &mut [Matrix<f64, D>]| {};
    let all = slopes_of(exact, table, &table.gradient, right_law);
    let at_rest = slopes_of(exact, table, &still, right_law);
    let tangents = |all: &[Slopes<D>]| -> Vec<f64> {
        all.iter().flat_map(|at| rows(|rate| at.tangent(rate))).collect()
    };
    let right = tangents(&all);
    if right.iter().any(|it| !it.is_finite()) {
        return None;
    }
    let scale = size(&right).max(f64::MIN_POSITIVE);
    let off = |wrong: &[f64]| -> Vec<f64> {
        wrong.iter().zip(&right).map(|(wrong, right)| (wrong - right) / scale).collect()
    };
    let largest = right.iter().fold(0.0, |most: f64, it| most.max(it.abs()));
    let count = (right.len() as f64).sqrt();
    let floor = (table.rounding + DIFFERENCES * largest) * count / scale;
    let wrong = |hypothesis: &Hypothesis<D>, size: &[f64]| {
        off(&match &hypothesis.change {
            Change::Tangent(change) => {
                let pairs = all.iter().zip(&at_rest);
                pairs.flat_map(|(at, rest)| rows(|rate| change([at, rest], size, rate))).collect()
            }
            Change::Order(order) => {
                right.chunks_exact(36).flat_map(|it| reordered(it, *order)).collect()
            }
            Change::Stress(_, change) => {
                let (time, reference) = (exact.domain.time[0], &table.reference[..]);
                tangents(&slopes_of(exact, table, &table.gradient, |gradient, tau| {
                    change(&Given { exact, size, time, reference, gradient }, tau);
                }))
            }
            _ => right.clone(),
        })
    };
    Some(to_round_off(exact, &hypotheses, off(&table.tangent), floor, &wrong))
}
