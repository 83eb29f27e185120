//! How far, how fast and how stiffly a field deforms: bounds of the principal stretch, of the strain
//! rate and of the wave speed over the domain.

use std::collections::BTreeMap;

use mms_math::Scalar as _;

use super::chart::{Chart, Run};
use super::enclosure::Formulas;
use super::matrix::{eigenvalues, largest_acoustic, largest_eigenvalue, largest_relative_rate};
use super::motion::Motion;
use super::search::{Found, Measure, largest};
use crate::expr::Graph;
use crate::mechanics::Response;
use crate::program::Output;
use crate::program::dual::Dual;
use crate::program::interpret::Number;
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

/// Bounds all three where J is at least `jacobian`, with at most `limit` cells each, and says how
/// many there were.
pub fn bound(
    graph: &mut Graph,
    chart: &Chart,
    motion: &Motion,
    jacobian: f64,
    limit: usize,
) -> (Rates, usize) {
    let dimension = motion.dimension();
    let right = &motion.right;
    let stretch = Formulas::new(graph, chart, right);
    let shape = |values: &[Interval]| with_identity(values, dimension);
    let squeeze = search(chart, &stretch, limit, |values, _| {
        let least = eigenvalues(&shape(values)).into_iter().map(Interval::lower);
        match least.fold(f64::INFINITY, f64::min) {
            least if least > 0.0 => 1.0 / least.sqrt().next_down(),
            _ => f64::INFINITY,
        }
    });
    let stretch =
        search(chart, &stretch, limit, |values, _| largest_eigenvalue(&shape(values)).sqrt());
    let rate = [right.as_slice(), &motion.right_rate].concat();
    let rate = Formulas::new(graph, chart, &rate);
    // J is the product of the principal stretches.
    let least = jacobian / stretch.bound.powi(dimension as i32 - 1);
    let least = least.max(1.0 / squeeze.bound) * (1.0 - 1e-9);
    let stretches = Interval::new(least, stretch.bound);
    let rate = search(chart, &rate, limit, |values, _| {
        let (right, rate) = values.split_at(dimension * dimension);
        let right = shape(right);
        // D : D = tr (C^-1 dC/dt)^2 / 4 (Holzapfel, Nonlinear Solid Mechanics, 2000, section 2.7).
        largest_relative_rate(&right, rate, stretches.square().lower()) / 2.0
    });
    let state = motion.gradient.as_ref().unwrap_or(right);
    let state = [state.as_slice(), &[motion.density]].concat();
    let state = Formulas::new(graph, chart, &state);
    let stress = BTreeMap::from([(STRESS, motion.stress.clone())]);
    let stress = schedule_plainly(graph, &stress);
    let mut tangent = Tangent { first: chart.run(&stress), second: chart.run(&stress) };
    let speed = search(chart, &state, limit, |values, place| {
        let Some((density, state)) = values.split_last() else { return f64::INFINITY };
        let gradient = match motion.gradient {
            Some(_) => state.to_vec(),
            None => principal_gradient(&shape(state), stretches),
        };
        wave_speed(&tangent.enclose(&gradient, place), *density)
    });
    // The dimensions that a field lacks are not stretched.
    let missing = if dimension < 3 { 1.0 } else { 0.0 };
    let rates = Rates {
        principal_stretch: stretch.bound.max(missing),
        strain_rate: rate.bound,
        reference_wave_speed: speed.bound,
    };
    (rates, squeeze.cells + stretch.cells + rate.cells + speed.cells)
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
            split: cell.steepest(&chart.changes(cell, &place, &enclosure.slopes)),
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

/// The principal stretches less 1, as a gradient: with a material that sees nothing but them, a
/// state in its principal axes.
fn principal_gradient(right: &[Interval], stretches: Interval) -> Vec<Interval> {
    let dimension = right.len().isqrt();
    let mut gradient = vec![Interval::from_f64(0.0); right.len()];
    for (axis, square) in eigenvalues(right).into_iter().enumerate() {
        let stretch = square.meet(stretches.square()).sqrt().meet(stretches);
        gradient[axis * dimension + axis] = stretch - Interval::from_f64(1.0);
    }
    gradient
}

/// The fastest wave: the largest eigenvalue of all acoustic tensors, over rho0.
fn wave_speed(tangent: &[Interval], density: Interval) -> f64 {
    if !density.is_defined() || density.lower() <= 0.0 {
        return f64::INFINITY;
    }
    let modulus = largest_acoustic(tangent).max(0.0);
    (modulus / density.lower()).sqrt() * (1.0 + f64::EPSILON)
}

/// dP/dF, by dual numbers, and its own derivatives by dual numbers of these.
struct Tangent<'a> {
    first: Run<'a, Dual<Interval>>,
    second: Run<'a, Dual<Dual<Interval>>>,
}

