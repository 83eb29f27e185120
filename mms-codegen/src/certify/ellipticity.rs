//! Strong ellipticity: every acoustic tensor A_iJkL N_J N_L is positive definite over body, window and ranges, so that waves
//! run in every direction and none grows.
//!
//! The quadratic form of A is bounded over all h of rank one. On these the minors h_iJ h_kL - h_iL h_kJ are 0, so multiples of
//! them may be added first (null Lagrangians): the sum is bounded as a matrix over all h. In two dimensions some multiple loses
//! nothing (Terpstra, Math. Ann. 116, 1938); in three dimensions the multiples that separate the shears of a pair of axes are
//! added.

use std::cell::{Cell, RefCell};
use std::ops::Add;

use mms_math::Scalar as _;
use mms_program::Program;
use mms_program::interval::Interval;
use mms_symbolic::expr::{Graph, Node, Symbol};

use super::matrix::{ROUNDING, diagonal, eigenvalues, spectral_radius};
use super::rates::{Searches, Stretches, search_until};
use super::softening::{Softening, softening};
use super::tangent::{MeanValue, Tangent};
use crate::bounds::chart::Chart;
use crate::bounds::enclosure::{Enclosures, Formulas};
use crate::bounds::search::{Measure, SearchResult, largest};
use crate::compile::Compiled;

/// The largest number of boxes of states, by dimension: a box in three dimensions takes about ten times as long as others.
const CELLS: [usize; 3] = [1000, 1000, 460];
/// The largest number of boxes of places and times.
const CELLS_OF_FIELD: usize = 100;

/// The number of steps of the search for multiples of minors.
const STEPS: usize = 24;
/// The part of the largest possible bound at which that search ends.
const GOOD: f64 = 0.9;

/// The verdict about the acoustic tensors.
#[derive(Clone, Debug, PartialEq)]
pub enum Ellipticity {
    /// All their eigenvalues are at least this positive number.
    Strong(f64),
    /// One of them is not positive definite.
    Lost(Softening),
    /// Some of them may not be positive definite.
    Unproved,
}

/// Bounds the acoustic tensors from below, and returns the number of cells of the chart.
///
/// Isotropic matter is examined in all states whose stretches and J lie within bounds, whether or not they occur: these have
/// few variables. If that does not decide, and for other matter, the states of the field are examined.
pub(super) fn bound(
    graph: &mut Graph,
    compiled: &Compiled,
    searches: &Searches<'_>,
    stretches: &Stretches,
) -> (Ellipticity, usize) {
    let stress = Tangent::program(graph, &searches.motion.stress);
    if searches.motion.oriented.is_none() {
        let states = States::new(graph, searches, stretches);
        let mut compliance = Compliance::new(searches.chart, &stress);
        let found = compliance.of_all(&states);
        // A state that is not strongly elliptic may never occur in the field.
        if compliance.lost.is_none() {
            return (judged(&found), 0);
        }
    }
    let mut compliance = Compliance::new(searches.chart, &stress);
    let found = compliance.of_field(graph, searches, stretches);
    let lost = compliance.lost.take();
    let lost = lost.and_then(|place| softening(graph, searches.chart, compiled, &place));
    (lost.map_or_else(|| judged(&found), Ellipticity::Lost), found.cells)
}

fn judged(found: &SearchResult) -> Ellipticity {
    match found.bound {
        bound if bound.is_finite() && bound > 0.0 => Ellipticity::Strong((1.0 / bound).next_down()),
        _ => Ellipticity::Unproved,
    }
}

/// The states of isotropic matter: principal stretches, J, and the variables of the chart on which the stress depends.
struct States<'a> {
    chart: &'a Chart,
    dimension: usize,
    /// The bounds of the stretches, and of J.
    stretches: [Interval; 2],
    volume: Interval,
    /// Which variables of the chart the stress depends on.
    is_seen: Vec<bool>,
}

