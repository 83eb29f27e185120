//! The explicit MPM/GIMP solver, for `const D` of 1 to 3 and for `f32` and `f64`.
//!
//! All state is in [`Solver`]: particles (structure of arrays), grid, boundary, clock. A step allocates nothing
//! but for tractions on a body of revolution, and is two passes over the particles, in an order that the [`Integrator`] says through
//! [`Operations`](crate::integrator::Operations): P2G (`p2g`: stress, weights, mass, momentum, force) and G2P
//! (`g2p`: weights, v, d, H).
//!
//! # What is a type and what is a value
//!
//! What decides the code of the inner loops is a type: dimension, precision, and the number of nodes along an
//! axis. What does not is a value: an integrator is the order in which a step calls `Operations`, compiled once
//! for each precision, and a transfer is looked at once per bunch. A shape function is asked for weights and for
//! nothing else (`weights`). [`crate::study::Solve`] goes from the names of a method to the types; its solvers are
//! compiled in this crate, once, and are `dyn AnySolver` to those who take the steps themselves.
//!
//! # What is stored
//!
//! Particles store the displacement, not the position, and H, not F, so that single precision loses nothing to x -
//! X and F - I. X is stored and never recovered. Stress is a function of H, computed for 256 particles at a time
//! where it is needed, and not stored. So is b, at X and t^n, for 2048 particles at a time: a batch begins with
//! what the time determines. One in eight of those is asked where its time goes, for the processor stops to look
//! at the clock. Times are computed from the step number, never accumulated. Initial u, v and H are the field's.
//! What particles read of the nodes decides what is computed for them (`transfer::Reads`): with PIC and APIC
//! nothing but v_i after its kick, and then momentum and dt times force are one sum; with FLIP also a_i, and then
//! v_i and a_i come of two sums in one pass over the nodes; with XPIC v_i before the kick too.
//!
//! # Memory and caches
//!
//! Both passes over the particles compute weights, for that is less work than reading them; where an integrator
//! needs them after the particles have changed (`KEEPS_WEIGHTS`), what they follow is kept. What a pass reads of a
//! large body has left the caches since the last pass, and is prefetched some bunches ahead; H, which stress needs
//! first, a part ahead. What a step changes of a bunch (d, v, H, and C with APIC) is kept number by number, those
//! of its particles beside each other, as registers take it (`column`); the material takes H, and gives stresses,
//! in the same way. X, m and V0 are slices, as fields take and give them.
//!
//! # Threads
//!
//! Particles stand in the order of the nodes that they reach, in slabs along the last axis (`slabs`). Sums have
//! one order whatever the number of threads is: results are the same bits. A particle may drift by a cell or more;
//! when one has nodes outside its slab's window, all are sorted, slabs are cut anew and the sums begin again.
//! Every 16 steps it is counted how many bunches and halves are of one cell, and how many could be: particles are
//! sorted if a twentieth is missing. That follows from the state alone, so that a run that is resumed does the
//! same. Small bodies, and stencils without a bound (`cpdi`), have one slab.
//!
//! # Failures
//!
//! A run never returns a number that is not one. J <= 0, a value that is not finite, a lost particle, a domain too
//! wide for its stencil or flat, a node without reference position: each stops the run with the step, the time,
//! the particle or node, the cause and advice.

mod any;
mod clock;
mod g2p;
mod misread;
mod need;
mod operations;
mod order;
mod p2g;
mod present;
mod relaxation;
mod setup;
mod slabs;
mod state;
mod weights;

use crate::axisymmetric::hoop_stretch;
use crate::boundary::Boundary;
use crate::failure::{Cause, Failure};
use crate::field::ManufacturedField;
use crate::formulation::Configuration;
use crate::grid::Grid;
use crate::integrator::Integrator;
use crate::nodal::Nodal;
use crate::particle::Particles;
use crate::real::Real;
use crate::tensor::{is_finite, matrix_is_finite};
use crate::transfer::Transfer;
use clock::Clock;
use order::When;
use slabs::Slabs;
use weights::{Domains, Kept, Kind};

pub use any::AnySolver;
pub(crate) use any::of_method;
pub use clock::Seconds;
pub use present::Present;
pub use relaxation::{Ramp, Residual};
pub use setup::{cell_size, filling};
pub use state::State;

