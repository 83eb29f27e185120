//! The order of the particles, and which of them may be added to the nodes at the same time.
//!
//! Particles stand in the order of the cells they were in when they were sorted: in a slab first those that make a bunch
//! with others of their cell, then those that make half of one, then the others. The layers of cells along the last
//! axis are cut into slabs with as many particles each, also within a layer; they stand together, and the nodes that
//! they can reach are a window of the grid's arrays. Windows of every other slab do not overlap, and so those are worked on at the
//! same time: first the even ones, then the odd ones, of which there are as many. Sums onto nodes have one order
//! whatever the number of threads is.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::column::{Bunch, Bunches};
use crate::nodal::{Nodal, Window};
use crate::particle::{Particles, reorder, reorder_bunches};
use crate::stencil::{ALL, BUNCH, HALF, Members};
use crate::threads::both;
use crate::{Lattice, Real, Vector};

/// Layers of nodes before and after a layer of cells that a particle in it may reach, wherever cells begin.
const REACH: [usize; 2] = [2, 3];

/// Layers that particles may at least drift before they have to be sorted.
const DRIFT: usize = 1;

/// At least so many layers that an inner slab has alone, and ...
const FEWEST_LAYERS: usize = REACH[0] + REACH[1] + 2 * DRIFT;

/// ... at most so many slabs.
const MOST_SLABS: usize = 64;

/// Fewer particles than this are one slab, and stand as they are.
const FEWEST_PARTICLES: usize = 4096;

/// Particles, and the nodes that they may reach.
pub(super) struct Slab {
    pub particles: Range<usize>,
    /// Indices of nodes.
    pub window: Range<usize>,
}

impl Slab {
    /// Which particles of a bunch are its own, by the first one of the bunch.
    #[inline(always)]
    pub fn members(&self, first: usize) -> Members {
        let Range { start, end } = self.particles;
        if start <= first && first + BUNCH <= end {
            return ALL;
        }
        [start, end].map(|p| p.clamp(first, first + BUNCH) - first)
    }
}

/// Where a slab ends and the next one begins.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Cut {
    /// The layer of the first particle after it.
    from: usize,
    /// Behind the layer of the last particle before it: another one if the cut is within a layer.
    until: usize,
    /// How many particles are before it.
    particle: usize,
}

/// What is done for a slab, with its part of two arrays of nodes.
type Work<'a, T, R, E> = dyn Fn(&Slab, [Window<'_, T>; 2]) -> Result<R, E> + Sync + 'a;

/// All slabs, and the order of the particles.
pub(super) struct Slabs {
    pub all: Vec<Slab>,
    /// What each slab but the first one begins with. There is room for the most slabs.
    cuts: Vec<Cut>,
    /// Nodes of a layer, and how many layers there are.
    layer: usize,
    layers: usize,
    /// Where each particle is, by its number; empty if they are in their first order.
    place: Vec<u32>,
    order: Vec<u32>,
    /// The cell of each particle.
    cell: Vec<u64>,
}

impl Slabs {
    /// One slab, of particles that are not yet sorted, and never are if there are few or if their stencils are not
    /// `near`.
    pub fn new<T: Real, const D: usize>(
        lattice: &Lattice<T, D>,
        particles: usize,
        near: bool,
    ) -> Self {
        let sorted = if near && particles >= FEWEST_PARTICLES { particles } else { 0 };
        let mut slabs = Self {
            all: Vec::with_capacity(MOST_SLABS),
            cuts: Vec::with_capacity(MOST_SLABS),
            layer: lattice.stride[D - 1],
            layers: lattice.count[D - 1],
            place: (0..sorted as u32).collect(),
            order: (0..sorted as u32).collect(),
            cell: vec![0; sorted],
        };
        slabs.cut(particles);
        slabs
    }

    /// Where the particle of that number is.
    pub fn place_of(&self, id: usize) -> usize {
        self.place.get(id).map_or(id, |&place| place as usize)
    }

    /// What slabs begin with, but for the first one.
    pub fn cuts(&self) -> &[Cut] {
        &self.cuts
    }