impl<'a> States<'a> {
    fn new(graph: &Graph, searches: &Searches<'a>, stretches: &Stretches) -> Self {
        let leaves = graph.reachable(&searches.motion.stress);
        let is_leaf =
            |symbol: &Symbol| leaves.iter().any(|leaf| *graph.node(*leaf) == Node::Symbol(*symbol));
        States {
            chart: searches.chart,
            dimension: searches.motion.dimension(),
            stretches: [stretches.least, stretches.greatest].map(Interval::from_f64),
            volume: searches.volume,
            is_seen: searches.chart.variables().iter().map(is_leaf).collect(),
        }
    }

    /// The number of variables.
    fn variables(&self) -> usize {
        self.dimension + self.is_seen.iter().filter(|is_seen| **is_seen).count()
    }

    /// H, J and the place at fractions of the variables; `None` where J is out of bounds, or the stretches do not ascend: the
    /// order of the axes has no effect on isotropic matter.
    fn at(&self, sides: &[Interval]) -> Option<(Vec<Interval>, Interval, Vec<Interval>)> {
        let one = Interval::from_f64(1.0);
        let (own, rest) = sides.split_at(self.dimension);
        let [least, most] = self.stretches;
        let own: Vec<_> = own.iter().map(|side| least + (most - least) * *side).collect();
        let volume = own.iter().fold(one, |volume, stretch| volume * *stretch);
        let ascends = own.windows(2).all(|pair| pair[0].lower() <= pair[1].upper());
        let is_possible = ascends
            && volume.upper() >= self.volume.lower()
            && volume.lower() <= self.volume.upper();
        let mut gradient = vec![Interval::from_f64(0.0); own.len() * own.len()];
        for (axis, stretch) in own.iter().enumerate() {
            gradient[axis * (own.len() + 1)] = *stretch - one;
        }
        let mut rest = rest.iter().copied();
        let whole = Interval::new(0.0, 1.0);
        let mut side = |is_seen: &bool| if *is_seen { rest.next().unwrap_or(whole) } else { whole };
        let place: Vec<_> = self.is_seen.iter().map(&mut side).collect();
        is_possible.then(|| (gradient, volume.meet(self.volume), self.chart.place(&place)))
    }
}

/// The reciprocal of the least eigenvalue of acoustic tensors; infinite if that is not positive.
struct Compliance<'a> {
    chart: &'a Chart,
    tangent: Tangent<'a>,
    /// The place of a state at which the bound is infinite even for this state alone, so that smaller cells cannot decide.
    lost: Option<Vec<f64>>,
}

impl<'a> Compliance<'a> {
    fn new(chart: &'a Chart, stress: &'a Program<()>) -> Self {
        Compliance { chart, tangent: Tangent::new(chart, stress), lost: None }
    }

    /// A bound over a box of states; sharpened only until it is finite.
    fn bound(&mut self, gradient: &[Interval], volume: Interval, place: &[Interval]) -> f64 {
        let coarse = compliance(least_acoustic(&self.tangent.enclose(gradient, volume, place)));
        if coarse.is_finite() || self.lost.is_some() {
            return coarse;
        }
        match self.tangent.mean_value(gradient, place) {
            Some(form) => coarse.min(compliance(least_of_form(&form))),
            None => coarse,
        }
    }

    /// The value at one state, or at almost one.
    fn value(&mut self, gradient: &[Interval], volume: Interval, place: &[Interval]) -> f64 {
        let value = self.bound(gradient, volume, place);
        if self.lost.is_none() && value.is_infinite() {
            self.lost = Some(place.iter().map(|side| side.middle()).collect());
        }
        value
    }

