//! From particles to nodes (P2G): mass and momentum, and forces.

use std::ops::Range;

use mms_math::dispatch::{IsaLevel, Work, best};
use mms_math::simd::{Plain, Simd};

use super::clock::{Laps, Seconds};
use super::faults;
use super::slabs::Slab;
use super::weights::{AHEAD, Domains, Scene, Stencils, TOGETHER, Weigh};
use crate::column::{HALF, PACK};
use crate::column::{Matrices, Pack as _, Vectors};
use crate::defect::{Defect, on};
use crate::failure::Cause;
use crate::field::ManufacturedField;
use crate::formulation::Configuration;
use crate::lanes::{columns, scaled, turned};
use crate::lattice::Lattice;
use crate::nodal::{LAST, Window};
use crate::particle::{Particles, material_points};
use crate::real::{Real, Vector};
use crate::stencil::{Members, Payload, ProductStencil, Stencil};
use crate::tensor::matrix_is_finite;

/// The number of particles whose stresses are computed together: few enough for the stresses to stay in the cache.
const PART: usize = 256;

/// The number of particles whose body forces are computed together, as a batch. Each batch computes the terms that depend on time
/// alone once; with so many particles they cost little.
const FORCED: usize = 2048;

/// One of this many batches is timed: reading the clock stalls the processor.
const TIMED: usize = 8;

/// The quantity that is added to the nodes.
#[derive(Clone, Copy)]
pub(super) enum Addend<T> {
    /// m, and m v, where v includes the linear velocity of each particle (APIC).
    Momentum,
    /// m, and m r with the residual velocity r.
    Residual,
    /// - V0 S grad w + w m b.
    Force,
    /// - V0 S grad w.
    Stress,
    /// Momentum without a linear velocity, and force, as two separate sums.
    Both,
    /// Momentum plus force times this time step, as one sum.
    Kicked(T),
}

impl<T> Addend<T> {
    /// Whether the quantity includes forces.
    fn has_force(&self) -> bool {
        !matches!(self, Addend::Momentum | Addend::Residual)
    }
}

/// The reason why the sums of a slab ended early.
pub(super) enum SlabError {
    /// A particle has left the nodes of its slab.
    Strayed(usize),
    /// A particle has no weights or no stress.
    Failed(usize, Cause),
}

impl From<(usize, Cause)> for SlabError {
    fn from((particle, cause): (usize, Cause)) -> Self {
        SlabError::Failed(particle, cause)
    }
}

/// The sums of the particles of one slab.
pub(super) struct SlabSums<'a, T: Real, const D: usize, F: ?Sized> {
    pub scene: Scene<'a, T, D>,
    pub domains: &'a dyn Domains<T, D>,
    pub particles: &'a Particles<T, D>,
    pub field: &'a F,
    pub addend: Addend<T>,
    pub formulation: Configuration<T, D>,
    /// The time at which the body force is evaluated.
    pub time: T,
}

