//! Interpolation from a grid of knots in the unit cube to another grid, axis by axis.

use crate::cell::Local;

/// Values of Lagrange polynomials at places along an axis.
pub(super) struct Interpolation {
    /// The places along the axis, each with its weight.
    pub(super) places: Vec<(f64, f64)>,
    /// The polynomials of all knots at each place.
    rows: Vec<Vec<f64>>,
}

impl Interpolation {
    /// The polynomials of these knots at places with weights.
    pub(super) fn new(knots: &[f64], places: Vec<(f64, f64)>) -> Self {
        let rows = places.iter().map(|(x, _)| lagrange(knots, *x)).collect();
        Interpolation { places, rows }
    }

    /// Interpolates numbers on the grid of knots, `size` of them at each point, to the grid of places; the result is in
    /// `room[0]`. On both grids the last axis runs fastest.
    pub(super) fn apply(
        &self,
        numbers: &[f64],
        dimension: usize,
        size: usize,
        room: &mut [Vec<f64>; 2],
    ) {
        let (from, to) = (self.rows[0].len(), self.rows.len());
        let [result, other] = room;
        result.clear();
        result.extend(numbers);
        for axis in 0..dimension {
            std::mem::swap(result, other);
            let (before, behind) =
                (to.pow(axis as u32), from.pow((dimension - 1 - axis) as u32) * size);
            result.clear();
            result.resize(before * to * behind, 0.0);
            let blocks =
                other.chunks_exact(from * behind).zip(result.chunks_exact_mut(to * behind));
            for (own, results) in blocks {
                for (row, result) in self.rows.iter().zip(results.chunks_exact_mut(behind)) {
                    for (factor, own) in row.iter().zip(own.chunks_exact(behind)) {
                        result.iter_mut().zip(own).for_each(|(to, it)| *to += factor * it);
                    }
                }
            }
        }
    }

    /// The place and the weight of a point of the grid.
    pub(super) fn point(&self, mut index: usize, dimension: usize) -> (Local, f64) {
        let (mut at, mut weight) = ([0.0; 3], 1.0);
        for axis in (0..dimension).rev() {
            let (x, own) = self.places[index % self.places.len()];
            index /= self.places.len();
            (at[axis], weight) = (x, weight * own);
        }
        (at, weight)
    }
}

/// The polynomials that are 1 at one knot and 0 at the others, at a place.
fn lagrange(knots: &[f64], x: f64) -> Vec<f64> {
    let factor = |at: usize, other: usize| match at == other {
        true => 1.0,
        false => (x - knots[other]) / (knots[at] - knots[other]),
    };
    let all = 0..knots.len();
    all.clone().map(|at| all.clone().map(|other| factor(at, other)).product()).collect()
}
