//! The nodes of one particle, with their weights w_ip and weight gradients grad w_ip; the sums between it
//! and its nodes.
//!
//! There are two sums, each the transpose of the other: [`Stencil::spread`] adds
//! w q + sum_a (grad w)_a Q_a to the nodes, and [`Stencil::collect`] returns sum_i w q_i and
//! sum_i (grad w)_a q_i. Mass, momentum and forces, interpolated velocities and their gradients are all
//! of that kind, and so is the linear velocity of APIC, with the moments w (x_i - x_p)_a in place of
//! (grad w)_a. Where a pass needs a sum with slopes and one without, it has both at once, weights and rows of nodes
//! being looked up once for them.

mod rows;
mod tensor;

use mms_math::machine::Machine;

use crate::nodal::{Nodal, Window};
use crate::{Lattice, Real, Vector};

pub use tensor::Tensor;

/// The nodes that a particle touches.
///
/// The sums go over four numbers of a node at a time, by a `machine` of the processor.
pub trait Stencil<T: Real, const D: usize>: Clone + Default + Send + Sync {
    /// Calls `visit(i, w_ip, grad w_ip)` for every node i; a node may come more than once, and its
    /// weights then add up.
    fn each(&self, visit: impl FnMut(usize, T, Vector<T, D>));

    /// The first node, and the one after the last.
    fn span(&self) -> [usize; 2];

    /// q_i += w q for every node i.
    fn spread_value<M: Machine<T>>(&self, machine: M, value: M::Four, nodes: Window<'_, T>);

    /// q_i += w q + sum_a (grad w)_a Q_a for every node i, with q the `value` and Q the `slopes`.
    fn spread<M: Machine<T>>(
        &self,
        machine: M,
        value: M::Four,
        slopes: [M::Four; D],
        nodes: Window<'_, T>,
    );

    /// [`spread_value`](Stencil::spread_value) of the first value to the first nodes, and
    /// [`spread`](Stencil::spread) of the second.
    #[inline(always)]
    fn spread_both<M: Machine<T>>(
        &self,
        machine: M,
        values: [M::Four; 2],
        slopes: [M::Four; D],
        [first, second]: [Window<'_, T>; 2],
    ) {
        self.spread_value(machine, values[0], first);
        self.spread(machine, values[1], slopes, second);
    }

    /// sum_i w q_i.
    fn collect_value<M: Machine<T>>(&self, machine: M, nodes: &[Nodal<T>]) -> M::Four;

    /// sum_i w q_i, and sum_i (grad w)_a q_i for every axis a.
    fn collect<M: Machine<T>>(&self, machine: M, nodes: &[Nodal<T>]) -> (M::Four, [M::Four; D]);

    /// [`collect_value`](Stencil::collect_value) of the first nodes and [`collect`](Stencil::collect) of the
    /// second: both values, and the slopes.
    #[inline(always)]
    fn collect_both<M: Machine<T>>(
        &self,
        machine: M,
        [first, second]: [&[Nodal<T>]; 2],
    ) -> ([M::Four; 2], [M::Four; D]) {
        let (value, slopes) = self.collect(machine, second);
        ([self.collect_value(machine, first), value], slopes)
    }

    /// As [`spread`](Stencil::spread), with the moments w (x_i - x_p)_a in place of (grad w)_a.
    fn spread_moments<M: Machine<T>>(
        &self,
        machine: M,
        lattice: &Lattice<T, D>,
        value: M::Four,
        slopes: [M::Four; D],
        nodes: Window<'_, T>,
    );

    /// The slopes of the linear function that is nearest to q_i, as the weights measure it:
    /// (sum_i w q_i (x) (x_i - x_p)) (sum_i w (x_i - x_p) (x) (x_i - x_p))^-1, if there is such.
    fn collect_slopes<M: Machine<T>>(
        &self,
        machine: M,
        lattice: &Lattice<T, D>,
        nodes: &[Nodal<T>],
    ) -> [M::Four; D];
}
