//! From nodes to particles: velocity, displacement, deformation.

use mms_math::dispatch::Work;
use mms_math::machine::{Fused, Machine, Plain};

use super::scene::Scene;
use crate::nodal::Nodal;
use crate::particle::Columns;
use crate::shape::Shape;
use crate::stencil::Stencil as _;
use crate::tensor::{deformation_gradient, jacobian};
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
        self.update(T::Machine::from(machine))
    }

    #[inline(always)]
    fn plain(self, machine: Plain) -> Self::Output {
        self.update(machine)
    }
}

impl<T: Real, const D: usize, S: Shape> Advance<'_, '_, T, D, S> {
    #[inline(always)]
    fn update<M: Machine<T>>(self, machine: M) -> Result<Sound, (usize, Cause)> {
        let Self { scene, particles, steps, velocity: nodal, acceleration, .. } = self;
        let lattice = scene.lattice;
        let with_affine = scene.transfer == Transfer::Apic && steps.velocity.is_some();
        let with_gradient = steps.deformation.is_some() || with_affine && S::DEGREE == 1;
        let mut sound = true;
        let mut stencil = S::Stencil::default();
        for k in 0..particles.len() {
            let p = particles.start + k;
            let (d, h) = (&mut particles.displacement[k], &mut particles.displacement_gradient[k]);
            scene.place(&mut stencil, p, d, h)?;
            let (mut mapped, mut gradient) = (Vector::zeros(), Matrix::zeros());
            if with_gradient {
                let (value, slopes) = stencil.collect(machine, nodal);
                (mapped, gradient) = (vector(machine, value), matrix(machine, slopes));
            } else if steps.position.or(steps.velocity).is_some() {
                mapped = vector(machine, stencil.collect_value(machine, nodal));
            }
            if let Some(kick) = steps.velocity {
                let v = &mut particles.velocity[k];
                let mut kicked = *v;
                if !matches!(scene.transfer, Transfer::Pic | Transfer::Apic) {
                    kicked += vector(machine, stencil.collect_value(machine, acceleration)) * kick;
                }
                *v = match scene.transfer {
                    Transfer::Flip { fraction: 1.0 } => kicked,
                    Transfer::Flip { fraction } => {
                        kicked * T::of(fraction) + mapped * T::of(1.0 - fraction)
                    }
                    Transfer::Pic | Transfer::Apic => mapped,
                    Transfer::Xpic { .. } => kicked - particles.residual[k],
                };
                if with_affine {
                    // For hat functions the nearest linear velocity is the one between the nodes.
                    particles.affine[k] = if S::DEGREE == 1 {
                        gradient
                    } else {
                        matrix(machine, stencil.collect_slopes(machine, lattice, nodal))
                    };
                }
                sound &= v.sum().is_finite();
            }
            if let Some(time_step) = steps.position {
                *d += mapped * time_step;
                sound &= d.sum().is_finite();
            }
            if let Some(time_step) = steps.deformation {
                let rate = if scene.moves { gradient * deformation_gradient(h) } else { gradient };
                *h += rate * time_step;
                sound &= jacobian(h) > T::zero() && h.sum().is_finite();
            }
        }
        Ok(sound)
    }
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
        self.update(T::Machine::from(machine))
    }

    #[inline(always)]
    fn plain(self, machine: Plain) -> Self::Output {
        self.update(machine)
    }
}

impl<T: Real, const D: usize, S: Shape> Residual<'_, '_, T, D, S> {
    #[inline(always)]
    fn update<M: Machine<T>>(self, machine: M) -> Result<Sound, (usize, Cause)> {
        let Self { scene, particles, nodal, source, .. } = self;
        let mut stencil = S::Stencil::default();
        for k in 0..particles.len() {
            let p = particles.start + k;
            let (d, h) = (&particles.displacement[k], &particles.displacement_gradient[k]);
            scene.place(&mut stencil, p, d, h)?;
            let from = match source {
                Source::Velocity => particles.velocity[k],
                Source::Residual => particles.residual[k],
            };
            particles.residual[k] = from - vector(machine, stencil.collect_value(machine, nodal));
        }
        Ok(true)
    }
}

#[inline(always)]
fn vector<T: Real, M: Machine<T>, const D: usize>(machine: M, four: M::Four) -> Vector<T, D> {
    let numbers = machine.numbers(four);
    let mut vector = Vector::zeros();
    for a in 0..D {
        vector[a] = numbers[a];
    }
    vector
}

/// The matrix whose columns these are.
#[inline(always)]
fn matrix<T: Real, M: Machine<T>, const D: usize>(
    machine: M,
    columns: [M::Four; D],
) -> Matrix<T, D> {
    let mut matrix = Matrix::zeros();
    for j in 0..D {
        let numbers = machine.numbers(columns[j]);
        for i in 0..D {
            matrix[(i, j)] = numbers[i];
        }
    }
    matrix
}
