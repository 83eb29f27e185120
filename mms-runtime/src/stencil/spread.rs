//! The sums of a bunch onto its nodes.
//!
//! Along an axis with three nodes one cell apart, weights sum to 1 and slopes to 0, and the middle node has the largest
//! weight. So the sum over all three takes no product, and what the outer two leave of it is for the middle one.

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
        let usual = W != 3 || self.stencil.even;
        if self.members == ALL && self.stencil.is_shared() && usual {
            if W == 3 {
                self.of::<M, SLOPES, W, BUNCH, true>(machine, 0, nodes);
            } else {
                self.of::<M, SLOPES, W, BUNCH, false>(machine, 0, nodes);
            }
        } else {
            let [from, to] = self.members;
            for p in from..to {
                self.of::<M, SLOPES, W, 1, false>(machine, p, nodes.reborrow());
            }
        }
    }

    /// Adds for `P` particles from `from` on; whether the middle nodes take the `REST`.
    #[inline(always)]
    fn of<
        M: Machine<T, Four = F>,
        const SLOPES: bool,
        const W: usize,
        const P: usize,
        const REST: bool,
    >(
        &self,
        machine: M,
        from: usize,
        mut nodes: Window<'_, T>,
    ) {
        let Tensor { first, stride, .. } = self.stencil;
        for k2 in 0..if D > 2 { W } else { 1 } {
            let plane = self.plane::<M, SLOPES, P>(machine, from, k2);
            let first = first[from] as usize + if D > 2 { k2 * stride[2 % D] } else { 0 };
            if D == 1 {
                let sums = self.sums::<M, SLOPES, W, P, REST>(machine, from, &plane);
                add(machine, nodes.row(first), &sums);
                continue;
            }
            if !REST {
                for k1 in 0..W {
                    let sums = self.sums::<M, SLOPES, W, P, REST>(
                        machine,
                        from,
                        &self.row::<M, SLOPES, P>(machine, from, k1, &plane),
                    );
                    add(machine, nodes.row(first + k1 * stride[1 % D]), &sums);
                }
                continue;
            }
            let all = self.sums::<M, SLOPES, W, P, REST>(machine, from, &plane);
            let before = self.sums::<M, SLOPES, W, P, REST>(
                machine,
                from,
                &self.row::<M, SLOPES, P>(machine, from, 0, &plane),
            );
            add(machine, nodes.row(first), &before);
            let after = self.sums::<M, SLOPES, W, P, REST>(
                machine,
                from,
                &self.row::<M, SLOPES, P>(machine, from, 2, &plane),
            );
            add(machine, nodes.row(first + 2 * stride[1 % D]), &after);
            let mut rest = all;
            for k0 in 0..W {
                rest[k0] = machine.minus(machine.minus(all[k0], before[k0]), after[k0]);
            }
            add(machine, nodes.row(first + stride[1 % D]), &rest);
        }
    }

    /// What a plane takes.
    #[inline(always)]
    fn plane<M: Machine<T, Four = F>, const SLOPES: bool, const P: usize>(
        &self,
        machine: M,
        from: usize,
        k2: usize,
    ) -> Taken<F, P> {
        let Self { stencil: Tensor { weight, .. }, aside, carried, .. } = self;
        let zero = machine.splat(T::zero());
        let mut plane = Taken { value: [zero; P], slopes: [[zero; 2]; P] };
        for p in 0..P {
            plane.value[p] = carried.value[from + p];
            let slopes = &carried.slopes[from + p];
            if SLOPES {
                plane.slopes[p] = [slopes[0], slopes[1 % D]];
            }
            if D > 2 {
                let w2 = machine.splat(weight[2 % D][k2][from + p]);
                plane.value[p] = machine.times(w2, plane.value[p]);
                if SLOPES {
                    let s2 = machine.splat(aside[2 % D][k2][from + p]);
                    plane.value[p] = machine.times_plus(s2, slopes[2 % D], plane.value[p]);
                    plane.slopes[p] = [machine.times(w2, slopes[0]), machine.times(w2, slopes[1])];
                }
            }
        }
        plane
    }

    /// What a row of the plane takes.
    #[inline(always)]
    fn row<M: Machine<T, Four = F>, const SLOPES: bool, const P: usize>(
        &self,
        machine: M,
        from: usize,
        k1: usize,
        plane: &Taken<F, P>,
    ) -> Taken<F, P> {
        let Self { stencil: Tensor { weight, .. }, aside, .. } = self;
        let mut row = *plane;
        for p in 0..P {
            let w1 = machine.splat(weight[1 % D][k1][from + p]);
            row.value[p] = machine.times(w1, plane.value[p]);
            if SLOPES {
                let s1 = machine.splat(aside[1 % D][k1][from + p]);
                row.value[p] = machine.times_plus(s1, plane.slopes[p][1], row.value[p]);
                row.slopes[p][0] = machine.times(w1, plane.slopes[p][0]);
            }
        }
        row
    }

    /// The sums that the nodes of a row take.
    #[inline(always)]
    fn sums<
        M: Machine<T, Four = F>,
        const SLOPES: bool,
        const W: usize,
        const P: usize,
        const REST: bool,
    >(
        &self,
        machine: M,
        from: usize,
        row: &Taken<F, P>,
    ) -> [F; W] {
        // A product is added to -0 without an addition.
        let mut sums = [machine.splat(-T::zero()); W];
        for p in 0..P {
            let (value, slope) = (row.value[p], row.slopes[p][0]);
            if REST {
                sums[0] = self.node::<M, SLOPES>(machine, [from + p, 0], [value, slope], sums[0]);
                sums[2] = self.node::<M, SLOPES>(machine, [from + p, 2], [value, slope], sums[2]);
                sums[1] = machine.plus(sums[1], value);
                continue;
            }
            for k0 in 0..W {
                sums[k0] =
                    self.node::<M, SLOPES>(machine, [from + p, k0], [value, slope], sums[k0]);
            }
        }
        if REST {
            sums[1] = machine.minus(sums[1], machine.plus(sums[0], sums[2]));
        }
        sums
    }

    /// The sum, and what one node of a row takes of one particle.
    #[inline(always)]
    fn node<M: Machine<T, Four = F>, const SLOPES: bool>(
        &self,
        machine: M,
        [p, k0]: [usize; 2],
        [value, slope]: [F; 2],
        sum: F,
    ) -> F {
        let Self { stencil: Tensor { weight, .. }, aside, .. } = self;
        let sum = machine.times_plus(machine.splat(weight[0][k0][p]), value, sum);
        if !SLOPES {
            return sum;
        }
        machine.times_plus(machine.splat(aside[0][k0][p]), slope, sum)
    }
}

/// What nodes take of `P` particles, but for the weights along the axes that are left.
#[derive(Clone, Copy)]
struct Taken<F, const P: usize> {
    /// Without the slopes along the first two axes.
    value: [F; P],
    /// These.
    slopes: [[F; 2]; P],
}

/// Adds to the nodes of a row.
#[inline(always)]
fn add<T: Real, M: Machine<T>, const W: usize>(
    machine: M,
    nodes: &mut [Nodal<T>; W],
    sums: &[M::Four; W],
) {
    for k0 in 0..W {
        let sum = machine.plus(machine.four(&nodes[k0].0), sums[k0]);
        nodes[k0] = Nodal(machine.numbers(sum));
    }
}
