//! What the sums between particles and nodes read.

use mms_math::machine::Machine;

use crate::column::{Bunch as _, Matrices, Vectors};
use crate::lanes::{positions, vectors};
use crate::shape::Shape;
use crate::stencil::BUNCH;
use crate::{Cause, Lattice, Real, Transfer, Vector};

/// The grid's geometry, and what the particles' weights follow.
pub(super) struct Scene<'a, T: Real, const D: usize, S: Shape> {
    pub lattice: &'a Lattice<T, D>,
    /// Whether weights follow the present positions ([`Formulation::MOVES`](crate::formulation::Formulation)).
    pub moves: bool,
    pub transfer: Transfer,
    pub reference_position: &'a [[Vector<T, D>; BUNCH]],
    pub domains: &'a [S::Domain<T, D>],
    /// What weights follow of every bunch, if that is not its present state.
    pub kept: &'a [Kept<T, D>],
}

impl<T: Real, const D: usize, S: Shape> Clone for Scene<'_, T, D, S> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T: Real, const D: usize, S: Shape> Copy for Scene<'_, T, D, S> {}

/// The displacements and the displacement gradients of a bunch.
pub(super) type Moved<'a, T, const D: usize> = (&'a Vectors<T, D>, &'a Matrices<T, D>);

/// Those of a bunch at another time.
pub(super) type Kept<T, const D: usize> = (Vectors<T, D>, Matrices<T, D>);

/// Room for the weights of a bunch and for those of the next one, which are found before those of the first are used: so
/// there is something to do while numbers are awaited. Weights of bunch k are in place k % 2.
pub(super) type Room<T, const D: usize, S> = [<S as Shape>::Stencil<T, D>; 2];

impl<T: Real, const D: usize, S: Shape> Scene<'_, T, D, S> {
    /// Has what weights are found of brought near, but for the state.
    #[inline(always)]
    pub fn fetch<M: Machine<T>>(&self, machine: M, bunch: usize) {
        machine.fetch(self.reference_position, bunch);
        machine.fetch(self.domains, bunch);
    }

    /// Finds the weights of a bunch, in this state if none was kept.
    ///
    /// # Errors
    /// A particle has none.
    #[inline(always)]
    pub fn weigh<M: Machine<T>>(
        &self,
        machine: M,
        bunch: usize,
        present: Moved<'_, T, D>,
        stencil: &mut S::Stencil<T, D>,
    ) -> Result<(), (usize, Cause)> {
        let (displacement, displacement_gradient) = match self.kept.get(bunch) {
            Some((displacement, gradient)) => (displacement, gradient),
            None => present,
        };
        let reference = &self.reference_position[bunch];
        let position = positions(machine, reference, displacement, self.moves);
        let unmoved;
        let h = if self.moves {
            displacement_gradient
        } else {
            unmoved = Matrices::zeros();
            &unmoved
        };
        let domains = &self.domains[bunch];
        match S::place(machine, stencil, self.lattice, &position, domains, h) {
            Ok(()) => Ok(()),
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
