//! Sorts particles by the cells that they are in. Each slab begins with the packs whose particles are all in one cell, then has
//! the halves of packs in one cell, then the other particles.

use mms_math::simd::{Plain, Simd as _};

use super::slabs::Slab;
use super::weights::Domains;
use crate::column::{HALF, PACK};
use crate::lanes::positions;
use crate::lattice::Lattice;
use crate::particle::Particles;
use crate::real::Real;
use crate::threads::each;

/// The number of packs that one thread locates at a time.
const PART: usize = 512;

/// Particles are sorted if more than this percentage of the packs and halves that could lie in one cell do not. The lost time
/// recurs in every step; sorting takes about as long as one step.
const LOOSE: usize = 5;

/// The condition for sorting particles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum When {
    /// Always.
    Now,
    /// If many packs that could lie in one cell lie in several.
    Loose,
}

/// The order of the particles.
pub(super) struct ParticleOrder {
    /// The place of each particle in the arrays, by its number; empty if particles are never sorted.
    place: Vec<u32>,
    /// The particle that moves to each place, while an order is computed.
    from: Vec<u32>,
    /// The cell of every particle, in the order of the arrays; after an order is computed, in the new order.
    cell: Vec<[u32; PACK]>,
    /// The number of particles of each cell; after an order is computed, the end of the cell's particles.
    count: Vec<u32>,
}

impl ParticleOrder {
    /// The order of particles on a grid with as many cells as `nodes`; fixed if `particles` is 0.
    pub fn new(particles: usize, nodes: usize) -> Self {
        Self {
            place: (0..particles as u32).collect(),
            from: vec![0; particles],
            cell: vec![[0; PACK]; particles.div_ceil(PACK)],
            count: vec![0; if particles > 0 { nodes } else { 0 }],
        }
    }

    /// An order of particles in these cells.
    #[cfg(test)]
    pub fn of_cells(cell: &[u32]) -> Self {
        let mut order = Self::new(cell.len(), 0);
        order.cell.as_flattened_mut()[..cell.len()].copy_from_slice(cell);
        order
    }

    /// Whether particles are never sorted.
    pub fn is_fixed(&self) -> bool {
        self.place.is_empty()
    }

    /// The place of the particle with the number `id`.
    pub fn place_of(&self, id: usize) -> usize {
        self.place.get(id).map_or(id, |&place| place as usize)
    }

    /// Records the place of each particle, unless particles are never sorted.
    pub fn place_ids(&mut self, ids: &[u32]) {
        if !self.is_fixed() {
            ids.iter().zip(0..).for_each(|(&id, p)| self.place[id as usize] = p);
        }
    }

    /// The cell of each particle: in the order of the arrays, or in the computed order.
    pub fn cells(&self) -> &[u32] {
        &self.cell.as_flattened()[..self.place.len()]
    }

    /// Finds the cell of each particle: of its present position, or of X if the body does not move through the grid (`moves`).
    /// The first cell begins at the coordinate `origin`, in units of cells.
    pub fn locate<T: Real, const D: usize>(
        &mut self,
        lattice: &Lattice<T, D>,
        origin: f64,
        particles: &Particles<T, D>,
        moves: bool,
    ) {
        let (reference, displacement) =
            (particles.reference_position.packs(), particles.displacement.packs());
        let cells_of = |pack: usize| {
            let simd = T::PlainSimd::from(Plain);
            let position = positions(simd, &reference[pack], &displacement[pack], moves);
            let mut cells = [0; PACK];
            for a in 0..D {
                let along = simd.numbers(lattice.cells_along(simd, a, position[a]));
                for (cell, along) in cells.iter_mut().zip(along) {
                    let along = (along.to_f64() - origin).max(0.0) as usize;
                    *cell += (along.min(lattice.count[a] - 1) * lattice.stride[a]) as u32;
                }
            }
            cells
        };
        each((&mut self.cell[..], 0..reference.len()), PART, &|(cells, packs)| {
            cells.iter_mut().zip(packs).for_each(|(cells, pack)| *cells = cells_of(pack));
        });
        let Self { place, cell, count, .. } = self;
        count.fill(0);
        let cells = &cell.as_flattened()[..place.len()];
        for alike in cells.chunk_by(|a, b| a == b) {
            count[alike[0] as usize] += alike.len() as u32;
        }
    }

