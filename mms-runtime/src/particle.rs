//! The particles: structure of arrays, entry `p` of every array belongs to particle `p`.

use std::borrow::Cow;
use std::iter::repeat_n;
use std::ops::Range;

use mms_math::simd::Simd;

use crate::axisymmetric::hoop_stretch;
use crate::body::Filling;
use crate::column::PACK;
use crate::column::{Column, Matrices, Pack, Packs, Vectors};
use crate::real::{Matrix, Real, Vector};
use crate::tensor::jacobian;
use crate::threads::Parts;
use crate::transfer::Transfer;

/// The state of all particles.
///
/// The displacement is stored, not the position, and H, not F: so `f32` loses nothing to x - X and to F - I, and X is never
/// recomputed. The stress is not stored, for it follows from H.
#[derive(Clone, Debug)]
pub struct Particles<T, const D: usize> {
    /// The number that a particle started with: the solver may change the order of particles.
    pub id: Column<u32>,
    /// X.
    pub reference_position: Column<Vector<T, D>>,
    /// d = x - X.
    pub displacement: Packs<Vectors<T, D>>,
    /// v.
    pub velocity: Packs<Vectors<T, D>>,
    /// H = F - I.
    pub displacement_gradient: Packs<Matrices<T, D>>,
    /// h = F_tt - 1, the strain around the axis; empty unless the body is a body of revolution.
    pub hoop_strain: Column<T>,
    /// m.
    pub mass: Column<T>,
    /// V0.
    pub reference_volume: Column<T>,
    /// C, the linear velocity on each particle; empty except with APIC.
    pub affine: Packs<Matrices<T, D>>,
    /// (I - S S+)^m v, the part of the velocity that the grid does not represent; empty except with XPIC.
    pub residual: Packs<Vectors<T, D>>,
}

impl<T: Real, const D: usize> Particles<T, D> {
    /// Creates the particles that fill a body, undeformed, at rest and without mass. C is 0: the first map of APIC loses terms
    /// of second order in h.
    pub fn new(filling: &Filling<D>, transfer: Transfer) -> Self {
        let count = filling.len();
        let (affine, residual) = match transfer {
            Transfer::Apic => (count, 0),
            Transfer::Xpic { .. } => (0, count),
            Transfer::Flip { .. } | Transfer::Pic => (0, 0),
        };
        Self {
            // The number of particles in a filling is limited to less than 2^32.
            id: (0..count as u32).collect(),
            reference_position: filling.position.iter().map(|x| x.map(T::of)).collect(),
            displacement: repeat_n(Vector::zeros(), count).collect(),
            velocity: repeat_n(Vector::zeros(), count).collect(),
            displacement_gradient: repeat_n(Matrix::zeros(), count).collect(),
            hoop_strain: Vec::new().into(),
            mass: vec![T::zero(); count].into(),
            reference_volume: filling.volume.iter().map(|&volume| T::of(volume)).collect(),
            affine: repeat_n(Matrix::zeros(), affine).collect(),
            residual: repeat_n(Vector::zeros(), residual).collect(),
        }
    }

    /// The number of particles.
    pub fn len(&self) -> usize {
        self.mass.len()
    }

    /// Whether there is no particle; a filled body always has some.
    pub fn is_empty(&self) -> bool {
        self.mass.is_empty()
    }

    /// x = X + d of one particle.
    #[inline(always)]
    pub fn position(&self, particle: usize) -> Vector<T, D> {
        self.reference_position[particle] + self.displacement.get(particle)
    }

    /// J of one particle.
    pub fn jacobian(&self, particle: usize) -> T {
        jacobian(&self.displacement_gradient.get(particle))
            * hoop_stretch(&self.hoop_strain, particle)
    }

    /// The memory of one particle, in bytes.
    pub fn bytes_per_particle(&self) -> usize {
        let numbers = if self.hoop_strain.is_empty() { 2 } else { 3 };
        let given = size_of::<Vector<T, D>>() + numbers * size_of::<T>();
        let kept = self.displacement.bytes() + self.velocity.bytes();
        let deformation = self.displacement_gradient.bytes();
        let transfer = self.affine.bytes() + self.residual.bytes();
        size_of::<u32>() + given + kept + deformation + transfer
    }

    /// Moves particle `order[p]` to place `p`, in every array.
    pub(crate) fn reorder(&mut self, order: &mut [u32]) {
        let Self {
            id,
            reference_position,
            displacement,
            velocity,
            displacement_gradient,
            hoop_strain,
            mass,
            reference_volume,
            affine,
            residual,
        } = self;
        reorder(id, order);
        reorder(reference_position, order);
        reorder_packs(displacement, order);
        reorder_packs(velocity, order);
        reorder_packs(displacement_gradient, order);
        reorder(hoop_strain, order);
        reorder(mass, order);
        reorder(reference_volume, order);
        reorder_packs(affine, order);
        reorder_packs(residual, order);
        self.fill_up();
    }

    /// Pads the last pack with copies of the last particle, after particles were changed one by one.
    pub(crate) fn fill_up(&mut self) {
        self.reference_position.fill_up();
        self.displacement.fill_up();
        self.velocity.fill_up();
        self.displacement_gradient.fill_up();
        self.hoop_strain.fill_up();
        self.mass.fill_up();
        self.reference_volume.fill_up();
        self.affine.fill_up();
        self.residual.fill_up();
    }

    /// Prefetches the data that P2G reads of a pack, except X and H, which other code needs sooner.
    #[inline(always)]
    pub(crate) fn fetch<M: Simd<T>>(&self, simd: M, pack: usize) {
        simd.fetch(self.displacement.packs(), pack);
        simd.fetch(self.velocity.packs(), pack);
        simd.fetch(self.mass.packs(), pack);
        simd.fetch(self.reference_volume.packs(), pack);
        simd.fetch(self.affine.packs(), pack);
    }

