//! The constitutive response of a field's material.

use crate::column::{Bunch as _, Matrices};
use crate::stencil::BUNCH;
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

    /// [`kirchhoff_stress`](Material::kirchhoff_stress) of whole bunches of particles, whose matrices are kept entry by
    /// entry: what a solver asks for in every step. A material that passes on another one's does so here too, for
    /// otherwise matrices are turned twice.
    fn kirchhoff_stress_of_bunches(
        &self,
        reference: &[[Vector<T, D>; BUNCH]],
        displacement_gradient: &[Matrices<T, D>],
        stress: &mut [Matrices<T, D>],
    ) {
        let parts = reference.chunks(TOGETHER).zip(displacement_gradient.chunks(TOGETHER));
        for ((reference, h), stress) in parts.zip(stress.chunks_mut(TOGETHER)) {
            let count = BUNCH * h.len();
            let [mut gradients, mut stresses] = [[Matrix::zeros(); TOGETHER * BUNCH]; 2];
            for (k, gradient) in gradients[..count].iter_mut().enumerate() {
                *gradient = h[k / BUNCH].get(k % BUNCH);
            }
            let found = &mut stresses[..count];
            self.kirchhoff_stress(reference.as_flattened(), &gradients[..count], found);
            for (k, found) in found.iter().enumerate() {
                stress[k / BUNCH].set(k % BUNCH, found);
            }
        }
    }

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

/// How many bunches are evaluated together.
const TOGETHER: usize = 32;

/// [`Material::kirchhoff_stress`] by [`Material::kirchhoff_stress_of_bunches`], for materials that have the latter.
///
/// # Panics
/// If the slices have different lengths.
pub fn by_bunches<T: Real, M: Material<T, D> + ?Sized, const D: usize>(
    material: &M,
    reference: &[Vector<T, D>],
    displacement_gradient: &[Matrix<T, D>],
    stress: &mut [Matrix<T, D>],
) {
    assert_eq!(reference.len(), stress.len(), "a reference position for each stress");
    assert_eq!(displacement_gradient.len(), stress.len(), "H for each stress");
    let parts = reference.chunks(TOGETHER * BUNCH);
    let parts = parts.zip(displacement_gradient.chunks(TOGETHER * BUNCH));
    for ((x, h), stress) in parts.zip(stress.chunks_mut(TOGETHER * BUNCH)) {
        let mut points = [[x[0]; BUNCH]; TOGETHER];
        points.as_flattened_mut()[..x.len()].copy_from_slice(x);
        let mut gradients = [Matrices::zeros(); TOGETHER];
        for (k, h) in h.iter().enumerate() {
            gradients[k / BUNCH].set(k % BUNCH, h);
        }
        let mut stresses = [Matrices::zeros(); TOGETHER];
        let bunches = x.len().div_ceil(BUNCH);
        material.kirchhoff_stress_of_bunches(
            &points[..bunches],
            &gradients[..bunches],
            &mut stresses[..bunches],
        );
        for (k, stress) in stress.iter_mut().enumerate() {
            *stress = stresses[k / BUNCH].get(k % BUNCH);
        }
    }
}
