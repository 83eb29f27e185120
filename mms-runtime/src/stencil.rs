//! The nodes of one particle, with their weights w_ip and weight gradients grad w_ip.

use crate::{Lattice, Real, Vector};

/// The nodes that a particle touches.
pub trait Stencil<T: Real, const D: usize>: Clone + Send + Sync {
    /// Calls `visit(i, w_ip, grad w_ip)` for every node i; a node may come more than once, and its
    /// weights then add up.
    fn each(&self, visit: impl FnMut(usize, T, Vector<T, D>));

    /// sum_i w_ip q_i: the nodal quantity at the particle.
    fn interpolate(&self, nodal: &[Vector<T, D>]) -> Vector<T, D> {
        let mut sum = Vector::zeros();
        self.each(|i, w, _| sum += nodal[i] * w);
        sum
    }
}

/// The weights along one axis: those of the nodes `first`, `first + 1`, ...
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisWeights<T, const N: usize> {
    /// The first node with a weight.
    pub first: i64,
    /// How many nodes there are, `first` included; at most `N`.
    pub count: usize,
    /// The weights; those past `count` mean nothing.
    pub weight: [T; N],
    /// Their derivatives by the position in cells.
    pub slope: [T; N],
}

impl<T: Real, const N: usize> AxisWeights<T, N> {
    /// `count` weights from node `first` on; `formula` gives the weight and its derivative for a
    /// particle at the given offset (in cells) from a node.
    pub fn new(position: T, first: T, count: usize, formula: impl Fn(T) -> (T, T)) -> Self {
        let node = first.to_f64();
        let mut weights = Self {
            // What is not finite is on no grid.
            first: if node.is_finite() { node as i64 } else { i64::MIN },
            count: count.min(N),
            weight: [T::zero(); N],
            slope: [T::zero(); N],
        };
        let mut offset = position - first;
        for k in 0..weights.count {
            (weights.weight[k], weights.slope[k]) = formula(offset);
            offset -= T::one();
        }
        weights
    }
}

/// A stencil that is the product of the weights along the axes.
#[derive(Clone, Copy, Debug)]
pub struct Tensor<T, const D: usize, const N: usize> {
    /// Index of the first node in the grid's arrays.
    first: usize,
    /// Distance in the grid's arrays between neighbours along each axis.
    stride: [usize; D],
    /// Weights along each axis; their slopes are per length here, not per cell.
    axes: [AxisWeights<T, N>; D],
}

impl<T: Real, const D: usize, const N: usize> Tensor<T, D, N> {
    /// The stencil with these weights along each axis, or `None` if it does not fit on the grid.
    pub fn new(
        lattice: &Lattice<T, D>,
        weights: impl Fn(usize) -> AxisWeights<T, N>,
    ) -> Option<Self> {
        let mut first = 0;
        let mut axes = std::array::from_fn(weights);
        for (a, axis) in axes.iter_mut().enumerate() {
            let start = usize::try_from(axis.first).ok()?;
            if start + axis.count > lattice.count[a] {
                return None;
            }
            first += start * lattice.stride[a];
            let per_length = T::one() / lattice.cell_size[a];
            axis.slope.iter_mut().for_each(|slope| *slope *= per_length);
        }
        Some(Self { first, stride: lattice.stride, axes })
    }
}

impl<T: Real, const D: usize, const N: usize> Stencil<T, D> for Tensor<T, D, N> {
    #[inline(always)]
    fn each(&self, mut visit: impl FnMut(usize, T, Vector<T, D>)) {
        let Self { first, stride, axes } = self;
        let counts = |a: usize| if a < D { axes[a].count } else { 1 };
        let factor = |a: usize, k: usize| if a < D { axes[a].weight[k] } else { T::one() };
        for k2 in 0..counts(2) {
            for k1 in 0..counts(1) {
                for k0 in 0..counts(0) {
                    let k = [k0, k1, k2];
                    let node = (0..D).map(|a| k[a] * stride[a]).sum::<usize>() + first;
                    let weight = factor(0, k0) * factor(1, k1) * factor(2, k2);
                    let gradient = Vector::from_fn(|a, _| {
                        (0..D).fold(T::one(), |product, b| {
                            let axis = &axes[b];
                            product * if a == b { axis.slope[k[b]] } else { axis.weight[k[b]] }
                        })
                    });
                    visit(node, weight, gradient);
                }
            }
        }
    }
}
