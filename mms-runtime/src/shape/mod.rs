//! Shape functions: the weights w_ip and weight gradients that tie a particle to its nodes.
//!
//! To add one, write `shape/name.rs` with a type that implements [`Shape`] (the formula of one axis,
//! its source, and how the particle's half width follows its deformation), and add `name::Type` to
//! the list below. The property tests and the `mms` command then find it by itself.

use crate::extension::extension_list;
use crate::{Matrix, Real, Vector};

extension_list! {
    /// The shape functions.
    ShapeName, ShapeVisitor: Shape, "shape function";
    linear::Linear,
    ugimp::Ugimp,
    cpgimp::Cpgimp,
}

/// The most nodes along one axis that a particle may touch.
pub const MAX_NODES: usize = 4;

/// A shape function: the tensor product of one formula per axis.
///
/// Lengths are in cells (divided by the cell size); node `i` of an axis is at coordinate `i`.
/// The weights of one particle add up to 1, and reproduce linear functions of its position.
pub trait Shape: 'static {
    /// The half width l_p of a particle's domain along each axis, from its initial half width and its
    /// displacement gradient. Lengths in, lengths out.
    fn half_width<T: Real, const D: usize>(
        initial: &Vector<T, D>,
        displacement_gradient: &Matrix<T, D>,
    ) -> Vector<T, D>;

    /// The weights along one axis of a particle at `position` with half width `half_width`.
    ///
    /// `position` is finite and well within the range of `i64`; 0 < `half_width` < 1.
    fn axis_weights<T: Real>(position: T, half_width: T) -> AxisWeights<T>;
}

/// The weights along one axis: those of nodes `first`, `first + 1`, ...
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisWeights<T> {
    /// The first node with a weight.
    pub first: i64,
    /// How many nodes follow, `first` included; at most [`MAX_NODES`].
    pub count: usize,
    /// The weights; those past `count` mean nothing.
    pub weight: [T; MAX_NODES],
    /// Their derivatives with respect to the position in cells.
    pub weight_gradient: [T; MAX_NODES],
}

impl<T: Real> AxisWeights<T> {
    /// `count` weights from node `first` on; `formula` gives the weight and its derivative for a
    /// particle at the given offset (in cells) from a node.
    pub fn new(position: T, first: T, count: usize, formula: impl Fn(T) -> (T, T)) -> Self {
        let mut weights = Self {
            first: first.to_f64() as i64,
            count: count.min(MAX_NODES),
            weight: [T::zero(); MAX_NODES],
            weight_gradient: [T::zero(); MAX_NODES],
        };
        let mut offset = position - first;
        for k in 0..weights.count {
            (weights.weight[k], weights.weight_gradient[k]) = formula(offset);
            offset -= T::one();
        }
        weights
    }
}

/// The nodes of one particle, with their weights: the tensor product of its axes' weights.
#[derive(Clone, Copy, Debug)]
pub struct Stencil<T, const D: usize> {
    /// Index of the first node in the grid's arrays.
    first: usize,
    /// Distance in the grid's arrays between neighbours along each axis.
    stride: [usize; D],
    /// Weights along each axis; their gradients are per length here, not per cell.
    axes: [AxisWeights<T>; D],
}

impl<T: Real, const D: usize> Stencil<T, D> {
    /// The stencil of a particle at `position` with `half_width` (in cells, relative to the grid's first
    /// node) on a grid of `count` nodes per axis, or `None` if it does not fit on the grid.
    pub fn new<S: Shape>(
        position: &Vector<T, D>,
        half_width: &Vector<T, D>,
        cell_size: T,
        count: &[usize; D],
        stride: &[usize; D],
    ) -> Option<Self> {
        let mut first = 0;
        let mut axes = [AxisWeights::new(T::zero(), T::zero(), 0, |x| (x, x)); D];
        for a in 0..D {
            let on_axis = position[a] >= T::zero() && position[a] < T::of(count[a] as f64);
            if !on_axis {
                return None;
            }
            axes[a] = S::axis_weights(position[a], half_width[a]);
            let start = usize::try_from(axes[a].first).ok()?;
            if start + axes[a].count > count[a] {
                return None;
            }
            first += start * stride[a];
            axes[a].weight_gradient.iter_mut().for_each(|gradient| *gradient /= cell_size);
        }
        Some(Self { first, stride: *stride, axes })
    }

    /// The nodes: index, weight, weight gradient (per length).
    pub fn nodes(&self) -> Nodes<'_, T, D> {
        Nodes { stencil: self, offset: [0; D], done: self.axes.iter().any(|axis| axis.count == 0) }
    }
}

/// The nodes of a [`Stencil`], the first axis running fastest.
pub struct Nodes<'a, T, const D: usize> {
    stencil: &'a Stencil<T, D>,
    offset: [usize; D],
    done: bool,
}

impl<T: Real, const D: usize> Iterator for Nodes<'_, T, D> {
    type Item = (usize, T, Vector<T, D>);

    fn next(&mut self) -> Option<Self::Item> {
        if self.done {
            return None;
        }
        let Stencil { first, stride, axes } = self.stencil;
        let mut node = *first;
        let mut weight = T::one();
        let mut weight_gradient = Vector::repeat(T::one());
        for a in 0..D {
            let k = self.offset[a];
            node += k * stride[a];
            weight *= axes[a].weight[k];
            for b in 0..D {
                let factor = if a == b { axes[a].weight_gradient[k] } else { axes[a].weight[k] };
                weight_gradient[b] *= factor;
            }
        }
        self.advance();
        Some((node, weight, weight_gradient))
    }
}

impl<T, const D: usize> Nodes<'_, T, D> {
    fn advance(&mut self) {
        for a in 0..D {
            self.offset[a] += 1;
            if self.offset[a] < self.stencil.axes[a].count {
                return;
            }
            self.offset[a] = 0;
        }
        self.done = true;
    }
}
