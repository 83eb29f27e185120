//! The operations that integrators consist of.

use std::time::Instant;

use super::Solver;
use super::clock::{Seconds, timed};
use super::g2p::{Advance, IsProvedSound, Residual, Source, Steps};
use super::p2g::{Addend, SlabError, SlabSums};
use super::relaxation::norm;
use super::sorting::When;
use super::weights::Scene;
use crate::axisymmetric::hoop_stretch;
use crate::boundary::traction::FacePoint;
use crate::column::PACK;
use crate::defect::{Defect, on};
use crate::failure::{Cause, Failure};
use crate::field::ManufacturedField;
use crate::grid::Grid;
use crate::grid::divide_by_mass;
use crate::integrator::{Operations, Sum, Update};
use crate::nodal::Nodal;
use crate::real::{Real, Vector};
use crate::tensor::deformation_gradient;
use crate::threads::{each_node, each_part};
use crate::transfer::Reads;
use crate::transfer::Transfer;

/// The number of packs that one thread updates at a time.
const PART: usize = 2048 / PACK;

impl<T: Real, const D: usize, F> Operations<T> for Solver<'_, T, D, F>
where
    F: ManufacturedField<T, D> + ?Sized,
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

    fn map(&mut self, sums: &[Sum<T>]) -> Result<(), Failure> {
        let (mut mass, mut velocity, mut acceleration, mut kick) = (false, None, None, None);
        for sum in sums {
            match *sum {
                Sum::Mass => mass = true,
                Sum::Velocity(time) => velocity = Some(time),
                Sum::Acceleration(time) => acceleration = Some(time),
                Sum::Kick(time_step, time) => {
                    let time = if on(Defect::LateWall) { time - time_step } else { time };
                    let stale = on(Defect::StaleNodalVelocity);
                    kick = Some((if stale { T::zero() } else { time_step }, time));
                }
            }
        }
        if mass {
            self.keep();
        }
        if let Some(time) = acceleration {
            let step = self.time_step();
            let time = if on(Defect::ForceLate) { time - step } else { time };
            let ahead = T::ratio(1, 2) * step;
            self.time_of_force = if on(Defect::ForceAhead) { time + ahead } else { time };
        }
        if let (Some(_), Some(force), Some(kick)) = (velocity, acceleration, kick)
            && self.transfer.reads() != Reads::VelocityBefore
        {
            return self.map_kicked(mass, force, kick);
        }
        if mass || velocity.is_some() {
            self.add_to_nodes(Addend::Momentum)?;
            self.complete_momentum(mass)?;
        }
        if let Some(time) = velocity {
            self.find_velocity(time)?;
        }
        if let Some(time) = acceleration {
            self.add_to_nodes(Addend::Force)?;
            self.find_acceleration(time)?;
        }
        if let Some((time_step, time)) = kick {
            self.kick(time_step, time);
        }
        Ok(())
    }

    fn advance(&mut self, updates: &[Update<T>]) -> Result<(), Failure> {
        let mut steps = Steps { velocity: None, position: None, deformation: None };
        for update in updates {
            match *update {
                Update::Velocity(kick) => steps.velocity = Some(kick),
                Update::Position(time_step) => steps.position = Some(time_step),
                Update::Deformation(time_step) => steps.deformation = Some(time_step),
            }
        }
        let Self { grid, particles, domains, kept, transfer, seconds, .. } = self;
        let Grid { lattice, velocity, acceleration, .. } = &*grid;
        let (reference_position, columns) = particles.columns();
        let (moves, transfer) = (self.formulation.moves, *transfer);
        let scene = Scene { lattice, moves, transfer, reference_position, kept };
        let domains = &**domains;
        let sound = timed(&mut seconds.transfer, || {
            each_part(
                columns,
                PART,
                &|particles| {
                    domains.advance(Advance { scene, particles, steps, velocity, acceleration })
                },
                &both_sound,
            )
        });
        self.suspect |= !sound.map_err(|(p, cause)| self.failure(p, cause))?;
        Ok(())
    }
}

/// The forces at nodes whose norm is computed.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Forces {
    /// All forces, on components without a constraint.
    Free,
    /// The forces of the stress alone.
    OfStress,
}

fn both_sound(
    first: Result<IsProvedSound, (usize, Cause)>,
    second: Result<IsProvedSound, (usize, Cause)>,
) -> Result<IsProvedSound, (usize, Cause)> {
    Ok(first? & second?)
}

