//! Stencils that are products of weights along the axes.
//!
//! The sums are factorised: what does not depend on the node along an axis is multiplied once for all of
//! them, so that a node takes one product per number, and one more where there are slopes.

use std::ops::Range;

use mms_math::machine::Machine;

use super::collect::{Summed, Sums};
use super::spread::Spread;
use super::{BUNCH, Carried, Collected, HALF, Members, Stencil, Wanted};
use crate::defect::{Defect, on};
use crate::nodal::{Nodal, Window};
use crate::{Lattice, Real, Vector};

/// For every axis, and the first, second, .. node along it, a number for each particle of a bunch.
pub(super) type Along<T, const D: usize, const N: usize> = [[[T; BUNCH]; N]; D];

/// Which particles of a bunch have the same nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sharing {
    /// All.
    All,
    /// Those of each half.
    Halves,
    /// Not even those.
    Apart,
}

/// A stencil that is the product of the weights along the axes: of `N` nodes along each, or where that is enough
/// for the whole bunch, of `LEAST`. Where that is no less, the weights are B-splines of degree N - 1.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub struct Tensor<T, const D: usize, const LEAST: usize, const N: usize> {
    pub(super) weight: Along<T, D, N>,
    /// Their derivatives, per length.
    pub(super) slope: Along<T, D, N>,
    /// Number of the first node along each axis.
    start: [[i32; BUNCH]; D],
    /// Index of the first node in the grid's arrays.
    pub(super) first: [u32; BUNCH],
    /// Distance in the grid's arrays between neighbours along each axis.
    pub(super) stride: [u32; D],
    /// Sum of those.
    strides: u32,
    /// Whether all of each half have the same nodes.
    shared: bool,
    /// How many nodes along each axis have a weight, at most: N or LEAST.
    width: usize,
    /// Whether all nodes are one cell apart, and along each axis weights sum to 1.
    pub(super) regular: bool,
}

impl<T: Real, const D: usize, const LEAST: usize, const N: usize> Tensor<T, D, LEAST, N> {
    /// A stencil that has no nodes yet.
    #[inline(always)]
    pub fn new() -> Self {
        Self {
            weight: [[[T::zero(); BUNCH]; N]; D],
            slope: [[[T::zero(); BUNCH]; N]; D],
            start: [[0; BUNCH]; D],
            first: [0; BUNCH],
            stride: [0; D],
            strides: 0,
            shared: true,
            width: N,
            regular: true,
        }
    }

    /// Begins to take `W` weights along each axis; `regular` ones sum to 1, and their nodes are one cell apart.
    #[inline(always)]
    pub fn begin<const W: usize>(&mut self, lattice: &Lattice<T, D>, regular: bool) {
        const { assert!(W == LEAST || W == N) };
        self.first = [0; BUNCH];
        // There are fewer than 2^32 nodes.
        self.stride = std::array::from_fn(|a| lattice.stride[a] as u32);
        self.strides = self.stride.iter().sum();
        (self.width, self.regular) = (W, regular);
    }

    /// Takes the weights along an axis, and their derivatives per cell, of the nodes from `first` on; if these are not
    /// all on the grid, the stencil may not be used.
    #[inline(always)]
    pub fn set<M: Machine<T>, const W: usize>(
        &mut self,
        machine: M,
        lattice: &Lattice<T, D>,
        axis: usize,
        first: M::Eight,
        [weight, slope]: [[M::Eight; W]; 2],
    ) {
        let length_axis = if on(Defect::SquareCells) { 0 } else { axis };
        let per_length = machine.splat(lattice.per_length[length_axis]);
        for k in 0..W {
            self.weight[axis][k] = machine.numbers(weight[k]);
            self.slope[axis][k] = machine.numbers(machine.times(slope[k], per_length));
        }
        self.start[axis] = machine.whole(first);
        for p in 0..BUNCH {
            let along = (self.start[axis][p] as u32).wrapping_mul(self.stride[axis]);
            self.first[p] = self.first[p].wrapping_add(along);
        }
        if axis + 1 == D {
            let mut different = 0;
            for p in 0..BUNCH {
                different |= self.first[p] ^ self.first[p / HALF * HALF];
            }
            self.shared = different == 0;
        }
    }

