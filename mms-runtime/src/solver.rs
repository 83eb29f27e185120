//! The explicit MPM/GIMP solver, for `const D` of 1 to 3 and for `f32` and `f64`.
//!
//! All state is in [`Solver`]: particles (structure of arrays), grid, boundary, clock. A step is two passes over the particles,
//! in an order that the [`Integrator`] determines through [`Operations`](crate::integrator::Operations): P2G (`p2g`: stress,
//! weights, mass, momentum, force) and G2P (`g2p`: weights, v, d, H). A step allocates only for tractions on a body of
//! revolution.
//!
//! # What is a type and what is a value
//!
//! Quantities that determine the code of the inner loops are types: dimension, precision, and the number of nodes along an
//! axis. All others are values: an integrator is the order in which a step calls `Operations`, compiled once for each
//! precision, and the transfer is tested once per pack. A shape function only computes weights (`weights`).
//! [`crate::study::Solve`] maps the names of a method to the types; its solvers are compiled in this crate, once, and callers
//! that take the steps themselves use them as `dyn AnySolver`.
//!
//! # What is stored
//!
//! Particles store the displacement, not the position, and H, not F, so that single precision loses nothing to x - X and F - I.
//! X is stored and never recomputed. Stress is a function of H, computed for 256 particles at a time where it is needed, and
//! not stored. The body force b, at X and t^n, is computed for 2048 particles at a time: a batch begins with the terms that
//! depend on time alone. Only one in eight of these batches is timed, since reading the clock stalls the processor. Times are
//! computed from the step number, never accumulated. Initial u, v and H are the field's. The solver computes at nodes what
//! particles read (`transfer::Reads`): with PIC and APIC only v_i after its kick, and then momentum and dt times force are one
//! sum; with FLIP also a_i, and then v_i and a_i are computed from two sums in one pass over the nodes; with XPIC v_i before
//! the kick too.
//!
//! # Memory and caches
//!
//! Both passes over the particles compute weights, for that is less work than reading them. If an integrator needs them after
//! the particles have changed (`KEEPS_WEIGHTS`), the solver keeps the data that they depend on. In a large body, a pass's data
//! have left the caches since the last pass, and are prefetched some packs ahead; H, which stress needs first, a part ahead.
//! Data of a pack that a step changes (d, v, H, and C with APIC) are stored component by component, the values of its
//! particles adjacent, as registers load them (`column`); the material reads H, and writes stresses, in the same layout. X, m
//! and V0 are slices, as in the methods of fields.
//!
//! # Threads
//!
//! Particles are sorted by the nodes that they reach, in slabs along the last axis (`slabs`). Sums have one order for any
//! number of threads: results are the same bits. A particle may drift by a cell or more; when one has nodes outside its slab's
//! window, all are sorted, slabs are cut anew and the sums begin again. Every 16 steps the solver compares the number of packs
//! and halves whose particles are all in one cell with the largest possible number, and sorts the particles if more than 5 %
//! are missing. This depends on the state alone, so that a resumed run sorts at the same steps. Small bodies, and stencils
//! without a bound (`cpdi`), have one slab.
//!
//! # Failures
//!
//! A run never returns NaN. J <= 0, a value that is not finite, a lost particle, a domain too wide for its stencil or flat, a
//! node without reference position: each stops the run with the step, the time, the particle or node, the cause and advice.

mod any;
mod clock;
mod faults;
mod g2p;
mod need;
mod operations;
mod p2g;
mod relaxation;
mod setup;
mod slabs;
mod sorting;
mod state;
mod state_view;
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
use slabs::Slabs;
use sorting::When;
use weights::{CachedDomains, Domains, ShapeProperties};

pub use any::AnySolver;
pub(crate) use any::of_method;
pub use clock::Seconds;
pub use relaxation::{Ramp, Residual};
pub use setup::{cell_size, filling};
pub use state::State;
pub use state_view::StateView;

/// The number of steps after which the solver tests whether to sort particles again, for packs that share their nodes are
/// faster than others.
const STEPS_IN_ORDER: usize = 16;

/// A body of particles, its grid, and the field that drives it, with any shape function.
pub struct Solver<'f, T: Real, const D: usize, F: ?Sized> {
    field: &'f F,
    clock: Clock,
    particles: Particles<T, D>,
    kind: ShapeProperties<T, D>,
    domains: Box<dyn Domains<T, D>>,
    grid: Grid<T, D>,
    boundary: Boundary<T, D>,
    transfer: Transfer,
    slabs: Slabs,
    /// The displacements and gradients at the beginning of the step, if the integrator needs the old weights after the
    /// displacements have changed.
    kept: Vec<CachedDomains<T, D>>,
    keeps_weights: bool,
    /// XPIC: the sum of the residual velocity at the nodes, and that sum divided by their mass.
    residual: [Vec<Nodal<T>>; 2],
    /// The time that the body force was last evaluated at.
    time_of_force: T,
    /// Whether the state may be invalid.
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
    /// The step failed, or led to an invalid state.
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
    /// The first invalid particle.
    pub fn check(&self) -> Result<(), Failure> {
        let particles = &self.particles;
        // Inverted particles first: they often cause values that are not finite.
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

    /// The state, for measurements.
    pub fn present(&self) -> StateView<'_, T, D, F> {
        let Clock { step, time_step, lag, .. } = self.clock;
        let time = self.clock.time_of(step);
        StateView {
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

    /// The grid after the last step.
    pub fn grid(&self) -> &Grid<T, D> {
        &self.grid
    }

    /// dt.
    pub fn time_step_length(&self) -> f64 {
        self.clock.time_step
    }

    /// The number of steps of the time window.
    pub fn steps(&self) -> usize {
        self.clock.steps
    }

    /// The times of the parts of all steps so far.
    pub fn seconds(&self) -> Seconds {
        self.seconds
    }
}
