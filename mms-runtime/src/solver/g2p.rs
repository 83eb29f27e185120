//! From nodes to particles (G2P): velocity, displacement, deformation.

use mms_math::dispatch::{IsaLevel, Work, best};
use mms_math::simd::{Plain, Simd};

use super::faults;
use super::weights::{AHEAD, Scene, Stencils, TOGETHER, Weigh};
use crate::column::PACK;
use crate::defect::{Defect, on};
use crate::failure::Cause;
use crate::lanes::{columns, components, determinants, set_columns, set_components};
use crate::lattice::Lattice;
use crate::nodal::Nodal;
use crate::particle::Columns;
use crate::real::Real;
use crate::stencil::{ProductStencil, Stencil, Wanted};
use crate::threads::Parts as _;
use crate::transfer::Reads;
use crate::transfer::Transfer;

/// The parts of the particles' state that are updated from the nodes, each with its time step.
#[derive(Clone, Copy)]
pub(super) struct Steps<T> {
    pub velocity: Option<T>,
    pub position: Option<T>,
    pub deformation: Option<T>,
}

/// The update of some particles.
pub(super) struct Advance<'a, 'p, T: Real, const D: usize> {
    pub scene: Scene<'a, T, D>,
    pub particles: Columns<'p, T, D>,
    pub steps: Steps<T>,
    /// v_i.
    pub velocity: &'a [Nodal<T>],
    /// a_i.
    pub acceleration: &'a [Nodal<T>],
}

/// True only if all new numbers are finite and J > 0. May be false although they are.
pub(super) type IsProvedSound = bool;

impl<T: Real, const D: usize> Advance<'_, '_, T, D> {
    /// Updates the particles with these weights.
    pub fn with<St: Stencil<T, D>>(
        self,
        weights: &dyn Weigh<T, D, St>,
    ) -> Result<IsProvedSound, (usize, Cause)> {
        best(Weighted { pass: self, weights })
    }
}

/// A pass with the weights of one kind of stencils.
struct Weighted<'a, P, T: Real, const D: usize, St> {
    pass: P,
    weights: &'a dyn Weigh<T, D, St>,
}

impl<T, const D: usize, St> Work<T> for Weighted<'_, Advance<'_, '_, T, D>, T, D, St>
where
    T: Real,
    St: Stencil<T, D>,
{
    type Output = Result<IsProvedSound, (usize, Cause)>;
    const WIDEST: IsaLevel = St::WIDEST;

    #[inline(always)]
    fn on<M: Simd<T>>(self, simd: M) -> Self::Output {
        let Advance { scene, mut particles, steps, velocity, acceleration } = self.pass;
        let nodes = Nodes { scene, steps, velocity, acceleration };
        let mut room = Stencils::<St>::default();
        // Zero times all new numbers: zero, if all are finite.
        let mut rest = simd.splat(T::zero());
        let mut sound = true;
        let count = particles.len();
        for first in (0..count).step_by(TOGETHER) {
            let many = TOGETHER.min(count - first);
            let (some, room) = (first..first + many, &mut room[..many]);
            let moved = particles.moved(some.clone());
            self.weights.weigh(&scene, particles.start + first, moved, room)?;
            for (k, stencil) in some.zip(room) {
                particles.fetch(simd, k + AHEAD);
                sound &= nodes.update(simd, &mut particles, k, &*stencil, &mut rest);
            }
        }
        Ok(sound & simd.all_at_most(rest, rest))
    }
}

/// The data of the nodes that particles are updated from.
struct Nodes<'a, T: Real, const D: usize> {
    scene: Scene<'a, T, D>,
    steps: Steps<T>,
    velocity: &'a [Nodal<T>],
    acceleration: &'a [Nodal<T>],
}