    /// Takes the slabs that these cuts make of so many particles, if there may be such.
    pub fn accept(&mut self, cuts: &[Cut], particles: usize) -> bool {
        let apart = |pair: &[Cut]| {
            pair[0].until.checked_add(FEWEST_LAYERS).is_some_and(|least| least <= pair[1].from)
                && pair[0].particle <= pair[1].particle
        };
        let within = |cut: &Cut| {
            let thick = cut.until.checked_sub(cut.from);
            thick.is_some_and(|thick| thick <= 1)
                && cut.until <= self.layers
                && cut.particle <= particles
        };
        let fit = cuts.windows(2).all(apart) && cuts.iter().all(within);
        if !fit || self.place.is_empty() && !cuts.is_empty() {
            return false;
        }
        self.cuts.clear();
        self.cuts.extend_from_slice(cuts);
        self.cut(particles);
        true
    }

    /// Makes slabs of so many particles.
    fn cut(&mut self, particles: usize) {
        let Self { all, cuts, layer, layers, .. } = self;
        let last = cuts.len();
        // How far the particles of the neighbours of an inner slab may drift into it.
        let drift = |s: usize| (cuts[s].from - cuts[s - 1].until - REACH[0] - REACH[1]) / 2;
        let slab = |s: usize| {
            let before = if s > 1 { cuts[s - 1].from - REACH[0] - drift(s - 1) } else { 0 };
            let after =
                if s + 1 < last { cuts[s].until + REACH[1] + drift(s + 1) } else { *layers };
            let from = if s > 0 { cuts[s - 1].particle } else { 0 };
            let to = if s < last { cuts[s].particle } else { particles };
            let after = after.min(*layers);
            Slab { particles: from..to, window: before * *layer..after * *layer }
        };
        all.clear();
        all.extend((0..=last).map(slab));
    }

    /// Remembers where each particle stands, where they do not stand in their first order.
    pub fn stand(&mut self, ids: &[u32]) {
        if !self.place.is_empty() {
            ids.iter().zip(0..).for_each(|(&id, p)| self.place[id as usize] = p);
        }
    }

    /// Sorts the particles, with their `domains`, by the cells of their positions from an origin, in cells.
    pub fn sort<T: Real, B: Bunch, const D: usize>(
        &mut self,
        lattice: &Lattice<T, D>,
        origin: f64,
        particles: &mut Particles<T, D>,
        domains: &mut Bunches<B>,
        position: impl Fn(&Particles<T, D>, usize) -> Vector<T, D>,
    ) {
        if self.place.is_empty() {
            return;
        }
        for (p, cell) in self.cell.iter_mut().enumerate() {
            let cells = lattice.in_cells(&position(particles, p));
            let from_origin = |a: usize| (cells[a].to_f64() - origin).max(0.0) as usize;
            let along = |a: usize| from_origin(a).min(lattice.count[a] - 1);
            *cell = (0..D).map(|a| along(a) * lattice.stride[a]).sum::<usize>() as u64;
        }
        let Self { order, cell, .. } = self;
        arrange(order, cell, &particles.id);
        reorder(cell, order);
        self.cut_evenly();
        let Self { all, order, cell, place, .. } = self;
        for Slab { particles, .. } in all {
            let own = particles.clone();
            bunch(&mut order[own.clone()], &cell[own.clone()], own.start, &mut place[own]);
        }
        reorder_bunches(domains, order);
        domains.fill_up();
        particles.reorder(order);
        self.stand(&particles.id);
    }

    /// Makes an even number of slabs with as many particles each, to a cell; three, where there are too few layers.
    fn cut_evenly(&mut self) {
        let Self { cuts, cell, layer: nodes, .. } = self;
        let particles = cell.len();
        let layer = |p: usize| cell[p] as usize / *nodes;
        let (first, last) = (layer(0), layer(particles - 1));
        let number = match last + 1 - first {
            few if few < FEWEST_LAYERS + 2 => 1,
            some if some < 4 * FEWEST_LAYERS => 3,
            // A cut within a layer takes one more.
            many => (many / (FEWEST_LAYERS + 1)).clamp(4, MOST_SLABS) / 2 * 2,
        };
        let begin = |of: u64| cell.partition_point(|&cell| cell < of);
        let between =
            |layer| Cut { from: layer, until: layer, particle: begin((layer * *nodes) as u64) };
        cuts.clear();
        for s in 1..number {
            let least = cuts.last().map_or(first + 1, |cut| cut.until + FEWEST_LAYERS);
            let most = last - (number - 1 - s) * FEWEST_LAYERS;
            let fair = cell[s * particles / number];
            let from = fair as usize / *nodes;
            // There are particles before that layer.
            let cut = if from < least {
                between(least)
            } else {
                let particle = begin(fair);
                let until = from + usize::from(layer(particle - 1) == from);
                if until <= most { Cut { from, until, particle } } else { between(most) }
            };
            cuts.push(cut);
        }
        self.cut(particles);
    }

