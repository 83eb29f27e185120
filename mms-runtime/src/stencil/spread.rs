//! The sums of a bunch onto its nodes.
//!
//! Along an axis with three nodes one cell apart, weights sum to 1 and slopes to 0, and the middle node has the largest
//! weight. So the sum over all three takes no product, and what the outer two leave of it is for the middle one.

use mms_math::machine::Machine;

use super::tensor::{Along, Tensor};
use super::{ALL, BUNCH, HALF, Members, Sloped};
use crate::Real;
use crate::nodal::Window;

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
    pub carried: &'a Sloped<M::Eight, D>,
    pub members: Members,
}

/// Where what the two halves of a bunch carry goes.
#[derive(Clone, Copy)]
enum Goal {
    /// Both to the nodes from one on.
    Together(usize),
    /// Each to nodes of its own, but for those that are not meant.
    Apart([Option<usize>; 2]),
}

impl<M: Machine<T>, T: Real, const D: usize, const LEAST: usize, const N: usize, const SLOPES: bool>
    Spread<'_, M, T, D, LEAST, N, SLOPES>
{
    /// Adds to `W` nodes along every axis: for the particles of each half together where they share their nodes, else
    /// for one of each half after the other.
    #[inline(always)]
    pub fn add<const W: usize>(&self, mut nodes: Window<'_, T>) {
        let Tensor { first, regular, .. } = *self.stencil;
        if self.members == ALL && self.stencil.is_shared() && (W != 3 || regular) {
            let [one, two] = [first[0], first[HALF]].map(|first| first as usize);
            let goal =
                if one == two { Goal::Together(one) } else { Goal::Apart([Some(one), Some(two)]) };
            if W == 3 {
                self.of::<W, HALF, true>(0, goal, nodes);
            } else {
                self.of::<W, HALF, false>(0, goal, nodes);
            }
            return;
        }
        let [from, to] = self.members;
        for k in 0..HALF {
            let meant = |p: usize| (from <= p && p < to).then_some(first[p] as usize);
            let pair = [meant(k), meant(k + HALF)];
            if pair != [None; 2] {
                self.of::<W, 1, false>(k, Goal::Apart(pair), nodes.reborrow());
            }
        }
    }

    /// Adds for `P` particles of each half from `from` on; whether the middle ones of three nodes take the `REST`.
    #[inline(always)]
    fn of<const W: usize, const P: usize, const REST: bool>(
        &self,
        from: usize,
        goal: Goal,
        mut nodes: Window<'_, T>,
    ) {
        let Self { machine, stencil: Tensor { stride, .. }, .. } = *self;
        let mut along = [Factors::none(machine); W];
        for k0 in 0..W {
            along[k0] = self.factors::<P>(from, 0, k0);
        }
        for k2 in 0..if D > 2 { W } else { 1 } {
            let plane = self.plane::<P>(from, k2);
            let apart = if D > 2 { k2 * stride[2 % D] } else { 0 };
            if D == 1 {
                let sums = self.sums::<W, P, REST>(&along, &plane);
                self.put(&mut nodes, goal, apart, &sums);
            } else if REST {
                let mut rest = self.sums::<W, P, REST>(&along, &plane);
                let before = self.sums::<W, P, REST>(&along, &self.row(from, 0, &plane));
                self.put(&mut nodes, goal, apart, &before);
                let after = self.sums::<W, P, REST>(&along, &self.row(from, 2, &plane));
                self.put(&mut nodes, goal, apart + 2 * stride[1 % D], &after);
                for k0 in 0..W {
                    rest[k0] = machine.minus(machine.minus(rest[k0], before[k0]), after[k0]);
                }
                self.put(&mut nodes, goal, apart + stride[1 % D], &rest);
            } else {
                for k1 in 0..W {
                    let sums = self.sums::<W, P, REST>(&along, &self.row(from, k1, &plane));
                    self.put(&mut nodes, goal, apart + k1 * stride[1 % D], &sums);
                }
            }
        }
    }

    /// The weights of node `k` along an axis, and what is in place of them where the slopes are.
    #[inline(always)]
    fn factors<const P: usize>(&self, from: usize, axis: usize, k: usize) -> Factors<M::Eight, P> {
        let Self { machine, stencil: Tensor { weight, .. }, aside, .. } = *self;
        let mut factors = Factors::none(machine);
        spread(machine, &weight[axis][k], from, &mut factors.weight);
        if SLOPES {
            spread(machine, &aside[axis][k], from, &mut factors.aside);
        }
        factors
    }

    /// What a plane takes.
    #[inline(always)]
    fn plane<const P: usize>(&self, from: usize, k2: usize) -> Taken<M::Eight, P> {
        let Self { machine, carried, .. } = *self;
        let zero = machine.splat(T::zero());
        let mut plane = Taken { value: [zero; P], slopes: [[zero; 2]; P] };
        let factors =
            if D > 2 { self.factors::<P>(from, 2 % D, k2) } else { Factors::none(machine) };
        for p in 0..P {
            plane.value[p] = carried.value[from + p];
            let slopes = &carried.slopes[from + p];
            if SLOPES {
                plane.slopes[p] = [slopes[0], slopes[1 % D]];
            }
            if D > 2 {
                let (w2, s2) = (factors.weight[p], factors.aside[p]);
                plane.value[p] = machine.times(w2, plane.value[p]);
                if SLOPES {
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
        plane: &Taken<M::Eight, P>,
    ) -> Taken<M::Eight, P> {
        let machine = self.machine;
        let factors = self.factors::<P>(from, 1 % D, k1);
        let mut row = *plane;
        for p in 0..P {
            let (w1, s1) = (factors.weight[p], factors.aside[p]);
            row.value[p] = machine.times(w1, plane.value[p]);
            if SLOPES {
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
        along: &[Factors<M::Eight, P>; W],
        row: &Taken<M::Eight, P>,
    ) -> [M::Eight; W] {
        let machine = self.machine;
        // A product is added to -0 without an addition.
        let mut sums = [machine.splat(-T::zero()); W];
        for p in 0..P {
            let taken = [row.value[p], row.slopes[p][0]];
            if REST {
                sums[0] = self.node(&along[0], p, taken, sums[0]);
                sums[2] = self.node(&along[2], p, taken, sums[2]);
                sums[1] = machine.plus(sums[1], taken[0]);
            } else {
                for k0 in 0..W {
                    sums[k0] = self.node(&along[k0], p, taken, sums[k0]);
                }
            }
        }
        if REST {
            sums[1] = machine.minus(sums[1], machine.plus(sums[0], sums[2]));
        }
        sums
    }

    /// The sum, and what one node of a row takes of a particle of each half.
    #[inline(always)]
    fn node<const P: usize>(
        &self,
        factors: &Factors<M::Eight, P>,
        p: usize,
        [value, slope]: [M::Eight; 2],
        sum: M::Eight,
    ) -> M::Eight {
        let sum = self.machine.times_plus(factors.weight[p], value, sum);
        if SLOPES { self.machine.times_plus(factors.aside[p], slope, sum) } else { sum }
    }

    /// Adds to the nodes of a row, so far from the first one.
    #[inline(always)]
    fn put<const W: usize>(
        &self,
        nodes: &mut Window<'_, T>,
        goal: Goal,
        apart: usize,
        sums: &[M::Eight; W],
    ) {
        let machine = self.machine;
        match goal {
            Goal::Together(first) => {
                let row = nodes.row::<W>(first + apart);
                for k0 in 0..W {
                    machine.add_halves(&mut row[k0].0, sums[k0]);
                }
            }
            Goal::Apart([one, two]) => {
                if let Some(first) = one {
                    let row = nodes.row::<W>(first + apart);
                    for k0 in 0..W {
                        machine.add_first(&mut row[k0].0, sums[k0]);
                    }
                }
                if let Some(first) = two {
                    let row = nodes.row::<W>(first + apart);
                    for k0 in 0..W {
                        machine.add_second(&mut row[k0].0, sums[k0]);
                    }
                }
            }
        }
    }
}

/// The factors of a node along an axis, for `P` particles of each half.
#[derive(Clone, Copy)]
struct Factors<F, const P: usize> {
    weight: [F; P],
    aside: [F; P],
}

impl<F: Copy, const P: usize> Factors<F, P> {
    #[inline(always)]
    fn none<T: Real, M: Machine<T, Eight = F>>(machine: M) -> Self {
        let nothing = [machine.splat(T::zero()); P];
        Self { weight: nothing, aside: nothing }
    }
}

/// The numbers of `P` particles of each half from `from` on, each in all places of its half.
#[inline(always)]
fn spread<T: Real, M: Machine<T>, const P: usize>(
    machine: M,
    numbers: &[T; BUNCH],
    from: usize,
    to: &mut [M::Eight; P],
) {
    if P == HALF {
        to.copy_from_slice(&machine.spread(machine.eight(numbers)));
        return;
    }
    for p in 0..P {
        to[p] = machine.splat_halves(numbers[from + p], numbers[from + p + HALF]);
    }
}

/// What nodes take of `P` particles of each half, but for the weights along the axes that are left.
#[derive(Clone, Copy)]
struct Taken<F, const P: usize> {
    /// Without the slopes along the first two axes.
    value: [F; P],
    /// These.
    slopes: [[F; 2]; P],
}
