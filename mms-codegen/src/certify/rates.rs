//! Bounds of the principal stretch, of the strain rate and of the wave speed over the domain: how far, how fast and how stiffly
//! a field deforms.
//!
//! Strains are bounded by C = F^T F in the basis of the coordinates, so that rotations cost no sharpness, and also by F, whose
//! entries are shorter where nothing rotates; the smaller bound counts. Eigenvalues of C are bounded by Hertz and Weyl,
//! singular values of F by Weyl. The strain rate D is computed from C as D : D = tr (C^-1 dC/dt)^2/4, in two dimensions as (2
//! (dJ/dt)^2 - det dC/dt)/(2 J^2), and from F as sym(dF/dt F^-1).
//!
//! The wave speed follows from the acoustic tensor on a grid of directions, whose gaps are bounded, and from the least rho0;
//! for isotropic materials in principal axes. In the deformed body F_pJ F_qL A_iJkL replaces A_iJkL. The stable time step is
//! the cell size divided by the larger of the two wave speeds; the speed of particles does not enter.

use std::collections::HashMap;
use std::ops::Range;

use mms_math::Scalar as _;

use super::matrix::{
    Grid, eigenvalues, largest_acoustic, largest_rate, largest_relative_rate, singular_values,
};
use super::motion::ChartMotion;
use super::tangent::Tangent;
use crate::bounds::chart::Chart;
use crate::bounds::enclosure::{Enclosures, Formulas, key};
use crate::bounds::search::{Measure, SearchResult, largest};
use mms_program::interpret::Number as _;
use mms_program::interval::Interval;
use mms_symbolic::expr::{Expr, Graph};

/// The relative excess over a value at which a bound is sharp enough.
const SHARPNESS: f64 = 0.1;

/// Upper bounds of rates for all states of the field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rates {
    /// The largest principal stretch.
    pub principal_stretch: f64,
    /// The norm of the rate of deformation D = sym(dF/dt F^-1), 1/s.
    pub strain_rate: f64,
    /// The speed of waves in the deformed body, m/s of x.
    pub wave_speed: f64,
    /// The speed of waves in the reference configuration, m/s of X.
    pub reference_wave_speed: f64,
}

impl Rates {
    /// The time that the fastest wave needs per cell size, whether the cells lie in the reference or in the deformed body.
    pub fn time_step_per_cell_size(&self) -> f64 {
        1.0 / self.wave_speed.max(self.reference_wave_speed)
    }
}

/// The configuration in which the waves cross cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Frame {
    /// In the reference configuration.
    Reference,
    /// In the deformed body.
    Deformed,
}

/// Bounds all four rates, and counts the cells, without the cells of the stretches.
pub(super) fn bound(
    graph: &mut Graph,
    searches: &Searches<'_>,
    stretches: &Stretches,
) -> (Rates, usize) {
    let rate = searches.strain_rate(graph, stretches.least);
    let frames = [Frame::Reference, Frame::Deformed];
    let [reference, deformed] = searches.wave_speeds(graph, stretches, frames, 0.0);
    let principal_stretch = stretches.principal(searches.motion);
    let rates = Rates {
        principal_stretch,
        strain_rate: rate.bound,
        // In the deformed body a wave moves at most `principal_stretch` times as far as in the reference configuration.
        wave_speed: deformed.bound.min(reference.bound * principal_stretch),
        reference_wave_speed: reference.bound,
    };
    (rates, rate.cells + reference.cells + deformed.cells)
}

/// A bound of the speed of waves in a frame, where J lies within `jacobian`, sharpened only until it is at most `speed`. The
/// search uses at most `limit` cells for each stretch and for the speed.
pub fn wave_speed(
    graph: &mut Graph,
    chart: &Chart,
    motion: &ChartMotion,
    jacobian: [f64; 2],
    limit: usize,
    (frame, speed): (Frame, f64),
) -> f64 {
    let searches = Searches::new(chart, motion, jacobian, limit);
    let stretches = searches.stretches(graph);
    let [found] = searches.wave_speeds(graph, &stretches, [frame], speed);
    found.bound
}

/// The common inputs of the search for each rate.
pub(super) struct Searches<'a> {
    pub chart: &'a Chart,
    pub motion: &'a ChartMotion,
    /// J, H and C - I, the first formulas of every search.
    pub strain: Vec<Expr>,
    /// The bounds of J everywhere.
    pub volume: Interval,
    /// The largest number of cells of each search.
    pub limit: usize,
}

/// Bounds of the principal stretches.
pub(super) struct Stretches {
    pub least: f64,
    pub greatest: f64,
    /// The number of cells.
    pub cells: usize,
}