    /// The largest value over all possible states.
    fn of_all(&mut self, states: &States<'_>) -> SearchResult {
        let this = RefCell::new(self);
        let most = CELLS[states.dimension - 1];
        let open = Open::default();
        let is_enough = |bound: f64, _| {
            bound.is_finite() || this.borrow().lost.is_some() || open.is_hopeless(most)
        };
        largest(states.variables(), states.chart.limit(most), is_enough, |cell| {
            let mut this = this.borrow_mut();
            let at = cell.centre();
            let point: Vec<_> = at.iter().map(|side| Interval::from_f64(*side)).collect();
            let state = states.at(&point);
            let attained = state.map(|(h, j, place)| this.value(&h, j, &place));
            let bound = states.at(&cell.0).map(|(h, j, place)| this.bound(&h, j, &place));
            let (attained, bound) = (attained.unwrap_or(f64::NEG_INFINITY), bound.unwrap_or(0.0));
            open.count(bound);
            Measure { bound, attained, split: cell.widest(), at }
        })
    }

    /// The largest value over the states of a field.
    fn of_field(
        &mut self,
        graph: &mut Graph,
        searches: &Searches<'_>,
        stretches: &Stretches,
    ) -> SearchResult {
        let all = Interval::new(stretches.least, stretches.greatest);
        let mut seen = searches.strain.clone();
        let known = seen.len();
        seen.extend(searches.motion.oriented.iter().flatten());
        let formulas = Formulas::new(graph, self.chart, &seen);
        let chart = self.chart;
        let this = RefCell::new(self);
        let measure = |values: &[Interval], place: &[Interval], enough: f64| {
            let mut this = this.borrow_mut();
            let state = searches.state(values);
            let gradient = state.gradient(&values[known..], all);
            match enough.is_infinite() {
                true => this.value(&gradient, state.volume, place),
                false => this.bound(&gradient, state.volume, place),
            }
        };
        let sharp = |_| if this.borrow().lost.is_some() { f64::INFINITY } else { f64::MAX };
        let mut bounds = Enclosures::new(&formulas, chart);
        search_until(chart, &mut bounds, CELLS_OF_FIELD, 0..seen.len(), sharp, measure)
    }
}

/// The number of boxes examined, and of those without a bound.
#[derive(Default)]
struct Open {
    all: Cell<usize>,
    unbounded: Cell<usize>,
}

impl Open {
    fn count(&self, bound: f64) {
        self.all.set(self.all.get() + 1);
        self.unbounded.set(self.unbounded.get() + usize::from(bound.is_infinite()));
    }

    /// Whether the boxes that remain to be split need more boxes than the limit allows. Every box that was split had no bound,
    /// and each remaining one needs at least two.
    fn is_hopeless(&self, most: usize) -> bool {
        let (all, unbounded) = (self.all.get(), self.unbounded.get());
        let left = unbounded.saturating_sub(all.saturating_sub(1) / 2);
        all + 2 * left > most
    }
}

/// The reciprocal of a bound; infinite if that is not positive.
fn compliance(least: f64) -> f64 {
    if least > 0.0 { (1.0 / least).next_up() } else { f64::INFINITY }
}

/// A lower bound from a mean-value form. The least eigenvalue is concave, so over a linear form it is least at a corner; the
/// uncertainty of the slopes is subtracted.
fn least_of_form(form: &MeanValue) -> f64 {
    let parts = || [&form.centre].into_iter().chain(form.slopes.iter().map(|(_, slopes)| slopes));
    if !parts().flatten().all(|entry| entry.is_defined() && entry.farthest().is_finite()) {
        return f64::NEG_INFINITY;
    }
    let middle =
        |entries: &[Interval]| -> Vec<f64> { entries.iter().map(|it| it.middle()).collect() };
    let centre = middle(&form.centre);
    let slopes: Vec<(f64, Vec<f64>)> =
        form.slopes.iter().map(|(half, slopes)| (*half, middle(slopes))).collect();
    let shifts = Shifts::new(&centre);
    let part = shifts.best();
    let corner = |signs: usize| {
        let mut tensor = centre.clone();
        for (direction, (half, slopes)) in slopes.iter().enumerate() {
            let side = if signs >> direction & 1 == 1 { *half } else { -half };
            tensor.iter_mut().zip(slopes).for_each(|(entry, slope)| *entry += side * slope);
        }
        Shifts { tensor: &tensor, ..shifts }.least(part)
    };
    let least = (0..1 << slopes.len()).map(corner).fold(f64::INFINITY, f64::min);
    let mut unknown: Vec<f64> = form.centre.iter().map(|entry| entry.width() / 2.0).collect();
    for (half, slopes) in &form.slopes {
        unknown.iter_mut().zip(slopes).for_each(|(sum, slope)| *sum += half * slope.width() / 2.0);
    }
    least - shifts.reach(&unknown) - ROUNDING * spectral_radius(&centre)
}

