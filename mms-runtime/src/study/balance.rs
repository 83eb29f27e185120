//! What the body force and the faces do to a body: the balance of momentum and that of energy.

use crate::formulation::Formulation;
use crate::shape::Shape;
use crate::{ManufacturedField, Real, Solver, Vector};

/// What drove the body, in double precision.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Balance {
    /// The time that energies and work are of: the last that has a velocity at it, or on both sides of it.
    pub time: f64,
    /// sum m v.v/2 then, of velocities half a step apart the mean.
    pub kinetic_energy: f64,
    /// sum V0 W then, if the material offers W.
    pub strain_energy: Option<f64>,
    /// The work of b until then.
    pub body_work: f64,
    /// Kinetic and strain energy then, less what they were at the start, less the work of b: what the faces
    /// did, and what the method gained or lost. Faces that rest, are free or joined by a period do nothing.
    pub energy_residual: Option<f64>,
    /// The force of the faces on the body in the last step, reactions and tractions together: the rate of
    /// momentum less sum m b. `D` components.
    pub surface_force: Vec<f64>,
}

/// Keeps account of a run, step by step.
pub(super) struct Account<T, const D: usize> {
    /// v by the particles' numbers, the time where it lives, and sum m v.v/2.
    velocity: Vec<Vector<T, D>>,
    time_of_velocity: f64,
    kinetic_energy: f64,
    /// The work of b until then.
    work: f64,
    /// Kinetic and strain energy at the start.
    start: Option<f64>,
    /// W of each particle.
    energy: Vec<T>,
    balance: Balance,
}

impl<T: Real, const D: usize> Account<T, D> {
    /// Of the state that a run starts from.
    pub fn new<F, S, L>(solver: &Solver<'_, T, D, F, S, L>) -> Self
    where
        F: ManufacturedField<T, D> + ?Sized,
        S: Shape,
        L: Formulation,
    {
        let count = solver.particles().len();
        let mut account = Self {
            velocity: vec![Vector::zeros(); count],
            time_of_velocity: solver.time_of_velocity(),
            kinetic_energy: 0.0,
            work: 0.0,
            start: None,
            energy: vec![T::zero(); count],
            balance: Balance::default(),
        };
        account.remember(solver);
        let strain = account.strain_energy(solver);
        account.start = strain.map(|strain| strain + account.kinetic_energy);
        account.balance.strain_energy = strain;
        account
    }

    /// After each step.
    pub fn step<F, S, L>(&mut self, solver: &Solver<'_, T, D, F, S, L>)
    where
        F: ManufacturedField<T, D> + ?Sized,
        S: Shape,
        L: Formulation,
    {
        let particles = solver.particles();
        let elapsed = solver.time_of_velocity() - self.time_of_velocity;
        let (mut work, mut force) = (0.0, Vector::<f64, D>::zeros());
        for (p, &id) in particles.id.iter().enumerate() {
            let before = self.velocity[id as usize].map(Real::to_f64);
            let after = particles.velocity[p].map(Real::to_f64);
            let (m, b) = (particles.mass[p].to_f64(), particles.body_force[p].map(Real::to_f64));
            // With the mean velocity, the work of all forces is the change of the kinetic energy.
            work += m * b.dot(&(before + after)) / 2.0 * elapsed;
            force += ((after - before) / elapsed - b) * m;
        }
        let before = self.kinetic_energy;
        self.remember(solver);
        let balance = &mut self.balance;
        balance.surface_force = force.as_slice().to_vec();
        let is_behind = solver.present() > self.time_of_velocity;
        // The positions of the step's start lie between the velocities before and after it.
        (balance.kinetic_energy, balance.body_work) = match is_behind {
            true => ((before + self.kinetic_energy) / 2.0, self.work + work / 2.0),
            false => (self.kinetic_energy, self.work + work),
        };
        self.work += work;
        balance.time = solver.present() - if is_behind { solver.time_step_length() } else { 0.0 };
    }

    /// Before the last step, if velocities are behind, and after it: the strain energy.
    pub fn look<F, S, L>(&mut self, solver: &Solver<'_, T, D, F, S, L>)
    where
        F: ManufacturedField<T, D> + ?Sized,
        S: Shape,
        L: Formulation,
    {
        self.balance.strain_energy = self.strain_energy(solver);
    }

    /// At the end.
    pub fn close(mut self) -> Balance {
        let known = self.balance.strain_energy.zip(self.start);
        self.balance.energy_residual = known.map(|(strain, start)| {
            strain + self.balance.kinetic_energy - start - self.balance.body_work
        });
        self.balance
    }

    fn remember<F, S, L>(&mut self, solver: &Solver<'_, T, D, F, S, L>)
    where
        F: ManufacturedField<T, D> + ?Sized,
        S: Shape,
        L: Formulation,
    {
        let particles = solver.particles();
        self.time_of_velocity = solver.time_of_velocity();
        self.kinetic_energy = 0.0;
        for (p, &id) in particles.id.iter().enumerate() {
            let v = particles.velocity[p];
            self.velocity[id as usize] = v;
            self.kinetic_energy +=
                particles.mass[p].to_f64() * v.map(Real::to_f64).norm_squared() / 2.0;
        }
    }

    fn strain_energy<F, S, L>(&mut self, solver: &Solver<'_, T, D, F, S, L>) -> Option<f64>
    where
        F: ManufacturedField<T, D> + ?Sized,
        S: Shape,
        L: Formulation,
    {
        let particles = solver.particles();
        let (x, h) = (&particles.reference_position, &particles.displacement_gradient);
        let offered = solver.field().strain_energy(x, h, &mut self.energy);
        let shares = self.energy.iter().zip(&particles.reference_volume);
        offered.then(|| shares.map(|(w, volume)| w.to_f64() * volume.to_f64()).sum())
    }
}
