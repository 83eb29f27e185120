//! The balances of momentum and energy: the effect of the body force and the faces on a body.

use serde::{Deserialize, Serialize};

use crate::axisymmetric::strain_energy;
use crate::field::ManufacturedField;
use crate::real::{Matrix, Real, Vector};
use crate::solver::StateView;

/// The balances of momentum and energy, in double precision.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Balance {
    /// The time of energies and work: the last time with a known velocity, or with known velocities half a step before and
    /// after.
    pub time: f64,
    /// sum m v.v/2 at `time`; of velocities half a step apart the mean.
    pub kinetic_energy: f64,
    /// sum V0 W at `time`, if the material supports W.
    pub strain_energy: Option<f64>,
    /// The work of b until `time`.
    pub body_work: f64,
    /// The work of given fields until `time`, which is the change of W with time at fixed F; `None` unless the material changes
    /// with time.
    pub given_work: Option<f64>,
    /// Kinetic and strain energy at `time`, minus their values at the start, minus the work of b and of given fields. It is the
    /// work of the faces plus the gain or loss of the method. Faces at rest, free faces and periodic faces do no work.
    pub energy_residual: Option<f64>,
    /// The force of the faces on the body in the last step, reactions and tractions together: the rate of momentum minus sum m
    /// b. `D` components.
    pub surface_force: Vec<f64>,
}

/// Computes the balances of a run, step by step.
pub(super) struct Account<T, const D: usize> {
    /// v by the particles' numbers, its time, and sum m v.v/2.
    velocity: Vec<Vector<T, D>>,
    time_of_velocity: f64,
    kinetic_energy: f64,
    /// b of each particle in the last step.
    body_force: Vec<Vector<T, D>>,
    /// H and W of each particle.
    displacement_gradient: Vec<Matrix<T, D>>,
    energy: Vec<T>,
    /// The particles after the last step, if the material changes with time.
    earlier: Option<Strained<T, D>>,
    tally: Tally,
}

/// The arguments of W at the particles, X and H, with their volumes and the time.
struct Strained<T, const D: usize> {
    time: f64,
    reference: Vec<Vector<T, D>>,
    gradient: Vec<Matrix<T, D>>,
    hoop_strain: Vec<T>,
    volume: Vec<T>,
}

impl<T: Real, const D: usize> Strained<T, D> {
    /// The particles of a state, if the material changes with time.
    fn of<F>(present: &StateView<'_, T, D, F>) -> Option<Self>
    where
        F: ManufacturedField<T, D> + ?Sized,
    {
        let particles = present.particles;
        present.field.changes_with_time().then(|| Strained {
            time: present.time,
            reference: particles.reference_position.to_vec(),
            gradient: particles.displacement_gradient.iter().collect(),
            hoop_strain: particles.hoop_strain.to_vec(),
            volume: particles.reference_volume.to_vec(),
        })
    }

    /// The change of sum V0 W between two times at these H.
    fn change<F>(&self, field: &F, times: [f64; 2], energy: &mut [T]) -> f64
    where
        F: ManufacturedField<T, D> + ?Sized,
    {
        let [before, after] = times.map(|time| {
            let strains = (&self.gradient[..], &self.hoop_strain[..]);
            strain_energy(field, T::of(time), &self.reference, strains, energy);
            let shares = energy.iter().zip(&self.volume);
            shares.map(|(w, volume)| w.to_f64() * volume.to_f64()).sum::<f64>()
        });
        after - before
    }
}

/// The sums that do not follow from the state.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Tally {
    /// The work of b until the time of the velocities.
    work: f64,
    /// The work of given fields until the last step.
    given: f64,
    /// Kinetic and strain energy at the start.
    start: Option<f64>,
    balance: Balance,
}

