//! The background grid: its geometry, and what its nodes carry.

use crate::failure::at_most;
use crate::shape::{MAX_NODES, Shape, Stencil};
use crate::{Real, Refusal, Vector};

/// More nodes than this are refused.
const NODE_LIMIT: f64 = (1u64 << 28) as f64;

/// Cells around the body's motion, on top of what its particles' stencils reach.
const MARGIN: f64 = 2.0;

/// A regular grid of cubic cells, the first axis running fastest in every array.
#[derive(Clone, Debug)]
pub struct Grid<T, const D: usize> {
    /// Position of the first node.
    pub lower: Vector<T, D>,
    /// Distance h between neighbouring nodes.
    pub cell_size: T,
    /// Nodes along each axis.
    pub count: [usize; D],
    /// Distance in the arrays between neighbours along each axis.
    pub stride: [usize; D],
    /// The node, along each axis, at the lower corner of the reference body.
    pub body_node: [usize; D],
    /// A node with no more mass than this is taken as empty, and nothing is divided by its mass.
    pub mass_floor: T,
    /// m_i.
    pub mass: Vec<T>,
    /// (mv)_i.
    pub momentum: Vec<Vector<T, D>>,
    /// f_i, internal and external.
    pub force: Vec<Vector<T, D>>,
    /// v_i.
    pub velocity: Vec<Vector<T, D>>,
    /// a_i.
    pub acceleration: Vec<Vector<T, D>>,
}

impl<T: Real, const D: usize> Grid<T, D> {
    /// A grid with a node at `body_lower`, large enough for particles between `lowest` and `highest`.
    pub fn new(
        body_lower: &[f64; D],
        cell_size: f64,
        lowest: &[f64; D],
        highest: &[f64; D],
    ) -> Result<Self, Refusal> {
        let cells = |distance: f64| (distance / cell_size).ceil().max(0.0);
        let padding = MAX_NODES as f64 + MARGIN;
        let below: [f64; D] = std::array::from_fn(|a| cells(body_lower[a] - lowest[a]) + padding);
        let above: [f64; D] = std::array::from_fn(|a| cells(highest[a] - body_lower[a]) + padding);
        let nodes: f64 = (0..D).map(|a| below[a] + above[a] + 1.0).product();
        at_most("grid nodes", nodes, NODE_LIMIT)?;
        let count: [usize; D] = std::array::from_fn(|a| (below[a] + above[a]) as usize + 1);
        let stride = std::array::from_fn(|a| count[..a].iter().product());
        let total = count.iter().product();
        Ok(Self {
            lower: Vector::from_fn(|a, _| T::of(body_lower[a] - below[a] * cell_size)),
            cell_size: T::of(cell_size),
            count,
            stride,
            body_node: below.map(|cells| cells as usize),
            mass_floor: T::zero(),
            mass: vec![T::zero(); total],
            momentum: vec![Vector::zeros(); total],
            force: vec![Vector::zeros(); total],
            velocity: vec![Vector::zeros(); total],
            acceleration: vec![Vector::zeros(); total],
        })
    }

    /// How many nodes there are.
    pub fn len(&self) -> usize {
        self.mass.len()
    }

    /// Whether there is no node; a grid always has some.
    pub fn is_empty(&self) -> bool {
        self.mass.is_empty()
    }

    /// The node's coordinate along each axis, in cells from the first node.
    pub fn coordinates(&self, node: usize) -> [usize; D] {
        std::array::from_fn(|a| node / self.stride[a] % self.count[a])
    }

    /// The node's position.
    pub fn position(&self, node: usize) -> Vector<T, D> {
        let coordinates = self.coordinates(node);
        Vector::from_fn(|a, _| self.lower[a] + T::of(coordinates[a] as f64) * self.cell_size)
    }

    /// The nodes and weights of a particle, or `None` if its domain does not fit on the grid.
    pub fn stencil<S: Shape>(
        &self,
        position: &Vector<T, D>,
        half_width: &Vector<T, D>,
    ) -> Option<Stencil<T, D>> {
        let in_cells = |length: Vector<T, D>| length / self.cell_size;
        Stencil::new::<S>(
            &in_cells(position - self.lower),
            &in_cells(*half_width),
            self.cell_size,
            &self.count,
            &self.stride,
        )
    }

    /// v_i = (mv)_i / m_i; 0 on empty nodes.
    pub fn velocity_from_momentum(&mut self) {
        divide_by_mass(&self.momentum, &self.mass, self.mass_floor, &mut self.velocity);
    }

    /// a_i = f_i / m_i; 0 on empty nodes.
    pub fn acceleration_from_force(&mut self) {
        divide_by_mass(&self.force, &self.mass, self.mass_floor, &mut self.acceleration);
    }

    /// v_i += dt a_i.
    pub fn kick(&mut self, time_step: T) {
        for (velocity, acceleration) in self.velocity.iter_mut().zip(&self.acceleration) {
            *velocity += acceleration * time_step;
        }
    }
}

fn divide_by_mass<T: Real, const D: usize>(
    extensive: &[Vector<T, D>],
    mass: &[T],
    mass_floor: T,
    out: &mut [Vector<T, D>],
) {
    for ((out, extensive), &mass) in out.iter_mut().zip(extensive).zip(mass) {
        *out = if mass > mass_floor { extensive / mass } else { Vector::zeros() };
    }
}
