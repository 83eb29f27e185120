//! Stencils that are products of weights along the axes.
//!
//! The sums are factorised: what does not depend on the node along an axis is multiplied once for all of
//! them, so that a node takes one product per number, and one more where there are slopes.

use mms_math::machine::Machine;

use super::Stencil;
use super::rows::{Both, Collect, CollectValue, RowSum, Spread, SpreadValue};
use crate::defect::{Defect, on};
use crate::nodal::{Nodal, Window};
use crate::{Lattice, Real, Vector};

/// A stencil that is the product of the weights along the axes.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub struct Tensor<T, const D: usize, const N: usize> {
    /// The weights of the first, second, .. node along every axis; past the last axis they mean nothing.
    weight: [[T; 4]; N],
    /// Their derivatives, per length.
    slope: [[T; 4]; N],
    /// Index of the first node in the grid's arrays.
    first: usize,
    /// Distance in the grid's arrays between neighbours along each axis.
    stride: [usize; D],
    /// Number of the first node along each axis.
    start: [i32; 4],
    /// How many nodes along each axis have a weight, at most: N, or 3 of 4, which GIMP mostly has.
    width: usize,
}

/// Nodes along an axis of a stencil that has room for more, but does not need it.
const NARROW: usize = 3;

/// The weight and the slope of one node along an axis.
pub type Pair<F> = [F; 2];

impl<T: Real, const D: usize, const N: usize> Tensor<T, D, N> {
    /// A stencil that has no nodes yet.
    #[inline(always)]
    pub fn new() -> Self {
        Self {
            weight: [[T::zero(); 4]; N],
            slope: [[T::zero(); 4]; N],
            first: 0,
            stride: [0; D],
            start: [0; 4],
            width: N,
        }
    }

    /// Takes the weights along all axes, and their derivatives per cell, of the nodes from `first` on. Whether all
    /// nodes are on the grid; if not, the stencil may not be used.
    #[inline(always)]
    pub fn set<M: Machine<T>, const W: usize>(
        &mut self,
        machine: M,
        lattice: &Lattice<T, D>,
        first: M::Four,
        [weight, slope]: [[M::Four; W]; 2],
    ) -> bool {
        let per_length = machine.four(&lattice.frame.per_length);
        let square = on(Defect::SquareCells);
        let first_axis = lattice.frame.per_length[0];
        let per_length = if square { machine.splat(first_axis) } else { per_length };
        for k in 0..N.min(W) {
            self.weight[k] = machine.numbers(weight[k]);
            self.slope[k] = machine.numbers(machine.times(slope[k], per_length));
        }
        let width = if W < N { N.min(W.max(NARROW)) } else { N };
        for k in W..width {
            (self.weight[k], self.slope[k]) = ([T::zero(); 4], [T::zero(); 4]);
        }
        let after = machine.plus(first, machine.splat(T::of(width as f64)));
        // What is not a number is on no grid.
        let fits = machine.all_at_most(machine.splat(T::zero()), first)
            && machine.all_at_most(after, machine.four(&lattice.frame.nodes));
        self.start = machine.whole(first);
        (self.stride, self.width, self.first) = (lattice.stride, width, 0);
        for a in 0..D {
            self.first += (self.start[a] as usize).wrapping_mul(lattice.stride[a]);
        }
        fits
    }

    /// With the moments w (x_i - x_p) in place of slopes; `scaled`, over sum_i w (x_i - x_p)^2.
    #[inline(always)]
    fn with_moments<M: Machine<T>>(
        &self,
        machine: M,
        lattice: &Lattice<T, D>,
        scaled: bool,
    ) -> Self {
        let mut tensor = *self;
        let zero = machine.splat(T::zero());
        let (mut weight, mut apart) = ([zero; N], [zero; N]);
        let mut middle = zero;
        for k in 0..N.min(self.width) {
            let mut from_first = [T::zero(); 4];
            for a in 0..D {
                let start = self.start[a] as usize;
                from_first[a] = lattice.coordinate[a][start + k] - lattice.coordinate[a][start];
            }
            weight[k] = machine.four(&self.weight[k]);
            apart[k] = machine.four(&from_first);
            middle = machine.times_plus(weight[k], apart[k], middle);
        }
        let mut spread = zero;
        for k in 0..N {
            apart[k] = machine.minus(apart[k], middle);
            weight[k] = machine.times(weight[k], apart[k]);
            spread = machine.times_plus(weight[k], apart[k], spread);
        }
        for k in 0..N {
            let moment = if scaled { machine.over(weight[k], spread) } else { weight[k] };
            tensor.slope[k] = machine.numbers(moment);
        }
        tensor
    }

    /// The weight and slope of node `k` along axis `a`; of an axis that there is not, 1 and 0.
    #[inline(always)]
    fn along<M: Machine<T>>(&self, machine: M, a: usize, k: usize) -> Pair<M::Four> {
        if a < D {
            [machine.splat(self.weight[k][a]), machine.splat(self.slope[k][a])]
        } else {
            [machine.splat(T::one()), machine.splat(T::zero())]
        }
    }

