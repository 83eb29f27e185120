//! From particles to nodes: mass and momentum, and forces.

use std::marker::PhantomData;
use std::ops::Range;

use mms_math::dispatch::{Work, narrow};
use mms_math::machine::{Fused, Machine, Plain};

use super::clock::{Seconds, timed};
use super::scene::Scene;
use super::slabs::Slab;
use crate::formulation::Formulation;
use crate::nodal::Nodal;
use crate::particle::Particles;
use crate::shape::Shape;
use crate::stencil::Stencil as _;
use crate::tensor::matrix_is_finite;
use crate::{Cause, ManufacturedField, Matrix, Real, Vector};

/// Particles whose stresses are computed together; they stay in the first cache.
const BLOCK: usize = 64;

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

/// The sums of the particles of one slab.
pub(super) struct Map<'a, T: Real, const D: usize, F: ?Sized, S: Shape, L> {
    pub scene: Scene<'a, T, D, S>,
    pub particles: &'a Particles<T, D>,
    pub field: &'a F,
    pub carried: Carried,
    pub formulation: PhantomData<L>,
}

impl<T: Real, const D: usize, F, S, L> Map<'_, T, D, F, S, L>
where
    F: ManufacturedField<T, D> + ?Sized,
    S: Shape,
    L: Formulation,
{
    /// Adds to momentum and force of the nodes in the slab's window. An error comes with its particle.
    pub fn slab(
        &self,
        slab: &Slab,
        nodes: [&mut [Nodal<T>]; 2],
    ) -> Result<Seconds, (usize, Cause)> {
        let [momentum, force] = nodes;
        let mut seconds = Seconds::default();
        let mut stress = [Matrix::zeros(); BLOCK];
        for first in slab.particles.clone().step_by(BLOCK) {
            let block = first..slab.particles.end.min(first + BLOCK);
            let stress = &mut stress[..block.len()];
            if let Carried::Force | Carried::Everything = self.carried {
                timed(&mut seconds.stress, || self.find_stress(block.clone(), stress))?;
            }
            let sums = Sums {
                scene: self.scene,
                particles: self.particles,
                carried: self.carried,
                block,
                stress,
                window: slab.window.start,
                momentum: &mut *momentum,
                force: &mut *force,
            };
            timed(&mut seconds.transfer, || narrow(sums))?;
        }
        Ok(seconds)
    }

    /// The stress that works on grad w, of every particle in a block.
    fn find_stress(
        &self,
        block: Range<usize>,
        stress: &mut [Matrix<T, D>],
    ) -> Result<(), (usize, Cause)> {
        let gradients = &self.particles.displacement_gradient[block.clone()];
        let reference = &self.particles.reference_position[block.clone()];
        self.field.kirchhoff_stress(reference, gradients, stress);
        for ((p, h), stress) in block.zip(gradients).zip(stress) {
            let singular = || (p, Cause::Inverted { jacobian: 0.0 });
            *stress = L::stress(stress, h).ok_or_else(singular)?;
            if !matrix_is_finite(stress) {
                return Err((p, Cause::NotFinite { quantity: "stress" }));
            }
        }
        Ok(())
    }
}

/// The sums of a block of particles, whose stress is known.
struct Sums<'a, T: Real, const D: usize, S: Shape> {
    scene: Scene<'a, T, D, S>,
    particles: &'a Particles<T, D>,
    carried: Carried,
    block: Range<usize>,
    stress: &'a [Matrix<T, D>],
    /// The node that the arrays begin with.
    window: usize,
    momentum: &'a mut [Nodal<T>],
    force: &'a mut [Nodal<T>],
}

impl<T: Real, const D: usize, S: Shape> Work for Sums<'_, T, D, S> {
    type Output = Result<(), (usize, Cause)>;

    #[inline(always)]
    fn fused(self, machine: Fused) -> Self::Output {
        self.add(T::Machine::from(machine))
    }

    #[inline(always)]
    fn plain(self, machine: Plain) -> Self::Output {
        self.add(machine)
    }
}

impl<T: Real, const D: usize, S: Shape> Sums<'_, T, D, S> {
    #[inline(always)]
    fn add<M: Machine<T>>(self, machine: M) -> Result<(), (usize, Cause)> {
        let Self { scene, particles, carried, .. } = self;
        let with_momentum = !matches!(carried, Carried::Force);
        let with_force = matches!(carried, Carried::Force | Carried::Everything);
        let four = |vector: Vector<T, D>, last: T| machine.four(&Nodal::new(&vector, last).0);
        let mut stencil = S::Stencil::default();
        for (p, stress) in self.block.zip(self.stress) {
            let (d, h) = (&particles.displacement[p], &particles.displacement_gradient[p]);
            scene.place(&mut stencil, p, d, h)?;
            stencil.shift(self.window);
            let mass = particles.mass[p];
            if with_momentum {
                let (velocity, affine) = match carried {
                    Carried::Residual => (particles.residual[p], None),
                    _ => (particles.velocity[p], particles.affine.get(p)),
                };
                let value = four(velocity * mass, mass);
                match affine {
                    None => stencil.spread_value(machine, value, self.momentum),
                    Some(c) => {
                        let slopes = columns(machine, &(c * mass));
                        let (lattice, nodes) = (scene.lattice, &mut *self.momentum);
                        stencil.spread_moments(machine, lattice, value, slopes, nodes);
                    }
                }
            }
            if with_force {
                let value = four(particles.body_force[p] * mass, T::zero());
                let slopes = columns(machine, &(stress * -particles.reference_volume[p]));
                stencil.spread(machine, value, slopes, self.force);
            }
        }
        Ok(())
    }
}

/// The columns of a matrix.
#[inline(always)]
fn columns<T: Real, M: Machine<T>, const D: usize>(
    machine: M,
    matrix: &Matrix<T, D>,
) -> [M::Four; D] {
    let mut columns = [machine.splat(T::zero()); D];
    for j in 0..D {
        let row = |i: usize| if i < D { matrix[(i, j)] } else { T::zero() };
        columns[j] = machine.four(&[row(0), row(1), row(2), T::zero()]);
    }
    columns
}
