//! Slabs: the order of the particles, and the sets of particles that may be added to the nodes at the same time.
//!
//! Particles are ordered by the cells they were in when they were sorted. The layers of cells along the last axis are cut into
//! slabs with about as many particles each, also within a layer. The particles of a slab are adjacent, and the nodes that they
//! can reach are a window of the grid's arrays. Windows of every other slab do not overlap, and so threads process these slabs
//! at the same time: first the even ones, then the odd ones, of which there are as many. Updates of nodes and particles are cut
//! into parts. Sums onto nodes have one order for any number of threads.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::sorting::{ParticleOrder, When};
use super::weights::Domains;
use crate::column::PACK;
use crate::lattice::Lattice;
use crate::nodal::{Nodal, Window};
use crate::particle::Particles;
use crate::real::Real;
use crate::stencil::{ALL, Members};
use crate::threads::both;

/// Layers of nodes before and after a layer of cells that a particle in it may reach, for any origin of cells.
const REACH: [usize; 2] = [2, 3];

/// The number of layers that a particle may drift before all particles are sorted.
const DRIFT: usize = 1;

/// The least number of whole layers of an inner slab.
const FEWEST_LAYERS: usize = REACH[0] + REACH[1] + 2 * DRIFT;

/// The largest number of slabs.
const MOST_SLABS: usize = 64;

/// Fewer particles than this are one slab, and are not sorted.
const FEWEST_PARTICLES: usize = 4096;

/// Particles, and the nodes that they may reach.
pub(super) struct Slab {
    pub particles: Range<usize>,
    /// Indices of nodes.
    pub window: Range<usize>,
}

impl Slab {
    /// The particles of a pack that belong to the slab; `first` is the pack's first particle.
    #[inline(always)]
    pub fn members(&self, first: usize) -> Members {
        let Range { start, end } = self.particles;
        if start <= first && first + PACK <= end {
            return ALL;
        }
        [start, end].map(|p| p.clamp(first, first + PACK) - first)
    }
}

/// The cut between a slab and the next one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Cut {
    /// The layer of the first particle after the cut.
    from: usize,
    /// One layer beyond the layer of the last particle before the cut. It differs from `from` if the cut is within a layer.
    until: usize,
    /// The number of particles before the cut.
    particle: usize,
}

/// The work for a slab, with its part of two arrays of nodes.
type SlabWork<'a, T, R, E> = dyn Fn(&Slab, [Window<'_, T>; 2]) -> Result<R, E> + Sync + 'a;

/// All slabs, and the order of the particles.
pub(super) struct Slabs {
    pub all: Vec<Slab>,
    /// The cuts before each slab except the first one. Has capacity for the largest number of slabs.
    cuts: Vec<Cut>,
    /// The number of nodes of a layer, and the number of layers.
    layer: usize,
    layers: usize,
    pub order: ParticleOrder,
}

impl Slabs {
    /// One slab of unsorted particles. They are never sorted if they are few, or if their stencils are not `near`.
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
            order: ParticleOrder::new(sorted, lattice.len()),
        };
        slabs.cut(particles);
        slabs
    }

    /// The cuts between the slabs.
    pub fn cuts(&self) -> &[Cut] {
        &self.cuts
    }

    /// Makes slabs of `particles` by these cuts, if they are valid; returns whether they are.
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
        if !fit || self.order.is_fixed() && !cuts.is_empty() {
            return false;
        }
        self.cuts.clear();
        self.cuts.extend_from_slice(cuts);
        self.cut(particles);
        true
    }

    /// Makes slabs of `particles` by the cuts.
    fn cut(&mut self, particles: usize) {
        let Self { all, cuts, layer, layers, .. } = self;
        let last = cuts.len();
        // The layers by which the particles of the neighbours of an inner slab may drift into it.
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

    /// Sorts the particles, with their `domains`, by the cells of their present positions, or of X if the body does not move
    /// through the grid (`moves`). The first cell begins at the coordinate `origin`, in units of cells.
    pub fn sort<T: Real, const D: usize>(
        &mut self,
        lattice: &Lattice<T, D>,
        origin: f64,
        particles: &mut Particles<T, D>,
        domains: &mut dyn Domains<T, D>,
        moves: bool,
        when: When,
    ) {
        if self.order.is_fixed() {
            return;
        }
        self.order.locate(lattice, origin, particles, moves);
        if when == When::Now || self.order.is_loose() {
            self.order.arrange();
            self.cut_evenly();
            self.order.apply(&self.all, particles, domains);
        }
    }

    /// Cuts the particles into an even number of slabs with equal numbers of particles, to within the particles of one cell;
    /// into three slabs if the layers are too few, and into one if there are hardly any.
    fn cut_evenly(&mut self) {
        let Self { cuts, order, layer: nodes, .. } = self;
        let cell = order.cells();
        let particles = cell.len();
        let layer = |p: usize| cell[p] as usize / *nodes;
        let (first, last) = (layer(0), layer(particles - 1));
        let number = match last + 1 - first {
            few if few < FEWEST_LAYERS + 2 => 1,
            some if some < 4 * FEWEST_LAYERS => 3,
            // One layer more than the fewest for each slab, so that a cut can be within a layer.
            many => (many / (FEWEST_LAYERS + 1)).clamp(4, MOST_SLABS) / 2 * 2,
        };
        let begin = |of: u32| cell.partition_point(|&cell| cell < of);
        let between =
            |layer| Cut { from: layer, until: layer, particle: begin((layer * *nodes) as u32) };
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
    /// The error of the first slab that has one.
    pub fn each<T, R, E>(
        &self,
        nodes: [&mut [Nodal<T>]; 2],
        work: &SlabWork<'_, T, R, E>,
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
        work: &SlabWork<'_, T, R, E>,
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
    use super::super::sorting::ParticleOrder;
    use super::{Cut, REACH, Slabs};

    /// Slabs of layers with these numbers of particles, beginning with layer 5, in rows of ten cells with equal numbers.
    fn slabs(particles_of_layers: &[usize]) -> Slabs {
        let cells = particles_of_layers.iter().zip(5_u32..);
        let layer =
            |(&count, layer)| (0..count as u32).map(move |k| 10 * layer + 10 * k / count as u32);
        let cell: Vec<u32> = cells.flat_map(layer).collect();
        let order = ParticleOrder::of_cells(&cell);
        let layers = particles_of_layers.len() + 10;
        let mut slabs = Slabs { all: Vec::new(), cuts: Vec::new(), layer: 10, layers, order };
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
                for &cell in &slabs.order.cells()[slab.particles.clone()] {
                    let layer = cell as usize / 10;
                    let reach = 10 * (layer - REACH[0])..10 * (layer + REACH[1] + 1);
                    assert!(slab.window.start <= reach.start && reach.end <= slab.window.end);
                }
            }
            assert_eq!(next, slabs.order.cells().len());
            if layers.iter().all(|&count| count == 100) && layers.len() > 28 {
                let fair = slabs.order.cells().len() / number;
                assert!(all.iter().all(|slab| slab.particles.len().abs_diff(fair) <= 11));
            }
        }
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