impl Stretches {
    /// The largest principal stretch; a missing dimension has the stretch 1.
    fn principal(&self, motion: &ChartMotion) -> f64 {
        self.greatest.max(if motion.dimension() < 3 { 1.0 } else { 0.0 })
    }
}

impl<'a> Searches<'a> {
    pub fn new(
        chart: &'a Chart,
        motion: &'a ChartMotion,
        jacobian: [f64; 2],
        limit: usize,
    ) -> Self {
        let strain = [&[motion.jacobian][..], &motion.gradient, &motion.right].concat();
        let volume = Interval::new(jacobian[0], jacobian[1]);
        Searches { chart, motion, strain, volume, limit }
    }

    /// The deformation, from bounds of the formulas.
    pub fn state(&self, values: &[Interval]) -> State {
        let (gradient, right) = values[1..self.strain.len()].split_at(self.motion.gradient.len());
        State::new(values[0].meet(self.volume), gradient, right)
    }

    /// The least and the largest principal stretch.
    pub fn stretches(&self, graph: &mut Graph) -> Stretches {
        let formulas = Formulas::new(graph, self.chart, &self.strain);
        let mut bounds = Enclosures::new(&formulas, self.chart);
        let all = 0..self.strain.len();
        let squeeze = search(self.chart, &mut bounds, self.limit, all.clone(), |values, _, _| {
            match self.state(values).stretches.first().map_or(0.0, |least| least.lower()) {
                least if least > 0.0 => 1.0 / least.next_down(),
                _ => f64::INFINITY,
            }
        });
        let stretch = search(self.chart, &mut bounds, self.limit, all, |values, _, _| {
            self.state(values).stretches.last().map_or(f64::INFINITY, |greatest| greatest.upper())
        });
        // J is the product of the principal stretches.
        let least = self.volume.lower() / stretch.bound.powi(self.motion.dimension() as i32 - 1);
        Stretches {
            least: least.max(1.0 / squeeze.bound) * (1.0 - 1e-9),
            greatest: stretch.bound,
            cells: squeeze.cells + stretch.cells,
        }
    }

    /// The largest |D| where no principal stretch is less than `floor`.
    fn strain_rate(&self, graph: &mut Graph, floor: f64) -> SearchResult {
        let (motion, known) = (self.motion, self.strain.len());
        let size = motion.gradient.len();
        let mut moving = [&self.strain[..], &motion.gradient_rate, &motion.right_rate].concat();
        moving.extend(motion.squared_rate);
        let formulas = Formulas::new(graph, self.chart, &moving);
        let mut bounds = Enclosures::new(&formulas, self.chart);
        let steering = known..known + 2 * size;
        search(self.chart, &mut bounds, self.limit, steering, |values, _, _| {
            let state = self.state(values);
            let (gradient_rate, rest) = values[known..].split_at(size);
            let (right_rate, squared) = rest.split_at(size);
            let of_gradient = largest_rate(&state.deformation, gradient_rate, floor);
            let of_right = largest_relative_rate(&state.right, right_rate, floor * floor);
            let of_both = of_gradient.min(of_right / 2.0);
            squared.iter().fold(of_both, |rate, squared| rate.min(state.rate(*squared)))
        })
    }

    /// The fastest wave in each frame, sharpened only until it is at most `speed`.
    fn wave_speeds<const N: usize>(
        &self,
        graph: &mut Graph,
        stretches: &Stretches,
        frames: [Frame; N],
        speed: f64,
    ) -> [SearchResult; N] {
        let stretches = Interval::new(stretches.least, stretches.greatest);
        let (motion, known) = (self.motion, self.strain.len());
        let mut seen = self.strain.clone();
        seen.push(motion.density);
        seen.extend(motion.oriented.iter().flatten());
        let formulas = Formulas::new(graph, self.chart, &seen);
        let stress = Tangent::program(graph, &motion.stress);
        let mut tangents = Tangents::new(Tangent::new(self.chart, &stress));
        let mut bounds = Enclosures::new(&formulas, self.chart);
        let grid = Grid::new(motion.dimension());
        frames.map(|frame| {
            let measure = |values: &[Interval], place: &[Interval], enough: f64| {
                let (state, density) = (self.state(values), values[known]);
                let gradient = state.gradient(&values[known + 1..], stretches);
                let speed = |tangent: &[Interval]| match frame {
                    Frame::Reference => wave_speed_of(&grid, tangent, density),
                    Frame::Deformed => {
                        wave_speed_of(&grid, &pushed(tangent, &with_identity(&gradient)), density)
                    }
                };
                let coarse = tangents.coarse(&gradient, state.volume, place);
                match speed(coarse) {
                    found if found <= enough => found,
                    _ => speed(tangents.sharp(&gradient, place)),
                }
            };
            let sharp = |value: f64| if value > speed { value * (1.0 + SHARPNESS) } else { speed };
            let steering = 0..seen.len();
            search_until(self.chart, &mut bounds, self.limit, steering, sharp, measure)
        })
    }
}

