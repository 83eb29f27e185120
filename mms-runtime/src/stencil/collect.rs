//! The sums over the nodes of a bunch: one component after the other, of all four particles.

use mms_math::machine::Machine;

use super::tensor::{Along, Tensor};
use super::{BUNCH, Collected};
use crate::Real;
use crate::nodal::Nodal;

/// What is summed, over which nodes.
pub(super) struct Sums<'a, T, const D: usize, const LEAST: usize, const N: usize> {
    pub stencil: &'a Tensor<T, D, LEAST, N>,
    /// In place of weights, for slopes.
    pub moment: &'a Along<T, D, N>,
    pub nodes: &'a [Nodal<T>],
}

/// The weights, slopes and moments of the nodes along an axis.
struct Axis<F, const W: usize> {
    weight: [F; W],
    slope: [F; W],
    moment: [F; W],
}

/// The rows of nodes along the first axis.
type Rows<'a, T, const W: usize> = [[&'a [Nodal<T>; W]; W]; W];

impl<T: Real, const D: usize, const LEAST: usize, const N: usize> Sums<'_, T, D, LEAST, N> {
    /// All sums over `W` nodes along every axis: those of particles that share their nodes together.
    #[inline(always)]
    pub fn all<M: Machine<T>, const GRADIENT: bool, const SLOPES: bool, const W: usize>(
        &self,
        machine: M,
    ) -> Collected<M::Four, D> {
        let mut collected = Collected::all(machine.splat(T::zero()));
        let firsts = self.stencil.first;
        let mut left = [true; BUNCH];
        while let Some(leader) = left.iter().position(|&left| left) {
            let first = firsts[leader];
            let mut along = self.axis::<M, W>(machine, 0);
            if firsts == [first; BUNCH] {
                left = [false; BUNCH];
            } else {
                let shares = firsts.map(|other| other == first);
                for p in 0..BUNCH {
                    left[p] &= !shares[p];
                }
                // Every product has a factor of the first axis: those of others are 0.
                let share = shares.map(|shares| if shares { T::one() } else { T::zero() });
                let share = machine.four(&share);
                for k in 0..W {
                    along.weight[k] = machine.times(along.weight[k], share);
                    along.slope[k] = machine.times(along.slope[k], share);
                    along.moment[k] = machine.times(along.moment[k], share);
                }
            }
            let rows = self.rows::<W>(first as usize);
            for c in 0..D {
                self.component::<M, GRADIENT, SLOPES, W>(machine, &along, &rows, c, &mut collected);
            }
        }
        collected
    }

    #[inline(always)]
    fn axis<M: Machine<T>, const W: usize>(&self, machine: M, a: usize) -> Axis<M::Four, W> {
        let Self { stencil, moment, .. } = self;
        let nothing = [machine.splat(T::zero()); W];
        let mut along = Axis { weight: nothing, slope: nothing, moment: nothing };
        for k in 0..W {
            along.weight[k] = machine.four(&stencil.weight[a][k]);
            along.slope[k] = machine.four(&stencil.slope[a][k]);
            along.moment[k] = machine.four(&moment[a][k]);
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

    /// Adds the sums of one component.
    #[inline(always)]
    fn component<M: Machine<T>, const GRADIENT: bool, const SLOPES: bool, const W: usize>(
        &self,
        machine: M,
        along: &Axis<M::Four, W>,
        rows: &Rows<'_, T, W>,
        c: usize,
        collected: &mut Collected<M::Four, D>,
    ) {
        let zero = machine.splat(T::zero());
        let number = |x: &[T; BUNCH]| machine.four(x);
        let Self { stencil: Tensor { weight, slope, .. }, moment, .. } = self;
        let mut value = zero;
        let (mut gradient, mut slopes) = ([zero; 3], [zero; 3]);
        for k2 in 0..if D > 2 { W } else { 1 } {
            let mut of_plane = zero;
            let (mut plane_gradient, mut plane_slopes) = ([zero; 2], [zero; 2]);
            for k1 in 0..if D > 1 { W } else { 1 } {
                let (mut of_row, mut row_gradient, mut row_slope) = (zero, zero, zero);
                for k0 in 0..W {
                    let node = machine.splat(rows[k2][k1][k0].0[c]);
                    of_row = machine.times_plus(along.weight[k0], node, of_row);
                    if GRADIENT {
                        row_gradient = machine.times_plus(along.slope[k0], node, row_gradient);
                    }
                    if SLOPES {
                        row_slope = machine.times_plus(along.moment[k0], node, row_slope);
                    }
                }
                if D == 1 {
                    (of_plane, plane_gradient[0], plane_slopes[0]) =
                        (of_row, row_gradient, row_slope);
                    continue;
                }
                let w1 = number(&weight[1 % D][k1]);
                of_plane = machine.times_plus(w1, of_row, of_plane);
                if GRADIENT {
                    let s1 = number(&slope[1 % D][k1]);
                    plane_gradient[0] = machine.times_plus(w1, row_gradient, plane_gradient[0]);
                    plane_gradient[1] = machine.times_plus(s1, of_row, plane_gradient[1]);
                }
                if SLOPES {
                    let m1 = number(&moment[1 % D][k1]);
                    plane_slopes[0] = machine.times_plus(w1, row_slope, plane_slopes[0]);
                    plane_slopes[1] = machine.times_plus(m1, of_row, plane_slopes[1]);
                }
            }
            if D < 3 {
                value = of_plane;
                gradient = [plane_gradient[0], plane_gradient[1], zero];
                slopes = [plane_slopes[0], plane_slopes[1], zero];
                continue;
            }
            let w2 = number(&weight[2 % D][k2]);
            value = machine.times_plus(w2, of_plane, value);
            if GRADIENT {
                let s2 = number(&slope[2 % D][k2]);
                for a in 0..2 {
                    gradient[a] = machine.times_plus(w2, plane_gradient[a], gradient[a]);
                }
                gradient[2] = machine.times_plus(s2, of_plane, gradient[2]);
            }
            if SLOPES {
                let m2 = number(&moment[2 % D][k2]);
                for a in 0..2 {
                    slopes[a] = machine.times_plus(w2, plane_slopes[a], slopes[a]);
                }
                slopes[2] = machine.times_plus(m2, of_plane, slopes[2]);
            }
        }
        collected.value[c] = machine.plus(collected.value[c], value);
        for a in 0..D {
            if GRADIENT {
                let sum = &mut collected.gradient[a][c];
                *sum = machine.plus(*sum, gradient[a]);
            }
            if SLOPES {
                let sum = &mut collected.slopes[a][c];
                *sum = machine.plus(*sum, slopes[a]);
            }
        }
    }
}
