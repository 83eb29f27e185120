//! The geometry of the background grid: cells, and the nodes that shape functions have on them.
//!
//! Along an axis, cells lie between knots, one cell size apart; a spline of degree p has one node per cell
//! and p more. Node `j` is at the mean of the p inner knots of its spline (Greville 1967), so that
//! sum_i w_i x_i = x. For degree 1 these are the knots themselves.

use mms_math::machine::Machine;

use crate::failure::at_most;
use crate::nodal::four;
use crate::{Real, Refusal, Vector};

/// More nodes than this are refused.
const NODE_LIMIT: f64 = (1u64 << 28) as f64;

/// The cells along one axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Coordinate of the first knot.
    pub lower: f64,
    /// Distance between knots.
    pub cell_size: f64,
    /// How many cells there are.
    pub cells: usize,
    /// The first and the last knot of splines. Where it is not the first or last of the axis, splines
    /// end there with knots of full multiplicity: at the faces of a body that do not move.
    pub ends: [i64; 2],
    /// Where the faces of the body lie, in cells from the first knot.
    pub body: [f64; 2],
}

/// A regular grid of equal boxes, the first axis running fastest in every array.
#[derive(Clone, Debug)]
pub struct Lattice<T, const D: usize> {
    /// Position of the first knot.
    pub lower: Vector<T, D>,
    /// Distance h between knots along each axis.
    pub cell_size: Vector<T, D>,
    /// 1/h.
    pub per_length: Vector<T, D>,
    /// Nodes along each axis.
    pub count: [usize; D],
    /// Distance in the arrays between neighbours along each axis.
    pub stride: [usize; D],
    /// The degree of the shape functions that the nodes are for.
    pub degree: usize,
    /// The cells along each axis.
    pub axes: [Axis; D],
    /// [`Axis::ends`] as lengths in cells.
    pub ends: [[T; 2]; D],
    /// The period along each axis, in cells, where there is one.
    pub period: [Option<T>; D],
    /// The coordinates of the nodes along each axis.
    pub coordinate: [Vec<T>; D],
    /// The same four axes at a time.
    pub frame: Frame<T>,
}

/// What finds a position's cell along four axes at a time. Along those that there are not, everything is in the
/// middle of a cell, far from the ends.
#[derive(Clone, Copy, Debug)]
pub struct Frame<T> {
    /// [`Lattice::lower`].
    pub lower: [T; 4],
    /// [`Lattice::per_length`].
    pub per_length: [T; 4],
    /// [`Lattice::count`], and how many more there would be room for.
    pub nodes: [T; 4],
    /// [`Lattice::ends`].
    pub ends: [[T; 4]; 2],
}

impl<T: Real> Frame<T> {
    fn new(axes: &[Axis], degree: usize) -> Self {
        let all = |of: fn(&Axis) -> f64, beyond: f64| {
            std::array::from_fn(|a| T::of(axes.get(a).map_or(beyond, of)))
        };
        let nodes = |a: usize| axes.get(a).map_or(BEYOND.cells, |axis| axis.cells) + degree;
        Self {
            lower: all(|axis| axis.lower, BEYOND.lower),
            per_length: all(|axis| 1.0 / axis.cell_size, BEYOND.cell_size),
            nodes: std::array::from_fn(|a| T::of(nodes(a) as f64)),
            ends: [
                all(|axis| axis.ends[0] as f64, BEYOND.ends[0] as f64),
                all(|axis| axis.ends[1] as f64, BEYOND.ends[1] as f64),
            ],
        }
    }
}

/// An axis that there is not, where every coordinate is 0.
const BEYOND: Axis =
    Axis { lower: -16.5, cell_size: 1.0, cells: 32, ends: [0, 32], body: [0.0, 32.0] };

