//! What the sums between particles and nodes read.

use std::ops::Range;

use mms_math::machine::Machine;

use super::fours::Fours;
use crate::lanes::components;
use crate::shape::Shape;
use crate::stencil::BUNCH;
use crate::{Cause, Lattice, Matrix, Real, Transfer, Vector};

/// The grid's geometry, and the particles' domains and weights.
pub(super) struct Scene<'a, T: Real, const D: usize, S: Shape> {
    pub lattice: &'a Lattice<T, D>,
    /// Whether weights follow the present positions ([`Formulation::MOVES`](crate::formulation::Formulation)).
    pub moves: bool,
    pub transfer: Transfer,
    pub reference_position: &'a [Vector<T, D>],
    pub domains: &'a [S::Domain<T, D>],
    /// The weights of every bunch, where they are kept.
    pub weights: &'a [S::Stencil<T, D>],
}

impl<T: Real, const D: usize, S: Shape> Clone for Scene<'_, T, D, S> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T: Real, const D: usize, S: Shape> Copy for Scene<'_, T, D, S> {}

/// The displacements and the displacement gradients of a bunch.
pub(super) type State<'a, T, const D: usize> =
    (&'a [Vector<T, D>; BUNCH], &'a [Matrix<T, D>; BUNCH]);

/// What the weights of some particles follow from.
pub(super) struct Placed<'a, T: Real, const D: usize, S: Shape> {
    /// The first of them, which is the first of a bunch.
    start: usize,
    reference_position: Fours<'a, Vector<T, D>>,
    domains: Fours<'a, S::Domain<T, D>>,
}

impl<'a, T: Real, const D: usize, S: Shape> Scene<'a, T, D, S> {
    /// What the weights of some particles follow from.
    #[inline(always)]
    pub fn placed(&self, particles: Range<usize>) -> Placed<'a, T, D, S> {
        Placed {
            start: particles.start,
            reference_position: Fours::new(&self.reference_position[particles.clone()]),
            domains: Fours::new(&self.domains[particles]),
        }
    }

    /// The weights of the bunch `k` of particles, with these displacements and displacement gradients: those that are
    /// kept, or new ones.
    #[inline(always)]
    pub fn weigh<'b, M: Machine<T>>(
        &self,
        machine: M,
        placed: &Placed<'_, T, D, S>,
        k: usize,
        (displacement, displacement_gradient): State<'_, T, D>,
        room: &'b mut S::Stencil<T, D>,
    ) -> Result<&'b S::Stencil<T, D>, (usize, Cause)>
    where
        'a: 'b,
    {
        if let Some(weights) = self.weights.get(placed.start / BUNCH + k) {
            return Ok(weights);
        }
        let mut position = components(machine, placed.reference_position.at(k));
        let mut h = &[Matrix::zeros(); BUNCH];
        if self.moves {
            let displacement = components(machine, displacement);
            for a in 0..D {
                position[a] = machine.plus(position[a], displacement[a]);
            }
            h = displacement_gradient;
        }
        let last = self.domains.len() - 1;
        S::place(machine, room, self.lattice, &position, placed.domains.at(k), h)
            .map_err(|(p, cause)| ((placed.start + BUNCH * k + p).min(last), cause))?;
        Ok(room)
    }
}