/// By so many entries of H at most, dP/dF is differentiated: beyond, that does not pay.
const DIRECTIONS: usize = 4;

impl Tangent<'_> {
    /// dP_iJ/dH_kL, row-major in (i, J) and (k, L), over a box: the bounds of interval arithmetic,
    /// and within them those of the mean-value form.
    fn enclose(&mut self, gradient: &[Interval], place: &[Interval]) -> Vec<Interval> {
        let mut tangent = self.natural(gradient, place);
        let varies = |entry: &usize| gradient[*entry].width() > 0.0;
        let directions: Vec<usize> = (0..gradient.len()).filter(varies).collect();
        let whole = tangent.iter().all(|entry| entry.is_defined());
        if directions.is_empty() || directions.len() > DIRECTIONS || !whole {
            return tangent;
        }
        let middle = |entry: &Interval| Interval::from_f64(entry.middle());
        let centre: Vec<Interval> = gradient.iter().map(middle).collect();
        let mut form = self.natural(&centre, place);
        for direction in directions {
            let slopes = self.slopes(gradient, place, direction);
            let side = gradient[direction] - centre[direction];
            for (entry, slope) in form.iter_mut().zip(slopes) {
                *entry = *entry + slope * side;
            }
        }
        tangent.iter_mut().zip(form).for_each(|(entry, form)| *entry = entry.meet(form));
        tangent
    }

    fn natural(&mut self, gradient: &[Interval], place: &[Interval]) -> Vec<Interval> {
        let place: Vec<_> = place.iter().copied().map(Dual::constant).collect();
        columns(gradient.len(), |column| {
            let unit = |entry: usize| Interval::from_f64(f64::from(u8::from(entry == column)));
            let gradient = gradient.iter().enumerate();
            let gradient: Vec<_> =
                gradient.map(|(entry, value)| Dual { value: *value, slope: unit(entry) }).collect();
            let stress =
                self.first.at(&place, [&[volume(&gradient)], &gradient], &[STRESS]).swap_remove(0);
            stress.into_iter().map(|component| component.slope).collect()
        })
    }

    /// The derivative of dP/dH by one entry of H.
    fn slopes(
        &mut self,
        gradient: &[Interval],
        place: &[Interval],
        direction: usize,
    ) -> Vec<Interval> {
        let place: Vec<_> =
            place.iter().map(|side| Dual::constant(Dual::constant(*side))).collect();
        columns(gradient.len(), |column| {
            let unit =
                |entry: usize, at: usize| Interval::from_f64(f64::from(u8::from(entry == at)));
            let gradient = gradient.iter().enumerate().map(|(entry, value)| Dual {
                value: Dual { value: *value, slope: unit(entry, direction) },
                slope: Dual::constant(unit(entry, column)),
            });
            let gradient: Vec<_> = gradient.collect();
            let stress =
                self.second.at(&place, [&[volume(&gradient)], &gradient], &[STRESS]).swap_remove(0);
            stress.into_iter().map(|component| component.slope.slope).collect()
        })
    }
}

/// J - 1 of a gradient that is diagonal but for what derivatives are taken by.
fn volume<T: Number>(gradient: &[T]) -> T {
    let one = T::from_f64(1.0);
    let stretches = gradient.iter().step_by(gradient.len().isqrt() + 1);
    let stretches = stretches.map(|entry| one.clone() + entry.clone());
    stretches.fold(one.clone(), |product, stretch| product * stretch) - one.clone()
}

/// A square matrix from its columns.
fn columns(order: usize, mut column: impl FnMut(usize) -> Vec<Interval>) -> Vec<Interval> {
    let mut matrix = vec![Interval::UNDEFINED; order * order];
    for at in 0..order {
        for (row, entry) in column(at).into_iter().enumerate() {
            matrix[row * order + at] = entry;
        }
    }
    matrix
}