impl<T: Real, const D: usize> Lattice<T, D> {
    /// The nodes of shape functions of `degree` on these cells.
    ///
    /// # Errors
    /// More than 2^28 nodes.
    pub fn new(mut axes: [Axis; D], degree: usize, periodic: [bool; D]) -> Result<Self, Refusal> {
        for axis in axes.iter_mut().filter(|_| degree == 1) {
            // Hat functions go on beyond a face, for its images.
            axis.ends = [0, axis.cells as i64];
        }
        let frame = Frame::new(&axes, degree);
        let nodes: f64 = axes.iter().map(|axis| (axis.cells + degree) as f64).product();
        at_most("grid nodes", nodes, NODE_LIMIT)?;
        let count: [usize; D] = std::array::from_fn(|a| axes[a].cells + degree);
        let coordinate = std::array::from_fn(|a| {
            let Axis { lower, cell_size, .. } = axes[a];
            (0..count[a])
                .map(|j| T::of(lower + greville(j, degree, axes[a].ends) * cell_size))
                .collect()
        });
        Ok(Self {
            lower: Vector::from_fn(|a, _| T::of(axes[a].lower)),
            cell_size: Vector::from_fn(|a, _| T::of(axes[a].cell_size)),
            per_length: Vector::from_fn(|a, _| T::of(1.0 / axes[a].cell_size)),
            ends: std::array::from_fn(|a| axes[a].ends.map(|end| T::of(end as f64))),
            stride: std::array::from_fn(|a| count[..a].iter().product()),
            period: std::array::from_fn(|a| {
                periodic[a].then(|| T::of(axes[a].body[1] - axes[a].body[0]))
            }),
            count,
            degree,
            axes,
            coordinate,
            frame,
        })
    }

    /// How many nodes there are.
    pub fn len(&self) -> usize {
        self.count.iter().product()
    }

    /// Whether there is no node; a grid always has some.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The node's number along each axis.
    pub fn coordinates(&self, node: usize) -> [usize; D] {
        std::array::from_fn(|a| node / self.stride[a] % self.count[a])
    }

    /// The node's position.
    pub fn position(&self, node: usize) -> Vector<T, D> {
        let coordinates = self.coordinates(node);
        Vector::from_fn(|a, _| self.coordinate[a][coordinates[a]])
    }

    /// A position in cells from the first knot, within the period where there is one.
    #[inline(always)]
    pub fn in_cells(&self, position: &Vector<T, D>) -> Vector<T, D> {
        let mut cells = *position;
        for a in 0..D {
            cells[a] = (position[a] - self.lower[a]) * self.per_length[a];
            if let Some(period) = self.period[a] {
                let start = T::of(self.axes[a].body[0]);
                let periods = ((cells[a] - start) / period).floor();
                cells[a] -= periods * period;
            }
        }
        cells
    }

    /// As [`in_cells`](Lattice::in_cells), four axes at a time.
    #[inline(always)]
    pub fn in_frame<M: Machine<T>>(&self, machine: M, position: &Vector<T, D>) -> M::Four {
        if self.period.iter().any(Option::is_some) {
            let middle = T::of(-BEYOND.lower);
            return four(machine, &self.in_cells(position), middle);
        }
        let from_lower =
            machine.minus(four(machine, position, T::zero()), machine.four(&self.frame.lower));
        machine.times(from_lower, machine.four(&self.frame.per_length))
    }

    /// The node on the lower (`false`) or upper face of the body along an axis, where there is one: the
    /// face lies on a knot, and splines of a higher degree than 1 end there.
    pub fn node_on_face(&self, axis: usize, upper: bool) -> Option<usize> {
        let Axis { body, ends, .. } = &self.axes[axis];
        let knot = body[usize::from(upper)].round();
        let on_knot = (body[usize::from(upper)] - knot).abs() < 1e-4;
        let ended = self.degree == 1 || ends[usize::from(upper)] == knot as i64;
        let node = knot as usize + if upper { self.degree - 1 } else { 0 };
        (on_knot && ended).then_some(node)
    }
}

/// The mean of the inner knots of node `j`, in cells: the knots j - p + 1 to j, held between the ends.
fn greville(j: usize, degree: usize, ends: [i64; 2]) -> f64 {
    let knot = |k: i64| k.clamp(ends[0], ends[1]) as f64;
    let first = j as i64 - degree as i64 + 1;
    (first..=j as i64).map(knot).sum::<f64>() / degree as f64
}
