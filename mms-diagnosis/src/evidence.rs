//! The results of a solver, and their errors as coefficients of smooth functions.

use std::sync::Arc;

use mms_runtime::Vector;

use crate::exact::{Exact, Quantity, vectors};
use crate::smooth::{Fitting, Smooth, less};

/// The results of a solver on one mesh, at one or more times.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// h.
    pub cell_size: f64,
    /// The time step, if it is known.
    pub time_step: Option<f64>,
    /// The results, in the order of their times.
    pub snapshots: Vec<Snapshot>,
}

/// A multiplier that spreads the indices of points: the golden ratio of 2^32 (Knuth, "The Art of Computer Programming", vol. 3,
/// section 6.4).
const SPREAD: u32 = 2_654_435_769;

impl Mesh {
    /// Keeps about `most` points of each result, spread evenly over all: smooth functions need no more.
    pub fn thinned<const D: usize>(&self, most: usize) -> Mesh {
        let thin = |it: &Snapshot| {
            let points = it.reference.len() / D;
            let part = most as f64 / points.max(1) as f64 * f64::from(u32::MAX);
            let is_kept = |at: usize| f64::from((at as u32).wrapping_mul(SPREAD)) <= part;
            let keep = |numbers: &[f64]| -> Vec<f64> {
                let each = numbers.chunks(numbers.len() / points.max(1)).enumerate();
                each.filter(|(at, _)| is_kept(*at)).flat_map(|(_, it)| it.to_vec()).collect()
            };
            if points <= most {
                return it.clone();
            }
            Snapshot {
                reference: keep(&it.reference),
                values: it.values.iter().map(|(of, numbers)| (*of, keep(numbers))).collect(),
                volumes: it.volumes.as_deref().map(keep),
                ..it.clone()
            }
        };
        Mesh { snapshots: self.snapshots.iter().map(thin).collect(), ..self.clone() }
    }
}

/// The results of a solver at one time, point by point.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Snapshot {
    /// The time.
    pub time: f64,
    /// X.
    pub reference: Vec<f64>,
    /// The quantities; tensors by rows.
    pub values: Vec<(Quantity, Vec<f64>)>,
    /// Reference volumes of the points, where they are known.
    pub volumes: Option<Vec<f64>>,
    /// The degree of the cells, where these are known.
    pub degree: Option<u32>,
}

/// The highest degree of functions, in one to three dimensions.
pub const DEGREE: [usize; 3] = [9, 8, 4];
/// The most times that are compared.
const TIMES: usize = 4;

/// The compared results: quantities at times, as coefficients of smooth functions, each divided by the size of the exact
/// quantity.
#[derive(Clone, Debug)]
pub struct ComparisonFrame<const D: usize> {
    /// The times.
    pub times: Vec<f64>,
    /// The quantities, each with its size.
    pub quantities: Vec<(Quantity, f64)>,
    /// The functions.
    pub smooth: Smooth<D>,
}

/// The errors of results in a frame.
pub struct ErrorCoefficients {
    /// Coefficients: by times, by quantities, by components, by functions.
    pub coefficients: Vec<f64>,
    /// The part of the squared error that the coefficients represent.
    pub share: f64,
}

impl<const D: usize> ComparisonFrame<D> {
    /// The frame for results with these points, at some of their times.
    pub fn new(exact: &Exact<'_, D>, snapshots: &[&Snapshot], smooth: Smooth<D>) -> Self {
        let (start, is_at_rest) = (exact.domain.time[0], exact.is_at_rest());
        let last = snapshots.len().saturating_sub(1);
        let chosen: Vec<&Snapshot> = match snapshots.len() {
            0..=TIMES => snapshots.to_vec(),
            // Evenly spaced, including the last one.
            _ => (1..=TIMES).map(|part| snapshots[part * last / TIMES]).collect(),
        };
        let kinds = snapshots.first().map_or(&[][..], |it| &it.values);
        let size = |quantity: Quantity| {
            let squares = chosen
                .iter()
                .flat_map(|it| exact.values(quantity, it.time, &vectors(&it.reference)));
            let squares: Vec<f64> = squares.filter(|it| it.is_finite()).map(|it| it * it).collect();
            let mean = squares.iter().sum::<f64>() / squares.len().max(1) as f64
                * quantity.components(D) as f64;
            if mean > 0.0 { mean.sqrt() } else { 1.0 }
        };
        let times = chosen.iter().map(|it| it.time);
        ComparisonFrame {
            // At the start the state is given, unless nothing moves.
            times: times.filter(|time| *time > start || is_at_rest).collect(),
            quantities: kinds.iter().map(|(quantity, _)| (*quantity, size(*quantity))).collect(),
            smooth,
        }
    }

