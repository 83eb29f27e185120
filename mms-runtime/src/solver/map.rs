//! From particles to nodes: mass and momentum, and forces.

use std::ops::Range;

use mms_math::dispatch::{Work, best};
use mms_math::machine::{Fused, Machine, Plain};

use super::clock::{Seconds, timed};
use super::misread;
use super::scene::Scene;
use super::slabs::Slab;
use crate::defect::{Defect, on};
use crate::formulation::Configuration;
use crate::nodal::{Window, columns, four};
use crate::particle::{Particles, material_points};
use crate::shape::Shape;
use crate::stencil::{ALL, BUNCH, Members, Sloped, Stencil};
use crate::tensor::matrix_is_finite;
use crate::{Cause, Lattice, ManufacturedField, Matrix, Real, Vector};

/// Particles whose stresses are computed together: so many that it is nothing to ask what time it is, and so few that
/// their stresses stay near.
const PART: usize = 256;

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
        let mut room = S::Stencil::default();
        // Bunches are the same whatever the slabs are: the first and the last one may have others' particles.
        let Range { start, end } = slab.particles;
        let count = self.particles.len();
        for first in (start / BUNCH * BUNCH..end).step_by(PART) {
            let part = first..end.next_multiple_of(BUNCH).min(first + PART);
            if let Carried::Force | Carried::Everything = self.carried {
                let part = first..part.end.min(count);
                let stress = &mut stress[..part.len()];
                timed(&mut seconds.stress, || self.find_stress(part, stress))?;
            }
            let sums = Sums {
                scene: self.scene,
                particles: self.particles,
                carried: self.carried,
                bunches: first / BUNCH..part.end / BUNCH,
                stress: stress.as_chunks().0,
                nodes: [momentum.reborrow(), force.reborrow()],
                slab,
                room: &mut room,
            };
            timed(&mut seconds.transfer, || best(sums))?;
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
        Ok((self.formulation.stress)(gradients, stress).map_err(singular)?)
    }
}

/// The sums of some particles, whose stress is known.
struct Sums<'a, T: Real, const D: usize, S: Shape> {
    scene: Scene<'a, T, D, S>,
    particles: &'a Particles<T, D>,
    carried: Carried,
    bunches: Range<usize>,
    /// From the first one of these on.
    stress: &'a [[Matrix<T, D>; BUNCH]],
    /// Momentum and force.
    nodes: [Window<'a, T>; 2],
    slab: &'a Slab,
    room: &'a mut S::Stencil<T, D>,
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
        let Self { scene, particles, carried, bunches: range, stress, mut nodes, slab, room } =
            self;
        let Slab { particles: own, window } = slab;
        let stress = &stress[..range.len()];
        let bunches = Bunches::new(particles, range.clone(), stress);
        // For the stress of the next part.
        let next = &particles.displacement_gradient.bunches()[range.end..];
        let mut rest = machine.splat(T::zero());
        for k in 0..range.len() {
            let bunch = range.start + k;
            if let Some(next) = next.get(k) {
                for h in next {
                    machine.fetch(h);
                }
            }
            let moved = (&bunches.displacement[k], &bunches.displacement_gradient[k]);
            let stencil = scene.weigh(machine, bunch, moved, room)?;
            let first = BUNCH * bunch;
            let whole = own.start <= first && first + BUNCH <= own.end;
            let members = if whole {
                ALL
            } else {
                [own.start, own.end].map(|p| p.clamp(first, first + BUNCH) - first)
            };
            if let Some(p) = stencil.beyond(members, window) {
                return Err(Stop::Strayed(first + p));
            }
            let [momentum, force] = &mut nodes;
            let nodes = [momentum.reborrow(), force.reborrow()];
            let bunch = Bunch { bunches: &bunches, k, members, stencil };
            bunch.add(machine, carried, scene.lattice, nodes, &mut rest);
        }
        if machine.all_at_most(rest, rest) {
            return Ok(());
        }
        let odd = stress.as_flattened().iter().position(|stress| !matrix_is_finite(stress));
        let cause = Cause::NotFinite { quantity: "stress" };
        odd.map_or(Ok(()), |p| Err(Stop::Failed(BUNCH * range.start + p, cause)))
    }
}

/// The particles that are added, bunch by bunch.
struct Bunches<'a, T: Real, const D: usize> {
    displacement: &'a [[Vector<T, D>; BUNCH]],
    velocity: &'a [[Vector<T, D>; BUNCH]],
    displacement_gradient: &'a [[Matrix<T, D>; BUNCH]],
    body_force: &'a [[Vector<T, D>; BUNCH]],
    mass: &'a [[T; BUNCH]],
    reference_volume: &'a [[T; BUNCH]],
    stress: &'a [[Matrix<T, D>; BUNCH]],
    /// With APIC.
    affine: Option<&'a [[Matrix<T, D>; BUNCH]]>,
    /// With XPIC.
    residual: Option<&'a [[Vector<T, D>; BUNCH]]>,
}