impl<T: Real, const D: usize, F> SlabSums<'_, T, D, F>
where
    F: ManufacturedField<T, D> + ?Sized,
{
    /// Adds to momentum and force of the nodes in the slab's window. Returns the seconds that body forces, stresses and the
    /// transfer took in the batches that are timed.
    pub fn slab(&self, slab: &Slab, nodes: [Window<'_, T>; 2]) -> Result<Seconds, SlabError> {
        let [mut momentum, mut force] = nodes;
        let mut seconds = Seconds::default();
        let mut stress = [Matrices::zeros(); PART / PACK];
        let mut hoop_stress = [[T::zero(); PACK]; PART / PACK];
        let mut body_force = [[Vector::zeros(); PACK]; FORCED / PACK];
        let has_force = self.addend.has_force();
        // Packs do not depend on the slabs: the first and the last one may contain particles of other slabs.
        let Range { start, end } = slab.particles;
        for forced in parts(start / PACK..end.div_ceil(PACK), FORCED / PACK) {
            let mut laps = Laps::start((forced.start * PACK / FORCED).is_multiple_of(TIMED));
            let body_force = &mut body_force[..forced.len()];
            if has_force {
                self.find_body_force(forced.clone(), body_force);
                laps.end(&mut seconds.forcing);
            }
            for part in parts(forced.clone(), PART / PACK) {
                let stress = &mut stress[..part.len()];
                let hoop_stress = &mut hoop_stress[..part.len()];
                if has_force {
                    self.find_stress(part.clone(), stress, hoop_stress)?;
                    laps.end(&mut seconds.stress);
                }
                let sums = Sums {
                    scene: self.scene,
                    particles: self.particles,
                    added: self.addend,
                    body_force: &body_force[part.start - forced.start..][..part.len()],
                    packs: part,
                    stress,
                    hoop_stress: (has_force && self.scene.lattice.is_meridian)
                        .then_some(&*hoop_stress),
                    nodes: [momentum.reborrow(), force.reborrow()],
                    slab,
                };
                self.domains.scatter(sums)?;
                laps.end(&mut seconds.transfer);
            }
        }
        Ok(seconds)
    }

    /// Computes the stress that multiplies grad w, of every particle of a part, and on a meridian the stress around the axis.
    fn find_stress(
        &self,
        part: Range<usize>,
        stress: &mut [Matrices<T, D>],
        hoop_stress: &mut [[T; PACK]],
    ) -> Result<(), SlabError> {
        let all = self.particles;
        let gradients = &all.displacement_gradient.packs()[part.clone()];
        let reference = &all.reference_position.packs()[part.clone()];
        let displacement = &all.displacement.packs()[part.clone()];
        let points = material_points(reference, displacement, on(Defect::ModuliAtPresent));
        match self.field.axisymmetric() {
            None => {
                self.field.kirchhoff_stress_of_packs(self.time, &points, gradients, stress);
            }
            Some(axisymmetric) => {
                let strains = &all.hoop_strain.packs()[part.clone()];
                axisymmetric.kirchhoff_stress_of_packs(
                    self.time,
                    &points,
                    (gradients, strains),
                    (stress, hoop_stress),
                );
                if !self.formulation.moves {
                    first_piola_kirchhoff(strains, hoop_stress);
                }
            }
        }
        let singular = |k| (PACK * part.start + k, Cause::Inverted { jacobian: 0.0 });
        Ok((self.formulation.stress)(gradients, stress).map_err(singular)?)
    }

    /// Computes b of every particle of a part.
    fn find_body_force(&self, part: Range<usize>, body_force: &mut [[Vector<T, D>; PACK]]) {
        let all = self.particles;
        let reference = &all.reference_position.packs()[part.clone()];
        let displacement = &all.displacement.packs()[part];
        let points = material_points(reference, displacement, on(Defect::ForceAtPresent));
        self.field.body_force(self.time, points.as_flattened(), body_force.as_flattened_mut());
    }
}

/// Splits a range into parts of `count`.
fn parts(range: Range<usize>, count: usize) -> impl Iterator<Item = Range<usize>> {
    let end = range.end;
    range.step_by(count).map(move |first| first..end.min(first + count))
}

/// The sums of some particles with known stress and body force.
pub(super) struct Sums<'a, T: Real, const D: usize> {
    scene: Scene<'a, T, D>,
    particles: &'a Particles<T, D>,
    added: Addend<T>,
    packs: Range<usize>,
    /// The stresses, from the first of the `packs` on.
    stress: &'a [Matrices<T, D>],
    hoop_stress: Option<&'a [[T; PACK]]>,
    body_force: &'a [[Vector<T, D>; PACK]],
    /// Momentum and force.
    nodes: [Window<'a, T>; 2],
    slab: &'a Slab,
}

impl<T: Real, const D: usize> Sums<'_, T, D> {
    /// Adds to the nodes with these weights.
    pub fn with<St: Stencil<T, D>>(self, weights: &dyn Weigh<T, D, St>) -> Result<(), SlabError> {
        best(Scatter { sums: self, weights })
    }
}

/// Sums with the weights of one kind of stencils.
struct Scatter<'a, T: Real, const D: usize, St> {
    sums: Sums<'a, T, D>,
    weights: &'a dyn Weigh<T, D, St>,
}