    /// The pairs that are compared: the index of each time, with each quantity.
    pub fn each(&self) -> impl Iterator<Item = (usize, Quantity)> {
        let quantities = |at| self.quantities.iter().map(move |(quantity, _)| (at, *quantity));
        (0..self.times.len()).flat_map(quantities)
    }

    /// The fit of errors at the points of a mesh, set up once; `None` if the mesh has no result.
    pub fn sight<'a>(&'a self, mesh: &'a Mesh) -> Option<Sight<'a, D>> {
        let mut points: Vec<(&[f64], Arc<Fitting>)> = Vec::new();
        for time in &self.times {
            let own = &*nearest(mesh, *time)?.reference;
            // Most results of a mesh have the same points at all times.
            let known = points.iter().find(|(it, _)| *it == own).map(|(_, it)| it.clone());
            let fitting = || Arc::new(self.smooth.fitting(&vectors(own)));
            points.push((own, known.unwrap_or_else(fitting)));
        }
        Some(Sight { frame: self, mesh, points })
    }

    /// Evaluates coefficients at points, for the first quantity at the last time.
    pub fn values(&self, coefficients: &[f64], points: &[Vector<f64, D>]) -> Option<Vec<Vec<f64>>> {
        let count = self.smooth.count();
        let numbers = |it: &(Quantity, f64)| count * it.0.components(D);
        let all: usize = self.quantities.iter().map(numbers).sum();
        let (quantity, size) = *self.quantities.first()?;
        let first = all * self.times.len().checked_sub(1)?;
        let of = coefficients.get(first..first + count * quantity.components(D))?;
        let value = |functions: &[f64], of: &[f64]| -> f64 {
            size * functions.iter().zip(of).map(|(f, c)| f * c).sum::<f64>()
        };
        let at = |x: &Vector<f64, D>| {
            let functions = self.smooth.values(x);
            of.chunks(count).map(|of| value(&functions, of)).collect()
        };
        Some(points.iter().map(at).collect())
    }
}

/// Fits the errors of a mesh by the smooth functions of a frame.
pub struct Sight<'a, const D: usize> {
    frame: &'a ComparisonFrame<D>,
    mesh: &'a Mesh,
    /// X of the points at each time, and the fit there.
    points: Vec<(&'a [f64], Arc<Fitting>)>,
}

impl<const D: usize> Sight<'_, D> {
    /// Fits the errors of each time and quantity at the points; `None` if an error is not finite.
    pub fn see(&self, errors: &[Vec<f64>]) -> Option<ErrorCoefficients> {
        let mut seen = ErrorCoefficients { coefficients: Vec::new(), share: 0.0 };
        let (mut all, mut held) = (0.0, 0.0);
        let sizes = self.frame.quantities.iter().map(|(_, size)| size).cycle();
        for (((at, _), errors), size) in self.frame.each().zip(errors).zip(sizes) {
            let (points, fitting) = &self.points[at];
            let scaled: Vec<f64> = errors.iter().map(|error| error / size).collect();
            if scaled.iter().any(|it| !it.is_finite()) {
                return None;
            }
            let (coefficients, share) = fitting.fit(&scaled);
            let count = points.len() / D;
            let square = scaled.iter().map(|it| it * it).sum::<f64>() / count.max(1) as f64;
            (all, held) = (all + square, held + share * square);
            seen.coefficients.extend(coefficients);
        }
        seen.share = if all > 0.0 { held / all } else { 1.0 };
        Some(seen)
    }

    /// The errors of the mesh; `None` where one is not finite.
    pub fn errors_of(&self, exact: &Exact<'_, D>) -> Option<ErrorCoefficients> {
        let one = |(at, quantity): (usize, Quantity)| {
            let snapshot = nearest(self.mesh, self.frame.times[at])?;
            let (_, values) = snapshot.values.iter().find(|(it, _)| *it == quantity)?;
            let right = exact.values(quantity, snapshot.time, &vectors(&snapshot.reference));
            Some(less(values, 1.0, &right))
        };
        self.see(&self.frame.each().map(one).collect::<Option<Vec<_>>>()?)
    }
}

/// The result nearest to a time.
pub fn nearest(mesh: &Mesh, time: f64) -> Option<&Snapshot> {
    let away = |it: &&Snapshot| (it.time - time).abs();
    mesh.snapshots.iter().min_by(|a, b| away(a).total_cmp(&away(b)))
}