    /// Which particles have the same nodes.
    #[inline(always)]
    pub(super) fn sharing(&self) -> Sharing {
        if !self.shared {
            Sharing::Apart
        } else if self.first[0] == self.first[HALF] {
            Sharing::All
        } else {
            Sharing::Halves
        }
    }

    /// The moments w (x_i - x_p), and the inverse of sum_i w (x_i - x_p)^2 along each axis.
    #[inline(always)]
    fn moments<M: Machine<T>>(
        &self,
        machine: M,
        lattice: &Lattice<T, D>,
    ) -> (Along<T, D, N>, [M::Eight; D]) {
        let zero = machine.splat(T::zero());
        let mut moment = [[[T::zero(); BUNCH]; N]; D];
        let mut per_spread = [zero; D];
        for a in 0..D {
            let (mut weight, mut apart) = ([zero; N], [zero; N]);
            let mut middle = zero;
            for k in 0..self.width() {
                weight[k] = machine.eight(&self.weight[a][k]);
                apart[k] = self.beyond_first(machine, lattice, a, k);
                middle = machine.times_plus(weight[k], apart[k], middle);
            }
            let mut spread = zero;
            for k in 0..N {
                apart[k] = machine.minus(apart[k], middle);
                weight[k] = machine.times(weight[k], apart[k]);
                spread = machine.times_plus(weight[k], apart[k], spread);
                moment[a][k] = machine.numbers(weight[k]);
            }
            per_spread[a] = if LEAST == N && N > 2 && self.regular {
                // The variance of N lengths that are evenly distributed over a cell: their sum is a B-spline's.
                let h = lattice.cell_size[a];
                machine.splat(T::ratio(12, N as i32) / (h * h))
            } else {
                machine.over(machine.splat(T::one()), spread)
            };
        }
        (moment, per_spread)
    }

    /// How far a node is from the first one along an axis.
    #[inline(always)]
    fn beyond_first<M: Machine<T>>(
        &self,
        machine: M,
        lattice: &Lattice<T, D>,
        axis: usize,
        k: usize,
    ) -> M::Eight {
        if self.regular {
            return machine.splat(lattice.cell_size[axis] * T::of(k as f64));
        }
        let coordinate = &lattice.coordinate[axis];
        let apart = std::array::from_fn(|p| {
            let start = self.start[axis][p] as usize;
            // Past the width weights are 0, and nodes may not be there.
            coordinate.get(start + k).map_or(T::zero(), |&there| there - coordinate[start])
        });
        machine.eight(&apart)
    }

    /// How far the last node is behind the first one, in the grid's arrays.
    #[inline(always)]
    fn extent(&self) -> usize {
        (self.width() - 1) * self.strides as usize
    }

    /// How many nodes along each axis have a weight, at most.
    #[inline(always)]
    fn width(&self) -> usize {
        if LEAST < N { self.width } else { N }
    }

    /// The first of the `members` whose first node is not among the `room` ones from `start` on.
    #[cold]
    #[inline(never)]
    fn first_beyond(&self, [from, to]: Members, start: u32, room: u32) -> Option<usize> {
        (from..to).find(|&p| self.first[p].wrapping_sub(start) >= room)
    }

    /// Adds to nodes; where there is something of the kind, with `ASIDES`.
    #[inline(always)]
    fn add<M: Machine<T>, const ASIDES: bool>(
        &self,
        machine: M,
        carried: &Carried<M::Eight, D>,
        moment: Option<&Along<T, D, N>>,
        members: Members,
        nodes: Window<'_, T>,
    ) {
        let stencil = self;
        let spread =
            Spread::<M, T, D, LEAST, N, ASIDES> { machine, stencil, carried, moment, members };
        if LEAST < N && self.width == LEAST {
            spread.add::<LEAST>(nodes);
        } else {
            spread.add::<N>(nodes);
        }
    }

