//! The sums of a bunch onto its nodes.
//!
//! Along an axis with three nodes one cell apart, weights sum to 1 and slopes to 0, and the middle node has the largest
//! weight. So the sum over all three takes no product, and what the outer two leave of it is for the middle one.

use mms_math::machine::Machine;

use super::tensor::{Along, Tensor};
use super::{ALL, BUNCH, Members, Sloped};
use crate::Real;
use crate::nodal::{Nodal, Window};

/// What is added to the nodes, with slopes or without.
pub(super) struct Spread<
    'a,
    M: Machine<T>,
    T: Real,
    const D: usize,
    const LEAST: usize,
    const N: usize,
    const SLOPES: bool,
> {
    pub machine: M,
    pub stencil: &'a Tensor<T, D, LEAST, N>,
    /// What the slopes are multiplied by, in place of weights, along their axis.
    pub aside: &'a Along<T, D, N>,
    pub carried: &'a Sloped<M::Four, D>,
    pub members: Members,
}

impl<M: Machine<T>, T: Real, const D: usize, const LEAST: usize, const N: usize, const SLOPES: bool>
    Spread<'_, M, T, D, LEAST, N, SLOPES>
{
    /// Adds to `W` nodes along every axis: for all four particles together where they share their nodes, else for
    /// one after the other.
    #[inline(always)]
    pub fn add<const W: usize>(&self, mut nodes: Window<'_, T>) {
        let together = self.members == ALL && self.stencil.is_shared();
        if W == 3 && together && self.stencil.regular {
            self.of::<W, BUNCH, true>(0, nodes);
        } else if W != 3 && together {
            self.of::<W, BUNCH, false>(0, nodes);
        } else {
            let [from, to] = self.members;
            for p in from..to {
                self.of::<W, 1, false>(p, nodes.reborrow());
            }
        }
    }

    /// Adds for `P` particles from `from` on; whether the middle ones of three nodes take the `REST`.
    #[inline(always)]
    fn of<const W: usize, const P: usize, const REST: bool>(
        &self,
        from: usize,
        mut nodes: Window<'_, T>,
    ) {
        let Self { machine, stencil: Tensor { first, stride, .. }, .. } = *self;
        for k2 in 0..if D > 2 { W } else { 1 } {
            let plane = self.plane::<P>(from, k2);
            let first = first[from] as usize + if D > 2 { k2 * stride[2 % D] } else { 0 };
            if D == 1 {
                let sums = self.sums::<W, P, REST>(from, &plane);
                add(machine, nodes.row(first), &sums);
            } else if REST {
                let mut rest = self.sums::<W, P, REST>(from, &plane);
                let before = self.sums::<W, P, REST>(from, &self.row(from, 0, &plane));
                add(machine, nodes.row(first), &before);
                let after = self.sums::<W, P, REST>(from, &self.row(from, 2, &plane));
                add(machine, nodes.row(first + 2 * stride[1 % D]), &after);
                for k0 in 0..W {
                    rest[k0] = machine.minus(machine.minus(rest[k0], before[k0]), after[k0]);
                }
                add(machine, nodes.row(first + stride[1 % D]), &rest);
            } else {
                for k1 in 0..W {
                    let sums = self.sums::<W, P, REST>(from, &self.row(from, k1, &plane));
                    add(machine, nodes.row(first + k1 * stride[1 % D]), &sums);
                }
            }
        }
    }

    /// What a plane takes.
    #[inline(always)]
    fn plane<const P: usize>(&self, from: usize, k2: usize) -> Taken<M::Four, P> {
        let Self { machine, stencil: Tensor { weight, .. }, aside, carried, .. } = *self;
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
                    plane.slopes[p] =
                        [machine.times(w2, slopes[0]), machine.times(w2, slopes[1 % D])];
                }
            }
        }
        plane
    }

    /// What a row of a plane takes.
    #[inline(always)]
    fn row<const P: usize>(
        &self,
        from: usize,
        k1: usize,
        plane: &Taken<M::Four, P>,
    ) -> Taken<M::Four, P> {
        let Self { machine, stencil: Tensor { weight, .. }, aside, .. } = *self;
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
    fn sums<const W: usize, const P: usize, const REST: bool>(
        &self,
        from: usize,
        row: &Taken<M::Four, P>,
    ) -> [M::Four; W] {
        let machine = self.machine;
        // A product is added to -0 without an addition.
        let mut sums = [machine.splat(-T::zero()); W];
        for p in 0..P {
            let taken = [row.value[p], row.slopes[p][0]];
            if REST {
                sums[0] = self.node([from + p, 0], taken, sums[0]);
                sums[2] = self.node([from + p, 2], taken, sums[2]);
                sums[1] = machine.plus(sums[1], taken[0]);
                continue;
            }
            for k0 in 0..W {
                sums[k0] = self.node([from + p, k0], taken, sums[k0]);
            }
        }
        if REST {
            sums[1] = machine.minus(sums[1], machine.plus(sums[0], sums[2]));
        }
        sums
    }

    /// The sum, and what one node of a row takes of one particle.
    #[inline(always)]
    fn node(&self, [p, k0]: [usize; 2], [value, slope]: [M::Four; 2], sum: M::Four) -> M::Four {
        let Self { machine, stencil: Tensor { weight, .. }, aside, .. } = *self;
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
