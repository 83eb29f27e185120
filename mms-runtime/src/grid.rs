//! The background grid: what its nodes carry.

use crate::{Lattice, Real, Vector};

/// The nodes of a [`Lattice`]; entry `i` of every array belongs to node `i`.
#[derive(Clone, Debug)]
pub struct Grid<T, const D: usize> {
    /// Where the nodes are.
    pub lattice: Lattice<T, D>,
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
    /// Empty nodes at rest.
    pub fn new(lattice: Lattice<T, D>) -> Self {
        let total = lattice.len();
        Self {
            lattice,
            mass_floor: T::zero(),
            mass: vec![T::zero(); total],
            momentum: vec![Vector::zeros(); total],
            force: vec![Vector::zeros(); total],
            velocity: vec![Vector::zeros(); total],
            acceleration: vec![Vector::zeros(); total],
        }
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

/// `extensive` / `mass`; 0 on nodes with no more mass than `mass_floor`.
pub(crate) fn divide_by_mass<T: Real, const D: usize>(
    extensive: &[Vector<T, D>],
    mass: &[T],
    mass_floor: T,
    out: &mut [Vector<T, D>],
) {
    for ((out, extensive), &mass) in out.iter_mut().zip(extensive).zip(mass) {
        *out = if mass > mass_floor { extensive / mass } else { Vector::zeros() };
    }
}
