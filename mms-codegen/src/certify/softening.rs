//! The loss of strong ellipticity: a place, a time and directions m and N with m_i N_J A_iJkL m_k N_L <= 0, which
//! interval arithmetic proves.

use mms_math::Scalar as _;
use mms_mechanics::Response;
use mms_program::interval::Interval;
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::Graph;

use super::tangent::Tangent;
use crate::bounds::chart::Chart;
use crate::bounds::enclosure::Formulas;
use crate::bounds::witness::Witness;
use crate::compile::Compiled;

/// The number of alternations between a search of m for an N and of N for an m.
const TURNS: usize = 12;
/// The number of steps of each search.
const STEPS: usize = 24;

/// A wave that grows without a bound, at any wavelength.
#[derive(Clone, Debug, PartialEq)]
pub struct Softening {
    /// The place and the time.
    pub witness: Witness,
    /// N, of length 1.
    pub direction: Vec<f64>,
    /// An upper bound of the least eigenvalue of the acoustic tensor of N; not positive.
    pub value: f64,
}

/// Searches for directions at values of the variables of the chart.
pub(super) fn softening(
    graph: &mut Graph,
    chart: &Chart,
    compiled: &Compiled,
    place: &[f64],
) -> Option<Softening> {
    let derived = &compiled.derived;
    let gradient = chart.pull_back(graph, &derived.quantities[&Quantity::DisplacementGradient]);
    let stress = chart.pull_back(graph, &derived.responses[&Response::FirstPiolaKirchhoff]);
    let formulas = Formulas::new(graph, chart, &gradient);
    let stress = Tangent::program(graph, &stress);
    let thin: Vec<_> = place.iter().map(|value| Interval::from_f64(*value)).collect();
    let gradient = formulas.run::<Interval>(chart).values(&thin);
    let anywhere = Interval::new(f64::NEG_INFINITY, f64::INFINITY);
    let tangent = Tangent::new(chart, &stress).enclose(&gradient, anywhere, &thin);
    if !tangent.iter().all(|entry| entry.is_defined() && entry.farthest().is_finite()) {
        return None;
    }
    let (m, n) = softest(&tangent, compiled.field.space.rows());
    let form = form(&tangent, &m, &n);
    // The vectors have length 1 up to rounding.
    let value = (form / (squared_length(&m) * squared_length(&n))).upper();
    let spot = chart.points::<f64>().point(place);
    let parameters = chart.varying_parameters().map(|index| (index, spot.parameters[index]));
    let witness = Witness {
        parameters: parameters.collect(),
        coordinates: spot.coordinates,
        time: spot.time,
    };
    (value <= 0.0).then_some(Softening { witness, direction: n, value })
}

fn squared_length(vector: &[f64]) -> Interval {
    let squares = vector.iter().map(|it| Interval::from_f64(*it) * Interval::from_f64(*it));
    squares.fold(Interval::from_f64(0.0), |sum, square| sum + square)
}

/// m_i N_J A_iJkL m_k N_L.
fn form(tangent: &[Interval], m: &[f64], n: &[f64]) -> Interval {
    let dimension = m.len();
    let pair =
        |at: usize| Interval::from_f64(m[at / dimension]) * Interval::from_f64(n[at % dimension]);
    let order = dimension * dimension;
    let terms = (0..order * order).map(|at| tangent[at] * pair(at / order) * pair(at % order));
    terms.fold(Interval::from_f64(0.0), |sum, term| sum + term)
}

/// The m and N with the least form that is found, starting from each axis: alternately the least eigenvector for one of them
/// and for the other.
fn softest(tangent: &[Interval], dimension: usize) -> (Vec<f64>, Vec<f64>) {
    let middle: Vec<f64> = tangent.iter().map(|entry| entry.middle()).collect();
    let order = dimension * dimension;
    let contracted = |known: &[f64], is_normal: bool| -> Vec<f64> {
        let entry = |a: usize, b: usize| {
            let pairs = (0..order).map(|at| (at / dimension, at % dimension));
            let place = |own: usize, other: usize| match is_normal {
                true => own * dimension + other,
                false => other * dimension + own,
            };
            let term = |(p, q)| middle[place(a, p) * order + place(b, q)] * known[p] * known[q];
            pairs.map(term).sum()
        };
        (0..order).map(|at| entry(at / dimension, at % dimension)).collect()
    };
    let starts = (0..dimension).flat_map(|axis| {
        [0.1, -0.6]
            .map(|rest| (0..dimension).map(|own| if own == axis { 1.0 } else { rest }).collect())
    });
    let found = starts.map(|start: Vec<f64>| {
        let mut n = unit(start);
        let mut m = n.clone();
        for _ in 0..TURNS {
            m = least_eigenvector(&contracted(&n, true), m);
            n = least_eigenvector(&contracted(&m, false), n);
        }
        (form(tangent, &m, &n).middle(), (m, n))
    });
    let least = found.min_by(|(one, _), (other, _)| one.total_cmp(other));
    least.map(|(_, directions)| directions).expect("a start for each axis")
}

/// The least eigenvector, by powers of a matrix with reversed eigenvalues, from a start vector.
fn least_eigenvector(matrix: &[f64], start: Vec<f64>) -> Vec<f64> {
    let dimension = start.len();
    let most = matrix.iter().map(|entry| entry.abs()).sum::<f64>();
    let mut vector = start;
    for _ in 0..STEPS {
        let image = |row: usize| -> f64 {
            let row_of = &matrix[row * dimension..(row + 1) * dimension];
            let product: f64 = row_of.iter().zip(&vector).map(|(a, b)| a * b).sum();
            most * vector[row] - product
        };
        vector = unit((0..dimension).map(image).collect());
    }
    vector
}

/// Normalises a vector to length 1; returns the first axis if that is impossible.
fn unit(mut vector: Vec<f64>) -> Vec<f64> {
    let length = vector.iter().map(|it| it * it).sum::<f64>().sqrt();
    if length > 0.0 {
        vector.iter_mut().for_each(|it| *it /= length);
    } else {
        vector[0] = 1.0;
    }
    vector
}