/// Bounds the maximum of a measure of formulas. `measure` computes it from bounds of the formulas in a cell, or from their
/// values at its centre; a bound at most its third argument is sharp enough. A cell is split along the variable that changes
/// the formulas in `steering` most.
fn search(
    chart: &Chart,
    bounds: &mut Enclosures<'_>,
    limit: usize,
    steering: Range<usize>,
    measure: impl FnMut(&[Interval], &[Interval], f64) -> f64,
) -> SearchResult {
    let sharp = |value: f64| if value > 0.0 { value * (1.0 + SHARPNESS) } else { 0.0 };
    search_until(chart, bounds, limit, steering, sharp, measure)
}

/// Bounds a measure as `search` does, where `sharp` computes the bound that is sharp enough for a value.
pub(super) fn search_until(
    chart: &Chart,
    bounds: &mut Enclosures<'_>,
    limit: usize,
    steering: Range<usize>,
    sharp: impl Fn(f64) -> f64,
    mut measure: impl FnMut(&[Interval], &[Interval], f64) -> f64,
) -> SearchResult {
    let enough = |bound: f64, value: f64| bound <= sharp(value);
    let mut greatest = 0.0_f64;
    largest(chart.variables().len(), chart.limit(limit), enough, |cell| {
        let place = chart.place(&cell.0);
        let enclosure = bounds.enclose(&place);
        let at = cell.centre();
        let centre: Vec<Interval> = at.iter().map(|it| Interval::from_f64(*it)).collect();
        let centre = chart.place(&centre);
        let attained = measure(&bounds.values(&centre), &centre, f64::INFINITY);
        let attained = if attained.is_finite() { attained } else { f64::NEG_INFINITY };
        greatest = greatest.max(attained);
        let bound = measure(&enclosure.values, &place, sharp(greatest));
        let slopes = enclosure.slopes.iter().map(|by| by[steering.clone()].to_vec());
        let slopes: Vec<_> = slopes.collect();
        Measure {
            bound: if bound.is_nan() { f64::INFINITY } else { bound },
            attained,
            split: cell.steepest(&chart.changes(cell, &place, &slopes)),
            at,
        }
    })
}

/// Bounds of dP/dF over boxes, kept by place for several searches.
struct Tangents<'a> {
    tangent: Tangent<'a>,
    known: HashMap<Vec<u64>, OfPlace>,
}

/// Bounds of dP/dF over one box: cheap ones, and sharper ones if requested.
struct OfPlace {
    coarse: Vec<Interval>,
    sharp: Option<Vec<Interval>>,
}

impl<'a> Tangents<'a> {
    fn new(tangent: Tangent<'a>) -> Self {
        Tangents { tangent, known: HashMap::new() }
    }

    fn coarse(
        &mut self,
        gradient: &[Interval],
        volume: Interval,
        place: &[Interval],
    ) -> &[Interval] {
        let Tangents { tangent, known } = self;
        let new = || OfPlace { coarse: tangent.enclose(gradient, volume, place), sharp: None };
        &known.entry(key(place)).or_insert_with(new).coarse
    }

    /// Sharper bounds over a box whose coarse bounds exist already.
    fn sharp(&mut self, gradient: &[Interval], place: &[Interval]) -> &[Interval] {
        let Tangents { tangent, known } = self;
        let Some(OfPlace { coarse, sharp }) = known.get_mut(&key(place)) else { return &[] };
        sharp.get_or_insert_with(|| tangent.sharpen(coarse.clone(), gradient, place))
    }
}

/// The bounds of the deformation in a cell.
pub(super) struct State {
    /// C.
    right: Vec<Interval>,
    /// F.
    deformation: Vec<Interval>,
    /// The principal stretches, in ascending order: C bounds them under any rotation, F more sharply under a small one.
    stretches: Vec<Interval>,
    /// J.
    pub volume: Interval,
}

