//! From particles to nodes: mass and momentum, and forces.

use std::ops::Range;

use mms_math::dispatch::{Work, narrow};
use mms_math::machine::{Fused, Machine, Plain};

use super::clock::{Seconds, timed};
use super::misread;
use super::scene::{BLOCK, Room, Scene};
use super::slabs::Slab;
use crate::defect::{Defect, on};
use crate::formulation::Configuration;
use crate::nodal::{Window, columns, four};
use crate::particle::{Particles, material_points};
use crate::shape::Shape;
use crate::stencil::Stencil;
use crate::tensor::matrix_is_finite;
use crate::{Cause, Lattice, ManufacturedField, Matrix, Real, Vector};

/// Particles whose stresses are computed together; what is known of them stays in the first cache.
const PART: usize = 128;

/// What is added to the nodes.
#[derive(Clone, Copy)]
pub(super) enum Carried {
    /// m, and m v with the linear velocity on each particle.
    Momentum,
    /// m, and m r with the residual velocity r.
    Residual,
    /// - V0 S grad w + w m b.
    Force,
    /// Momentum and force.
    Everything,
}

/// Why sums are not complete.
pub(super) enum Stop {
    /// A particle has left the nodes of its slab.
    Strayed(usize),
    /// A particle has no weights or no stress.
    Failed(usize, Cause),
}

impl From<(usize, Cause)> for Stop {
    fn from((particle, cause): (usize, Cause)) -> Self {
        Stop::Failed(particle, cause)
    }
}

/// The sums of the particles of one slab.
pub(super) struct Map<'a, T: Real, const D: usize, F: ?Sized, S: Shape> {
    pub scene: Scene<'a, T, D, S>,
    pub particles: &'a Particles<T, D>,
    pub field: &'a F,
    pub carried: Carried,
    pub formulation: Configuration<T, D>,
}

impl<T: Real, const D: usize, F, S> Map<'_, T, D, F, S>
where
    F: ManufacturedField<T, D> + ?Sized,
    S: Shape,
{
    /// Adds to momentum and force of the nodes in the slab's window.
    pub fn slab(&self, slab: &Slab, nodes: [Window<'_, T>; 2]) -> Result<Seconds, Stop> {
        let [mut momentum, mut force] = nodes;
        let mut seconds = Seconds::default();
        let mut stress = [Matrix::zeros(); PART];
        let mut room = Scene::<T, D, S>::room();
        for first in slab.particles.clone().step_by(PART) {
            let part = first..slab.particles.end.min(first + PART);
            let stress = &mut stress[..part.len()];
            if let Carried::Force | Carried::Everything = self.carried {
                timed(&mut seconds.stress, || self.find_stress(part.clone(), stress))?;
            }
            let sums = Sums {
                scene: self.scene,
                particles: self.particles,
                carried: self.carried,
                part,
                stress,
                nodes: [momentum.reborrow(), force.reborrow()],
                window: slab.window.clone(),
                room: &mut room,
            };
            timed(&mut seconds.transfer, || narrow(sums))?;
        }
        Ok(seconds)
    }

    /// The stress that works on grad w, of every particle of a part.
    fn find_stress(&self, part: Range<usize>, stress: &mut [Matrix<T, D>]) -> Result<(), Stop> {
        let gradients = &self.particles.displacement_gradient[part.clone()];
        let reference = &self.particles.reference_position[part.clone()];
        let displacement = &self.particles.displacement[part.clone()];
        let points = material_points(reference, displacement, on(Defect::ModuliAtPresent));
        self.field.kirchhoff_stress(&points, gradients, stress);
        let singular = |k| (part.start + k, Cause::Inverted { jacobian: 0.0 });
        (self.formulation.stress)(gradients, stress).map_err(singular)?;
        for (p, stress) in part.clone().zip(&*stress) {
            // Almost always one test does for all components.
            if !stress.sum().is_finite() && !matrix_is_finite(stress) {
                return Err(Stop::Failed(p, Cause::NotFinite { quantity: "stress" }));
            }
        }
        Ok(())
    }
}

/// The sums of some particles, whose stress is known.
struct Sums<'a, T: Real, const D: usize, S: Shape> {
    scene: Scene<'a, T, D, S>,
    particles: &'a Particles<T, D>,
    carried: Carried,
    part: Range<usize>,
    stress: &'a [Matrix<T, D>],
    /// Momentum and force.
    nodes: [Window<'a, T>; 2],
    window: Range<usize>,
    room: &'a mut Room<T, D, S>,
}

impl<T: Real, const D: usize, S: Shape> Work for Sums<'_, T, D, S> {
    type Output = Result<(), Stop>;

    #[inline(always)]
    fn fused(self, machine: Fused) -> Self::Output {
        self.add(T::FusedMachine::from(machine))
    }

    #[inline(always)]
    fn plain(self, machine: Plain) -> Self::Output {
        self.add(T::PlainMachine::from(machine))
    }
}

