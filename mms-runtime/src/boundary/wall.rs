//! A wall at rest on a plane of grid nodes, by the method of images.
//!
//! Particle domains reach past the wall. The body is continued there by its mirror image, moving
//! antisymmetrically, so nodes inside receive what their images (ghost nodes) got, and ghost nodes move
//! opposite to the nodes inside, in velocity and acceleration alike.

use crate::{Condition, Face, Grid, Real, Refusal, Vector};

/// A wall: which nodes are on it, which are behind it, and which components it reflects.
pub struct Wall {
    on_wall: Vec<usize>,
    /// Pairs of a ghost node and the node inside that it is the image of.
    images: Vec<(usize, usize)>,
    /// The wall's normal.
    axis: usize,
    /// Whether the tangential components are held as well.
    fixed: bool,
}

impl Wall {
    /// The wall at a `face` of a box with its lower corner at the grid's `body_node`; `edge` is the
    /// length of the box along the face's normal.
    pub fn new<T: Real, const D: usize>(
        grid: &Grid<T, D>,
        face: Face,
        condition: Condition,
        edge: f64,
    ) -> Result<Self, Refusal> {
        let (axis, upper) = match face {
            Face::Min(axis) => (axis, false),
            Face::Max(axis) => (axis, true),
            _ => return Err(Refusal::NoSuchFace { face, dimension: D }),
        };
        let cells = edge / grid.cell_size.to_f64();
        if upper && (cells - cells.round()).abs() > 1e-4 {
            return Err(Refusal::WallBetweenNodes { face, condition, cells });
        }
        let plane = grid.body_node[axis] + if upper { cells.round() as usize } else { 0 };
        let mut wall = Self {
            on_wall: Vec::new(),
            images: Vec::new(),
            axis,
            fixed: condition == Condition::Fixed,
        };
        for node in 0..grid.len() {
            let k = grid.coordinates(node)[axis];
            let behind = if upper { k > plane } else { k < plane };
            if k == plane {
                wall.on_wall.push(node);
            } else if behind && (2 * plane).checked_sub(k).is_some_and(|m| m < grid.count[axis]) {
                let inside = node + 2 * plane * grid.stride[axis] - 2 * k * grid.stride[axis];
                wall.images.push((node, inside));
            }
        }
        Ok(wall)
    }

    /// m_inside += m_ghost, which leaves the ghost nodes empty.
    pub fn fold_mass<T: Real>(&self, mass: &mut [T]) {
        for &(ghost, inside) in &self.images {
            let image = std::mem::replace(&mut mass[ghost], T::zero());
            mass[inside] += image;
        }
    }

    /// q_inside += reflected q_ghost, for momentum and force.
    pub fn fold<T: Real, const D: usize>(&self, extensive: &mut [Vector<T, D>]) {
        for &(ghost, inside) in &self.images {
            let image = self.reflect(extensive[ghost]);
            extensive[inside] += image;
        }
    }

    /// q_ghost = reflected q_inside, and 0 on the wall, for velocity and acceleration.
    pub fn mirror<T: Real, const D: usize>(&self, intensive: &mut [Vector<T, D>]) {
        for &(ghost, inside) in &self.images {
            intensive[ghost] = self.reflect(intensive[inside]);
        }
        for &node in &self.on_wall {
            // Half of (q + reflected q) would do too, but leaves round-off.
            for a in (0..D).filter(|&a| self.reflects(a)) {
                intensive[node][a] = T::zero();
            }
        }
    }

    fn reflects(&self, axis: usize) -> bool {
        self.fixed || axis == self.axis
    }

    fn reflect<T: Real, const D: usize>(&self, vector: Vector<T, D>) -> Vector<T, D> {
        Vector::from_fn(|a, _| if self.reflects(a) { -vector[a] } else { vector[a] })
    }
}