impl State {
    /// Bounds the state from J, H and C - I.
    fn new(volume: Interval, gradient: &[Interval], right: &[Interval]) -> Self {
        let deformation = with_identity(gradient);
        let both = with_identity(right).into_iter().zip(gram(&deformation));
        let right: Vec<_> = both.map(|(entry, square)| entry.meet(square)).collect();
        let roots = eigenvalues(&right).into_iter().map(|square| square.sqrt());
        let stretches = roots.zip(singular_values(&deformation));
        let mut stretches: Vec<_> = stretches.map(|(root, value)| root.meet(value)).collect();
        // J is the product of all principal stretches.
        for axis in 0..stretches.len() {
            let others = stretches.iter().enumerate().filter(|(other, _)| *other != axis);
            let rest = others.fold(volume, |rest, (_, stretch)| rest / *stretch);
            stretches[axis] = stretches[axis].meet(rest);
        }
        State { right, deformation, stretches, volume }
    }

    /// A bound of |D| from 2 J^2 D : D.
    fn rate(&self, squared: Interval) -> f64 {
        let square = squared.meet(Interval::new(0.0, f64::INFINITY)) / self.volume.square();
        let rate = (square / Interval::from_f64(2.0)).sqrt();
        if rate.is_defined() { rate.upper() } else { f64::INFINITY }
    }

    /// H for a material that needs it, else a gradient with the same principal stretches.
    pub fn gradient(&self, oriented: &[Interval], all: Interval) -> Vec<Interval> {
        if oriented.is_empty() { self.principal_gradient(all) } else { oriented.to_vec() }
    }

    /// The principal stretches less 1, as a gradient: the state in its principal axes, for a material whose stress depends on
    /// the stretches only. No stretch lies outside `all`.
    fn principal_gradient(&self, all: Interval) -> Vec<Interval> {
        let dimension = self.stretches.len();
        let mut gradient = vec![Interval::from_f64(0.0); dimension * dimension];
        for (axis, stretch) in self.stretches.iter().enumerate() {
            gradient[axis * (dimension + 1)] = stretch.meet(all) - Interval::from_f64(1.0);
        }
        gradient
    }
}

/// F^T F.
fn gram(deformation: &[Interval]) -> Vec<Interval> {
    let order = deformation.len().isqrt();
    let entry = |row: usize, column: usize| {
        let terms = (0..order).map(|k| match row == column {
            true => deformation[k * order + row].square(),
            false => deformation[k * order + row] * deformation[k * order + column],
        });
        terms.fold(Interval::from_f64(0.0), |sum, term| sum + term)
    };
    (0..order * order).map(|at| entry(at / order, at % order)).collect()
}

/// A square matrix plus I.
fn with_identity(matrix: &[Interval]) -> Vec<Interval> {
    let (mut matrix, order) = (matrix.to_vec(), matrix.len().isqrt());
    for entry in matrix.iter_mut().step_by(order + 1) {
        *entry = *entry + Interval::from_f64(1.0);
    }
    matrix
}

/// F_pJ F_qL A_iJkL: it replaces A for waves in the deformed body (Ogden, Non-linear Elastic Deformations, 1984, section 6.1).
fn pushed(tangent: &[Interval], deformation: &[Interval]) -> Vec<Interval> {
    let dimension = deformation.len().isqrt();
    let order = dimension * dimension;
    let sum = |terms: &mut dyn Iterator<Item = Interval>| {
        terms.fold(Interval::from_f64(0.0), |sum, term| sum + term)
    };
    // In the pair (i, J) of a row, or (k, L) of a column, J or L becomes p or q.
    let moved = |pair: usize, j: usize| pair / dimension * dimension + j;
    let along = |pair: usize, j: usize| deformation[pair % dimension * dimension + j];
    let rows = |at: usize| {
        let (row, column) = (at / order, at % order);
        let term = |j| along(row, j) * tangent[moved(row, j) * order + column];
        sum(&mut (0..dimension).map(term))
    };
    let half: Vec<Interval> = (0..order * order).map(rows).collect();
    let columns = |at: usize| {
        let (row, column) = (at / order, at % order);
        let term = |l| along(column, l) * half[row * order + moved(column, l)];
        sum(&mut (0..dimension).map(term))
    };
    (0..order * order).map(columns).collect()
}

/// The fastest wave: the largest eigenvalue of all acoustic tensors, over rho0.
fn wave_speed_of(grid: &Grid, tangent: &[Interval], density: Interval) -> f64 {
    if !density.is_defined() || density.lower() <= 0.0 {
        return f64::INFINITY;
    }
    let modulus = largest_acoustic(grid, tangent).max(0.0);
    (modulus / density.lower()).sqrt() * (1.0 + f64::EPSILON)
}
