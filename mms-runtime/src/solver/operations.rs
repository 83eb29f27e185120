//! The operations that integrators are made of.

use super::{Solver, clock::timed};
use crate::boundary::traction::Place;
use crate::formulation::Formulation;
use crate::integrator::Operations;
use crate::shape::Shape;
use crate::stencil::Stencil as _;
use crate::tensor::deformation_gradient;
use crate::{Cause, Failure, ManufacturedField, Matrix, Real, Vector, mapping};

impl<T: Real, const D: usize, F, S, L> Operations<T> for Solver<'_, T, D, F, S, L>
where
    F: ManufacturedField<T, D> + ?Sized,
    S: Shape,
    L: Formulation,
{
    fn time(&self) -> T {
        T::of(self.clock.time_of(self.clock.step))
    }

    fn time_step(&self) -> T {
        T::of(self.clock.time_step)
    }

    fn step_number(&self) -> usize {
        self.clock.step
    }

    fn map_mass(&mut self) -> Result<(), Failure> {
        if L::MOVES || self.stencils.is_empty() {
            let mut seconds = self.seconds;
            timed(&mut seconds.transfer, || self.weigh())?;
            self.seconds = seconds;
        }
        let time = self.time();
        let Self { boundary, field, grid, seconds, .. } = self;
        timed(&mut seconds.grid, || boundary.locate(*field, time, grid))
    }

    fn map_velocity(&mut self, time: T) {
        let Self { grid, particles, stencils, exchange, boundary, seconds, .. } = self;
        timed(&mut seconds.transfer, || {
            grid.momentum.fill(Vector::zeros());
            let (mass, velocity) = (&particles.mass, &particles.velocity);
            mapping::weighted_by_mass(stencils, mass, velocity, &mut grid.momentum);
            exchange.map_momentum(stencils, particles, |p| Self::place(particles, p), grid);
        });
        timed(&mut seconds.grid, || {
            boundary.fold(&mut grid.momentum);
            grid.velocity_from_momentum();
            boundary.velocity(self.field, time, &mut grid.velocity);
        });
        timed(&mut seconds.transfer, || {
            exchange.find_residual(stencils, particles, boundary, grid);
        });
    }

    fn map_acceleration(&mut self, time: T) -> Result<(), Failure> {
        let Self { grid, particles, stencils, field, boundary, seconds, .. } = self;
        timed(&mut seconds.forcing, || {
            field.body_force(time, &particles.reference_position, &mut particles.body_force);
        });
        timed(&mut seconds.transfer, || {
            grid.force.fill(Vector::zeros());
            let (mass, volume) = (&particles.mass, &particles.reference_volume);
            mapping::internal_force(stencils, volume, &particles.stress, &mut grid.force);
            mapping::weighted_by_mass(stencils, mass, &particles.body_force, &mut grid.force);
        });
        let place = |p: usize, reference: &Vector<T, D>| {
            if !L::MOVES {
                return Place { position: *reference, carrier: None };
            }
            let h = particles.displacement_gradient[p];
            let apart = reference - particles.reference_position[p];
            let position = particles.position(p) + deformation_gradient(&h) * apart;
            Place { position, carrier: Some(h) }
        };
        timed(&mut seconds.forcing, || {
            boundary.traction::<F, S>(field, time, &grid.lattice, place, &mut grid.force)
        })?;
        timed(&mut seconds.grid, || {
            boundary.fold(&mut grid.force);
            grid.acceleration_from_force();
            boundary.acceleration(*field, time, &mut grid.acceleration);
        });
        Ok(())
    }

    fn kick(&mut self, time_step: T, time: T) {
        let Self { grid, field, boundary, seconds, .. } = self;
        timed(&mut seconds.grid, || {
            grid.kick(time_step);
            boundary.velocity(*field, time, &mut grid.velocity);
        });
    }

    fn move_particles(&mut self, kick: T, time_step: T) {
        let Self { grid, particles, stencils, exchange, seconds, .. } = self;
        timed(&mut seconds.transfer, || {
            for (displacement, stencil) in particles.displacement.iter_mut().zip(&*stencils) {
                *displacement += stencil.interpolate(&grid.velocity) * time_step;
            }
            exchange.update_velocity(stencils, particles, grid, kick);
        });
    }

    fn deform(&mut self, time_step: T) {
        let Self { grid, particles, stencils, seconds, .. } = self;
        timed(&mut seconds.transfer, || {
            for (h, stencil) in particles.displacement_gradient.iter_mut().zip(&*stencils) {
                let velocity_gradient = mapping::gradient(stencil, &grid.velocity);
                *h += L::rate(&velocity_gradient, h) * time_step;
            }
        });
    }

    fn update_stress(&mut self) -> Result<(), Failure> {
        let mut seconds = self.seconds;
        let singular = timed(&mut seconds.stress, || self.find_stress());
        self.seconds = seconds;
        singular.map_or(Ok(()), |p| Err(self.failure(p, Cause::Inverted { jacobian: 0.0 })))
    }
}

impl<T: Real, const D: usize, F, S, L> Solver<'_, T, D, F, S, L>
where
    F: ManufacturedField<T, D> + ?Sized,
    S: Shape,
    L: Formulation,
{
    /// The stress of every particle's H, or the first particle whose F is singular where that has none.
    pub(super) fn find_stress(&mut self) -> Option<usize> {
        let Self { particles, field, .. } = self;
        let gradients = &particles.displacement_gradient;
        field.kirchhoff_stress(&particles.reference_position, gradients, &mut particles.stress);
        particles.stress.iter_mut().zip(gradients).position(|(stress, h)| {
            let working = L::stress(stress, h);
            *stress = working.unwrap_or(*stress);
            working.is_none()
        })
    }

    /// The weights, and the mass of the nodes.
    fn weigh(&mut self) -> Result<(), Failure> {
        self.stencils.clear();
        for p in 0..self.particles.len() {
            let undeformed = Matrix::zeros();
            let gradient =
                if L::MOVES { &self.particles.displacement_gradient[p] } else { &undeformed };
            let position = Self::place(&self.particles, p);
            let stencil = S::stencil(&self.grid.lattice, &position, &self.domains[p], gradient)
                .map_err(|cause| self.failure(p, cause))?;
            self.stencils.push(stencil);
        }
        let Self { grid, particles, stencils, boundary, .. } = self;
        grid.mass.fill(T::zero());
        mapping::mass(stencils, &particles.mass, &mut grid.mass);
        boundary.fold_mass(&mut grid.mass);
        Ok(())
    }
}
