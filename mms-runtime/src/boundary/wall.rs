//! A wall at rest on a plane of grid nodes, by the method of images.
//!
//! Particle domains and weights reach past the wall. The body is continued there by its mirror image, moving antisymmetrically.
//! Mass, momentum and force at ghost nodes are reflected and added to the nodes inside; then ghost nodes get the reflected
//! velocity and acceleration of the nodes inside. Splines that end at the wall have no ghost nodes.

use super::images::Images;
use crate::defect::{Defect, on};
use crate::failure::Refusal;
use crate::field::{Condition, Face};
use crate::lattice::Lattice;
use crate::nodal::{LAST, Nodal};
use crate::real::Real;

/// A wall: which nodes are on it, which are behind it, and which components it reflects.
pub struct Wall {
    on_wall: Vec<usize>,
    /// Ghost nodes, and the nodes inside that they are images of.
    images: Images,
    /// The wall's normal.
    axis: usize,
    /// Whether the wall constrains the tangential components as well.
    fixed: bool,
}

impl Wall {
    /// The wall at a `face` of a box.
    ///
    /// # Errors
    /// The face lies between planes of nodes, or is not a face of a box.
    pub fn new<T: Real, const D: usize>(
        lattice: &Lattice<T, D>,
        face: Face,
        condition: Condition,
    ) -> Result<Self, Refusal> {
        let (axis, upper) = match face {
            Face::Min(axis) => (axis, false),
            Face::Max(axis) => (axis, true),
            _ => return Err(Refusal::UnsupportedCondition { face, condition }),
        };
        let [from, to] = lattice.axes[axis].body;
        let Some(plane) = lattice.node_on_face(axis, upper) else {
            let cells = if upper { to - from } else { from.fract() };
            return Err(Refusal::WallBetweenNodes { face, condition, cells });
        };
        let (mut on_wall, mut images) = (Vec::new(), Vec::new());
        // Splines of a higher degree end at the wall, and nothing reaches past it.
        let reaches_past = lattice.degree == 1 && !on(Defect::NoGhosts);
        for node in 0..lattice.len() {
            let k = lattice.coordinates(node)[axis];
            let behind = reaches_past && if upper { k > plane } else { k < plane };
            if k == plane {
                on_wall.push(node);
            } else if behind && (2 * plane).checked_sub(k).is_some_and(|m| m < lattice.count[axis])
            {
                let stride = lattice.stride[axis];
                let inside = node + 2 * plane * stride - 2 * k * stride;
                images.push((k.abs_diff(plane) - 1, (node, inside)));
            }
        }
        let is_axis = lattice.is_meridian && face == Face::Min(0);
        let fixed = condition == Condition::Fixed
            || on(Defect::StickyRoller)
            || is_axis && on(Defect::AxisFixed);
        Ok(Self { on_wall, images: Images::new(images), axis, fixed })
    }

    /// Finds the ghost nodes that have mass.
    pub fn reach<T: Real>(&mut self, momentum: &[Nodal<T>]) {
        self.images.reach(momentum);
    }

    /// q_inside += reflected q_ghost, for mass, momentum and force; empties the ghost nodes.
    pub fn fold<T: Real>(&self, extensive: &mut [Nodal<T>]) {
        self.images.fold(extensive, |ghost| self.reflect(ghost));
    }

    /// q_ghost = reflected q_inside, and 0 on the wall, for velocity and acceleration.
    pub fn mirror<T: Real>(&self, intensive: &mut [Nodal<T>]) {
        self.images.copy(intensive, |inside| {
            if on(Defect::MirrorSign) { inside } else { self.reflect(inside) }
        });
        if on(Defect::WallReleased) {
            return;
        }
        for &node in &self.on_wall {
            // Half of (q + reflected q) would be 0 up to round-off only.
            for a in (0..LAST).filter(|&a| self.reflects(a)) {
                intensive[node].0[a] = T::zero();
            }
        }
    }

    fn reflects(&self, axis: usize) -> bool {
        self.fixed || axis == self.axis
    }

    fn reflect<T: Real>(&self, mut node: Nodal<T>) -> Nodal<T> {
        for a in (0..LAST).filter(|&a| self.reflects(a)) {
            node.0[a] = -node.0[a];
        }
        node
    }
}