impl<T: Real, const D: usize, S: Shape> Sums<'_, T, D, S> {
    #[inline(always)]
    fn add<M: Machine<T>>(self, machine: M) -> Result<(), Stop> {
        let Self { scene, particles, carried, part, stress, mut nodes, window, room } = self;
        let Particles { displacement, displacement_gradient, .. } = particles;
        let start = part.start;
        for first in part.clone().step_by(BLOCK) {
            let block = first..part.end.min(first + BLOCK);
            let (d, h) = (&displacement[block.clone()], &displacement_gradient[block.clone()]);
            let stencils = scene.weigh(machine, block.clone(), d, h, room)?;
            for (p, stencil) in block.zip(stencils) {
                // For the stress of the next part.
                machine.fetch(displacement_gradient.get(p + PART));
                let [from, to] = stencil.span();
                if from < window.start || to > window.end {
                    return Err(Stop::Strayed(p));
                }
                let [momentum, force] = &mut nodes;
                let nodes = [momentum.reborrow(), force.reborrow()];
                let one = One { particles, p, stress: &stress[p - start], stencil };
                one.add(machine, carried, scene.lattice, nodes);
            }
        }
        Ok(())
    }
}

/// One particle.
struct One<'a, T: Real, const D: usize, St> {
    particles: &'a Particles<T, D>,
    p: usize,
    stress: &'a Matrix<T, D>,
    stencil: &'a St,
}

impl<T: Real, const D: usize, St: Stencil<T, D>> One<'_, T, D, St> {
    /// Adds what is `carried` to momentum and force of the nodes.
    #[inline(always)]
    fn add<M: Machine<T>>(
        self,
        machine: M,
        carried: Carried,
        lattice: &Lattice<T, D>,
        [momentum, force]: [Window<'_, T>; 2],
    ) {
        let Self { particles, p, stencil, .. } = self;
        let affine = match carried {
            Carried::Residual => None,
            _ => particles.affine.get(p),
        };
        match (carried, affine) {
            (Carried::Force, _) => {
                let (push, slopes) = self.push(machine);
                stencil.spread(machine, push, slopes, force);
            }
            (Carried::Everything, None) => {
                let (push, slopes) = self.push(machine);
                let values = [self.momentum(machine, &particles.velocity[p]), push];
                stencil.spread_both(machine, values, slopes, [momentum, force]);
            }
            (Carried::Everything, Some(affine)) => {
                self.add_affine(machine, affine, lattice, momentum);
                let (push, slopes) = self.push(machine);
                stencil.spread(machine, push, slopes, force);
            }
            (Carried::Momentum, Some(affine)) => {
                self.add_affine(machine, affine, lattice, momentum);
            }
            (Carried::Momentum, None) => {
                let value = self.momentum(machine, &particles.velocity[p]);
                stencil.spread_value(machine, value, momentum);
            }
            (Carried::Residual, _) => {
                let value = self.momentum(machine, &particles.residual[p]);
                stencil.spread_value(machine, value, momentum);
            }
        }
    }

    /// m v, and m.
    #[inline(always)]
    fn momentum<M: Machine<T>>(&self, machine: M, velocity: &Vector<T, D>) -> M::Four {
        let mass = machine.splat(self.particles.mass[self.p]);
        machine.times(four(machine, velocity, T::one()), mass)
    }

    /// m b, and - V0 S.
    #[inline(always)]
    fn push<M: Machine<T>>(&self, machine: M) -> (M::Four, [M::Four; D]) {
        let Self { particles, p, stress, .. } = *self;
        let mass = machine.splat(particles.mass[p]);
        let body_force = four(machine, &particles.body_force[p], T::zero());
        let volume = machine.splat(-particles.reference_volume[p]);
        (machine.times(body_force, mass), misread::stress(scaled(machine, stress, volume)))
    }

    /// The momentum of a linear velocity.
    #[inline(always)]
    fn add_affine<M: Machine<T>>(
        &self,
        machine: M,
        affine: &Matrix<T, D>,
        lattice: &Lattice<T, D>,
        momentum: Window<'_, T>,
    ) {
        let value = self.momentum(machine, &self.particles.velocity[self.p]);
        let slopes = scaled(machine, affine, machine.splat(self.particles.mass[self.p]));
        self.stencil.spread_moments(machine, lattice, value, slopes, momentum);
    }
}

/// The columns of a matrix, times a number.
#[inline(always)]
fn scaled<T: Real, M: Machine<T>, const D: usize>(
    machine: M,
    matrix: &Matrix<T, D>,
    factor: M::Four,
) -> [M::Four; D] {
    let mut columns = columns(machine, matrix);
    for a in 0..D {
        columns[a] = machine.times(columns[a], factor);
    }
    columns
}