impl<'a, T: Real, const D: usize> Bunches<'a, T, D> {
    #[inline(always)]
    fn new(
        all: &'a Particles<T, D>,
        range: Range<usize>,
        stress: &'a [[Matrix<T, D>; BUNCH]],
    ) -> Self {
        Self {
            displacement: &all.displacement.bunches()[range.clone()],
            velocity: &all.velocity.bunches()[range.clone()],
            displacement_gradient: &all.displacement_gradient.bunches()[range.clone()],
            body_force: &all.body_force.bunches()[range.clone()],
            mass: &all.mass.bunches()[range.clone()],
            reference_volume: &all.reference_volume.bunches()[range.clone()],
            stress,
            affine: all.affine.bunches().get(range.clone()),
            residual: all.residual.bunches().get(range),
        }
    }
}

/// Some particles beside each other.
struct Bunch<'a, T: Real, const D: usize, St> {
    bunches: &'a Bunches<'a, T, D>,
    k: usize,
    members: Members,
    stencil: &'a St,
}

impl<T: Real, const D: usize, St: Stencil<T, D>> Bunch<'_, T, D, St> {
    /// Adds what is `carried` to momentum and force of the nodes; and to `rest` zero times the stress.
    #[inline(always)]
    fn add<M: Machine<T>>(
        self,
        machine: M,
        carried: Carried,
        lattice: &Lattice<T, D>,
        [momentum, force]: [Window<'_, T>; 2],
        rest: &mut M::Four,
    ) {
        let Self { bunches, k, members, stencil } = self;
        match (carried, &bunches.affine, &bunches.residual) {
            (Carried::Force, ..) => {}
            (Carried::Residual, _, Some(residual)) => {
                let value = self.momentum(machine, &residual[k]);
                stencil.spread_value(machine, value, members, momentum);
            }
            (_, Some(affine), _) => {
                let linear = self.linear(machine, &affine[k]);
                stencil.spread_moments(machine, lattice, &linear, members, momentum);
            }
            _ => {
                let value = self.momentum(machine, &bunches.velocity[k]);
                stencil.spread_value(machine, value, members, momentum);
            }
        }
        if let Carried::Force | Carried::Everything = carried {
            stencil.spread(machine, &self.push(machine, rest), members, force);
        }
    }

    /// m v, and m.
    #[inline(always)]
    fn momentum<M: Machine<T>>(
        &self,
        machine: M,
        velocity: &[Vector<T, D>; BUNCH],
    ) -> [M::Four; BUNCH] {
        let mass = &self.bunches.mass[self.k];
        let mut momentum = [machine.splat(T::zero()); BUNCH];
        for p in 0..BUNCH {
            let velocity = four(machine, &velocity[p], T::one());
            momentum[p] = machine.times(velocity, machine.splat(mass[p]));
        }
        momentum
    }

    /// The momentum of a linear velocity.
    #[inline(always)]
    fn linear<M: Machine<T>>(
        &self,
        machine: M,
        affine: &[Matrix<T, D>; BUNCH],
    ) -> Sloped<M::Four, D> {
        let value = self.momentum(machine, &self.bunches.velocity[self.k]);
        let mass = &self.bunches.mass[self.k];
        let mut slopes = [[machine.splat(T::zero()); D]; BUNCH];
        for p in 0..BUNCH {
            slopes[p] = scaled(machine, &affine[p], machine.splat(mass[p]));
        }
        Sloped { value, slopes }
    }

    /// m b, and - V0 S; to `rest` is added zero times that: zero, if it is finite.
    #[inline(always)]
    fn push<M: Machine<T>>(&self, machine: M, rest: &mut M::Four) -> Sloped<M::Four, D> {
        let Bunches { body_force, mass, reference_volume, stress, .. } = self.bunches;
        let (body_force, mass) = (&body_force[self.k], &mass[self.k]);
        let (volume, stress) = (&reference_volume[self.k], &stress[self.k]);
        let zero = machine.splat(T::zero());
        let mut push = Sloped { value: [zero; BUNCH], slopes: [[zero; D]; BUNCH] };
        for p in 0..BUNCH {
            let body_force = four(machine, &body_force[p], T::zero());
            push.value[p] = machine.times(body_force, machine.splat(mass[p]));
            let slopes = scaled(machine, &stress[p], machine.splat(-volume[p]));
            for column in slopes {
                *rest = machine.times_plus(column, zero, *rest);
            }
            push.slopes[p] = misread::stress(slopes);
        }
        push
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
