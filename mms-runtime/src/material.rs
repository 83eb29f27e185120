//! The constitutive response of a field's material.

use crate::column::PACK;
use crate::column::{Matrices, Pack as _};
use crate::real::{Matrix, Real, Vector};

/// The constitutive response that the forcing was derived with.
///
/// The stress follows from the same strain-energy density as the field's body force, so that solver and forcing cannot
/// disagree. Every method works on a batch of particles: all slices of one call have equal length, entry `p` belongs to
/// particle `p`, and every entry of the result is written.
pub trait Material<T: Real, const D: usize>: Send + Sync {
    /// Reference density rho0 at each reference position (mass per reference volume).
    fn density(&self, reference: &[Vector<T, D>], density: &mut [T]);

    /// Fastest wave speed at F = I at each reference position (length per time).
    fn wave_speed(&self, reference: &[Vector<T, D>], speed: &mut [T]);

    /// Whether W at a fixed H changes with time, through given fields such as a temperature.
    fn changes_with_time(&self) -> bool {
        false
    }

    /// Whether W is a function of the small strain. Then all measures of stress are equal to P.
    fn is_small_strain(&self) -> bool {
        false
    }

    /// The material and the hoop strain of a field of a body of revolution, whose plane is the meridian; `None` for all other
    /// fields. It computes stress and energy at hoop strains other than the field's own.
    fn axisymmetric(&self) -> Option<&dyn Axisymmetric<T, D>> {
        None
    }

    /// Kirchhoff stress tau = P F^T (force per reference area) of the displacement gradient H = F - I, at a time. The argument
    /// is H, not F, so that nothing cancels at small strain. The stress is P F^T for a W of the small strain too: the updated
    /// formulation computes the divergence in the present configuration.
    fn kirchhoff_stress(
        &self,
        time: T,
        reference: &[Vector<T, D>],
        displacement_gradient: &[Matrix<T, D>],
        stress: &mut [Matrix<T, D>],
    );

    /// [`kirchhoff_stress`](Material::kirchhoff_stress) of whole packs of particles, whose matrices are stored entry by
    /// entry. Solvers call it in every step. A material that wraps another one should forward this method too, otherwise
    /// matrices are transposed twice.
    fn kirchhoff_stress_of_packs(
        &self,
        time: T,
        reference: &[[Vector<T, D>; PACK]],
        displacement_gradient: &[Matrices<T, D>],
        stress: &mut [Matrices<T, D>],
    ) {
        let parts = reference.chunks(TOGETHER).zip(displacement_gradient.chunks(TOGETHER));
        for ((reference, h), stress) in parts.zip(stress.chunks_mut(TOGETHER)) {
            let count = PACK * h.len();
            let [mut gradients, mut stresses] = [[Matrix::zeros(); TOGETHER * PACK]; 2];
            for (k, gradient) in gradients[..count].iter_mut().enumerate() {
                *gradient = h[k / PACK].get(k % PACK);
            }
            let found = &mut stresses[..count];
            self.kirchhoff_stress(time, reference.as_flattened(), &gradients[..count], found);
            for (k, found) in found.iter().enumerate() {
                stress[k / PACK].set(k % PACK, found);
            }
        }
    }

    /// Computes the strain energy W (per reference volume) of the displacement gradient H at a time, and returns whether the
    /// material supports it. If not, `energy` is unchanged. Only the balance of energy calls it.
    fn strain_energy(
        &self,
        _time: T,
        _reference: &[Vector<T, D>],
        _displacement_gradient: &[Matrix<T, D>],
        _energy: &mut [T],
    ) -> bool {
        false
    }
}

/// The hoop strain and the material of a body of revolution. Every method works on a batch, as in [`Material`].
pub trait Axisymmetric<T: Real, const D: usize>: Send + Sync {
    /// u_R/R; its limit on the axis.
    fn hoop_strain(&self, time: T, reference: &[Vector<T, D>], out: &mut [T]);

    /// The Kirchhoff stress of whole packs of particles, in the meridian and around the axis.
    fn kirchhoff_stress_of_packs(
        &self,
        time: T,
        reference: &[[Vector<T, D>; PACK]],
        strains: (&[Matrices<T, D>], &[[T; PACK]]),
        stresses: (&mut [Matrices<T, D>], &mut [[T; PACK]]),
    );

    /// The volume per radian of a ring divided by the area of its box in the meridian, whose middle has this radius: this
    /// radius (Pappus). A solver that weights rings otherwise has an error.
    fn weight(&self, middle: f64) -> f64 {
        middle
    }

    /// Computes the strain energy W per reference volume, and returns whether the material supports it.
    fn strain_energy(
        &self,
        time: T,
        reference: &[Vector<T, D>],
        strains: (&[Matrix<T, D>], &[T]),
        energy: &mut [T],
    ) -> bool;
}

/// The number of packs that are evaluated together.
const TOGETHER: usize = 32;

