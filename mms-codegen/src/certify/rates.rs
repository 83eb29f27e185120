//! How far, how fast and how stiffly a field deforms: bounds of the principal stretch, of the strain
//! rate and of the wave speed over the domain.

use std::collections::BTreeMap;

use mms_math::Scalar as _;

use super::chart::{Chart, Run};
use super::enclosure::Formulas;
use super::matrix::{largest_acoustic, largest_eigenvalue};
use super::motion::Motion;
use super::search::{Found, Measure, largest};
use crate::expr::Graph;
use crate::mechanics::Response;
use crate::program::Output;
use crate::program::dual::Dual;
use crate::program::interpret::Number as _;
use crate::program::interval::Interval;
use crate::program::schedule::schedule_plainly;

/// A bound that exceeds a value by no more than this part of it is sharp enough.
const SHARPNESS: f64 = 0.1;

/// No state of the field exceeds these.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rates {
    /// The largest principal stretch.
    pub principal_stretch: f64,
    /// The norm of the rate of deformation D = sym(dF/dt F^-1), 1/s.
    pub strain_rate: f64,
    /// The speed of waves in the reference configuration, m/s of X.
    pub reference_wave_speed: f64,
}

impl Rates {
    /// The speed of waves in the deformed body: no stretch carries them farther.
    pub fn wave_speed(&self) -> f64 {
        self.reference_wave_speed * self.principal_stretch
    }

    /// No wave crosses a cell in a time step of less than this times the cell size, whether the
    /// cells lie in the reference or in the deformed body.
    pub fn time_step_per_cell_size(&self) -> f64 {
        1.0 / self.wave_speed().max(self.reference_wave_speed)
    }
}

/// Bounds all three, with at most `limit` cells each, and says how many there were.
pub fn bound(graph: &mut Graph, chart: &Chart, motion: &Motion, limit: usize) -> (Rates, usize) {
    let dimension = motion.dimension();
    let right = &motion.right;
    let stretch = Formulas::new(graph, chart, right);
    let stretch = search(chart, &stretch, limit, |values, _| {
        largest_eigenvalue(&with_identity(values, dimension)).sqrt()
    });
    let rate = [right.as_slice(), &motion.right_rate, &[motion.jacobian]].concat();
    let rate = Formulas::new(graph, chart, &rate);
    let rate = search(chart, &rate, limit, |values, _| strain_rate(values, dimension));
    let state = [motion.gradient.as_slice(), &[motion.density]].concat();
    let state = Formulas::new(graph, chart, &state);
    let stress = BTreeMap::from([(STRESS, motion.stress.clone())]);
    let stress = schedule_plainly(graph, &stress);
    let mut stress = chart.run(&stress);
    let speed =
        search(chart, &state, limit, |values, place| wave_speed(&mut stress, values, place));
    // The dimensions that a field lacks are not stretched.
    let missing = if dimension < 3 { 1.0 } else { 0.0 };
    let rates = Rates {
        principal_stretch: stretch.bound.max(missing),
        strain_rate: rate.bound,
        reference_wave_speed: speed.bound,
    };
    (rates, stretch.cells + rate.cells + speed.cells)
}

const STRESS: Output = Output::Response(Response::FirstPiolaKirchhoff);

/// Bounds a measure of formulas: in a cell from bounds of the formulas, and at its centre from their
/// values there.
fn search(
    chart: &Chart,
    formulas: &Formulas,
    limit: usize,
    mut measure: impl FnMut(&[Interval], &[Interval]) -> f64,
) -> Found {
    let mut bounds = formulas.run::<Interval>(chart);
    let enough = |bound: f64, value: f64| bound <= value * (1.0 + SHARPNESS);
    largest(chart.variables().len(), limit, enough, |cell| {
        let place = chart.place(&cell.0);
        let enclosure = bounds.enclose(&place);
        let bound = measure(&enclosure.values, &place);
        let at = cell.centre();
        let centre: Vec<Interval> = at.iter().map(|it| Interval::from_f64(*it)).collect();
        let centre = chart.place(&centre);
        let attained = measure(&bounds.values(&centre), &centre);
        Measure {
            bound: if bound.is_nan() { f64::INFINITY } else { bound },
            attained: if attained.is_finite() { attained } else { f64::NEG_INFINITY },
            split: cell.steepest(&enclosure.changes(&place)),
            at,
        }
    })
}