    /// X, and the arrays that a step changes.
    pub(crate) fn columns(&mut self) -> (&[[Vector<T, D>; PACK]], Columns<'_, T, D>) {
        let columns = Columns {
            start: 0,
            displacement: self.displacement.packs_mut(),
            velocity: self.velocity.packs_mut(),
            displacement_gradient: self.displacement_gradient.packs_mut(),
            hoop_strain: self.hoop_strain.packs_mut(),
            affine: self.affine.packs_mut(),
            residual: self.residual.packs_mut(),
        };
        (self.reference_position.packs(), columns)
    }
}

/// Marks the completed places of an order.
const DONE: u32 = 1 << 31;

/// Moves item `order[p]` to place `p`; an empty array stays empty.
pub(crate) fn reorder<V>(items: &mut [V], order: &mut [u32]) {
    if !items.is_empty() {
        follow(order, |place, from| items.swap(place, from));
    }
}

/// Moves entry `order[p]` to place `p`, as [`reorder`] does.
pub(crate) fn reorder_packs<B: Pack>(items: &mut Packs<B>, order: &mut [u32]) {
    if !items.is_empty() {
        follow(order, |place, from| items.swap(place, from));
    }
}

/// Applies an order by exchanges, cycle by cycle.
fn follow(order: &mut [u32], mut swap: impl FnMut(usize, usize)) {
    for first in 0..order.len() {
        let mut place = first;
        while order[place] & DONE == 0 {
            let from = order[place] as usize;
            order[place] |= DONE;
            if from != first {
                swap(place, from);
            }
            place = from;
        }
    }
    order.iter_mut().for_each(|from| *from &= !DONE);
}

/// The arrays that a step changes, for the packs from `start` on.
pub(crate) struct Columns<'a, T, const D: usize> {
    pub start: usize,
    pub displacement: &'a mut [Vectors<T, D>],
    pub velocity: &'a mut [Vectors<T, D>],
    pub displacement_gradient: &'a mut [Matrices<T, D>],
    pub hoop_strain: &'a mut [[T; PACK]],
    pub affine: &'a mut [Matrices<T, D>],
    pub residual: &'a mut [Vectors<T, D>],
}

impl<T: Real, const D: usize> Columns<'_, T, D> {
    /// Prefetches the data of a pack that a step changes.
    #[inline(always)]
    pub fn fetch<M: Simd<T>>(&self, simd: M, pack: usize) {
        simd.fetch(self.displacement, pack);
        simd.fetch(self.velocity, pack);
        simd.fetch(self.displacement_gradient, pack);
        simd.fetch(self.affine, pack);
    }

    /// The displacements and the displacement gradients of some packs.
    #[inline(always)]
    pub fn moved(&self, packs: Range<usize>) -> (&[Vectors<T, D>], &[Matrices<T, D>]) {
        (&self.displacement[packs.clone()], &self.displacement_gradient[packs])
    }
}

impl<T: Real, const D: usize> Parts for Columns<'_, T, D> {
    fn len(&self) -> usize {
        self.displacement.len()
    }

    fn split(self, count: usize) -> [Self; 2] {
        let (displacement, displacements) = self.displacement.split_at_mut(count);
        let (velocity, velocities) = self.velocity.split_at_mut(count);
        let (gradient, gradients) = self.displacement_gradient.split_at_mut(count);
        let (hoop, hoops) = self.hoop_strain.split_at_mut(count.min(self.hoop_strain.len()));
        let (affine, affines) = self.affine.split_at_mut(count.min(self.affine.len()));
        let (residual, residuals) = self.residual.split_at_mut(count.min(self.residual.len()));
        let first = Self {
            start: self.start,
            displacement,
            velocity,
            displacement_gradient: gradient,
            hoop_strain: hoop,
            affine,
            residual,
        };
        let others = Self {
            start: self.start + count,
            displacement: displacements,
            velocity: velocities,
            displacement_gradient: gradients,
            hoop_strain: hoops,
            affine: affines,
            residual: residuals,
        };
        [first, others]
    }
}

/// The points where material and b are evaluated, for some packs: X, or x if a defect uses x instead.
pub(crate) fn material_points<'a, T: Real, const D: usize>(
    reference: &'a [[Vector<T, D>; PACK]],
    displacement: &[Vectors<T, D>],
    at_present: bool,
) -> Cow<'a, [[Vector<T, D>; PACK]]> {
    let present = |(reference, displacement): (&[Vector<T, D>; PACK], &Vectors<T, D>)| {
        std::array::from_fn(|k| reference[k] + displacement.get(k))
    };
    match at_present {
        true => reference.iter().zip(displacement).map(present).collect(),
        false => Cow::Borrowed(reference),
    }
}

#[cfg(test)]
mod tests {
    use super::reorder;

    #[test]
    fn an_order_is_applied_to_every_array_alike() {
        let mut order = [3, 0, 1, 2, 5, 4, 6];
        let mut letters = ['a', 'b', 'c', 'd', 'e', 'f', 'g'];
        let mut nothing: [char; 0] = [];
        reorder(&mut nothing, &mut order);
        reorder(&mut letters, &mut order);
        assert_eq!(letters, ['d', 'a', 'b', 'c', 'f', 'e', 'g']);
        let mut numbers = [0, 1, 2, 3, 4, 5, 6];
        reorder(&mut numbers, &mut order);
        assert_eq!(numbers, [3, 0, 1, 2, 5, 4, 6]);
    }
}