    /// Whether sorting pays: more than `LOOSE` percent of the packs and halves that could lie in one cell do not.
    pub fn is_loose(&self) -> bool {
        let could: usize = self.count.iter().map(|&count| wholes(count as usize)).sum();
        let are = of_one_cell::<HALF>(self.cells()) + of_one_cell::<PACK>(self.cells());
        100 * are < (100 - LOOSE) * could
    }

    /// Computes the order by cells; it is stable: particles of one cell keep their order.
    pub fn arrange(&mut self) {
        let Self { place, from, cell, count } = self;
        let cell = &mut cell.as_flattened_mut()[..place.len()];
        // The next place of each cell's particles.
        let mut first = 0;
        for next in &mut *count {
            first += std::mem::replace(next, first);
        }
        for (&cell, p) in cell.iter().zip(0..) {
            let next = &mut count[cell as usize];
            from[*next as usize] = p;
            *next += 1;
        }
        let mut first = 0;
        for (&end, number) in count.iter().zip(0..) {
            cell[first..end as usize].fill(number);
            first = end as usize;
        }
    }

    /// Sorts the particles and their `domains` in the computed order, whole packs of a slab's cells first.
    pub fn apply<T: Real, const D: usize>(
        &mut self,
        slabs: &[Slab],
        particles: &mut Particles<T, D>,
        domains: &mut dyn Domains<T, D>,
    ) {
        let Self { from, cell, place, .. } = self;
        let cell = cell.as_flattened();
        for Slab { particles, .. } in slabs {
            let own = particles.clone();
            pack(&mut from[own.clone()], &cell[own.clone()], own.start, &mut place[own]);
        }
        domains.reorder(from);
        particles.reorder(from);
        self.place_ids(&particles.id);
    }
}

/// The number of halves and whole packs that `count` particles of a cell fill.
fn wholes(count: usize) -> usize {
    count / HALF + count / PACK
}

/// The number of groups of `N` adjacent particles in one cell.
fn of_one_cell<const N: usize>(cell: &[u32]) -> usize {
    let groups = cell.as_chunks::<N>().0.iter();
    groups.filter(|group| group.iter().all(|cell| *cell == group[0])).count()
}

/// Orders particles so that most packs, and most halves, lie in one cell: first the particles of each cell that fill whole
/// packs, then particles that fill half of one, then the others. The first place has the index `start`; packs begin at every
/// eighth place.
fn pack(order: &mut [u32], cell: &[u32], start: usize, scratch: &mut [u32]) {
    /// The numbers of a cell's particles that fill packs, halves of packs, and neither.
    fn shares(count: usize) -> [usize; 3] {
        let [packed, halved] = [count / PACK * PACK, count / HALF * HALF];
        [packed, halved - packed, count - halved]
    }
    let cells = || cell.chunk_by(|a, b| a == b).map(|cell| shares(cell.len()));
    let mut whole = [0, 1, 2].map(|share| cells().map(|shares| shares[share]).sum::<usize>());
    // The places before the first pack receive others, then halves, then packs. If this breaks a group, its rest moves to the
    // end.
    let mut lead = start.next_multiple_of(PACK) - start;
    let (mut front, mut back) = (0, order.len());
    let mut places = [const { [0..0, 0..0, 0..0] }; 3];
    for (share, group) in [(2, 1), (1, HALF), (0, PACK)] {
        let leading = lead.min(whole[share]);
        let rest = leading.next_multiple_of(group) - leading;
        places[share][0] = front..front + leading;
        places[share][1] = back - rest..back;
        (front, back, lead) = (front + leading, back - rest, lead - leading);
        whole[share] -= leading + rest;
    }
    for share in 0..3 {
        places[share][2] = front..front + whole[share];
        front += whole[share];
    }
    let mut places = places.map(|ranges| ranges.into_iter().flatten());
    let mut particles = order.iter();
    for shares in cells() {
        for (share, count) in shares.into_iter().enumerate() {
            for (particle, place) in particles.by_ref().take(count).zip(&mut places[share]) {
                scratch[place] = *particle;
            }
        }
    }
    order.copy_from_slice(scratch);
}

