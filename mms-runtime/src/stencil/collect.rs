//! The sums over the nodes of a bunch: one component after the other, of all four particles.

use mms_math::machine::Machine;

use super::BUNCH;
use super::tensor::{Along, Tensor};
use crate::Real;
use crate::nodal::Nodal;

/// What is summed, over which nodes.
pub(super) struct Sums<'a, T, const D: usize, const LEAST: usize, const N: usize, const K: usize> {
    pub stencil: &'a Tensor<T, D, LEAST, N>,
    /// What comes, in `K` sums for every axis, in place of the weights along that axis: slopes, moments.
    pub asides: [&'a Along<T, D, N>; K],
    pub nodes: &'a [Nodal<T>],
}

/// The sums of a vector: with weights, and of each of the `K` asides for every axis.
pub(super) struct Summed<F, const D: usize, const K: usize> {
    pub value: [F; D],
    pub asides: [[[F; D]; D]; K],
}

/// The weights, and the asides, of the nodes along an axis.
#[derive(Clone, Copy)]
struct Axis<F, const W: usize, const K: usize> {
    weight: [F; W],
    asides: [[F; W]; K],
}

/// The rows of nodes along the first axis.
type Rows<'a, T, const W: usize> = [[&'a [Nodal<T>; W]; W]; W];

impl<T: Real, const D: usize, const LEAST: usize, const N: usize, const K: usize>
    Sums<'_, T, D, LEAST, N, K>
{
    /// All sums over `W` nodes along every axis: those of particles that share their nodes together.
    #[inline(always)]
    pub fn all<M: Machine<T>, const W: usize>(&self, machine: M) -> Summed<M::Four, D, K> {
        let nothing = machine.splat(-T::zero());
        let mut summed = Summed { value: [nothing; D], asides: [[[nothing; D]; D]; K] };
        let along = self.axis::<M, W>(machine, 0);
        if self.stencil.is_shared() {
            self.add(machine, &along, self.stencil.first[0], &mut summed);
            return summed;
        }
        let firsts = self.stencil.first;
        // A bit of every particle whose nodes have not been seen.
        let mut left = (1_u32 << BUNCH) - 1;
        while left != 0 {
            let first = firsts[left.trailing_zeros() as usize % BUNCH];
            let mut share = [T::zero(); BUNCH];
            for p in 0..BUNCH {
                if firsts[p] == first {
                    share[p] = T::one();
                    left &= !(1 << p);
                }
            }
            // Every product has a factor of the first axis: those of others are 0.
            let share = machine.four(&share);
            let mut own = along;
            for k in 0..W {
                own.weight[k] = machine.times(own.weight[k], share);
                for aside in &mut own.asides {
                    aside[k] = machine.times(aside[k], share);
                }
            }
            self.add(machine, &own, first, &mut summed);
        }
        summed
    }

    /// Adds what comes of the nodes from `first` on.
    #[inline(always)]
    fn add<M: Machine<T>, const W: usize>(
        &self,
        machine: M,
        along: &Axis<M::Four, W, K>,
        first: u32,
        summed: &mut Summed<M::Four, D, K>,
    ) {
        let rows = self.rows::<W>(first as usize);
        for c in 0..D {
            self.component(machine, along, &rows, c, summed);
        }
    }

    #[inline(always)]
    fn axis<M: Machine<T>, const W: usize>(&self, machine: M, a: usize) -> Axis<M::Four, W, K> {
        let nothing = [machine.splat(T::zero()); W];
        let mut along = Axis { weight: nothing, asides: [nothing; K] };
        for k in 0..W {
            along.weight[k] = machine.four(&self.stencil.weight[a][k]);
            for s in 0..K {
                along.asides[s][k] = machine.four(&self.asides[s][a][k]);
            }
        }
        along
    }

    #[inline(always)]
    fn rows<const W: usize>(&self, first: usize) -> Rows<'_, T, W> {
        let stride = |a: usize| if a < D { self.stencil.stride[a] } else { 0 };
        let row = |k1: usize, k2: usize| {
            let row = &self.nodes[first + k1 * stride(1) + k2 * stride(2)..];
            row.first_chunk().expect("a row of nodes")
        };
        std::array::from_fn(|k2| std::array::from_fn(|k1| row(k1, k2)))
    }

    /// Adds the sums of one component: along rows, of these in planes, of these in space. Along the last axis that
    /// there is, they go on from the sums of other particles, which have the weight 0 here.
    #[inline(always)]
    fn component<M: Machine<T>, const W: usize>(
        &self,
        machine: M,
        along: &Axis<M::Four, W, K>,
        rows: &Rows<'_, T, W>,
        c: usize,
        summed: &mut Summed<M::Four, D, K>,
    ) {
        // A product is added to -0 without an addition.
        let zero = machine.splat(-T::zero());
        let mut before = [[zero; 3]; K];
        for s in 0..K {
            for a in 0..D {
                before[s][a] = summed.asides[s][a][c];
            }
        }
        let (mut space, mut space_asides) = (summed.value[c], before);
        for k2 in 0..if D > 2 { W } else { 1 } {
            let (mut plane, mut plane_asides) = (zero, [[zero; 3]; K]);
            if D == 2 {
                (plane, plane_asides) = (space, space_asides);
            }
            for k1 in 0..if D > 1 { W } else { 1 } {
                let (mut row, mut row_asides) = (zero, [zero; K]);
                if D == 1 {
                    row = space;
                    for s in 0..K {
                        row_asides[s] = space_asides[s][0];
                    }
                }
                for k0 in 0..W {
                    let node = machine.splat(rows[k2][k1][k0].0[c]);
                    row = machine.times_plus(along.weight[k0], node, row);
                    for s in 0..K {
                        row_asides[s] =
                            machine.times_plus(along.asides[s][k0], node, row_asides[s]);
                    }
                }
                if D == 1 {
                    plane = row;
                    for s in 0..K {
                        plane_asides[s][0] = row_asides[s];
                    }
                    continue;
                }
                let w1 = machine.four(&self.stencil.weight[1 % D][k1]);
                plane = machine.times_plus(w1, row, plane);
                for s in 0..K {
                    let of_row = [row_asides[s], zero, zero];
                    let s1 = machine.four(&self.asides[s][1 % D][k1]);
                    gather(machine, [w1, s1], 1, row, of_row, &mut plane_asides[s]);
                }
            }
            if D < 3 {
                (space, space_asides) = (plane, plane_asides);
                continue;
            }
            let w2 = machine.four(&self.stencil.weight[2 % D][k2]);
            space = machine.times_plus(w2, plane, space);
            for s in 0..K {
                let s2 = machine.four(&self.asides[s][2 % D][k2]);
                let of_plane = plane_asides[s];
                gather(machine, [w2, s2], 2, plane, of_plane, &mut space_asides[s]);
            }
        }
        summed.value[c] = space;
        for s in 0..K {
            for a in 0..D {
                summed.asides[s][a][c] = space_asides[s][a];
            }
        }
    }
}

/// Adds to the sums of an aside what comes of those along the axes before axis `a`.
#[inline(always)]
fn gather<T: Real, M: Machine<T>>(
    machine: M,
    [weight, aside]: [M::Four; 2],
    a: usize,
    value: M::Four,
    asides: [M::Four; 3],
    sums: &mut [M::Four; 3],
) {
    for b in 0..a {
        sums[b] = machine.times_plus(weight, asides[b], sums[b]);
    }
    sums[a] = machine.times_plus(aside, value, sums[a]);
}