/// A lower bound of m_i N_J A_iJkL m_k N_L for unit vectors m and N, where A, row-major in (i, J) and (k, L), lies within these
/// bounds.
fn least_acoustic(entries: &[Interval]) -> f64 {
    let middle: Vec<f64> = entries.iter().map(|entry| entry.middle()).collect();
    if !entries.iter().all(|entry| entry.is_defined() && entry.farthest().is_finite()) {
        return f64::NEG_INFINITY;
    }
    let shifts = Shifts::new(&middle);
    let whole = symmetric(shifted(entries, &shifts.multiples(shifts.best()), Interval::from_f64));
    let least = blocks(&whole).into_iter();
    let least = least.map(|block| eigenvalues(&block).first().map_or(0.0, |it| it.lower()));
    least.fold(f64::INFINITY, f64::min)
}

/// A multiple of a minor h_iJ h_kL - h_iL h_kJ with i < k, J < L: the places of its factors, and the multiple.
type Multiple = ([[usize; 2]; 2], f64);

/// The multiples of minors that may be added to a tensor.
struct Shifts<'a> {
    tensor: &'a [f64],
    dimension: usize,
    /// The change of each multiple per unit of the number `part`, which `best` optimises.
    step: f64,
    /// An upper bound of every least eigenvalue.
    most: f64,
}

impl<'a> Shifts<'a> {
    fn new(tensor: &'a [f64]) -> Self {
        let order = tensor.len().isqrt();
        let step = 2.0 * tensor.iter().fold(0.0_f64, |largest, entry| largest.max(entry.abs()));
        let diagonal = tensor.iter().step_by(order + 1);
        let most = diagonal.fold(f64::INFINITY, |most, entry| most.min(*entry));
        Shifts { tensor, dimension: order.isqrt(), step, most }
    }

    /// The multiples that cancel the entries A_iLkJ, which couple the two shears of a pair of axes; each is changed by `part` times
    /// `step`. `part` is 0 except in two dimensions.
    fn multiples(&self, part: f64) -> Vec<Multiple> {
        let size = self.dimension;
        let pairs = || (0..size).flat_map(|a| (a + 1..size).map(move |b| [a, b]));
        let minors = pairs().flat_map(|rows| pairs().map(move |columns| (rows, columns)));
        let multiple = |([i, k], [j, l]): ([usize; 2], [usize; 2])| {
            let place = |row: usize, column: usize| row * size + column;
            let factors = [[place(i, j), place(k, l)], [place(i, l), place(k, j)]];
            let parted = self.tensor[factors[1][0] * size * size + factors[1][1]];
            (factors, parted + part * self.step)
        };
        minors.map(multiple).collect()
    }

    /// The part with the greatest least eigenvalue, which is concave in it, or one that is good enough; 0 in three dimensions.
    fn best(&self) -> f64 {
        let (mut from, mut to) = (-1.0, 1.0);
        let mut best = (self.least(0.0), 0.0);
        let steps = if self.dimension == 2 { STEPS } else { 0 };
        for _ in 0..steps {
            if best.0 >= GOOD * self.most {
                break;
            }
            let parts = [from + (to - from) / 3.0, to - (to - from) / 3.0];
            let [left, right] = parts.map(|part| (self.least(part), part));
            best = [left, right]
                .into_iter()
                .fold(best, |best, it| if it.0 > best.0 { it } else { best });
            if left.0 < right.0 { from = left.1 } else { to = right.1 }
        }
        best.1
    }

