//! Stencils that are products of weights along the axes.
//!
//! The sums are factorised: what does not depend on the node along an axis is multiplied once for all of
//! them, so that a node takes one product per number, and one more where there are slopes.

use mms_math::machine::Machine;

use super::{Stencil, add};
use crate::nodal::Nodal;
use crate::{Lattice, Real, Vector};

/// A stencil that is the product of the weights along the axes.
#[derive(Clone, Copy, Debug)]
pub struct Tensor<T, const D: usize, const N: usize> {
    /// Number of the first node along each axis.
    start: [usize; D],
    /// Index of the first node in the grid's arrays.
    first: usize,
    /// Distance in the grid's arrays between neighbours along each axis.
    stride: [usize; D],
    /// How many nodes along each axis have a weight, at most: N, or 3 of 4, which GIMP mostly has.
    width: usize,
    weight: [[T; N]; D],
    /// Derivatives of the weights, per length.
    slope: [[T; N]; D],
}

impl<T: Real, const D: usize, const N: usize> Tensor<T, D, N> {
    /// A stencil that has no nodes yet.
    #[inline(always)]
    pub fn new() -> Self {
        Self {
            start: [0; D],
            first: 0,
            stride: [0; D],
            width: N,
            weight: [[T::zero(); N]; D],
            slope: [[T::zero(); N]; D],
        }
    }

    /// Takes weights and their derivatives (per cell) of the nodes along axis `a`, as many as there is room for.
    #[inline(always)]
    pub fn set<const M: usize>(
        &mut self,
        lattice: &Lattice<T, D>,
        a: usize,
        first: T,
        [weight, slope]: [[T; M]; 2],
    ) {
        for k in 0..N.min(M) {
            self.weight[a][k] = weight[k];
            self.slope[a][k] = slope[k] * lattice.per_length[a];
        }
        // What is not a number, or before the first node, is a number beyond the last one.
        let first = first.to_f64();
        self.start[a] = if first >= 0.0 { first as usize } else { usize::MAX };
    }

    /// Takes the nodes where they are now, so many along each axis. Whether all of them are on the grid; if not,
    /// the stencil may not be used.
    #[inline(always)]
    pub fn settle(&mut self, lattice: &Lattice<T, D>, width: usize) -> bool {
        (self.stride, self.width, self.first) = (lattice.stride, width, 0);
        let mut fits = true;
        for a in 0..D {
            fits &= self.start[a].saturating_add(width) <= lattice.count[a];
            self.first = self.first.wrapping_add(self.start[a].wrapping_mul(lattice.stride[a]));
        }
        fits
    }

    /// With the moments w (x_i - x_p) in place of slopes; `scaled`, over sum_i w (x_i - x_p)^2.
    #[inline(always)]
    fn with_moments(&self, lattice: &Lattice<T, D>, scaled: bool) -> Self {
        let mut tensor = *self;
        for a in 0..D {
            let nodes = &lattice.coordinate[a][self.start[a]..self.start[a] + self.width];
            let (weight, slope) = (&self.weight[a], &mut tensor.slope[a]);
            let mut middle = T::zero();
            for (w, x) in weight.iter().zip(nodes) {
                middle += *w * (*x - nodes[0]);
            }
            let mut spread = T::zero();
            for ((slope, w), x) in slope.iter_mut().zip(weight).zip(nodes) {
                let apart = (*x - nodes[0]) - middle;
                *slope = *w * apart;
                spread += *slope * apart;
            }
            if scaled {
                let factor = T::one() / spread;
                slope.iter_mut().for_each(|slope| *slope *= factor);
            }
        }
        tensor
    }

    /// The weight and slope of node `k` along axis `a`; of an axis that there is not, 1 and 0.
    #[inline(always)]
    fn along<M: Machine<T>>(&self, machine: M, a: usize, k: usize) -> [M::Four; 2] {
        if a < D {
            [machine.splat(self.weight[a][k]), machine.splat(self.slope[a][k])]
        } else {
            [machine.splat(T::one()), machine.splat(T::zero())]
        }
    }

    /// How many nodes there are along an axis, with `W` along those that there are.
    #[inline(always)]
    fn nodes_along<const W: usize>(a: usize) -> usize {
        if a < D { W } else { 1 }
    }

    /// The first node of a row along the first axis.
    #[inline(always)]
    fn row(&self, k1: usize, k2: usize) -> usize {
        let stride = |a: usize| if a < D { self.stride[a] } else { 0 };
        self.first + k1 * stride(1) + k2 * stride(2)
    }

    #[inline(always)]
    fn spread_over<M: Machine<T>, const W: usize, const SLOPES: bool>(
        &self,
        machine: M,
        value: M::Four,
        slopes: &[M::Four; D],
        nodes: &mut [Nodal<T>],
    ) {
        let nothing = machine.splat(T::zero());
        for k2 in 0..Self::nodes_along::<W>(2) {
            let [w2, s2] = self.along(machine, 2, k2);
            let mut of_plane = machine.times(w2, value);
            let mut slopes_of_plane = [nothing; 2];
            if SLOPES {
                for a in 0..D.min(2) {
                    slopes_of_plane[a] = machine.times(w2, slopes[a]);
                }
                if D > 2 {
                    of_plane = machine.times_plus(s2, slopes[D - 1], of_plane);
                }
            }
            for k1 in 0..Self::nodes_along::<W>(1) {
                let [w1, s1] = self.along(machine, 1, k1);
                let mut of_row = machine.times(w1, of_plane);
                let slope_of_row = machine.times(w1, slopes_of_plane[0]);
                if SLOPES && D > 1 {
                    of_row = machine.times_plus(s1, slopes_of_plane[1], of_row);
                }
                let first = self.row(k1, k2);
                for (k0, node) in nodes[first..first + W].iter_mut().enumerate() {
                    let [w0, s0] = self.along(machine, 0, k0);
                    add(machine, node, w0, of_row);
                    if SLOPES {
                        add(machine, node, s0, slope_of_row);
                    }
                }
            }
        }
    }