    /// Does `work` for every slab, with its part of the nodes.
    ///
    /// # Errors
    /// What the first slab that has an error has.
    pub fn each<T, R, E>(
        &self,
        nodes: [&mut [Nodal<T>]; 2],
        work: &Work<'_, T, R, E>,
        join: &(dyn Fn(R, R) -> R + Sync),
    ) -> Result<R, E>
    where
        T: Real,
        R: Default + Send,
        E: Send,
    {
        let mut done = R::default();
        let [first, second] = nodes;
        for colour in 0..self.all.len().min(2) {
            let nodes = [&mut *first, &mut *second].map(|nodes| Window { start: 0, nodes });
            let colour = Colour { slabs: &self.all, colour };
            let part = colour.each(0..colour.len(), nodes, work, join)?;
            done = join(done, part);
        }
        Ok(done)
    }
}

/// The order of the particles by their cells, and within a cell by their numbers.
fn arrange(order: &mut [u32], cell: &[u64], id: &[u32]) {
    order.iter_mut().zip(0..).for_each(|(from, p)| *from = p);
    order.sort_unstable_by_key(|&p| (cell[p as usize], id[p as usize]));
}

/// Puts those of each cell that make a bunch first, then those that make half of one, then the others, so that most
/// bunches are of one cell, and most halves. The first place has the number `start`; bunches begin at every eighth.
fn bunch(order: &mut [u32], cell: &[u64], start: usize, scratch: &mut [u32]) {
    /// How many of a cell's particles make bunches, halves of bunches, and neither.
    fn shares(count: usize) -> [usize; 3] {
        let [bunched, halved] = [count / BUNCH * BUNCH, count / HALF * HALF];
        [bunched, halved - bunched, count - halved]
    }
    let cells = || cell.chunk_by(|a, b| a == b).map(|cell| shares(cell.len()));
    let total = |share: usize| cells().map(|shares| shares[share]).sum::<usize>();
    let [bunched, halved, others] = [total(0), total(1), total(2)];
    // Before the first bunch stands what there is, others first.
    let lead = start.next_multiple_of(BUNCH) - start;
    let lead = [lead.min(others), lead.saturating_sub(others).min(halved)];
    let lead_end = lead[0] + lead[1];
    // Where the next of each kind goes. Those that lead go on behind the bunches.
    let mut next = [lead_end, lead[0], 0];
    let leads_until = [usize::MAX, lead_end, lead[0]];
    let behind = [0, lead_end + bunched, lead[0] + bunched + halved];
    let mut from = 0;
    for shares in cells() {
        for (share, count) in shares.into_iter().enumerate() {
            for &particle in &order[from..from + count] {
                if next[share] == leads_until[share] {
                    next[share] = behind[share];
                }
                scratch[next[share]] = particle;
                next[share] += 1;
            }
            from += count;
        }
    }
    order.copy_from_slice(scratch);
}

/// Every other slab.
struct Colour<'a> {
    slabs: &'a [Slab],
    colour: usize,
}

impl Colour<'_> {
    fn len(&self) -> usize {
        (self.slabs.len() - self.colour).div_ceil(2)
    }

    fn get(&self, number: usize) -> &Slab {
        &self.slabs[2 * number + self.colour]
    }

    fn each<T: Real, R: Send, E: Send>(
        &self,
        numbers: Range<usize>,
        nodes: [Window<'_, T>; 2],
        work: &Work<'_, T, R, E>,
        join: &(dyn Fn(R, R) -> R + Sync),
    ) -> Result<R, E> {
        if numbers.len() == 1 {
            let slab = self.get(numbers.start);
            let own = nodes.map(|nodes| {
                let [_, own] = nodes.split(slab.window.start);
                let [own, _] = own.split(slab.window.end);
                own
            });
            return work(slab, own);
        }
        let middle = numbers.start + numbers.len() / 2;
        let at = self.get(middle).window.start;
        let [[before, after], [more_before, more_after]] = nodes.map(|nodes| nodes.split(at));
        let (before, after) = ([before, more_before], [after, more_after]);
        let (first, second) = both(
            || self.each(numbers.start..middle, before, work, join),
            || self.each(middle..numbers.end, after, work, join),
        );
        Ok(join(first?, second?))
    }
}

#[cfg(test)]
mod tests {
    use super::{Cut, REACH, Slabs, bunch};