    /// The largest change of a least eigenvalue when each entry of the tensor changes by at most these radii.
    fn reach(&self, radii: &[f64]) -> f64 {
        // The multiples are entries of the tensor, so their radii are added to the radii of the entries that they shift.
        let multiples = Shifts { tensor: radii, step: 0.0, ..*self }.multiples(0.0);
        let mut sum = radii.to_vec();
        let order = sum.len().isqrt();
        for (places, multiple) in multiples {
            for [a, b] in places {
                for at in [a * order + b, b * order + a] {
                    sum[at] += multiple.abs();
                }
            }
        }
        spectral_radius(&symmetric(sum))
    }

    fn least(&self, part: f64) -> f64 {
        let whole = symmetric(shifted(self.tensor, &self.multiples(part), |number| number));
        let values = blocks(&whole).into_iter().flat_map(diagonal);
        values.fold(f64::INFINITY, f64::min)
    }
}

/// A tensor with multiples of minors.
fn shifted<T: Copy + Add<Output = T>>(
    tensor: &[T],
    multiples: &[Multiple],
    number: fn(f64) -> T,
) -> Vec<T> {
    let (mut shifted, order) = (tensor.to_vec(), tensor.len().isqrt());
    for ([first, second], multiple) in multiples {
        for ([a, b], multiple) in [(first, *multiple), (second, -multiple)] {
            for at in [a * order + b, b * order + a] {
                shifted[at] = shifted[at] + number(multiple);
            }
        }
    }
    shifted
}

/// The symmetric part of a matrix.
fn symmetric<T: Part>(matrix: Vec<T>) -> Vec<T> {
    let order = matrix.len().isqrt();
    (0..matrix.len()).map(|at| matrix[at].with(matrix[at % order * order + at / order])).collect()
}

/// An entry of a symmetric matrix: a number, or bounds of one.
trait Part: Copy {
    /// Merges two entries that are equal in exact arithmetic: their mean, or their common bounds.
    fn with(self, other: Self) -> Self;
    /// Whether the entry is exactly 0.
    fn is_zero(self) -> bool;
}

impl Part for f64 {
    fn with(self, other: f64) -> f64 {
        (self + other) / 2.0
    }

    fn is_zero(self) -> bool {
        self == 0.0
    }
}

impl Part for Interval {
    fn with(self, other: Interval) -> Interval {
        self.meet(other)
    }

    fn is_zero(self) -> bool {
        self.lower() == 0.0 && self.upper() == 0.0
    }
}

/// The blocks of a symmetric matrix that zeros separate.
fn blocks<T: Part>(matrix: &[T]) -> Vec<Vec<T>> {
    let order = matrix.len().isqrt();
    let mut block_of: Vec<usize> = (0..order).collect();
    for (row, column) in (0..order).flat_map(|row| (0..row).map(move |column| (row, column))) {
        if !matrix[row * order + column].is_zero() {
            let (from, to) = (block_of[row], block_of[column]);
            block_of.iter_mut().filter(|block| **block == from).for_each(|block| *block = to);
        }
    }
    let members = |block| (0..order).filter(|row| block_of[*row] == block).collect::<Vec<_>>();
    let members = (0..order).map(members).filter(|rows| !rows.is_empty());
    let entries = |rows: Vec<usize>| {
        let pairs = rows.iter().flat_map(|row| rows.iter().map(move |column| (row, column)));
        pairs.map(|(row, column)| matrix[row * order + column]).collect()
    };
    members.map(entries).collect()
}