impl<T: Real, const D: usize> Account<T, D> {
    /// Begins at the first state of a run, or resumes with the sums of a checkpoint.
    pub fn new<F>(present: &StateView<'_, T, D, F>, before: Option<Tally>) -> Self
    where
        F: ManufacturedField<T, D> + ?Sized,
    {
        let count = present.particles.len();
        let mut account = Self {
            velocity: vec![Vector::zeros(); count],
            time_of_velocity: 0.0,
            kinetic_energy: 0.0,
            body_force: vec![Vector::zeros(); count],
            displacement_gradient: Vec::with_capacity(count),
            energy: vec![T::zero(); count],
            earlier: Strained::of(present),
            tally: Tally::default(),
        };
        account.remember(present);
        account.tally = before.unwrap_or_else(|| {
            let strain_energy = account.strain_energy(present);
            let start = strain_energy.map(|strain| strain + account.kinetic_energy);
            let given_work = account.earlier.is_some().then_some(0.0);
            let balance = Balance { strain_energy, given_work, ..Balance::default() };
            Tally { work: 0.0, given: 0.0, start, balance }
        });
        account
    }

    /// The sums that do not follow from the state.
    pub fn tally(&self) -> &Tally {
        &self.tally
    }

    /// Updates the sums. To be called after each step.
    pub fn step<F>(&mut self, present: &StateView<'_, T, D, F>)
    where
        F: ManufacturedField<T, D> + ?Sized,
    {
        let StateView { field, particles, time_of_force, .. } = *present;
        field.body_force(time_of_force, &particles.reference_position, &mut self.body_force);
        let elapsed = present.time_of_velocity - self.time_of_velocity;
        let (mut work, mut force) = (0.0, Vector::<f64, D>::zeros());
        for (p, &id) in particles.id.iter().enumerate() {
            let before = self.velocity[id as usize].map(Real::to_f64);
            let after = particles.velocity.get(p).map(Real::to_f64);
            let (m, b) = (particles.mass[p].to_f64(), self.body_force[p].map(Real::to_f64));
            // With the mean velocity, the work of all forces is the change of the kinetic energy.
            work += m * b.dot(&(before + after)) / 2.0 * elapsed;
            force += ((after - before) / elapsed - b) * m;
        }
        let before = self.kinetic_energy;
        self.remember(present);
        let given = self.work_of_given(present);
        let Tally { work: until_now, given: given_until_now, balance, .. } = &mut self.tally;
        balance.surface_force = force.as_slice().to_vec();
        let is_behind = present.time > self.time_of_velocity;
        // The positions at the step's start lie between the velocities before and after it.
        (balance.kinetic_energy, balance.body_work) = match is_behind {
            true => ((before + self.kinetic_energy) / 2.0, *until_now + work / 2.0),
            false => (self.kinetic_energy, *until_now + work),
        };
        *until_now += work;
        // The energies of a step whose velocities are behind belong to the step's start.
        let start = *given_until_now;
        *given_until_now += given.unwrap_or(0.0);
        balance.given_work = given.map(|_| if is_behind { start } else { *given_until_now });
        balance.time = present.time - if is_behind { present.time_step } else { 0.0 };
    }

    /// The change of W with time at fixed F in a step: the mean of the changes at the H of its ends.
    fn work_of_given<F>(&mut self, present: &StateView<'_, T, D, F>) -> Option<f64>
    where
        F: ManufacturedField<T, D> + ?Sized,
    {
        let (earlier, now) = (self.earlier.take()?, Strained::of(present)?);
        let times = [earlier.time, now.time];
        let mut change = |at: &Strained<T, D>| at.change(present.field, times, &mut self.energy);
        let work = (change(&earlier) + change(&now)) / 2.0;
        self.earlier = Some(now);
        Some(work)
    }

    /// Computes the strain energy. To be called before a step if velocities are behind, otherwise after it.
    pub fn look<F>(&mut self, present: &StateView<'_, T, D, F>)
    where
        F: ManufacturedField<T, D> + ?Sized,
    {
        self.tally.balance.strain_energy = self.strain_energy(present);
    }

    /// The balance, after a step whose strain energy was computed.
    pub fn balance(&self) -> Balance {
        let Tally { start, balance, .. } = &self.tally;
        let known = balance.strain_energy.zip(*start);
        let energy_residual = known
            .map(|(strain, start)| strain + balance.kinetic_energy - start - balance.body_work)
            .map(|residual| residual - balance.given_work.unwrap_or(0.0));
        Balance { energy_residual, ..balance.clone() }
    }

    fn remember<F: ?Sized>(&mut self, present: &StateView<'_, T, D, F>) {
        let particles = present.particles;
        self.time_of_velocity = present.time_of_velocity;
        self.kinetic_energy = 0.0;
        for (p, &id) in particles.id.iter().enumerate() {
            let v = particles.velocity.get(p);
            self.velocity[id as usize] = v;
            self.kinetic_energy +=
                particles.mass[p].to_f64() * v.map(Real::to_f64).norm_squared() / 2.0;
        }
    }

    fn strain_energy<F>(&mut self, present: &StateView<'_, T, D, F>) -> Option<f64>
    where
        F: ManufacturedField<T, D> + ?Sized,
    {
        let particles = present.particles;
        let (x, h) = (&particles.reference_position, &mut self.displacement_gradient);
        h.clear();
        h.extend(particles.displacement_gradient.iter());
        let strains = (&h[..], &*particles.hoop_strain);
        let offered =
            strain_energy(present.field, T::of(present.time), x, strains, &mut self.energy);
        let shares = self.energy.iter().zip(&particles.reference_volume);
        offered.then(|| shares.map(|(w, volume)| w.to_f64() * volume.to_f64()).sum())
    }
}