    /// Of layers with so many particles each, beginning with layer 5, in rows of ten cells with as many.
    fn slabs(particles_of_layers: &[usize]) -> Slabs {
        let cells = particles_of_layers.iter().zip(5_u64..);
        let layer =
            |(&count, layer)| (0..count as u64).map(move |k| 10 * layer + 10 * k / count as u64);
        let cell: Vec<u64> = cells.flat_map(layer).collect();
        let count = cell.len() as u32;
        let (place, order): (Vec<_>, Vec<_>) = ((0..count).collect(), (0..count).collect());
        let layers = particles_of_layers.len() + 10;
        let mut slabs =
            Slabs { all: Vec::new(), cuts: Vec::new(), layer: 10, layers, place, order, cell };
        slabs.cut_evenly();
        slabs
    }

    #[test]
    fn slabs_have_their_nodes_alone_and_particles_alike() {
        let thin_at_the_ends = [&[1; 20][..], &[500; 30], &[1; 20]].concat();
        for layers in [vec![100; 9], vec![100; 31], vec![100; 200], thin_at_the_ends] {
            let slabs = slabs(&layers);
            let (all, number) = (&slabs.all, slabs.all.len());
            assert_eq!(number, if layers.len() < 28 { 3 } else { number / 2 * 2 });
            assert_eq!((all[0].window.start, all[number - 1].window.end), (0, 10 * slabs.layers));
            for pair in all.windows(3) {
                assert!(pair[0].window.end <= pair[2].window.start);
            }
            let mut next = 0;
            for slab in all {
                assert_eq!(slab.particles.start, next);
                next = slab.particles.end;
                for &cell in &slabs.cell[slab.particles.clone()] {
                    let layer = cell as usize / 10;
                    let reach = 10 * (layer - REACH[0])..10 * (layer + REACH[1] + 1);
                    assert!(slab.window.start <= reach.start && reach.end <= slab.window.end);
                }
            }
            assert_eq!(next, slabs.cell.len());
            if layers.iter().all(|&count| count == 100) && layers.len() > 28 {
                let fair = slabs.cell.len() / number;
                assert!(all.iter().all(|slab| slab.particles.len().abs_diff(fair) <= 11));
            }
        }
    }

    #[test]
    fn bunches_are_of_one_cell_as_far_as_there_are_enough() {
        let cell: Vec<u64> =
            [(0, 9), (1, 4), (2, 2), (3, 13)].iter().flat_map(|&(c, n)| vec![c; n]).collect();
        let mut order: Vec<u32> = (20..48).collect();
        bunch(&mut order, &cell, 6, &mut [0; 28]);
        // Two others, the bunches of the first and the last cell, halves of bunches, others.
        let expected: Vec<u32> = [28..29, 33..34, 20..28, 35..43, 29..33, 43..47, 34..35, 47..48]
            .into_iter()
            .flatten()
            .collect();
        assert_eq!(order, expected);

        // Halves of bunches go before the first bunch where others are too few.
        let cell: Vec<u64> = [(0, 12), (1, 8)].iter().flat_map(|&(c, n)| vec![c; n]).collect();
        let mut order: Vec<u32> = (0..20).collect();
        bunch(&mut order, &cell, 12, &mut [0; 20]);
        let expected: Vec<u32> = [8..12, 0..8, 12..20].into_iter().flatten().collect();
        assert_eq!(order, expected);
    }

    #[test]
    fn cuts_that_slabs_cannot_have_are_refused() {
        let mut slabs = slabs(&[100; 31]);
        let cuts = slabs.cuts().to_vec();
        let windows: Vec<_> = slabs.all.iter().map(|slab| slab.window.clone()).collect();
        assert!(slabs.accept(&cuts, 3100));
        assert!(slabs.all.iter().zip(&windows).all(|(slab, window)| slab.window == *window));
        let cut = |from, until, particle| Cut { from, until, particle };
        for wrong in [
            vec![cut(9, 9, 100), cut(15, 15, 200)],
            vec![cut(9, 10, 100), cut(16, 16, 200)],
            vec![cut(9, 9, 200), cut(20, 20, 100)],
            vec![cut(60, 60, 100)],
            vec![cut(9, 8, 100)],
            vec![cut(9, 11, 100)],
            vec![cut(9, usize::MAX, 100)],
            vec![cut(9, 9, 3101)],
        ] {
            assert!(!slabs.accept(&wrong, 3100), "{wrong:?}");
        }
    }
}