#[cfg(test)]
mod tests {
    use super::{HALF, PACK, ParticleOrder, of_one_cell, pack, wholes};

    #[test]
    fn packs_are_of_one_cell_as_far_as_there_are_enough() {
        let cell: Vec<u32> =
            [(0, 9), (1, 4), (2, 2), (3, 13)].iter().flat_map(|&(c, n)| vec![c; n]).collect();
        let mut order: Vec<u32> = (20..48).collect();
        pack(&mut order, &cell, 6, &mut [0; 28]);
        // Two others, the packs of the first and the last cell, halves of packs, others.
        let expected: Vec<u32> = [28..29, 33..34, 20..28, 35..43, 29..33, 43..47, 34..35, 47..48]
            .into_iter()
            .flatten()
            .collect();
        assert_eq!(order, expected);

        // Halves of packs go before the first pack where others are too few.
        let cell: Vec<u32> = [(0, 12), (1, 8)].iter().flat_map(|&(c, n)| vec![c; n]).collect();
        let mut order: Vec<u32> = (0..20).collect();
        pack(&mut order, &cell, 12, &mut [0; 20]);
        let expected: Vec<u32> = [8..12, 0..8, 12..20].into_iter().flatten().collect();
        assert_eq!(order, expected);
    }

    #[test]
    fn an_order_of_cells_keeps_that_of_their_particles() {
        let mut order = ParticleOrder::of_cells(&[3, 0, 3, 1, 0, 3]);
        order.count = vec![2, 1, 0, 3];
        order.arrange();
        assert_eq!(order.from, [1, 4, 3, 0, 2, 5]);
        assert_eq!(order.cells(), [0, 0, 1, 3, 3, 3]);
    }

    #[test]
    fn an_order_is_loose_when_packs_are_of_many_cells() {
        let mut cell: Vec<u32> = (0..320).map(|p| p / 8).collect();
        let is_loose = |cell: &[u32]| {
            let order = ParticleOrder { count: vec![8; 40], ..ParticleOrder::of_cells(cell) };
            order.is_loose()
        };
        assert!(!is_loose(&cell));
        // Two packs and two halves of 120 are missing, then four and four.
        cell.swap(0, 8);
        assert!(!is_loose(&cell));
        cell.swap(16, 24);
        assert!(is_loose(&cell));
    }

    #[test]
    fn wherever_a_slab_begins_packs_are_of_one_cell() {
        for counts in [vec![8; 9], vec![4; 20], vec![12; 7], vec![9; 8], vec![13; 5]] {
            let cells = (0..).zip(&counts);
            let cell: Vec<u32> = cells.flat_map(|(c, &n)| vec![c; n]).collect();
            let of = |p: u32| cell[p as usize];
            for start in 0..PACK {
                let mut order: Vec<u32> = (0..cell.len() as u32).collect();
                let sorted = order.clone();
                pack(&mut order, &cell, start, &mut vec![0; cell.len()]);
                // The places in a row, after a number of particles of another slab.
                let others = u32::MAX - start as u32;
                let place_ids: Vec<u32> =
                    (others..).take(start).chain(order.iter().map(|p| of(*p))).collect();
                let could: usize = counts.iter().map(|&count| wholes(count)).sum();
                let are = of_one_cell::<HALF>(&place_ids) + of_one_cell::<PACK>(&place_ids);
                // The particles before the first pack break at most one pack of a cell, with its halves.
                assert!(are + 3 >= could, "{start}, {counts:?}: {are} of {could}");
                order.sort_unstable();
                assert_eq!(order, sorted);
            }
        }
    }
}
