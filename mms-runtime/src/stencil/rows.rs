//! The sums over the nodes of a tensor stencil, row by row.
//!
//! A sum says what it does with a plane, with a row of it, and with what a plane has come to;
//! [`Tensor::sum`](super::Tensor::sum) goes through them. These are types and not closures, for all of it has to be
//! inlined into code that is compiled for a processor.

use mms_math::machine::Machine;

use super::tensor::Pair;
use crate::Real;
use crate::nodal::{Nodal, Window};

/// A sum over nodes. What does not depend on the node along an axis is multiplied once for all of them.
pub trait RowSum<T: Real, M: Machine<T>> {
    /// What belongs to a plane.
    type Plane;

    /// What the plane with this pair along the third axis begins with.
    fn plane(&self, machine: M, pair: Pair<M::Four>) -> Self::Plane;

    /// The row with this pair along the second axis, whose first node is given; the other pairs are those along
    /// the first axis.
    fn row<const W: usize>(
        &mut self,
        machine: M,
        plane: &mut Self::Plane,
        pair: Pair<M::Four>,
        pairs: &[Pair<M::Four>; W],
        first: usize,
    );

    /// The plane is done.
    #[inline(always)]
    fn end(&mut self, _: M, _: Self::Plane, _: Pair<M::Four>) {}
}

/// node + a x.
#[inline(always)]
fn plus<T: Real, M: Machine<T>>(machine: M, node: &Nodal<T>, a: M::Four, x: M::Four) -> Nodal<T> {
    Nodal(machine.numbers(machine.times_plus(a, x, machine.four(&node.0))))
}

/// [`Stencil::spread_value`](super::Stencil::spread_value).
pub struct SpreadValue<'a, T, F> {
    pub value: F,
    pub nodes: Window<'a, T>,
}

impl<T: Real, M: Machine<T>> RowSum<T, M> for SpreadValue<'_, T, M::Four> {
    type Plane = M::Four;

    #[inline(always)]
    fn plane(&self, machine: M, [w2, _]: Pair<M::Four>) -> M::Four {
        machine.times(w2, self.value)
    }

    #[inline(always)]
    fn row<const W: usize>(
        &mut self,
        machine: M,
        of_plane: &mut M::Four,
        [w1, _]: Pair<M::Four>,
        pairs: &[Pair<M::Four>; W],
        first: usize,
    ) {
        let of_row = machine.times(w1, *of_plane);
        for (node, [w0, _]) in self.nodes.row(first, W).iter_mut().zip(pairs) {
            *node = plus(machine, node, *w0, of_row);
        }
    }
}

/// [`Stencil::spread`](super::Stencil::spread).
pub struct Spread<'a, T, F, const D: usize> {
    pub value: F,
    pub slopes: [F; D],
    pub nodes: Window<'a, T>,
}

/// What a plane has of a value and its slopes: the sum without the slopes along the first two axes, and these.
type OfPlane<F> = (F, [F; 2]);

impl<T: Real, F: Copy, const D: usize> Spread<'_, T, F, D> {
    /// The sum without the slope along the first axis, and this, of a row.
    #[inline(always)]
    fn of_row<M: Machine<T, Four = F>>(
        machine: M,
        &(of_plane, slopes): &OfPlane<F>,
        [w1, s1]: Pair<F>,
    ) -> [F; 2] {
        let mut of_row = machine.times(w1, of_plane);
        if D > 1 {
            of_row = machine.times_plus(s1, slopes[1], of_row);
        }
        [of_row, machine.times(w1, slopes[0])]
    }
}

impl<T: Real, M: Machine<T>, const D: usize> RowSum<T, M> for Spread<'_, T, M::Four, D> {
    type Plane = OfPlane<M::Four>;

    #[inline(always)]
    fn plane(&self, machine: M, [w2, s2]: Pair<M::Four>) -> Self::Plane {
        let mut of_plane = machine.times(w2, self.value);
        if D > 2 {
            of_plane = machine.times_plus(s2, self.slopes[D - 1], of_plane);
        }
        let mut slopes = [machine.splat(T::zero()); 2];
        for a in 0..D.min(2) {
            slopes[a] = machine.times(w2, self.slopes[a]);
        }
        (of_plane, slopes)
    }

    #[inline(always)]
    fn row<const W: usize>(
        &mut self,
        machine: M,
        of_plane: &mut Self::Plane,
        pair: Pair<M::Four>,
        pairs: &[Pair<M::Four>; W],
        first: usize,
    ) {
        let [of_row, slope] = Self::of_row(machine, of_plane, pair);
        for (node, [w0, s0]) in self.nodes.row(first, W).iter_mut().zip(pairs) {
            *node = plus(machine, &plus(machine, node, *w0, of_row), *s0, slope);
        }
    }
}

