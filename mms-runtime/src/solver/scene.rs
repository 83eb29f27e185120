//! What the sums between particles and nodes read.

use mms_math::machine::Machine;

use crate::column::{Bunch as _, Matrices, Vectors};
use crate::lanes::{components, turned, vectors};
use crate::shape::Shape;
use crate::stencil::BUNCH;
use crate::{Cause, Lattice, Real, Transfer, Vector};

/// The grid's geometry, and the particles' domains and weights.
pub(super) struct Scene<'a, T: Real, const D: usize, S: Shape> {
    pub lattice: &'a Lattice<T, D>,
    /// Whether weights follow the present positions ([`Formulation::MOVES`](crate::formulation::Formulation)).
    pub moves: bool,
    pub transfer: Transfer,
    pub reference_position: &'a [[Vector<T, D>; BUNCH]],
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
pub(super) type Moved<'a, T, const D: usize> = (&'a Vectors<T, D>, &'a Matrices<T, D>);

impl<T: Real, const D: usize, S: Shape> Scene<'_, T, D, S> {
    /// The weights of one bunch: those that are kept, or those of its state in a `room` for them.
    ///
    /// # Errors
    /// A particle has none.
    #[inline(always)]
    pub fn weigh<'b, M: Machine<T>>(
        &'b self,
        machine: M,
        bunch: usize,
        (displacement, displacement_gradient): Moved<'_, T, D>,
        room: &'b mut S::Stencil<T, D>,
    ) -> Result<&'b S::Stencil<T, D>, (usize, Cause)> {
        if let Some(kept) = self.weights.get(bunch) {
            return Ok(kept);
        }
        let mut position = turned(machine, &self.reference_position[bunch]);
        let unmoved;
        let h = if self.moves {
            let apart = components(machine, displacement);
            for a in 0..D {
                position[a] = machine.plus(position[a], apart[a]);
            }
            displacement_gradient
        } else {
            unmoved = Matrices::zeros();
            &unmoved
        };
        let domains = &self.domains[bunch];
        match S::place(machine, room, self.lattice, &position, domains, h) {
            Ok(()) => Ok(room),
            Err(cause) => {
                let (p, cause) = self.blamed(&vectors(machine, position), domains, h, cause);
                Err((BUNCH * bunch + p, cause))
            }
        }
    }

    /// Which of a bunch could not be placed alone, and why; the first one, if each could.
    #[cold]
    fn blamed(
        &self,
        positions: &[Vector<T, D>; BUNCH],
        domains: &S::Domain<T, D>,
        displacement_gradients: &Matrices<T, D>,
        cause: Cause,
    ) -> (usize, Cause) {
        for p in 0..BUNCH {
            let h = &displacement_gradients.get(p);
            if let Err(cause) = S::stencil(self.lattice, &positions[p], &domains.get(p), h) {
                return (p, cause);
            }
        }
        (0, cause)
    }
}