impl<T: Real, const D: usize> Nodes<'_, T, D> {
    /// Updates a pack, and returns whether all J > 0. Adds zero times all new numbers to `rest`.
    #[inline(always)]
    fn update<M: Simd<T>>(
        &self,
        simd: M,
        particles: &mut Columns<'_, T, D>,
        k: usize,
        stencil: &impl Stencil<T, D>,
        rest: &mut M::Eight,
    ) -> IsProvedSound {
        let Self { scene, steps, velocity, .. } = self;
        let degree = scene.lattice.degree;
        let zero = simd.splat(T::zero());
        let wanted = match (steps.velocity, steps.deformation) {
            // For hat functions the nearest linear velocity is the interpolant between the nodes.
            (Some(_), _) if scene.transfer == Transfer::Apic && degree == 1 => Wanted::Gradient,
            (Some(_), _) if scene.transfer == Transfer::Apic => Wanted::Slopes,
            (_, Some(_)) => Wanted::Gradient,
            _ => Wanted::Value,
        };
        let mapped = stencil.gather(simd, scene.lattice, wanted, velocity);
        if let Some(kick) = steps.velocity {
            let next = self.kicked(simd, kick, mapped.value, particles, k, stencil);
            set_components(simd, &mut particles.velocity[k], next);
            for a in 0..D {
                *rest = simd.times_plus(next[a], zero, *rest);
            }
            if scene.transfer == Transfer::Apic {
                let affine = if degree == 1 { mapped.gradient } else { mapped.slopes };
                let affine = faults::affine(simd, affine, degree);
                set_columns(simd, &mut particles.affine[k], affine);
            }
        }
        if let Some(time_step) = steps.position {
            let mut next = components(simd, &particles.displacement[k]);
            let own = components(simd, &particles.velocity[k]);
            let carrier = faults::carrier(mapped.value, own);
            for a in 0..D {
                next[a] = simd.times_plus(simd.splat(time_step), carrier[a], next[a]);
                *rest = simd.times_plus(next[a], zero, *rest);
            }
            set_components(simd, &mut particles.displacement[k], next);
        }
        let Some(time_step) = steps.deformation else { return true };
        let mut sound = true;
        if D == 2
            && let Some(strain) = particles.hoop_strain.get_mut(k)
            && let Some(stencil) = stencil.product()
        {
            let speed = match stencil.around() {
                Some(around) => simd.eight(&along_first(scene.lattice, &around, velocity)),
                None => mapped.value[0],
            };
            let mut rate = simd.over(speed, simd.eight(stencil.radius()));
            let before = simd.eight(strain);
            if scene.moves {
                rate = simd.times_plus(rate, before, rate);
            }
            let next = simd.times_plus(simd.splat(time_step), rate, before);
            *strain = simd.numbers(next);
            *rest = simd.times_plus(next, zero, *rest);
            let least = simd.splat(T::of(f64::from(f32::MIN_POSITIVE)));
            sound = simd.all_at_most(least, simd.plus(next, simd.splat(T::one())));
        }
        let h = columns(simd, &particles.displacement_gradient[k]);
        let gradient = faults::velocity_gradient(simd, mapped.gradient);
        let moves = scene.moves && !on(Defect::ReferenceGradient);
        let mut next = deformed(simd, h, gradient, time_step, moves);
        set_columns(simd, &mut particles.displacement_gradient[k], next);
        for j in 0..D {
            for i in 0..D {
                *rest = simd.times_plus(next[j][i], zero, *rest);
            }
            next[j][j] = simd.plus(next[j][j], simd.splat(T::one()));
        }
        let least = simd.splat(T::of(f64::from(f32::MIN_POSITIVE)));
        sound & simd.all_at_most(least, determinants(simd, &next))
    }

    /// The velocities of particles after a kick; `mapped` is the interpolated velocity of the nodes.
    #[inline(always)]
    fn kicked<M: Simd<T>>(
        &self,
        simd: M,
        kick: T,
        mapped: [M::Eight; D],
        particles: &mut Columns<'_, T, D>,
        k: usize,
        stencil: &impl Stencil<T, D>,
    ) -> [M::Eight; D] {
        let Self { scene, acceleration, .. } = self;
        if scene.transfer.reads() == Reads::Nothing {
            return mapped;
        }
        let acceleration = stencil.gather(simd, scene.lattice, Wanted::Value, acceleration);
        let mut next = components(simd, &particles.velocity[k]);
        for a in 0..D {
            next[a] = simd.times_plus(simd.splat(kick), acceleration.value[a], next[a]);
        }
        match scene.transfer {
            Transfer::Flip { fraction } if fraction < 1.0 => {
                let [own, others] = [fraction, 1.0 - fraction].map(T::of);
                for a in 0..D {
                    let others = simd.times(simd.splat(others), mapped[a]);
                    next[a] = simd.times_plus(simd.splat(own), next[a], others);
                }
            }
            Transfer::Xpic { .. } => {
                let sign = simd.splat(if on(Defect::XpicSign) { T::one() } else { -T::one() });
                let residual = components(simd, &particles.residual[k]);
                for a in 0..D {
                    next[a] = simd.times_plus(sign, residual[a], next[a]);
                }
            }
            Transfer::Flip { .. } | Transfer::Pic | Transfer::Apic => {}
        }
        next
    }
}

