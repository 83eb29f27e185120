//! From nodes to particles: velocity, displacement, deformation.

use mms_math::dispatch::Work;
use mms_math::machine::{Fused, Machine, Plain};

use super::misread;
use super::scene::{BLOCK, Scene};
use crate::defect::{Defect, on};
use crate::nodal::{Nodal, columns, four, matrix, vector};
use crate::particle::Columns;
use crate::shape::Shape;
use crate::stencil::Stencil as _;
use crate::tensor::jacobian;
use crate::{Cause, Matrix, Real, Transfer, Vector};

/// What of the particles' state follows the nodes, and how far.
#[derive(Clone, Copy)]
pub(super) struct Steps<T> {
    pub velocity: Option<T>,
    pub position: Option<T>,
    pub deformation: Option<T>,
}

/// The updates of some particles.
pub(super) struct Advance<'a, 'p, T: Real, const D: usize, S: Shape> {
    pub scene: Scene<'a, T, D, S>,
    pub particles: Columns<'p, T, D>,
    pub steps: Steps<T>,
    /// v_i.
    pub velocity: &'a [Nodal<T>],
    /// a_i.
    pub acceleration: &'a [Nodal<T>],
}

/// Whether all numbers are finite and J > 0, or might not be.
pub(super) type Sound = bool;

impl<T: Real, const D: usize, S: Shape> Work for Advance<'_, '_, T, D, S> {
    type Output = Result<Sound, (usize, Cause)>;

    #[inline(always)]
    fn fused(self, machine: Fused) -> Self::Output {
        self.update(T::FusedMachine::from(machine))
    }

    #[inline(always)]
    fn plain(self, machine: Plain) -> Self::Output {
        self.update(T::PlainMachine::from(machine))
    }
}

/// What the nodes say at a particle, as far as it is wanted.
struct Collected<F, const D: usize> {
    velocity: F,
    /// The columns of sum v_i (x) grad w.
    gradient: [F; D],
    acceleration: F,
}

impl<T: Real, const D: usize, S: Shape> Advance<'_, '_, T, D, S> {
    #[inline(always)]
    fn update<M: Machine<T>>(mut self, machine: M) -> Result<Sound, (usize, Cause)> {
        let mut sound = true;
        let mut room = Scene::<T, D, S>::room();
        for first in (0..self.particles.len()).step_by(BLOCK) {
            let block = first..self.particles.len().min(first + BLOCK);
            let Columns { start, displacement: d, displacement_gradient: h, .. } = &self.particles;
            let (d, h) = (&d[block.clone()], &h[block.clone()]);
            let numbers = start + block.start..start + block.end;
            let stencils = self.scene.weigh(machine, numbers, d, h, &mut room)?;
            // Zero times all new numbers: zero, if these are finite.
            let mut rest = machine.splat(T::zero());
            for (k, stencil) in block.zip(stencils) {
                sound &= self.update_particle(machine, k, stencil, &mut rest);
            }
            sound &= machine.all_at_most(rest, rest);
        }
        Ok(sound)
    }

    /// Whether J > 0.
    #[inline(always)]
    fn update_particle<M: Machine<T>>(
        &mut self,
        machine: M,
        k: usize,
        stencil: &S::Stencil<T, D>,
        rest: &mut M::Four,
    ) -> Sound {
        let Collected { velocity: mapped, gradient, acceleration } = self.collect(machine, stencil);
        let Self { scene, particles, steps, velocity: nodal, .. } = self;
        let zero = machine.splat(T::zero());
        let mut sound = true;
        if let Some(kick) = steps.velocity {
            let v = &mut particles.velocity[k];
            let before = four(machine, v, T::zero());
            let kicked = machine.times_plus(machine.splat(kick), acceleration, before);
            let next = match scene.transfer {
                Transfer::Flip { fraction: 1.0 } => kicked,
                Transfer::Flip { fraction } => {
                    let others = machine.times(machine.splat(T::of(1.0 - fraction)), mapped);
                    machine.times_plus(machine.splat(T::of(fraction)), kicked, others)
                }
                Transfer::Pic | Transfer::Apic => mapped,
                Transfer::Xpic { .. } if on(Defect::XpicSign) => {
                    machine.plus(kicked, four(machine, &particles.residual[k], T::zero()))
                }
                Transfer::Xpic { .. } => {
                    machine.minus(kicked, four(machine, &particles.residual[k], T::zero()))
                }
            };
            *v = vector(machine, next);
            *rest = machine.times_plus(next, zero, *rest);
            if scene.transfer == Transfer::Apic {
                // For hat functions the nearest linear velocity is the one between the nodes.
                let affine = match S::DEGREE {
                    1 => gradient,
                    _ => stencil.collect_slopes(machine, scene.lattice, nodal),
                };
                particles.affine[k] = misread::affine(matrix(machine, affine), S::DEGREE);
            }
        }
        if let Some(time_step) = steps.position {
            let d = &mut particles.displacement[k];
            let before = four(machine, d, T::zero());
            let mapped = misread::carrier(machine, mapped, particles.velocity, k);
            let next = machine.times_plus(machine.splat(time_step), mapped, before);
            *d = vector(machine, next);
            *rest = machine.times_plus(next, zero, *rest);
        }
        if let Some(time_step) = steps.deformation {
            let h = &mut particles.displacement_gradient[k];
            let gradient = misread::velocity_gradient(machine, gradient);
            let moves = scene.moves && !on(Defect::ReferenceGradient);
            let next = deformed(machine, h, gradient, time_step, moves);
            for a in 0..D {
                *rest = machine.times_plus(next[a], zero, *rest);
            }
            *h = matrix(machine, next);
            sound = jacobian(h) > T::zero();
        }
        sound
    }