/// Computes [`Material::kirchhoff_stress`] by [`Material::kirchhoff_stress_of_packs`], for materials that implement the
/// latter.
///
/// # Panics
/// If the slices have different lengths.
pub fn by_packs<T: Real, M: Material<T, D> + ?Sized, const D: usize>(
    material: &M,
    time: T,
    reference: &[Vector<T, D>],
    displacement_gradient: &[Matrix<T, D>],
    stress: &mut [Matrix<T, D>],
) {
    assert_eq!(reference.len(), stress.len(), "a reference position for each stress");
    assert_eq!(displacement_gradient.len(), stress.len(), "H for each stress");
    let parts = reference.chunks(TOGETHER * PACK);
    let parts = parts.zip(displacement_gradient.chunks(TOGETHER * PACK));
    for ((x, h), stress) in parts.zip(stress.chunks_mut(TOGETHER * PACK)) {
        let mut points = [[x[0]; PACK]; TOGETHER];
        points.as_flattened_mut()[..x.len()].copy_from_slice(x);
        let mut gradients = [Matrices::zeros(); TOGETHER];
        for (k, h) in h.iter().enumerate() {
            gradients[k / PACK].set(k % PACK, h);
        }
        let mut stresses = [Matrices::zeros(); TOGETHER];
        let packs = x.len().div_ceil(PACK);
        material.kirchhoff_stress_of_packs(
            time,
            &points[..packs],
            &gradients[..packs],
            &mut stresses[..packs],
        );
        for (k, stress) in stress.iter_mut().enumerate() {
            *stress = stresses[k / PACK].get(k % PACK);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Material, by_packs};
    use crate::column::PACK;
    use crate::column::{Matrices, Pack as _, Packs};
    use crate::real::{Matrix, Vector};

    /// A stress that depends on H and on X.
    fn stress(x: &Vector<f64, 2>, h: &Matrix<f64, 2>) -> Matrix<f64, 2> {
        h * h * x[0] + h.transpose() * x[1]
    }

    /// A material that computes points one after the other only.
    struct ByPoints;

    impl Material<f64, 2> for ByPoints {
        fn density(&self, _: &[Vector<f64, 2>], _: &mut [f64]) {}
        fn wave_speed(&self, _: &[Vector<f64, 2>], _: &mut [f64]) {}
        fn kirchhoff_stress(
            &self,
            _: f64,
            reference: &[Vector<f64, 2>],
            displacement_gradient: &[Matrix<f64, 2>],
            out: &mut [Matrix<f64, 2>],
        ) {
            for (k, out) in out.iter_mut().enumerate() {
                *out = stress(&reference[k], &displacement_gradient[k]);
            }
        }
    }

    /// A material that computes packs only.
    struct OfPacks;

    impl Material<f64, 2> for OfPacks {
        fn density(&self, _: &[Vector<f64, 2>], _: &mut [f64]) {}
        fn wave_speed(&self, _: &[Vector<f64, 2>], _: &mut [f64]) {}
        fn kirchhoff_stress(
            &self,
            time: f64,
            reference: &[Vector<f64, 2>],
            displacement_gradient: &[Matrix<f64, 2>],
            out: &mut [Matrix<f64, 2>],
        ) {
            by_packs(self, time, reference, displacement_gradient, out);
        }
        fn kirchhoff_stress_of_packs(
            &self,
            _: f64,
            reference: &[[Vector<f64, 2>; PACK]],
            displacement_gradient: &[Matrices<f64, 2>],
            out: &mut [Matrices<f64, 2>],
        ) {
            for (b, out) in out.iter_mut().enumerate() {
                for k in 0..PACK {
                    out.set(k, &stress(&reference[b][k], &displacement_gradient[b].get(k)));
                }
            }
        }
    }

    #[test]
    fn stresses_are_the_same_by_points_and_of_packs() {
        for count in [1, 8, 250, 600] {
            let number = |k: usize| (0.3 + 0.7 * k as f64).sin();
            let x: Vec<_> = (0..count).map(|p| Vector::from_fn(|i, _| number(7 * p + i))).collect();
            let h: Vec<_> =
                (0..count).map(|p| Matrix::from_fn(|i, j| number(5 * p + 2 * i + j))).collect();
            let expected: Vec<_> = x.iter().zip(&h).map(|(x, h)| stress(x, h)).collect();
            let mut found = vec![Matrix::zeros(); count];
            OfPacks.kirchhoff_stress(0.0, &x, &h, &mut found);
            assert_eq!(found, expected);

            let whole = count / PACK;
            let gradients: Packs<Matrices<f64, 2>> = h.iter().copied().collect();
            let mut found = vec![Matrices::zeros(); whole];
            let gradients = &gradients.packs()[..whole];
            ByPoints.kirchhoff_stress_of_packs(
                0.0,
                &x.as_chunks().0[..whole],
                gradients,
                &mut found,
            );
            for (p, expected) in expected[..PACK * whole].iter().enumerate() {
                assert_eq!(found[p / PACK].get(p % PACK), *expected, "{p} of {count}");
            }
        }
    }
}
