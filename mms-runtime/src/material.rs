//! The constitutive response of a field's material.

use crate::{Matrix, Real, Vector};

/// The constitutive response that the forcing was derived with.
///
/// The stress comes from the same strain-energy density as the field's body force, so that solver
/// and forcing cannot disagree. Every method works on a batch of particles: all slices of one call
/// have equal length, entry `p` belongs to particle `p`, and every entry of the result is written.
pub trait Material<T: Real, const D: usize>: Send + Sync {
    /// Reference density rho0 at each reference position (mass per reference volume).
    fn density(&self, reference: &[Vector<T, D>], density: &mut [T]);

    /// Fastest wave speed at F = I at each reference position (length per time).
    fn wave_speed(&self, reference: &[Vector<T, D>], speed: &mut [T]);

    /// Kirchhoff stress tau = P F^T (force per reference area) of the displacement gradient
    /// H = F - I. It takes H, not F, so that nothing cancels at small strain.
    fn kirchhoff_stress(
        &self,
        reference: &[Vector<T, D>],
        displacement_gradient: &[Matrix<T, D>],
        stress: &mut [Matrix<T, D>],
    );

    /// Strain energy W (per reference volume) of the displacement gradient H, and whether the material offers
    /// it. Nothing but the balance of energy asks for it; without it `energy` stays as it is.
    fn strain_energy(
        &self,
        _reference: &[Vector<T, D>],
        _displacement_gradient: &[Matrix<T, D>],
        _energy: &mut [T],
    ) -> bool {
        false
    }
}
