//! The sums for one particle at a time, where larger registers are missing or not faster. The loops over nodes are compiled once
//! for all widths, so that this code is small. They multiply each particle's numbers in the same order as
//! [`scatter`](super::scatter) and [`gather`](super::gather).

use super::gather::{Summed, Sums};
use super::tensor::{Along, ProductStencil};
use super::{HALF, Members, PACK, Payload};
use crate::nodal::{Nodal, Window};
use crate::real::Real;

/// The largest number of axes; along axes that a stencil does not have there is one node, of weight 1.
const AXES: usize = 3;

/// The largest number of kinds of gradient weights: slopes and moments.
const GRADIENTS: usize = 2;

impl<T: Real, const D: usize> ProductStencil<T, D> {
    fn nodes_along(&self, axis: usize) -> usize {
        if axis < D { self.width } else { 1 }
    }

    fn weight_alone(&self, axis: usize, k: usize, particle: usize) -> T {
        if axis < D { self.weight[axis][k][particle] } else { T::one() }
    }

    /// The node `k` along every axis, of a particle.
    fn node(&self, particle: usize, k: [usize; AXES]) -> u32 {
        let apart: u32 = (0..D).map(|a| k[a] as u32 * self.stride[a]).sum();
        self.first[particle].wrapping_add(apart)
    }

    /// Adds to the nodes of the `members`, with the moments of the weights if the data have moments.
    pub(super) fn scatter_alone(
        &self,
        payload: &Payload<[T; PACK], D>,
        moment: Option<&Along<T, D>>,
        [from, to]: Members,
        mut nodes: Window<'_, T>,
    ) {
        for p in from..to {
            // The gradient weight of node `k`, which replaces its weight along an axis.
            let gradient_weight = |a: usize, k: usize| {
                let mut gradient_weight = [T::zero(); HALF];
                for c in 0..if a < D { D } else { 0 } {
                    if let Some(slopes) = &payload.slopes {
                        gradient_weight[c] = self.slope[a][k][p] * slopes[a][c][p];
                    }
                    if let (Some(moments), Some(moment)) = (&payload.moments, moment) {
                        gradient_weight[c] += moment[a][k][p] * moments[a][c][p];
                    }
                }
                gradient_weight
            };
            for k2 in 0..self.nodes_along(2) {
                let (w2, a2) = (self.weight_alone(2, k2, p), gradient_weight(2, k2));
                for k1 in 0..self.nodes_along(1) {
                    let (w1, a1) = (self.weight_alone(1, k1, p), gradient_weight(1, k1));
                    for k0 in 0..self.nodes_along(0) {
                        let (w0, a0) = (self.weight_alone(0, k0, p), gradient_weight(0, k0));
                        let [node] = nodes.row(self.node(p, [k0, k1, k2]));
                        for c in 0..HALF {
                            let plane = w2 * payload.value[p % HALF][p / HALF * HALF + c] + a2[c];
                            let row = w1 * plane + w2 * a1[c];
                            node.0[c] += w0 * row + w1 * (w2 * a0[c]);
                        }
                    }
                }
            }
        }
    }
}

impl<T: Real, const D: usize, const K: usize> Sums<'_, T, D, K> {
    /// The sums over the nodes of every particle.
    pub(super) fn all_alone(&self) -> Summed<[T; PACK], D, K> {
        let all = self.stencil.gather_alone(&self.gradient_weights, self.nodes);
        let gradient_weights = std::array::from_fn(|s| all.gradient_weights[s]);
        Summed { value: all.value, gradient_weights }
    }
}

impl<T: Real, const D: usize> ProductStencil<T, D> {
    /// The sums over the nodes of every particle, with these kinds of gradient weights.
    fn gather_alone(
        &self,
        gradient_weights: &[&Along<T, D>],
        nodes: &[Nodal<T>],
    ) -> Summed<[T; PACK], D, GRADIENTS> {
        let nothing = [T::zero(); PACK];
        let mut all =
            Summed { value: [nothing; D], gradient_weights: [[[nothing; D]; D]; GRADIENTS] };
        for p in 0..PACK {
            let accumulate = |axis: usize, k: usize, before: &Sum<T>, sums: &mut Sum<T>| {
                let weight = self.weight_alone(axis, k, p);
                sums.value += weight * before.value;
                for (s, gradient_weight) in gradient_weights.iter().enumerate() {
                    for b in 0..axis {
                        sums.gradient_weights[s][b] += weight * before.gradient_weights[s][b];
                    }
                    if axis < D {
                        sums.gradient_weights[s][axis] +=
                            gradient_weight[axis][k][p] * before.value;
                    }
                }
            };
            for c in 0..D {
                let mut space = Sum::nothing();
                for k2 in 0..self.nodes_along(2) {
                    let mut plane = Sum::nothing();
                    for k1 in 0..self.nodes_along(1) {
                        let mut row = Sum::nothing();
                        for k0 in 0..self.nodes_along(0) {
                            let node = &nodes[self.node(p, [k0, k1, k2]) as usize];
                            let number = Sum { value: node.0[c], ..Sum::nothing() };
                            accumulate(0, k0, &number, &mut row);
                        }
                        accumulate(1, k1, &row, &mut plane);
                    }
                    accumulate(2, k2, &plane, &mut space);
                }
                all.value[c][p] = space.value;
                for s in 0..gradient_weights.len() {
                    for a in 0..D {
                        all.gradient_weights[s][a][c][p] = space.gradient_weights[s][a];
                    }
                }
            }
        }
        all
    }
}

/// The sums of one component of one particle.
#[derive(Clone, Copy)]
struct Sum<T> {
    value: T,
    gradient_weights: [[T; AXES]; GRADIENTS],
}

impl<T: Real> Sum<T> {
    /// The initial value is -0: -0 + x is x for every x, so the compiler drops the first addition.
    fn nothing() -> Self {
        Self { value: -T::zero(), gradient_weights: [[-T::zero(); AXES]; GRADIENTS] }
    }
}