impl<T: Real, const D: usize, St: Stencil<T, D>> Work<T> for Scatter<'_, T, D, St> {
    type Output = Result<(), SlabError>;
    const WIDEST: IsaLevel = St::WIDEST;

    #[inline(always)]
    fn on<M: Simd<T>>(self, simd: M) -> Self::Output {
        let Sums { scene, particles, added, packs: range, mut nodes, slab, .. } = self.sums;
        let Sums { stress, hoop_stress, body_force, .. } = self.sums;
        let packs =
            Arrays { hoop_stress, ..Arrays::new(particles, range.clone(), stress, body_force) };
        let mut room = Stencils::<St>::default();
        let mut rest = simd.splat(T::zero());
        let count = range.len();
        for first in (0..count).step_by(TOGETHER) {
            let many = TOGETHER.min(count - first);
            let (some, room) = (first..first + many, &mut room[..many]);
            let moved =
                (&packs.displacement[some.clone()], &packs.displacement_gradient[some.clone()]);
            self.weights.weigh(&scene, range.start + first, moved, room)?;
            for (k, stencil) in some.zip(room) {
                let pack = range.start + k;
                particles.fetch(simd, pack + AHEAD);
                // For the stress of the next part.
                simd.fetch(particles.displacement_gradient.packs(), pack + count);
                let members = slab.members(PACK * pack);
                if let Some(p) = stencil.beyond(members, &slab.window) {
                    return Err(SlabError::Strayed(PACK * pack + p));
                }
                let [momentum, force] = &mut nodes;
                let nodes = [momentum.reborrow(), force.reborrow()];
                let carrier = Carrier { packs: &packs, k, members, stencil };
                carrier.add(simd, added, scene.lattice, nodes, &mut rest);
            }
        }
        if simd.all_at_most(rest, rest) {
            return Ok(());
        }
        let mut all = stress.iter().flat_map(|stress| (0..PACK).map(|k| stress.get(k)));
        let odd = all.position(|stress| !matrix_is_finite(&stress));
        let cause = Cause::NotFinite { quantity: "stress" };
        odd.map_or(Ok(()), |p| Err(SlabError::Failed(PACK * range.start + p, cause)))
    }
}

/// Replaces tau_tt by P_tt = tau_tt/F_tt.
fn first_piola_kirchhoff<T: Real>(hoop_strain: &[[T; PACK]], hoop_stress: &mut [[T; PACK]]) {
    let strains = hoop_strain.as_flattened().iter();
    strains.zip(hoop_stress.as_flattened_mut()).for_each(|(&h, stress)| *stress /= T::one() + h);
}

/// Adds forces along the first axis to the nodes, in a function that is not inlined, compiled once for every processor.
#[inline(never)]
fn add_along_first<T: Real, const D: usize>(
    lattice: &Lattice<T, D>,
    stencil: &ProductStencil<T, D>,
    forces: [T; PACK],
    members: Members,
    nodes: Window<'_, T>,
) {
    let simd = T::PlainSimd::from(Plain);
    let nothing = simd.splat(T::zero());
    let rows = [simd.eight(&forces), nothing, nothing, nothing];
    let payload = Payload::value(simd.transposed(rows));
    stencil.scatter(simd, lattice, &payload, members, nodes);
}

/// The data of the particles to add, pack by pack.
struct Arrays<'a, T: Real, const D: usize> {
    displacement: &'a [Vectors<T, D>],
    velocity: &'a [Vectors<T, D>],
    displacement_gradient: &'a [Matrices<T, D>],
    body_force: &'a [[Vector<T, D>; PACK]],
    mass: &'a [[T; PACK]],
    reference_volume: &'a [[T; PACK]],
    stress: &'a [Matrices<T, D>],
    /// On a meridian only.
    hoop_stress: Option<&'a [[T; PACK]]>,
    /// With APIC only.
    affine: Option<&'a [Matrices<T, D>]>,
    /// With XPIC only.
    residual: Option<&'a [Vectors<T, D>]>,
}

impl<'a, T: Real, const D: usize> Arrays<'a, T, D> {
    #[inline(always)]
    fn new(
        all: &'a Particles<T, D>,
        range: Range<usize>,
        stress: &'a [Matrices<T, D>],
        body_force: &'a [[Vector<T, D>; PACK]],
    ) -> Self {
        Self {
            displacement: &all.displacement.packs()[range.clone()],
            velocity: &all.velocity.packs()[range.clone()],
            displacement_gradient: &all.displacement_gradient.packs()[range.clone()],
            mass: &all.mass.packs()[range.clone()],
            reference_volume: &all.reference_volume.packs()[range.clone()],
            stress,
            hoop_stress: None,
            body_force,
            affine: all.affine.packs().get(range.clone()),
            residual: all.residual.packs().get(range),
        }
    }
}

/// One pack of particles to add to the nodes.
struct Carrier<'a, T: Real, const D: usize, St> {
    packs: &'a Arrays<'a, T, D>,
    k: usize,
    members: Members,
    stencil: &'a St,
}

