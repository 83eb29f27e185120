//! The explicit updated-Lagrangian MPM/GIMP solver.
//!
//! The solver owns particles and grid; [`transfer`] computes the sums between them over plain slices,
//! the [`Integrator`] says in which order. A step allocates nothing.

mod setup;

use std::marker::PhantomData;

use crate::boundary::{Boundary, box_corners};
use crate::failure::positive;
use crate::integrator::Integrator;
use crate::particle::Particles;
use crate::shape::{Shape, Stencil};
use crate::study::Errors;
use crate::tensor::{components, deformation_gradient, is_finite, jacobian, matrix_is_finite};
use crate::{Cause, Failure, Grid, ManufacturedField, Real, Refusal, Vector, transfer};
use setup::{Clock, extent_of_motion, initialise, largest_wave_speed};

/// How finely a body and its time window are divided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    /// Cells along the longest edge of the body.
    pub cells: usize,
    /// Particles per cell along each axis.
    pub particles_per_cell: usize,
    /// time_step * c0 / cell_size, c0 being the fastest wave speed at F = I.
    pub courant: f64,
}

/// A body of particles, its grid, and the field that drives it.
pub struct Solver<'f, T: Real, const D: usize, F: ?Sized, S> {
    field: &'f F,
    clock: Clock,
    particles: Particles<T, D>,
    grid: Grid<T, D>,
    boundary: Boundary<T, D>,
    stencils: Vec<Stencil<T, D>>,
    exact: Vec<Vector<T, D>>,
    shape: PhantomData<S>,
}

impl<'f, T: Real, const D: usize, F, S> Solver<'f, T, D, F, S>
where
    F: ManufacturedField<T, D> + ?Sized,
    S: Shape,
{
    /// The field's body at the start of its time window: displacement, velocity and H are the field's.
    pub fn new(field: &'f F, resolution: &Resolution) -> Result<Self, Refusal> {
        let domain = field.domain();
        let [lower, upper] = box_corners(&domain.body)?;
        positive("the number of cells", resolution.cells as f64)?;
        positive("the number of particles per cell", resolution.particles_per_cell as f64)?;
        positive("the Courant number", resolution.courant)?;
        let edge = (0..D).map(|a| upper[a] - lower[a]).fold(0.0, f64::max);
        let cell_size = edge / resolution.cells as f64;

        let mut particles =
            Particles::fill_box(&lower, &upper, cell_size, resolution.particles_per_cell)?;
        let speed = largest_wave_speed(field, &particles)?;
        let window = domain.time.map(|time| time.to_f64());
        let clock = Clock::new(window, resolution.courant, cell_size, speed)?;
        let [lowest, highest] = extent_of_motion(field, &mut particles, &clock)?;
        let mut grid = Grid::new(&lower, cell_size, &lowest, &highest)?;
        let boundary = Boundary::new(&domain, &grid)?;
        initialise(field, &mut particles, T::of(clock.start))?;
        // Weights that are smaller than round-off squared carry nothing.
        let smallest = particles.mass.iter().fold(particles.mass[0], |a, &b| a.min(b));
        grid.mass_floor = smallest * T::default_epsilon() * T::default_epsilon();
        let count = particles.len();
        Ok(Self {
            field,
            clock,
            particles,
            grid,
            boundary,
            stencils: Vec::with_capacity(count),
            exact: vec![Vector::zeros(); count],
            shape: PhantomData,
        })
    }

    /// Advances by one time step and checks the new state.
    pub fn step<I: Integrator>(&mut self) -> Result<(), Failure> {
        I::step(self)?;
        self.clock.step += 1;
        self.check()
    }

    /// Advances through the time window; the largest errors over all its steps, initial state included.
    ///
    /// Calls `progress(step, steps)` after each step.
    pub fn run<I: Integrator>(
        &mut self,
        progress: &mut dyn FnMut(usize, usize),
    ) -> Result<Errors, Failure> {
        self.check()?;
        let mut errors = self.errors()?;
        while self.step_number() < self.steps() {
            self.step::<I>()?;
            errors = errors.larger(&self.errors()?);
            progress(self.step_number(), self.steps());
        }
        Ok(errors)
    }

    /// Checks the state: J > 0, and displacement, velocity, H and stress finite.
    pub fn check(&self) -> Result<(), Failure> {
        let particles = &self.particles;
        // An inverted particle first: what is not finite is often its consequence.
        for (p, h) in particles.displacement_gradient.iter().enumerate() {
            let jacobian = jacobian(h);
            if jacobian <= T::zero() {
                let jacobian = jacobian.to_f64();
                return Err(self.failure(p, Cause::Inverted { jacobian }));
            }
        }
        for p in 0..particles.len() {
            let suspect = [
                ("displacement", is_finite(&particles.displacement[p])),
                ("velocity", is_finite(&particles.velocity[p])),
                ("displacement gradient", matrix_is_finite(&particles.displacement_gradient[p])),
                ("Kirchhoff stress", matrix_is_finite(&particles.kirchhoff_stress[p])),
            ];
            if let Some((quantity, _)) = suspect.into_iter().find(|(_, finite)| !finite) {
                return Err(self.failure(p, Cause::NotFinite { quantity }));
            }
        }
        Ok(())
    }

    /// A failure of one particle, now.
    pub(crate) fn failure(&self, particle: usize, cause: Cause) -> Failure {
        Failure {
            step: self.clock.step,
            time: self.clock.time_of(self.clock.step),
            particle: Some(particle),
            reference_position: components(&self.particles.reference_position[particle]),
            cause,
        }
    }

    /// The errors of the displacement, now.
    pub fn errors(&mut self) -> Result<Errors, Failure> {
        let time = self.time();
        self.field.displacement(time, &self.particles.reference_position, &mut self.exact);
        Errors::of(&self.particles.displacement, &self.exact)
            .map_err(|p| self.failure(p, Cause::NotFinite { quantity: "displacement's error" }))
    }

    /// The particles.
    pub fn particles(&self) -> &Particles<T, D> {
        &self.particles
    }

    /// The grid, as the last step left it.
    pub fn grid(&self) -> &Grid<T, D> {
        &self.grid
    }

    /// The present time t^n.
    pub fn time(&self) -> T {
        T::of(self.clock.time_of(self.clock.step))
    }

    /// dt.
    pub fn time_step(&self) -> T {
        T::of(self.clock.time_step)
    }

    /// How many steps have been made.
    pub fn step_number(&self) -> usize {
        self.clock.step
    }

    /// How many steps the time window takes.
    pub fn steps(&self) -> usize {
        self.clock.steps
    }
}