    /// Does a sum over all nodes.
    #[inline(always)]
    fn sum<M: Machine<T>>(&self, machine: M, sum: &mut impl RowSum<T, M>) {
        if N > NARROW && self.width == NARROW {
            self.sum_of::<M, NARROW>(machine, sum);
        } else {
            self.sum_of::<M, N>(machine, sum);
        }
    }

    /// Does a sum over `W` nodes along every axis.
    #[inline(always)]
    fn sum_of<M: Machine<T>, const W: usize>(&self, machine: M, sum: &mut impl RowSum<T, M>) {
        let mut pairs = [[machine.splat(T::zero()); 2]; W];
        for k in 0..W {
            pairs[k] = self.along(machine, 0, k);
        }
        for k2 in 0..if D > 2 { W } else { 1 } {
            let pair = self.along(machine, 2, k2);
            let mut plane = sum.plane(machine, pair);
            for k1 in 0..if D > 1 { W } else { 1 } {
                let mut first = self.first;
                if D > 1 {
                    first += k1 * self.stride[1];
                }
                if D > 2 {
                    first += k2 * self.stride[2];
                }
                sum.row(machine, &mut plane, self.along(machine, 1, k1), &pairs, first);
            }
            sum.end(machine, plane, pair);
        }
    }
}

impl<T: Real, const D: usize, const N: usize> Default for Tensor<T, D, N> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Real, const D: usize, const N: usize> Stencil<T, D> for Tensor<T, D, N> {
    fn each(&self, mut visit: impl FnMut(usize, T, Vector<T, D>)) {
        let width = |a: usize| if a < D { self.width } else { 1 };
        for k2 in 0..width(2) {
            for k1 in 0..width(1) {
                for k0 in 0..width(0) {
                    let k = [k0, k1, k2];
                    let node = (0..D).map(|a| k[a] * self.stride[a]).sum::<usize>() + self.first;
                    let product = |skip: usize| {
                        let others = (0..D).filter(|&a| a != skip);
                        others.fold(T::one(), |product, a| product * self.weight[k[a]][a])
                    };
                    let gradient = Vector::from_fn(|a, _| self.slope[k[a]][a] * product(a));
                    visit(node, product(D), gradient);
                }
            }
        }
    }

    #[inline(always)]
    fn span(&self) -> [usize; 2] {
        let mut last = self.first;
        for stride in self.stride {
            last += (self.width - 1) * stride;
        }
        [self.first, last + 1]
    }

    #[inline(always)]
    fn spread_value<M: Machine<T>>(&self, machine: M, value: M::Four, nodes: Window<'_, T>) {
        self.sum(machine, &mut SpreadValue { value, nodes });
    }

    #[inline(always)]
    fn spread<M: Machine<T>>(
        &self,
        machine: M,
        value: M::Four,
        slopes: [M::Four; D],
        nodes: Window<'_, T>,
    ) {
        self.sum(machine, &mut Spread { value, slopes, nodes });
    }

    #[inline(always)]
    fn spread_both<M: Machine<T>>(
        &self,
        machine: M,
        [first_value, value]: [M::Four; 2],
        slopes: [M::Four; D],
        [first_nodes, nodes]: [Window<'_, T>; 2],
    ) {
        let first = SpreadValue { value: first_value, nodes: first_nodes };
        let second = Spread { value, slopes, nodes };
        self.sum(machine, &mut Both { first, second });
    }

    #[inline(always)]
    fn collect_value<M: Machine<T>>(&self, machine: M, nodes: &[Nodal<T>]) -> M::Four {
        let mut sum = CollectValue { value: machine.splat(T::zero()), nodes };
        self.sum(machine, &mut sum);
        sum.value
    }

    #[inline(always)]
    fn collect<M: Machine<T>>(&self, machine: M, nodes: &[Nodal<T>]) -> (M::Four, [M::Four; D]) {
        let nothing = machine.splat(T::zero());
        let mut sum = Collect { value: nothing, slopes: [nothing; D], nodes };
        self.sum(machine, &mut sum);
        (sum.value, sum.slopes)
    }

    #[inline(always)]
    fn collect_both<M: Machine<T>>(
        &self,
        machine: M,
        [first_nodes, nodes]: [&[Nodal<T>]; 2],
    ) -> ([M::Four; 2], [M::Four; D]) {
        let nothing = machine.splat(T::zero());
        let first = CollectValue { value: nothing, nodes: first_nodes };
        let second = Collect { value: nothing, slopes: [nothing; D], nodes };
        let mut sum = Both { first, second };
        self.sum(machine, &mut sum);
        ([sum.first.value, sum.second.value], sum.second.slopes)
    }

    #[inline(always)]
    fn spread_moments<M: Machine<T>>(
        &self,
        machine: M,
        lattice: &Lattice<T, D>,
        value: M::Four,
        slopes: [M::Four; D],
        nodes: Window<'_, T>,
    ) {
        self.with_moments(machine, lattice, false).spread(machine, value, slopes, nodes);
    }

    #[inline(always)]
    fn collect_slopes<M: Machine<T>>(
        &self,
        machine: M,
        lattice: &Lattice<T, D>,
        nodes: &[Nodal<T>],
    ) -> [M::Four; D] {
        self.with_moments(machine, lattice, true).collect(machine, nodes).1
    }
}