impl<T: Real, const D: usize, St: Stencil<T, D>> Carrier<'_, T, D, St> {
    /// Adds to momentum and force of the nodes. Adds zero times the stress to `rest`, which stays zero only if all stresses are
    /// finite.
    #[inline(always)]
    fn add<M: Simd<T>>(
        self,
        simd: M,
        added: Addend<T>,
        lattice: &Lattice<T, D>,
        [mut momentum, force]: [Window<'_, T>; 2],
        rest: &mut M::Eight,
    ) {
        let Self { packs, k, members, stencil } = self;
        let Arrays { velocity, affine, residual, .. } = packs;
        // One call adds payloads without gradient weights, another one payloads with them, so that each kind is compiled once.
        let alone = match (added, residual, affine) {
            (Addend::Residual, Some(residual), _) => Some(&residual[k]),
            (Addend::Momentum | Addend::Both, _, None) => Some(&velocity[k]),
            _ => None,
        };
        if let Some(velocity) = alone {
            let payload = Payload::value(simd.transposed(self.momentum(simd, velocity)));
            stencil.scatter(simd, lattice, &payload, members, momentum.reborrow());
        }
        let (share, with_momentum) = match added {
            Addend::Force | Addend::Stress | Addend::Both => (T::one(), false),
            Addend::Kicked(time_step) => (time_step, true),
            // Momentum with zero slopes.
            Addend::Momentum if affine.is_some() => (T::zero(), true),
            Addend::Momentum | Addend::Residual => return,
        };
        let mut numbers = [simd.splat(T::zero()); HALF];
        let mut moments = None;
        if with_momentum {
            numbers = self.momentum(simd, &velocity[k]);
            if let Some(affine) = affine {
                let mass = simd.eight(&packs.mass[k]);
                moments = Some(scaled(simd, columns(simd, &affine[k]), mass));
            }
        }
        if !matches!(added, Addend::Stress) {
            self.add_body_force(simd, simd.splat(share), &mut numbers);
        }
        let slopes = Some(self.stress(simd, simd.splat(share), rest));
        let mut nodes = if with_momentum { momentum } else { force };
        if D == 2 && packs.hoop_stress.is_some() {
            self.add_hoop_stress(simd, share, lattice, &mut numbers, nodes.reborrow());
        }
        let payload = Payload { value: simd.transposed(numbers), slopes, moments };
        stencil.scatter(simd, lattice, &payload, members, nodes);
    }

    /// m v, and m.
    #[inline(always)]
    fn momentum<M: Simd<T>>(&self, simd: M, velocity: &Vectors<T, D>) -> [M::Eight; HALF] {
        let mass = simd.eight(&self.packs.mass[self.k]);
        let mut numbers = [simd.splat(T::zero()); HALF];
        for i in 0..D {
            numbers[i] = simd.times(mass, simd.eight(&velocity.0[i]));
        }
        numbers[LAST] = mass;
        numbers
    }

    /// Adds this `share` of m b.
    #[inline(always)]
    fn add_body_force<M: Simd<T>>(&self, simd: M, share: M::Eight, numbers: &mut [M::Eight; HALF]) {
        let Arrays { body_force, mass, .. } = self.packs;
        let mass = simd.times(share, simd.eight(&mass[self.k]));
        let body_force: [M::Eight; D] = turned(simd, &body_force[self.k]);
        for i in 0..D {
            numbers[i] = simd.times_plus(mass, body_force[i], numbers[i]);
        }
    }

    /// Adds this `share` of - V0 S_tt / r to the force along R: to the `numbers`, or to the nodes if the strain around the axis
    /// has other weights.
    #[inline(always)]
    fn add_hoop_stress<M: Simd<T>>(
        &self,
        simd: M,
        share: T,
        lattice: &Lattice<T, D>,
        numbers: &mut [M::Eight; HALF],
        nodes: Window<'_, T>,
    ) {
        let Arrays { hoop_stress, reference_volume, .. } = self.packs;
        let (Some(stress), Some(stencil)) = (hoop_stress, self.stencil.product()) else { return };
        let volume = simd.eight(&reference_volume[self.k]);
        let force = simd.times(simd.times(simd.splat(-share), volume), simd.eight(&stress[self.k]));
        let force = simd.over(force, simd.eight(stencil.radius()));
        if on(Defect::HoopStress) {
            return;
        }
        match stencil.around() {
            Some(around) => {
                add_along_first(lattice, &around, simd.numbers(force), self.members, nodes)
            }
            None => numbers[0] = simd.plus(numbers[0], force),
        }
    }

    /// Computes this `share` of - V0 S. Adds zero times it to `rest`, which stays zero if it is finite.
    #[inline(always)]
    fn stress<M: Simd<T>>(
        &self,
        simd: M,
        share: M::Eight,
        rest: &mut M::Eight,
    ) -> [[M::Eight; D]; D] {
        let Arrays { reference_volume, stress, .. } = self.packs;
        let zero = simd.splat(T::zero());
        let volume = simd.times(share, simd.eight(&reference_volume[self.k]));
        let volume = simd.minus(zero, volume);
        let push = scaled(simd, columns(simd, &stress[self.k]), volume);
        for column in push {
            for entry in column {
                *rest = simd.times_plus(entry, zero, *rest);
            }
        }
        faults::stress(push)
    }
}