/// After so many steps it is seen whether particles are to be put in order again, for bunches that share their nodes
/// are faster than others.
const STEPS_IN_ORDER: usize = 16;

/// A body of particles, its grid, and the field that drives it, with any shape function.
pub struct Solver<'f, T: Real, const D: usize, F: ?Sized> {
    field: &'f F,
    clock: Clock,
    particles: Particles<T, D>,
    kind: Kind<T, D>,
    domains: Box<dyn Domains<T, D>>,
    grid: Grid<T, D>,
    boundary: Boundary<T, D>,
    transfer: Transfer,
    slabs: Slabs,
    /// What weights follow, as it was at the beginning of the step, if the integrator asks for those once more when it
    /// has changed.
    kept: Vec<Kept<T, D>>,
    keeps_weights: bool,
    /// XPIC: what is left of the velocity, mapped to nodes, and over their mass.
    residual: [Vec<Nodal<T>>; 2],
    /// The time that the body force was last evaluated at.
    time_of_force: T,
    /// Whether a state may be bad.
    suspect: bool,
    seconds: Seconds,
    formulation: Configuration<T, D>,
}

impl<T: Real, const D: usize, F> Solver<'_, T, D, F>
where
    F: ManufacturedField<T, D> + ?Sized,
{
    /// Advances by one time step and checks the new state.
    ///
    /// # Errors
    /// What the step led to, or could not do.
    pub fn step<I: Integrator>(&mut self) -> Result<(), Failure> {
        let (step, time) = (self.clock.step + 1, self.clock.time_of(self.clock.step));
        self.keeps_weights = I::KEEPS_WEIGHTS && self.formulation.moves;
        if self.formulation.moves && self.clock.step % STEPS_IN_ORDER == STEPS_IN_ORDER - 1 {
            self.sort(When::Loose);
        }
        I::step::<T>(self).map_err(|failure| Failure { step, time, ..failure })?;
        self.clock.step += 1;
        self.clock.lag = I::LAG;
        if std::mem::take(&mut self.suspect) { self.check() } else { Ok(()) }
    }

    /// Checks the state: J > 0, and displacement, velocity and H finite.
    ///
    /// # Errors
    /// The first particle that is not so.
    pub fn check(&self) -> Result<(), Failure> {
        let particles = &self.particles;
        // An inverted particle first: what is not finite is often its consequence.
        for p in 0..particles.len() {
            let jacobian = particles.jacobian(p);
            if jacobian <= T::zero() {
                let jacobian = jacobian.to_f64();
                return Err(self.failure(p, Cause::Inverted { jacobian }));
            }
        }
        for p in 0..particles.len() {
            let suspect = [
                ("displacement", is_finite(&particles.displacement.get(p))),
                ("velocity", is_finite(&particles.velocity.get(p))),
                ("hoop strain", hoop_stretch(&particles.hoop_strain, p).is_finite()),
                (
                    "displacement gradient",
                    matrix_is_finite(&particles.displacement_gradient.get(p)),
                ),
            ];
            if let Some((quantity, _)) = suspect.into_iter().find(|(_, finite)| !finite) {
                return Err(self.failure(p, Cause::NotFinite { quantity }));
            }
        }
        Ok(())
    }

    /// A failure of one particle, now.
    pub(crate) fn failure(&self, particle: usize, cause: Cause) -> Failure {
        self.present().failure(particle, cause)
    }

    /// The state, as measurements see it.
    pub fn present(&self) -> Present<'_, T, D, F> {
        let Clock { step, time_step, lag, .. } = self.clock;
        let time = self.clock.time_of(step);
        Present {
            field: self.field,
            particles: &self.particles,
            step,
            time,
            time_of_velocity: time - lag * time_step,
            time_of_force: self.time_of_force,
            time_step,
            moves: self.formulation.moves,
        }
    }

    /// The particles.
    pub fn particles(&self) -> &Particles<T, D> {
        &self.particles
    }

    /// The grid, as the last step left it.
    pub fn grid(&self) -> &Grid<T, D> {
        &self.grid
    }

    /// dt.
    pub fn time_step_length(&self) -> f64 {
        self.clock.time_step
    }

    /// How many steps the time window takes.
    pub fn steps(&self) -> usize {
        self.clock.steps
    }

    /// What the parts of the steps so far have taken.
    pub fn seconds(&self) -> Seconds {
        self.seconds
    }
}
