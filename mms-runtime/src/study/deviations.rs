//! The errors of a state: of displacement, velocity, F and P.

use super::{Errors, Watch};
use crate::formulation::Formulation;
use crate::shape::Shape;
use crate::tensor::inverse_deformation_gradient;
use crate::{Cause, Failure, ManufacturedField, Matrix, Real, Solver, Vector};

/// The errors of a state against the field's. Those that are not measured are 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Deviations {
    /// Of u.
    pub displacement: Errors,
    /// Of v, at the time where it lives.
    pub velocity: Errors,
    /// Of F; the norm of a tensor is that of Frobenius.
    pub deformation_gradient: Errors,
    /// Of P.
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

/// Measures states, in arrays that it keeps.
pub(super) struct Watcher<T, const D: usize> {
    watch: Watch,
    vector: Vec<Vector<T, D>>,
    gradient: Vec<Matrix<T, D>>,
    stress: [Vec<Matrix<T, D>>; 2],
}

impl<T: Real, const D: usize> Watcher<T, D> {
    /// For the particles of a solver.
    pub fn new<F, S, L>(watch: Watch, solver: &Solver<'_, T, D, F, S, L>) -> Self
    where
        F: ManufacturedField<T, D> + ?Sized,
        S: Shape,
        L: Formulation,
    {
        let count = solver.particles().len();
        let tensors = if watch == Watch::Everything { count } else { 0 };
        let matrices = || vec![Matrix::zeros(); tensors];
        Self {
            watch,
            vector: vec![Vector::zeros(); count],
            gradient: matrices(),
            stress: [matrices(), matrices()],
        }
    }

    /// The errors, now.
    ///
    /// # Errors
    /// An error that is not finite.
    pub fn measure<F, S, L>(
        &mut self,
        solver: &Solver<'_, T, D, F, S, L>,
    ) -> Result<Deviations, Failure>
    where
        F: ManufacturedField<T, D> + ?Sized,
        S: Shape,
        L: Formulation,
    {
        let (field, particles) = (solver.field(), solver.particles());
        let reference = &particles.reference_position;
        let now = T::of(solver.present());
        let odd = |quantity| move |p| solver.failure(p, Cause::NotFinite { quantity });
        field.displacement(now, reference, &mut self.vector);
        let displacement = Errors::of(&particles.displacement, &self.vector)
            .map_err(odd("displacement's error"))?;
        if self.watch == Watch::Displacement {
            return Ok(Deviations { displacement, ..Deviations::default() });
        }
        field.velocity(T::of(solver.time_of_velocity()), reference, &mut self.vector);
        let velocity =
            Errors::of(&particles.velocity, &self.vector).map_err(odd("velocity's error"))?;

        field.displacement_gradient(now, reference, &mut self.gradient);
        let gradients = [&particles.displacement_gradient, &self.gradient];
        let deformation_gradient =
            Errors::of_tensors(gradients[0], gradients[1]).map_err(odd("F's error"))?;
        for (stress, gradient) in self.stress.iter_mut().zip(gradients) {
            field.kirchhoff_stress(reference, gradient, stress);
            for (stress, gradient) in stress.iter_mut().zip(gradient) {
                // J > 0 has been checked; where the exact F is singular, the error is not finite.
                let inverse = inverse_deformation_gradient(gradient)
                    .unwrap_or(Matrix::repeat(T::of(f64::INFINITY)));
                *stress *= inverse.transpose();
            }
        }
        let first_piola_kirchhoff =
            Errors::of_tensors(&self.stress[0], &self.stress[1]).map_err(odd("P's error"))?;
        Ok(Deviations { displacement, velocity, deformation_gradient, first_piola_kirchhoff })
    }
}