/// [`Stencil::collect_value`](super::Stencil::collect_value).
pub struct CollectValue<'a, T, F> {
    pub value: F,
    pub nodes: &'a [Nodal<T>],
}

impl<T: Real, M: Machine<T>> RowSum<T, M> for CollectValue<'_, T, M::Four> {
    type Plane = M::Four;

    #[inline(always)]
    fn plane(&self, machine: M, _: Pair<M::Four>) -> M::Four {
        machine.splat(T::zero())
    }

    #[inline(always)]
    fn row<const W: usize>(
        &mut self,
        machine: M,
        of_plane: &mut M::Four,
        [w1, _]: Pair<M::Four>,
        pairs: &[Pair<M::Four>; W],
        first: usize,
    ) {
        let mut of_row = machine.splat(T::zero());
        for (node, [w0, _]) in self.nodes[first..first + W].iter().zip(pairs) {
            of_row = machine.times_plus(*w0, machine.four(&node.0), of_row);
        }
        *of_plane = machine.times_plus(w1, of_row, *of_plane);
    }

    #[inline(always)]
    fn end(&mut self, machine: M, of_plane: M::Four, [w2, _]: Pair<M::Four>) {
        self.value = machine.times_plus(w2, of_plane, self.value);
    }
}

/// [`Stencil::collect`](super::Stencil::collect).
pub struct Collect<'a, T, F, const D: usize> {
    pub value: F,
    pub slopes: [F; D],
    pub nodes: &'a [Nodal<T>],
}

impl<T: Real, M: Machine<T>, const D: usize> RowSum<T, M> for Collect<'_, T, M::Four, D> {
    type Plane = OfPlane<M::Four>;

    #[inline(always)]
    fn plane(&self, machine: M, _: Pair<M::Four>) -> Self::Plane {
        let nothing = machine.splat(T::zero());
        (nothing, [nothing; 2])
    }

    #[inline(always)]
    fn row<const W: usize>(
        &mut self,
        machine: M,
        (of_plane, slopes): &mut Self::Plane,
        [w1, s1]: Pair<M::Four>,
        pairs: &[Pair<M::Four>; W],
        first: usize,
    ) {
        let nothing = machine.splat(T::zero());
        let (mut of_row, mut slope) = (nothing, nothing);
        for (node, [w0, s0]) in self.nodes[first..first + W].iter().zip(pairs) {
            let node = machine.four(&node.0);
            of_row = machine.times_plus(*w0, node, of_row);
            slope = machine.times_plus(*s0, node, slope);
        }
        *of_plane = machine.times_plus(w1, of_row, *of_plane);
        slopes[0] = machine.times_plus(w1, slope, slopes[0]);
        slopes[1] = machine.times_plus(s1, of_row, slopes[1]);
    }

    #[inline(always)]
    fn end(&mut self, machine: M, (of_plane, slopes): Self::Plane, [w2, s2]: Pair<M::Four>) {
        self.value = machine.times_plus(w2, of_plane, self.value);
        for a in 0..D.min(2) {
            self.slopes[a] = machine.times_plus(w2, slopes[a], self.slopes[a]);
        }
        if D > 2 {
            self.slopes[D - 1] = machine.times_plus(s2, of_plane, self.slopes[D - 1]);
        }
    }
}

/// Two sums in one pass over the rows: [`Stencil::spread_both`](super::Stencil::spread_both) and
/// [`Stencil::collect_both`](super::Stencil::collect_both).
pub struct Both<A, B> {
    pub first: A,
    pub second: B,
}

impl<T: Real, M: Machine<T>, A: RowSum<T, M>, B: RowSum<T, M>> RowSum<T, M> for Both<A, B> {
    type Plane = (A::Plane, B::Plane);

    #[inline(always)]
    fn plane(&self, machine: M, pair: Pair<M::Four>) -> Self::Plane {
        (self.first.plane(machine, pair), self.second.plane(machine, pair))
    }

    #[inline(always)]
    fn row<const W: usize>(
        &mut self,
        machine: M,
        (first_plane, second_plane): &mut Self::Plane,
        pair: Pair<M::Four>,
        pairs: &[Pair<M::Four>; W],
        first: usize,
    ) {
        self.first.row(machine, first_plane, pair, pairs, first);
        self.second.row(machine, second_plane, pair, pairs, first);
    }

    #[inline(always)]
    fn end(&mut self, machine: M, (first, second): Self::Plane, pair: Pair<M::Four>) {
        self.first.end(machine, first, pair);
        self.second.end(machine, second, pair);
    }
}