/// The operations that integrators are made of; w = w_ip, grad w = grad w_ip at the positions x^n.
impl<T: Real, const D: usize, F, S> Solver<'_, T, D, F, S>
where
    F: ManufacturedField<T, D> + ?Sized,
    S: Shape,
{
    /// Weights at the present positions and half widths, and m_i = sum_p w m_p.
    pub fn map_mass(&mut self) -> Result<(), Failure> {
        self.stencils.clear();
        for p in 0..self.particles.len() {
            let stencil = self.stencil(p)?;
            self.stencils.push(stencil);
        }
        self.grid.mass.fill(T::zero());
        transfer::mass(&self.stencils, &self.particles.mass, &mut self.grid.mass);
        self.boundary.fold_mass(&mut self.grid.mass);
        let (time, step) = (self.time(), self.clock.step);
        self.boundary
            .locate(self.field, time, &self.grid)
            .map_err(|failure| Failure { step, ..failure })
    }

    fn stencil(&self, p: usize) -> Result<Stencil<T, D>, Failure> {
        let particles = &self.particles;
        let half_width =
            S::half_width(&particles.half_width[p], &particles.displacement_gradient[p]);
        let cell_size = self.grid.cell_size;
        let fits = |&l: &T| l > T::zero() && l < cell_size;
        if let Some(misfit) = half_width.iter().copied().find(|l| !fits(l)) {
            let (half_width, cell_size) = (misfit.to_f64(), cell_size.to_f64());
            return Err(self.failure(p, Cause::HalfWidth { half_width, cell_size }));
        }
        let position = particles.position(p);
        self.grid
            .stencil::<S>(&position, &half_width)
            .ok_or_else(|| self.failure(p, Cause::Lost { position: components(&position) }))
    }

    /// v_i = sum_p w m_p v_p / m_i, with the boundary's velocity at `time`.
    pub fn map_velocity(&mut self, time: T) {
        let Self { grid, particles, .. } = self;
        grid.momentum.fill(Vector::zeros());
        transfer::weighted_by_mass(
            &self.stencils,
            &particles.mass,
            &particles.velocity,
            &mut grid.momentum,
        );
        self.boundary.fold(&mut grid.momentum);
        grid.velocity_from_momentum();
        self.boundary.velocity(self.field, time, &mut grid.velocity);
    }

    /// a_i = (- sum_p V0 tau grad w + sum_p w m_p b(X_p, time)) / m_i, with the boundary's acceleration.
    pub fn map_acceleration(&mut self, time: T) {
        let Self { grid, particles, stencils, .. } = self;
        self.field.body_force(time, &particles.reference_position, &mut particles.body_force);
        grid.force.fill(Vector::zeros());
        transfer::internal_force(
            stencils,
            &particles.reference_volume,
            &particles.kirchhoff_stress,
            &mut grid.force,
        );
        transfer::weighted_by_mass(
            stencils,
            &particles.mass,
            &particles.body_force,
            &mut grid.force,
        );
        self.boundary.fold(&mut grid.force);
        grid.acceleration_from_force();
        self.boundary.acceleration(self.field, time, &mut grid.acceleration);
    }

    /// v_i += `time_step` a_i, with the boundary's velocity at `time`.
    pub fn kick(&mut self, time_step: T, time: T) {
        self.grid.kick(time_step);
        self.boundary.velocity(self.field, time, &mut self.grid.velocity);
    }

    /// v += `kick` sum_i w a_i, d += `time_step` sum_i w v_i.
    pub fn move_particles(&mut self, kick: T, time_step: T) {
        let Self { grid, particles, stencils, .. } = self;
        for (p, stencil) in stencils.iter().enumerate() {
            let acceleration = transfer::interpolate(stencil, &grid.acceleration);
            let velocity = transfer::interpolate(stencil, &grid.velocity);
            particles.velocity[p] += acceleration * kick;
            particles.displacement[p] += velocity * time_step;
        }
    }

    /// H += `time_step` L F, L = sum_i v_i (x) grad w.
    pub fn deform(&mut self, time_step: T) {
        let Self { grid, particles, stencils, .. } = self;
        for (h, stencil) in particles.displacement_gradient.iter_mut().zip(stencils.iter()) {
            let velocity_gradient = transfer::gradient(stencil, &grid.velocity);
            let f = deformation_gradient(h);
            *h += velocity_gradient * f * time_step;
        }
    }

    /// tau = tau(H).
    pub fn update_stress(&mut self) {
        let particles = &mut self.particles;
        self.field.kirchhoff_stress(
            &particles.reference_position,
            &particles.displacement_gradient,
            &mut particles.kirchhoff_stress,
        );
    }
}
