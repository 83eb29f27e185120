//! A periodic axis: nodes one period apart are the same node.
//!
//! Weights reach past both ends of the period. What nodes outside it receive goes to those inside, and
//! nodes outside move like them.

use crate::defect::{Defect, on};
use crate::nodal::Nodal;
use crate::{Lattice, Real};

/// Pairs of a node outside the period and the one inside that it repeats.
pub struct Period {
    pairs: Vec<(usize, usize)>,
}

impl Period {
    /// The pairs of an axis, if it is periodic: a whole number of cells.
    pub fn new<T: Real, const D: usize>(lattice: &Lattice<T, D>, axis: usize) -> Option<Self> {
        lattice.period[axis]?;
        let [from, to] = lattice.axes[axis].body.map(|knot| knot.ceil() as usize);
        let length = to - from + usize::from(on(Defect::PeriodOfNodes));
        let pairs = (0..lattice.len()).filter_map(|node| {
            let k = lattice.coordinates(node)[axis];
            let inside = (k + length - from % length) % length + from;
            let twin = node - k * lattice.stride[axis] + inside * lattice.stride[axis];
            (inside != k).then_some((node, twin))
        });
        Some(Self { pairs: pairs.collect() })
    }

    /// q_inside += q_outside, for mass, momentum and force, which leaves the nodes outside empty.
    pub fn fold<T: Real>(&self, extensive: &mut [Nodal<T>]) {
        for &(outside, inside) in &self.pairs {
            let image = std::mem::replace(&mut extensive[outside], Nodal::zero());
            extensive[inside] += image;
        }
    }

    /// q_outside = q_inside, for velocity and acceleration.
    pub fn copy<T: Real>(&self, intensive: &mut [Nodal<T>]) {
        for &(outside, inside) in &self.pairs {
            intensive[outside] = intensive[inside];
        }
    }
}
