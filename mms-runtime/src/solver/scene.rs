//! What the sums between particles and nodes read.

use std::ops::Range;

use mms_math::machine::Machine;

use crate::shape::Shape;
use crate::{Cause, Lattice, Matrix, Real, Transfer, Vector};

/// Particles whose weights are computed together; they stay in the first cache until they are used.
pub(super) const BLOCK: usize = 32;

/// The weights of a block.
pub(super) type Room<T, const D: usize, S> = [<S as Shape>::Stencil<T, D>; BLOCK];

/// The grid's geometry, and the particles' domains and weights.
pub(super) struct Scene<'a, T: Real, const D: usize, S: Shape> {
    pub lattice: &'a Lattice<T, D>,
    /// Whether weights follow the present positions ([`Formulation::MOVES`](crate::formulation::Formulation)).
    pub moves: bool,
    pub transfer: Transfer,
    pub reference_position: &'a [Vector<T, D>],
    pub domains: &'a [S::Domain<T, D>],
    /// The weights of every particle, where they are kept.
    pub weights: &'a [S::Stencil<T, D>],
}

impl<T: Real, const D: usize, S: Shape> Clone for Scene<'_, T, D, S> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T: Real, const D: usize, S: Shape> Copy for Scene<'_, T, D, S> {}

impl<'a, T: Real, const D: usize, S: Shape> Scene<'a, T, D, S> {
    /// Room for the weights of a block.
    #[inline(always)]
    pub fn room() -> Room<T, D, S> {
        std::array::from_fn(|_| S::Stencil::default())
    }

    /// The weights of a block of particles with these displacements and displacement gradients: those that are
    /// kept, or new ones.
    #[inline(always)]
    pub fn weigh<'b, M: Machine<T>>(
        &self,
        machine: M,
        block: Range<usize>,
        displacement: &[Vector<T, D>],
        displacement_gradient: &[Matrix<T, D>],
        room: &'b mut Room<T, D, S>,
    ) -> Result<&'b [S::Stencil<T, D>], (usize, Cause)>
    where
        'a: 'b,
    {
        if let Some(weights) = self.weights.get(block.clone()) {
            return Ok(weights);
        }
        let room = &mut room[..block.len()];
        let reference = &self.reference_position[block.clone()];
        let particles = reference.iter().zip(&self.domains[block.clone()]);
        let states = displacement.iter().zip(displacement_gradient);
        for ((stencil, p), ((reference, domain), (d, h))) in
            room.iter_mut().zip(block).zip(particles.zip(states))
        {
            let placed = if self.moves {
                S::place(machine, stencil, self.lattice, &(reference + d), domain, h)
            } else {
                S::place(machine, stencil, self.lattice, reference, domain, &Matrix::zeros())
            };
            placed.map_err(|cause| (p, cause))?;
        }
        Ok(room)
    }
}
