//! The geometry of the background grid: cells, and the nodes of shape functions on them.
//!
//! Along an axis, cells lie between knots, one cell size apart; a spline of degree p has one node per cell
//! and p more. Node `j` is at the mean of the p inner knots of its spline (Greville 1967), so that
//! sum_i w_i x_i = x. For degree 1 these are the knots themselves.

use mms_math::simd::{Plain, Simd};

use crate::failure::Refusal;
use crate::failure::at_most;
use crate::real::{Real, Vector};

/// The largest supported number of nodes.
const NODE_LIMIT: f64 = (1u64 << 28) as f64;

/// The cells along one axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Coordinate of the first knot.
    pub lower: f64,
    /// Distance between knots.
    pub cell_size: f64,
    /// The number of cells.
    pub cells: usize,
    /// The first and the last knot of splines. If it is not the first or last knot of the axis, splines end there with knots of
    /// full multiplicity: at the faces of a body that do not move.
    pub ends: [i64; 2],
    /// The positions of the body's faces, in cells from the first knot.
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
    /// [`count`](Lattice::count) as lengths in cells, which positions are compared with.
    pub nodes: [T; D],
    /// Distance in the arrays between neighbours along each axis.
    pub stride: [usize; D],
    /// The degree of the shape functions that the nodes are for.
    pub degree: usize,
    /// The cells along each axis.
    pub axes: [Axis; D],
    /// [`Axis::ends`] as lengths in cells.
    pub ends: [[T; 2]; D],
    /// The first and the last cell along each axis whose splines have no knot at the ends: as lengths in cells.
    pub inner: [[T; 2]; D],
    /// The period along each axis, in cells, where there is one.
    pub period: [Option<T>; D],
    /// The coordinates of the nodes along each axis.
    pub coordinate: [Vec<T>; D],
    /// Whether the first axis is the distance from an axis of revolution.
    pub is_meridian: bool,
}

impl<T: Real, const D: usize> Lattice<T, D> {
    /// Places the nodes of shape functions of `degree` on these cells.
    ///
    /// # Errors
    /// There are more than 2^28 nodes.
    pub fn new(mut axes: [Axis; D], degree: usize, periodic: [bool; D]) -> Result<Self, Refusal> {
        for axis in axes.iter_mut().filter(|_| degree == 1) {
            // Hat functions extend beyond a face, for its images.
            axis.ends = [0, axis.cells as i64];
        }
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
            inner: axes.each_ref().map(|axis| {
                let [first, last] = axis.ends.map(|end| end as f64);
                let reach = degree as f64 - 1.0;
                [T::of(first + reach), T::of(last - 1.0 - reach)]
            }),
            stride: std::array::from_fn(|a| count[..a].iter().product()),
            period: std::array::from_fn(|a| {
                periodic[a].then(|| T::of(axes[a].body[1] - axes[a].body[0]))
            }),
            nodes: count.map(|count| T::of(count as f64)),
            count,
            degree,
            axes,
            coordinate,
            is_meridian: false,
        })
    }

    /// The number of nodes.
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

    /// A position in cells from the first knot, within the period if there is one.
    pub fn in_cells(&self, position: &Vector<T, D>) -> Vector<T, D> {
        let simd = T::PlainSimd::from(Plain);
        let along = |a: usize| self.cells_along(simd, a, simd.splat(position[a]));
        Vector::from_fn(|a, _| simd.numbers(along(a))[0])
    }

    /// Converts coordinates of a pack of particles along one axis to cells, as [`in_cells`](Lattice::in_cells) does.
    #[inline(always)]
    pub fn cells_along<M: Simd<T>>(&self, simd: M, axis: usize, position: M::Eight) -> M::Eight {
        let from_lower = simd.minus(position, simd.splat(self.lower[axis]));
        let cells = simd.times(from_lower, simd.splat(self.per_length[axis]));
        let Some(period) = self.period[axis] else { return cells };
        let period = simd.splat(period);
        let start = simd.splat(T::of(self.axes[axis].body[0]));
        let periods = simd.floor(simd.over(simd.minus(cells, start), period));
        simd.minus(cells, simd.times(periods, period))
    }

    /// The node on the lower (`false`) or upper face of the body along an axis; `None` unless the face lies on a knot and
    /// splines of a higher degree than 1 end there.
    pub fn node_on_face(&self, axis: usize, upper: bool) -> Option<usize> {
        let Axis { body, ends, .. } = &self.axes[axis];
        let knot = body[usize::from(upper)].round();
        let on_knot = (body[usize::from(upper)] - knot).abs() < 1e-4;
        let ended = self.degree == 1 || ends[usize::from(upper)] == knot as i64;
        let node = knot as usize + if upper { self.degree - 1 } else { 0 };
        (on_knot && ended).then_some(node)
    }
}

/// The mean of the inner knots of node `j`, in cells: the knots j - p + 1 to j, clamped to the ends.
fn greville(j: usize, degree: usize, ends: [i64; 2]) -> f64 {
    let knot = |k: i64| k.clamp(ends[0], ends[1]) as f64;
    let first = j as i64 - degree as i64 + 1;
    (first..=j as i64).map(knot).sum::<f64>() / degree as f64
}
