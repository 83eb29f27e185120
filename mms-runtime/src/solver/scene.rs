//! What the sums between particles and nodes read.

use std::ops::Range;

use mms_math::machine::Machine;

use super::fours::Fours;
use crate::lanes::{components, vectors};
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
pub(super) type Moved<'a, T, const D: usize> =
    (&'a [Vector<T, D>; BUNCH], &'a [Matrix<T, D>; BUNCH]);

/// What the weights of some particles follow from.
pub(super) struct Placed<'a, T: Real, const D: usize, S: Shape> {
    /// The first of them, which is the first of a bunch.
    start: usize,
    /// The one after the last.
    end: usize,
    reference_position: Fours<'a, Vector<T, D>>,
    domains: Fours<'a, S::Domain<T, D>>,
}

impl<T: Real, const D: usize, S: Shape> Placed<'_, T, D, S> {
    /// Particle `p` of the bunch `k`; the last one, if there are not so many.
    fn particle(&self, k: usize, p: usize) -> usize {
        (self.start + BUNCH * k + p).min(self.end - 1)
    }
}

impl<'a, T: Real, const D: usize, S: Shape> Scene<'a, T, D, S> {
    /// What the weights of some particles follow from.
    #[inline(always)]
    pub fn placed(&self, particles: Range<usize>) -> Placed<'a, T, D, S> {
        Placed {
            start: particles.start,
            end: particles.end,
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
        (displacement, displacement_gradient): Moved<'_, T, D>,
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
        let domains = placed.domains.at(k);
        match S::place(machine, room, self.lattice, &position, domains, h) {
            Ok(()) => Ok(room),
            Err(cause) => {
                let (p, cause) = self.blamed(&vectors(machine, position), domains, h, cause);
                Err((placed.particle(k, p), cause))
            }
        }
    }

    /// Which of a bunch could not be placed alone, and why; the first one, if each could.
    #[cold]
    fn blamed(
        &self,
        positions: &[Vector<T, D>; BUNCH],
        domains: &[S::Domain<T, D>; BUNCH],
        displacement_gradients: &[Matrix<T, D>; BUNCH],
        cause: Cause,
    ) -> (usize, Cause) {
        for p in 0..BUNCH {
            let h = &displacement_gradients[p];
            if let Err(cause) = S::stencil(self.lattice, &positions[p], &domains[p], h) {
                return (p, cause);
            }
        }
        (0, cause)
    }
}