    /// The sums over nodes with weights, and those with each of these in place of the weights along an axis.
    #[inline(always)]
    fn sum<M: Machine<T>, const K: usize>(
        &self,
        machine: M,
        asides: [&Along<T, D, N>; K],
        nodes: &[Nodal<T>],
    ) -> Summed<M::Eight, D, K> {
        let sums = Sums { stencil: self, asides, nodes };
        if LEAST < N && self.width == LEAST {
            sums.all::<M, LEAST>(machine)
        } else {
            sums.all::<M, N>(machine)
        }
    }
}

impl<T: Real, const D: usize, const LEAST: usize, const N: usize> Default
    for Tensor<T, D, LEAST, N>
{
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Real, const D: usize, const LEAST: usize, const N: usize> Stencil<T, D>
    for Tensor<T, D, LEAST, N>
{
    fn each(&self, particle: usize, mut visit: impl FnMut(usize, T, Vector<T, D>)) {
        let width = |a: usize| if a < D { self.width } else { 1 };
        for k2 in 0..width(2) {
            for k1 in 0..width(1) {
                for k0 in 0..width(0) {
                    let k = [k0, k1, k2];
                    let from_first: usize = (0..D).map(|a| k[a] * self.stride[a] as usize).sum();
                    let product = |skip: usize| {
                        let others = (0..D).filter(|&a| a != skip);
                        others.fold(T::one(), |product, a| product * self.weight[a][k[a]][particle])
                    };
                    let gradient =
                        Vector::from_fn(|a, _| self.slope[a][k[a]][particle] * product(a));
                    visit(self.first[particle] as usize + from_first, product(D), gradient);
                }
            }
        }
    }

    #[inline(always)]
    fn beyond(&self, members: Members, nodes: &Range<usize>) -> Option<usize> {
        // How many nodes may come first; there are fewer than 2^32.
        let room = nodes.len().saturating_sub(self.extent()) as u32;
        let mut farthest = 0;
        for first in self.first {
            farthest = farthest.max(first.wrapping_sub(nodes.start as u32));
        }
        if farthest < room { None } else { self.first_beyond(members, nodes.start as u32, room) }
    }

    #[inline(always)]
    fn spread<M: Machine<T>>(
        &self,
        machine: M,
        lattice: &Lattice<T, D>,
        carried: &Carried<M::Eight, D>,
        members: Members,
        nodes: Window<'_, T>,
    ) {
        let own;
        let moment = if carried.moments.is_some() {
            (own, _) = self.moments(machine, lattice);
            Some(&own)
        } else {
            None
        };
        if carried.slopes.is_some() || carried.moments.is_some() {
            self.add::<M, true>(machine, carried, moment, members, nodes);
        } else {
            self.add::<M, false>(machine, carried, moment, members, nodes);
        }
    }

    #[inline(always)]
    fn collect<M: Machine<T>>(
        &self,
        machine: M,
        lattice: &Lattice<T, D>,
        wanted: Wanted,
        nodes: &[Nodal<T>],
    ) -> Collected<M::Eight, D> {
        let nothing = [[machine.splat(T::zero()); D]; D];
        match wanted {
            Wanted::Value => {
                let Summed { value, asides: [] } = self.sum(machine, [], nodes);
                Collected { value, gradient: nothing, slopes: nothing }
            }
            Wanted::Slopes if lattice.degree > 1 => {
                let (moment, per_spread) = self.moments(machine, lattice);
                let asides = [&self.slope, &moment];
                let Summed { value, asides: [gradient, mut slopes] } =
                    self.sum(machine, asides, nodes);
                for a in 0..D {
                    for c in 0..D {
                        slopes[a][c] = machine.times(slopes[a][c], per_spread[a]);
                    }
                }
                Collected { value, gradient, slopes }
            }
            Wanted::Gradient | Wanted::Slopes => {
                let Summed { value, asides: [gradient] } = self.sum(machine, [&self.slope], nodes);
                let slopes = if wanted == Wanted::Slopes { gradient } else { nothing };
                Collected { value, gradient, slopes }
            }
        }
    }
}