impl<T: Real, const D: usize, F> Solver<'_, T, D, F>
where
    F: ManufacturedField<T, D> + ?Sized,
{
    /// Copies displacements and gradients, if the integrator needs the old weights after the displacements have changed.
    fn keep(&mut self) {
        let Self { particles, kept, seconds, .. } = self;
        kept.clear();
        if self.keeps_weights {
            timed(&mut seconds.transfer, || {
                let gradients = particles.displacement_gradient.packs().iter().copied();
                kept.extend(particles.displacement.packs().iter().copied().zip(gradients));
            });
        }
    }

    /// Overwrites the nodes with sums over the particles. Sorts the particles, and starts again, if one has left its slab.
    fn add_to_nodes(&mut self, added: Addend<T>) -> Result<(), Failure> {
        let mut sorted = false;
        loop {
            match self.try_to_add(added) {
                Ok(()) => return Ok(()),
                Err(SlabError::Failed(p, cause)) => return Err(self.failure(p, cause)),
                Err(SlabError::Strayed(p)) if sorted => {
                    return Err(self.failure(p, Cause::lost(&self.particles.position(p))));
                }
                Err(SlabError::Strayed(_)) => {
                    self.sort(When::Now);
                    // The particles have not changed since their data were kept.
                    self.keep();
                }
            }
            sorted = true;
        }
    }

    /// Sorts the particles by the cells that they are in now. Drops the kept displacements and gradients.
    pub(super) fn sort(&mut self, when: When) {
        let Self { grid, particles, kind, domains, kept, slabs, seconds, .. } = self;
        let moves = self.formulation.moves;
        timed(&mut seconds.transfer, || {
            slabs.sort(&grid.lattice, kind.origin, particles, &mut **domains, moves, when);
        });
        kept.clear();
    }

    fn try_to_add(&mut self, added: Addend<T>) -> Result<(), SlabError> {
        let Self { grid, particles, domains, kept, slabs, transfer, .. } = self;
        let (field, formulation, time) = (self.field, self.formulation, self.time_of_force);
        let Grid { lattice, momentum, force, .. } = grid;
        let nodes: [&mut [Nodal<T>]; 2] = match added {
            Addend::Momentum | Addend::Kicked(_) => [momentum, &mut []],
            Addend::Residual => [&mut self.residual[0], &mut []],
            Addend::Force | Addend::Stress => [&mut [], force],
            Addend::Both => [momentum, force],
        };
        let seconds = &mut self.seconds;
        let [first, second] = nodes;
        timed(&mut seconds.grid, || {
            for nodes in [&mut *first, &mut *second] {
                each_node(nodes, &|part| part.fill(Nodal::zero()));
            }
        });
        let reference_position = particles.reference_position.packs();
        let (moves, transfer) = (self.formulation.moves, *transfer);
        let scene = Scene { lattice, moves, transfer, reference_position, kept };
        let domains = &**domains;
        let map = SlabSums { scene, domains, particles, field, addend: added, formulation, time };
        let start = Instant::now();
        let taken =
            slabs.each([first, second], &|slab, nodes| map.slab(slab, nodes), &Seconds::sum)?;
        let elapsed = start.elapsed().as_secs_f64();
        self.seconds = self.seconds.sum(taken.within(elapsed));
        Ok(())
    }

    /// Computes v_i after the kick, for steps that do not read v_i before it. If the transfer reads a_i, sums momentum and
    /// force separately; otherwise sums them together.
    fn map_kicked(
        &mut self,
        mass: bool,
        force: T,
        (time_step, time): (T, T),
    ) -> Result<(), Failure> {
        if self.transfer.reads() == Reads::Nothing {
            self.add_to_nodes(Addend::Kicked(time_step))?;
            self.add_tractions(force, Some(time_step))?;
            self.complete_momentum(mass)?;
            return self.find_velocity(time);
        }
        self.add_to_nodes(Addend::Both)?;
        self.complete_momentum(mass)?;
        self.add_tractions(force, None)?;
        let Self { grid, field, boundary, seconds, .. } = self;
        timed(&mut seconds.grid, || {
            boundary.fold(&mut grid.force);
            grid.kicked_from_momentum_and_force(time_step);
            boundary.acceleration(*field, force, &mut grid.acceleration);
            boundary.velocity(*field, time, &mut grid.velocity);
        });
        Ok(())
    }

    /// Folds (mv)_i of images; and if masses are new, informs the boundary.
    fn complete_momentum(&mut self, mass: bool) -> Result<(), Failure> {
        let time = self.time();
        let Self { grid, boundary, field, seconds, .. } = self;
        timed(&mut seconds.grid, || {
            boundary.reach(&grid.momentum);
            boundary.fold(&mut grid.momentum);
            if mass { boundary.locate(*field, time, grid) } else { Ok(()) }
        })
    }

    /// Computes v_i, and the residual of XPIC.
    fn find_velocity(&mut self, time: T) -> Result<(), Failure> {
        let Self { grid, boundary, field, seconds, .. } = self;
        timed(&mut seconds.grid, || {
            grid.velocity_from_momentum();
            boundary.velocity(*field, time, &mut grid.velocity);
        });
        let Transfer::Xpic { order } = self.transfer else { return Ok(()) };
        self.find_residual(Source::Velocity)?;
        for _ in 1..order {
            self.map_residual()?;
            self.find_residual(Source::Residual)?;
        }
        Ok(())
    }

    /// r = v - S v_i, or r -= S S+ r, where S interpolates from nodes to particles and S+ maps particles to nodes.
    fn find_residual(&mut self, source: Source) -> Result<(), Failure> {
        let Self { grid, particles, domains, kept, transfer, residual, seconds, .. } = self;
        let (reference_position, columns) = particles.columns();
        let lattice = &grid.lattice;
        let (moves, transfer) = (self.formulation.moves, *transfer);
        let scene = Scene { lattice, moves, transfer, reference_position, kept };
        let nodal = match source {
            Source::Velocity => &grid.velocity,
            Source::Residual => &residual[1],
        };
        let domains = &**domains;
        let found = timed(&mut seconds.transfer, || {
            each_part(
                columns,
                PART,
                &|particles| domains.residual(Residual { scene, particles, nodal, source }),
                &both_sound,
            )
        });
        found.map_err(|(p, cause)| self.failure(p, cause))?;
        Ok(())
    }

    /// S+ r.
    fn map_residual(&mut self) -> Result<(), Failure> {
        self.add_to_nodes(Addend::Residual)?;
        let Self { grid, boundary, residual: [sum, image], seconds, .. } = self;
        timed(&mut seconds.grid, || {
            boundary.fold(sum);
            divide_by_mass(sum, &grid.momentum, grid.mass_floor, image);
            boundary.residual(image);
        });
        Ok(())
    }

    /// a_i, with the tractions at `time`.
    fn find_acceleration(&mut self, time: T) -> Result<(), Failure> {
        self.add_tractions(time, None)?;
        let Self { grid, field, boundary, seconds, .. } = self;
        timed(&mut seconds.grid, || {
            boundary.fold(&mut grid.force);
            grid.acceleration_from_force();
            boundary.acceleration(*field, time, &mut grid.acceleration);
        });
        Ok(())
    }

    /// Adds the tractions at `time` to the forces or, if `kick` is given, their impulse over the time step `kick` to the
    /// momentum.
    fn add_tractions(&mut self, time: T, kick: Option<T>) -> Result<(), Failure> {
        let Self { grid, particles, kind, slabs, field, boundary, seconds, .. } = self;
        let place = |id: usize, reference: &Vector<T, D>| {
            if !self.formulation.moves {
                return FacePoint { position: *reference, carrier: None };
            }
            let p = slabs.order.place_of(id);
            let h = particles.displacement_gradient.get(p);
            let apart = reference - particles.reference_position[p];
            let apart = if on(Defect::TractionAtParticle) { Vector::zeros() } else { apart };
            let position = particles.position(p) + deformation_gradient(&h) * apart;
            let hoop = hoop_stretch(&particles.hoop_strain, p);
            FacePoint { position, carrier: Some((h, hoop)) }
        };
        let (share, nodes) = match kick {
            Some(time_step) => (time_step, &mut grid.momentum),
            None => (T::one(), &mut grid.force),
        };
        timed(&mut seconds.forcing, || {
            let point = kind.points(&grid.lattice);
            boundary.traction(*field, time, point, place, share, nodes)
        })
    }

    /// v_i += dt a_i, with the boundary's velocity at `time`.
    fn kick(&mut self, time_step: T, time: T) {
        let Self { grid, field, boundary, seconds, .. } = self;
        timed(&mut seconds.grid, || {
            grid.kick(time_step);
            boundary.velocity(*field, time, &mut grid.velocity);
        });
    }

    /// The norm of forces at the nodes, with the particles in their present state.
    pub(super) fn forces(&mut self, asked: Forces) -> Result<f64, Failure> {
        if asked == Forces::OfStress {
            self.add_to_nodes(Addend::Stress)?;
            return Ok(norm::<T, D>(&self.grid.force));
        }
        let time = self.time();
        (self.keeps_weights, self.time_of_force) = (false, time);
        self.keep();
        self.add_to_nodes(Addend::Momentum)?;
        self.complete_momentum(true)?;
        self.add_to_nodes(Addend::Force)?;
        self.add_tractions(time, None)?;
        let Self { grid, boundary, .. } = self;
        boundary.fold(&mut grid.force);
        boundary.residual(&mut grid.force);
        Ok(norm::<T, D>(&grid.force))
    }
}
