//! The background grid: the values at its nodes.

use crate::lattice::Lattice;
use crate::nodal::Nodal;
use crate::real::Real;
use crate::threads::each_node;

/// The nodes of a [`Lattice`]; entry `i` of every array belongs to node `i`.
#[derive(Clone, Debug)]
pub struct Grid<T, const D: usize> {
    /// The geometry of the nodes.
    pub lattice: Lattice<T, D>,
    /// A node with no more mass than this counts as empty, and nothing is divided by its mass.
    pub mass_floor: T,
    /// (mv)_i and m_i; after the kick with PIC and APIC.
    pub momentum: Vec<Nodal<T>>,
    /// f_i, internal and external; unused if forces are added directly to momentum.
    pub force: Vec<Nodal<T>>,
    /// v_i. The number beside the vector is unused.
    pub velocity: Vec<Nodal<T>>,
    /// a_i, if the particles' update reads it.
    pub acceleration: Vec<Nodal<T>>,
}

impl<T: Real, const D: usize> Grid<T, D> {
    /// Empty nodes at rest.
    pub fn new(lattice: Lattice<T, D>) -> Self {
        let nothing = vec![Nodal::zero(); lattice.len()];
        Self {
            lattice,
            mass_floor: T::zero(),
            momentum: nothing.clone(),
            force: nothing.clone(),
            velocity: nothing.clone(),
            acceleration: nothing,
        }
    }

    /// m_i of a node.
    pub fn mass(&self, node: usize) -> T {
        self.momentum[node].last()
    }

    /// v_i = (mv)_i / m_i; 0 on empty nodes.
    pub fn velocity_from_momentum(&mut self) {
        divide_by_mass(&self.momentum, &self.momentum, self.mass_floor, &mut self.velocity);
    }

    /// a_i = f_i / m_i; 0 on empty nodes.
    pub fn acceleration_from_force(&mut self) {
        divide_by_mass(&self.force, &self.momentum, self.mass_floor, &mut self.acceleration);
    }

    /// v_i += dt a_i.
    pub fn kick(&mut self, time_step: T) {
        let nodes = (&mut self.velocity[..], &self.acceleration[..]);
        each_node(nodes, &|(velocity, acceleration)| {
            for (velocity, acceleration) in velocity.iter_mut().zip(acceleration) {
                *velocity += *acceleration * time_step;
            }
        });
    }

    /// Computes a_i, and v_i after a kick: the three functions above in one pass.
    pub fn kicked_from_momentum_and_force(&mut self, time_step: T) {
        let Self { momentum, force, velocity, acceleration, mass_floor, .. } = self;
        let mass_floor = *mass_floor;
        let found = (&mut velocity[..], &mut acceleration[..]);
        let sums = (&momentum[..], &force[..]);
        each_node((found, sums), &|((velocity, acceleration), (momentum, force))| {
            let sums = momentum.iter().zip(force);
            for ((velocity, acceleration), (momentum, force)) in
                velocity.iter_mut().zip(acceleration).zip(sums)
            {
                let per_mass = per_mass(momentum, mass_floor);
                *acceleration = *force * per_mass;
                *velocity = *momentum * per_mass + *acceleration * time_step;
            }
        });
    }
}

/// Divides the vectors of `extensive` by the masses in `momentum`; 0 on nodes with no more mass than `mass_floor`.
pub(crate) fn divide_by_mass<T: Real>(
    extensive: &[Nodal<T>],
    momentum: &[Nodal<T>],
    mass_floor: T,
    out: &mut [Nodal<T>],
) {
    each_node((out, (extensive, momentum)), &|(out, (extensive, momentum))| {
        for ((out, extensive), momentum) in out.iter_mut().zip(extensive).zip(momentum) {
            *out = *extensive * per_mass(momentum, mass_floor);
        }
    });
}

/// 1/m_i, which multiplies the numbers of a node: one division for up to eight numbers. 0 on empty nodes.
fn per_mass<T: Real>(momentum: &Nodal<T>, mass_floor: T) -> T {
    let mass = momentum.last();
    if mass > mass_floor { T::one() / mass } else { T::zero() }
}