/// The first component of the nodes' vector, interpolated to particles, in a function that is not inlined, compiled once for
/// every processor.
#[inline(never)]
fn along_first<T: Real, const D: usize>(
    lattice: &Lattice<T, D>,
    stencil: &ProductStencil<T, D>,
    nodes: &[Nodal<T>],
) -> [T; PACK] {
    let simd = T::PlainSimd::from(Plain);
    simd.numbers(stencil.gather(simd, lattice, Wanted::Value, nodes).value[0])
}

/// The columns of H + dt G F, or of H + dt G if nothing `moves`, G being the gradient whose columns are given.
#[inline(always)]
fn deformed<T: Real, M: Simd<T>, const D: usize>(
    simd: M,
    h: [[M::Eight; D]; D],
    mut gradient: [[M::Eight; D]; D],
    time_step: T,
    moves: bool,
) -> [[M::Eight; D]; D] {
    let mut next = h;
    for j in 0..D {
        for i in 0..D {
            gradient[j][i] = simd.times(gradient[j][i], simd.splat(time_step));
            next[j][i] = simd.plus(next[j][i], gradient[j][i]);
        }
    }
    if moves {
        for j in 0..D {
            for i in 0..D {
                for a in 0..D {
                    next[j][i] = simd.times_plus(h[j][a], gradient[a][i], next[j][i]);
                }
            }
        }
    }
    next
}

/// The input of a residual's update.
#[derive(Clone, Copy)]
pub(super) enum Source {
    /// v.
    Velocity,
    /// The previous residual.
    Residual,
}

/// The computation of the residual velocities of some particles: the part that the grid does not represent.
pub(super) struct Residual<'a, 'p, T: Real, const D: usize> {
    pub scene: Scene<'a, T, D>,
    pub particles: Columns<'p, T, D>,
    pub nodal: &'a [Nodal<T>],
    pub source: Source,
}

impl<T: Real, const D: usize> Residual<'_, '_, T, D> {
    /// Computes the residuals with these weights.
    pub fn with<St: Stencil<T, D>>(
        self,
        weights: &dyn Weigh<T, D, St>,
    ) -> Result<IsProvedSound, (usize, Cause)> {
        best(Weighted { pass: self, weights })
    }
}

impl<T, const D: usize, St> Work<T> for Weighted<'_, Residual<'_, '_, T, D>, T, D, St>
where
    T: Real,
    St: Stencil<T, D>,
{
    type Output = Result<IsProvedSound, (usize, Cause)>;
    const WIDEST: IsaLevel = St::WIDEST;

    #[inline(always)]
    fn on<M: Simd<T>>(self, simd: M) -> Self::Output {
        let Residual { scene, particles, nodal, source } = self.pass;
        let mut room = Stencils::<St>::default();
        let count = particles.len();
        for first in (0..count).step_by(TOGETHER) {
            let many = TOGETHER.min(count - first);
            let (some, room) = (first..first + many, &mut room[..many]);
            let moved = particles.moved(some.clone());
            self.weights.weigh(&scene, particles.start + first, moved, room)?;
            for (k, stencil) in some.zip(room) {
                let from = match source {
                    Source::Velocity => &particles.velocity[k],
                    Source::Residual => &particles.residual[k],
                };
                let represented = stencil.gather(simd, scene.lattice, Wanted::Value, nodal);
                let mut left = components(simd, from);
                for a in 0..D {
                    left[a] = simd.minus(left[a], represented.value[a]);
                }
                set_components(simd, &mut particles.residual[k], left);
            }
        }
        Ok(true)
    }
}
