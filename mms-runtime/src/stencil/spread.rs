//! The sums of a bunch onto its nodes.

use mms_math::machine::Machine;

use super::tensor::{Along, Tensor};
use super::{ALL, BUNCH, Members, Sloped};
use crate::Real;
use crate::nodal::{Nodal, Window};

/// What is added to the nodes.
pub(super) struct Spread<'a, T, F, const D: usize, const LEAST: usize, const N: usize> {
    pub stencil: &'a Tensor<T, D, LEAST, N>,
    /// What the slopes are multiplied by, in place of weights, along their axis.
    pub aside: &'a Along<T, D, N>,
    pub carried: &'a Sloped<F, D>,
    pub members: Members,
}

impl<T, F, const D: usize, const LEAST: usize, const N: usize> Spread<'_, T, F, D, LEAST, N>
where
    T: Real,
    F: Copy,
{
    /// Adds to `W` nodes along every axis: for all four particles together where they share their nodes, else for
    /// one after the other.
    #[inline(always)]
    pub fn add<M: Machine<T, Four = F>, const SLOPES: bool, const W: usize>(
        &self,
        machine: M,
        mut nodes: Window<'_, T>,
    ) {
        if self.members == ALL && self.stencil.is_shared() {
            self.of::<M, SLOPES, W, BUNCH>(machine, 0, nodes);
        } else {
            let [from, to] = self.members;
            for p in from..to {
                self.of::<M, SLOPES, W, 1>(machine, p, nodes.reborrow());
            }
        }
    }

    /// Adds for `P` particles from `from` on.
    #[inline(always)]
    fn of<M: Machine<T, Four = F>, const SLOPES: bool, const W: usize, const P: usize>(
        &self,
        machine: M,
        from: usize,
        mut nodes: Window<'_, T>,
    ) {
        let Self { stencil: Tensor { weight, first, stride, .. }, aside, carried, .. } = self;
        let stride = |a: usize| if a < D { stride[a] } else { 0 };
        let zero = machine.splat(T::zero());
        let one = |numbers: &[T; BUNCH], p: usize| machine.splat(numbers[from + p]);
        for k2 in 0..if D > 2 { W } else { 1 } {
            // The sum without the slopes along the first two axes, and these.
            let mut plane = [zero; P];
            let mut plane_slopes = [[zero; 2]; P];
            for p in 0..P {
                plane[p] = carried.value[from + p];
                let slopes = &carried.slopes[from + p];
                if D > 2 {
                    let w2 = one(&weight[2 % D][k2], p);
                    plane[p] = machine.times(w2, plane[p]);
                    if SLOPES {
                        let s2 = one(&aside[2 % D][k2], p);
                        plane[p] = machine.times_plus(s2, slopes[2 % D], plane[p]);
                        plane_slopes[p] =
                            [machine.times(w2, slopes[0]), machine.times(w2, slopes[1 % D])];
                    }
                } else if SLOPES {
                    plane_slopes[p] = [slopes[0], slopes[1 % D]];
                }
            }
            for k1 in 0..if D > 1 { W } else { 1 } {
                // The sum without the slope along the first axis, and this.
                let (mut row, mut row_slope) = ([zero; P], [zero; P]);
                for p in 0..P {
                    (row[p], row_slope[p]) = (plane[p], plane_slopes[p][0]);
                    if D > 1 {
                        let w1 = one(&weight[1 % D][k1], p);
                        row[p] = machine.times(w1, plane[p]);
                        if SLOPES {
                            let s1 = one(&aside[1 % D][k1], p);
                            row[p] = machine.times_plus(s1, plane_slopes[p][1], row[p]);
                            row_slope[p] = machine.times(w1, plane_slopes[p][0]);
                        }
                    }
                }
                let first = first[from] as usize + k1 * stride(1) + k2 * stride(2);
                for (k0, node) in nodes.row(first, W).iter_mut().enumerate() {
                    let mut sum = machine.four(&node.0);
                    for p in 0..P {
                        sum = machine.times_plus(one(&weight[0][k0], p), row[p], sum);
                        if SLOPES {
                            sum = machine.times_plus(one(&aside[0][k0], p), row_slope[p], sum);
                        }
                    }
                    *node = Nodal(machine.numbers(sum));
                }
            }
        }
    }
}