    /// Collects what the steps need, and nothing else.
    #[inline(always)]
    fn collect<M: Machine<T>>(
        &self,
        machine: M,
        stencil: &S::Stencil<T, D>,
    ) -> Collected<M::Four, D> {
        let Self { scene, steps, velocity, acceleration, .. } = self;
        let nothing = machine.splat(T::zero());
        let mut collected =
            Collected { velocity: nothing, gradient: [nothing; D], acceleration: nothing };
        let moved = steps.velocity.is_some();
        let averaged = matches!(scene.transfer, Transfer::Pic | Transfer::Apic);
        let with_affine = moved && scene.transfer == Transfer::Apic && S::DEGREE == 1;
        let with_gradient = steps.deformation.is_some() || with_affine;
        let with_acceleration = moved && !averaged;
        if with_gradient && with_acceleration {
            let (values, gradient) = stencil.collect_both(machine, [acceleration, velocity]);
            ([collected.acceleration, collected.velocity], collected.gradient) = (values, gradient);
            return collected;
        }
        if with_gradient {
            (collected.velocity, collected.gradient) = stencil.collect(machine, velocity);
        } else if moved || steps.position.is_some() {
            collected.velocity = stencil.collect_value(machine, velocity);
        }
        if with_acceleration {
            collected.acceleration = stencil.collect_value(machine, acceleration);
        }
        collected
    }
}

/// The columns of H + dt G F, or of H + dt G if nothing `moves`, G being the gradient whose columns are given.
#[inline(always)]
fn deformed<T: Real, M: Machine<T>, const D: usize>(
    machine: M,
    h: &Matrix<T, D>,
    mut gradient: [M::Four; D],
    time_step: T,
    moves: bool,
) -> [M::Four; D] {
    for a in 0..D {
        gradient[a] = machine.times(gradient[a], machine.splat(time_step));
    }
    let mut next = columns(machine, h);
    for j in 0..D {
        next[j] = machine.plus(next[j], gradient[j]);
        if moves {
            for a in 0..D {
                next[j] = machine.times_plus(machine.splat(h[(a, j)]), gradient[a], next[j]);
            }
        }
    }
    next
}

/// What a residual is left of.
#[derive(Clone, Copy)]
pub(super) enum Source {
    /// v.
    Velocity,
    /// The residual before.
    Residual,
}

/// What the grid does not represent of the velocities of some particles.
pub(super) struct Residual<'a, 'p, T: Real, const D: usize, S: Shape> {
    pub scene: Scene<'a, T, D, S>,
    pub particles: Columns<'p, T, D>,
    pub nodal: &'a [Nodal<T>],
    pub source: Source,
}

impl<T: Real, const D: usize, S: Shape> Work for Residual<'_, '_, T, D, S> {
    type Output = Result<Sound, (usize, Cause)>;

    #[inline(always)]
    fn fused(self, machine: Fused) -> Self::Output {
        self.update(T::FusedMachine::from(machine))
    }

    #[inline(always)]
    fn plain(self, machine: Plain) -> Self::Output {
        self.update(T::PlainMachine::from(machine))
    }
}

impl<T: Real, const D: usize, S: Shape> Residual<'_, '_, T, D, S> {
    #[inline(always)]
    fn update<M: Machine<T>>(self, machine: M) -> Result<Sound, (usize, Cause)> {
        let Self { scene, particles, nodal, source, .. } = self;
        let mut room = Scene::<T, D, S>::room();
        for first in (0..particles.len()).step_by(BLOCK) {
            let block = first..particles.len().min(first + BLOCK);
            let d = &particles.displacement[block.clone()];
            let h = &particles.displacement_gradient[block.clone()];
            let numbers = particles.start + block.start..particles.start + block.end;
            let stencils = scene.weigh(machine, numbers, d, h, &mut room)?;
            for (k, stencil) in block.zip(stencils) {
                let from: Vector<T, D> = match source {
                    Source::Velocity => particles.velocity[k],
                    Source::Residual => particles.residual[k],
                };
                let represented = stencil.collect_value(machine, nodal);
                particles.residual[k] = from - vector::<T, M, D>(machine, represented);
            }
        }
        Ok(true)
    }
}
