//! What the sums between particles and nodes read.

use crate::shape::Shape;
use crate::{Cause, Lattice, Matrix, Real, Transfer, Vector};

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

impl<T: Real, const D: usize, S: Shape> Scene<'_, T, D, S> {
    /// The weights of a particle with displacement d and displacement gradient H.
    #[inline(always)]
    pub fn place(
        &self,
        stencil: &mut S::Stencil<T, D>,
        p: usize,
        displacement: &Vector<T, D>,
        displacement_gradient: &Matrix<T, D>,
    ) -> Result<(), (usize, Cause)> {
        if let Some(weights) = self.weights.get(p) {
            stencil.clone_from(weights);
            return Ok(());
        }
        let (reference, domain) = (&self.reference_position[p], &self.domains[p]);
        let placed = if self.moves {
            let position = reference + displacement;
            S::place(stencil, self.lattice, &position, domain, displacement_gradient)
        } else {
            S::place(stencil, self.lattice, reference, domain, &Matrix::zeros())
        };
        placed.map_err(|cause| (p, cause))
    }
}