/// C from C - I.
fn with_identity(right: &[Interval], dimension: usize) -> Vec<Interval> {
    let mut right = right.to_vec();
    for axis in 0..dimension {
        let entry = &mut right[axis * dimension + axis];
        *entry = *entry + Interval::from_f64(1.0);
    }
    right
}

/// |D| from C - I, dC/dt and J: with M = C^-1 dC/dt, D = F^-T (dC/dt) F^-1 / 2 and
/// D : D = tr (M M)/4 (Holzapfel, Nonlinear Solid Mechanics, 2000, section 2.7).
fn strain_rate(values: &[Interval], dimension: usize) -> f64 {
    let order = dimension * dimension;
    let right = with_identity(&values[..order], dimension);
    let (rate, jacobian) = (&values[order..2 * order], values[2 * order]);
    let adjugate = adjugate(&right, dimension);
    let zero = Interval::from_f64(0.0);
    let mut trace = zero;
    let product: Vec<Interval> = (0..order)
        .map(|at| {
            let (row, column) = (at / dimension, at % dimension);
            (0..dimension).fold(zero, |sum, k| {
                sum + adjugate[row * dimension + k] * rate[k * dimension + column]
            })
        })
        .collect();
    for row in 0..dimension {
        for column in 0..dimension {
            let (here, there) = (row * dimension + column, column * dimension + row);
            let term = if here == there {
                product[here].square()
            } else {
                product[here] * product[there]
            };
            trace = trace + term;
        }
    }
    let squared = trace / jacobian.square().square() / Interval::from_f64(4.0);
    if squared.is_defined() { squared.upper().max(0.0).sqrt().next_up() } else { f64::INFINITY }
}

/// The matrix of cofactors of a symmetric matrix.
fn adjugate(matrix: &[Interval], dimension: usize) -> Vec<Interval> {
    let at = |row: usize, column: usize| matrix[row % dimension * dimension + column % dimension];
    let entry = |row: usize, column: usize| match dimension {
        1 => Interval::from_f64(1.0),
        2 if row == column => at(row + 1, column + 1),
        2 => -at(row, column),
        _ => {
            at(row + 1, column + 1) * at(row + 2, column + 2)
                - at(row + 1, column + 2) * at(row + 2, column + 1)
        }
    };
    (0..matrix.len()).map(|k| entry(k / dimension, k % dimension)).collect()
}

/// The fastest wave from H and rho0: the largest eigenvalue of all acoustic tensors over rho0, with
/// dP/dF from dual numbers.
fn wave_speed(stress: &mut Run<'_, Dual<Interval>>, values: &[Interval], place: &[Interval]) -> f64 {
    let Some((density, gradient)) = values.split_last() else { return f64::INFINITY };
    let order = gradient.len();
    let place: Vec<_> = place.iter().map(|side| Dual::constant(*side)).collect();
    let mut gradient: Vec<_> = gradient.iter().map(|entry| Dual::constant(*entry)).collect();
    let mut tangent = vec![Interval::UNDEFINED; order * order];
    for column in 0..order {
        gradient[column].slope = Interval::from_f64(1.0);
        let components = stress.at(&place, &gradient, &[STRESS]).swap_remove(0);
        for (row, component) in components.iter().enumerate() {
            tangent[row * order + column] = component.slope;
        }
        gradient[column].slope = Interval::from_f64(0.0);
    }
    if !density.is_defined() || density.lower() <= 0.0 {
        return f64::INFINITY;
    }
    let modulus = largest_acoustic(&tangent).max(0.0);
    (modulus / density.lower()).sqrt() * (1.0 + f64::EPSILON)
}
