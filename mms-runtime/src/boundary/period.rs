//! A periodic axis: nodes one period apart are the same node.
//!
//! Weights reach past both ends of the period. Sums at nodes outside it are added to the nodes inside, and nodes outside move
//! like the nodes inside.

use super::images::Images;
use crate::defect::{Defect, on};
use crate::lattice::Lattice;
use crate::nodal::Nodal;
use crate::real::Real;

/// The nodes outside a period, and the nodes inside that they repeat.
pub struct Period(Images);

impl Period {
    /// The period of an axis, which is a whole number of cells; `None` if the axis is not periodic.
    pub fn new<T: Real, const D: usize>(lattice: &Lattice<T, D>, axis: usize) -> Option<Self> {
        lattice.period[axis]?;
        let [from, to] = lattice.axes[axis].body.map(|knot| knot.ceil() as usize);
        let length = to - from + usize::from(on(Defect::PeriodOfNodes));
        let pairs = (0..lattice.len()).filter_map(|node| {
            let k = lattice.coordinates(node)[axis];
            let inside = (k + length - from % length) % length + from;
            let twin = node - k * lattice.stride[axis] + inside * lattice.stride[axis];
            let layer = if k < from { from - k - 1 } else { k.saturating_sub(from + length) };
            (inside != k).then_some((layer, (node, twin)))
        });
        Some(Self(Images::new(pairs)))
    }

    /// Finds the nodes outside that have mass.
    pub fn reach<T: Real>(&mut self, momentum: &[Nodal<T>]) {
        self.0.reach(momentum);
    }

    /// q_inside += q_outside, for mass, momentum and force; empties the nodes outside.
    pub fn fold<T: Real>(&self, extensive: &mut [Nodal<T>]) {
        self.0.fold(extensive, |outside| outside);
    }

    /// q_outside = q_inside, for velocity and acceleration.
    pub fn copy<T: Real>(&self, intensive: &mut [Nodal<T>]) {
        self.0.copy(intensive, |inside| inside);
    }
}