    #[inline(always)]
    fn collect_over<M: Machine<T>, const W: usize, const SLOPES: bool>(
        &self,
        machine: M,
        nodes: &[Nodal<T>],
    ) -> (M::Four, [M::Four; D]) {
        let nothing = machine.splat(T::zero());
        let (mut value, mut slopes) = (nothing, [nothing; D]);
        for k2 in 0..Self::nodes_along::<W>(2) {
            let [w2, s2] = self.along(machine, 2, k2);
            let mut of_plane = nothing;
            let mut slopes_of_plane = [nothing; 2];
            for k1 in 0..Self::nodes_along::<W>(1) {
                let [w1, s1] = self.along(machine, 1, k1);
                let (mut of_row, mut slope_of_row) = (nothing, nothing);
                let first = self.row(k1, k2);
                for (k0, node) in nodes[first..first + W].iter().enumerate() {
                    let [w0, s0] = self.along(machine, 0, k0);
                    let node = machine.four(&node.0);
                    of_row = machine.times_plus(w0, node, of_row);
                    if SLOPES {
                        slope_of_row = machine.times_plus(s0, node, slope_of_row);
                    }
                }
                of_plane = machine.times_plus(w1, of_row, of_plane);
                if SLOPES {
                    slopes_of_plane[0] = machine.times_plus(w1, slope_of_row, slopes_of_plane[0]);
                    slopes_of_plane[1] = machine.times_plus(s1, of_row, slopes_of_plane[1]);
                }
            }
            value = machine.times_plus(w2, of_plane, value);
            if SLOPES {
                for a in 0..D.min(2) {
                    slopes[a] = machine.times_plus(w2, slopes_of_plane[a], slopes[a]);
                }
                if D > 2 {
                    slopes[D - 1] = machine.times_plus(s2, of_plane, slopes[D - 1]);
                }
            }
        }
        (value, slopes)
    }

    #[inline(always)]
    fn spread_any<M: Machine<T>, const SLOPES: bool>(
        &self,
        machine: M,
        value: M::Four,
        slopes: &[M::Four; D],
        nodes: &mut [Nodal<T>],
    ) {
        if N > 3 && self.width == 3 {
            self.spread_over::<M, 3, SLOPES>(machine, value, slopes, nodes);
        } else {
            self.spread_over::<M, N, SLOPES>(machine, value, slopes, nodes);
        }
    }

    #[inline(always)]
    fn collect_any<M: Machine<T>, const SLOPES: bool>(
        &self,
        machine: M,
        nodes: &[Nodal<T>],
    ) -> (M::Four, [M::Four; D]) {
        if N > 3 && self.width == 3 {
            self.collect_over::<M, 3, SLOPES>(machine, nodes)
        } else {
            self.collect_over::<M, N, SLOPES>(machine, nodes)
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
                        others.fold(T::one(), |product, a| product * self.weight[a][k[a]])
                    };
                    let gradient = Vector::from_fn(|a, _| self.slope[a][k[a]] * product(a));
                    visit(node, product(D), gradient);
                }
            }
        }
    }

    #[inline(always)]
    fn shift(&mut self, first: usize) {
        self.first -= first;
    }

    #[inline(always)]
    fn spread_value<M: Machine<T>>(&self, machine: M, value: M::Four, nodes: &mut [Nodal<T>]) {
        self.spread_any::<M, false>(machine, value, &[value; D], nodes);
    }

    #[inline(always)]
    fn spread<M: Machine<T>>(
        &self,
        machine: M,
        value: M::Four,
        slopes: [M::Four; D],
        nodes: &mut [Nodal<T>],
    ) {
        self.spread_any::<M, true>(machine, value, &slopes, nodes);
    }

    #[inline(always)]
    fn collect_value<M: Machine<T>>(&self, machine: M, nodes: &[Nodal<T>]) -> M::Four {
        self.collect_any::<M, false>(machine, nodes).0
    }

    #[inline(always)]
    fn collect<M: Machine<T>>(&self, machine: M, nodes: &[Nodal<T>]) -> (M::Four, [M::Four; D]) {
        self.collect_any::<M, true>(machine, nodes)
    }

    #[inline(always)]
    fn spread_moments<M: Machine<T>>(
        &self,
        machine: M,
        lattice: &Lattice<T, D>,
        value: M::Four,
        slopes: [M::Four; D],
        nodes: &mut [Nodal<T>],
    ) {
        self.with_moments(lattice, false).spread(machine, value, slopes, nodes);
    }

    #[inline(always)]
    fn collect_slopes<M: Machine<T>>(
        &self,
        machine: M,
        lattice: &Lattice<T, D>,
        nodes: &[Nodal<T>],
    ) -> [M::Four; D] {
        self.with_moments(lattice, true).collect(machine, nodes).1
    }
}
