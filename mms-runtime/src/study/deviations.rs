//! The errors of a state: of displacement, velocity, F and P.

use serde::{Deserialize, Serialize};

use super::{Errors, Watch};
use crate::axisymmetric::{hoop_strain, kirchhoff_stress};
use crate::failure::{Cause, Failure};
use crate::field::ManufacturedField;
use crate::particle::Particles;
use crate::real::{Matrix, Real, Vector};
use crate::solver::StateView;
use crate::tensor::inverse_deformation_gradient;

/// The errors of a state against the field's. Errors that are not measured are 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Deviations {
    /// The error of u.
    pub displacement: Errors,
    /// The error of v, at the time of the velocities.
    pub velocity: Errors,
    /// The error of F, in the Frobenius norm.
    pub deformation_gradient: Errors,
    /// The error of P.
    pub first_piola_kirchhoff: Errors,
}

impl Deviations {
    /// The larger of each norm.
    pub fn larger(&self, other: &Self) -> Self {
        Self {
            displacement: self.displacement.larger(&other.displacement),
            velocity: self.velocity.larger(&other.velocity),
            deformation_gradient: self.deformation_gradient.larger(&other.deformation_gradient),
            first_piola_kirchhoff: self.first_piola_kirchhoff.larger(&other.first_piola_kirchhoff),
        }
    }
}

/// Measures states, in reused arrays.
pub(super) struct Watcher<T, const D: usize> {
    watch: Watch,
    vector: Vec<Vector<T, D>>,
    /// The gradients of the particles, and of the field.
    gradients: [Vec<Matrix<T, D>>; 2],
    stress: [Vec<Matrix<T, D>>; 2],
    /// The largest value so far of the size that rounding is relative to: of d, and of |x| |H| if weights depend on x.
    size: f64,
}

impl<T: Real, const D: usize> Watcher<T, D> {
    /// A watcher for `count` particles.
    pub fn new(watch: Watch, count: usize) -> Self {
        let tensors = if watch == Watch::Displacement { 0 } else { count };
        let matrices = || vec![Matrix::zeros(); tensors];
        Self {
            watch,
            vector: vec![Vector::zeros(); count],
            gradients: [matrices(), matrices()],
            stress: [matrices(), matrices()],
            size: 0.0,
        }
    }

    /// The error of d that is expected from rounding alone after this number of steps: each adds a rounding of one unit in the
    /// last place, of variance 1/12, to d, and all of them are a random walk (Higham, Accuracy and Stability of Numerical
    /// Algorithms, 2002, section 2.8). In the updated formulation weights have the same rounding of x, and the stress of a
    /// strain H acts at a place that is off by it.
    pub fn round_off(&self, steps: usize) -> f64 {
        T::default_epsilon().to_f64() * (steps as f64 / 12.0).sqrt() * self.size
    }

    /// The largest size so far that rounding is relative to.
    pub fn size(&self) -> f64 {
        self.size
    }

    /// Resumes from a saved size.
    pub fn resume(&mut self, size: f64) {
        self.size = size;
    }

    /// Updates the size that rounding is relative to.
    fn weigh(&mut self, particles: &Particles<T, D>, moves: bool) {
        let squares = particles.displacement.iter().enumerate().map(|(p, d)| {
            let own = d.map(Real::to_f64).norm_squared();
            if !moves {
                return own;
            }
            let strain = particles.displacement_gradient.get(p).map(Real::to_f64).norm_squared();
            own + particles.position(p).map(Real::to_f64).norm_squared() * strain
        });
        let mean = squares.sum::<f64>() / particles.len().max(1) as f64;
        self.size = self.size.max(mean.sqrt());
    }

    /// Measures the errors of the present state.
    ///
    /// # Errors
    /// An error is not finite.
    pub fn measure<F>(&mut self, present: &StateView<'_, T, D, F>) -> Result<Deviations, Failure>
    where
        F: ManufacturedField<T, D> + ?Sized,
    {
        let StateView { field, particles, .. } = *present;
        let reference = &particles.reference_position;
        let weights = field.axisymmetric().map(|_| &*particles.reference_volume);
        let now = T::of(present.time);
        let odd = |quantity| move |p| present.failure(p, Cause::NotFinite { quantity });
        field.displacement(now, reference, &mut self.vector);
        let displacement = Errors::of(particles.displacement.iter(), &self.vector, weights)
            .map_err(odd("displacement's error"))?;
        self.weigh(particles, present.moves);
        if self.watch == Watch::Displacement {
            return Ok(Deviations { displacement, ..Deviations::default() });
        }
        field.velocity(T::of(present.time_of_velocity), reference, &mut self.vector);
        let velocity = Errors::of(particles.velocity.iter(), &self.vector, weights)
            .map_err(odd("velocity's error"))?;

        let [computed, exact] = &mut self.gradients;
        computed.clear();
        computed.extend(particles.displacement_gradient.iter());
        field.displacement_gradient(now, reference, exact);
        let strains = [particles.hoop_strain.to_vec(), hoop_strain(field, now, reference)];
        let deformation_gradient =
            Errors::of_tensors((computed, &strains[0]), (exact, &strains[1]), weights)
                .map_err(odd("F's error"))?;
        let mut hoop_stresses = strains.clone();
        let stresses = self.stress.iter_mut().zip(&mut hoop_stresses);
        for ((stress, hoop_stress), (gradient, strain)) in
            stresses.zip(self.gradients.iter().zip(&strains))
        {
            kirchhoff_stress(field, now, reference, (gradient, strain), (stress, hoop_stress));
            hoop_stress.iter_mut().zip(strain).for_each(|(stress, &h)| *stress /= T::one() + h);
            for (stress, gradient) in stress.iter_mut().zip(gradient) {
                // J > 0 has been checked; where the exact F is singular, the error is not finite.
                let inverse = inverse_deformation_gradient(gradient)
                    .unwrap_or(Matrix::repeat(T::of(f64::INFINITY)));
                *stress *= inverse.transpose();
            }
        }
        let first_piola_kirchhoff = Errors::of_tensors(
            (&self.stress[0], &hoop_stresses[0]),
            (&self.stress[1], &hoop_stresses[1]),
            weights,
        )
        .map_err(odd("P's error"))?;
        Ok(Deviations { displacement, velocity, deformation_gradient, first_piola_kirchhoff })
    }
}
