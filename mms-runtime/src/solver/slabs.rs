//! The order of the particles, and which of them may be added to the nodes at the same time.
//!
//! The layers of cells along the last axis are cut into slabs. Particles stand in the order of the cells they
//! were in when they were sorted, so that those of a slab stand together; the nodes that they can reach are a
//! window of the grid's arrays. Windows of every other slab do not overlap, and so those are worked on at the
//! same time: first the even ones, then the odd ones. Sums onto nodes have one order whatever the number of
//! threads is.

use std::ops::Range;

use crate::nodal::{Nodal, Window};
use crate::particle::{Particles, reorder};
use crate::{Lattice, Real, Vector};

/// At least so many layers in a slab, and ...
const FEWEST_LAYERS: usize = 8;

/// ... at most so many slabs.
const MOST_SLABS: usize = 64;

/// For fewer particles than this there is one slab.
const FEWEST_PARTICLES: usize = 4096;

/// Layers of nodes, from the first to the last that a particle in one layer of cells may reach.
const REACH: [usize; 2] = [1, 3];

/// Particles, and the nodes that they may reach.
pub(super) struct Slab {
    pub particles: Range<usize>,
    /// Indices of nodes.
    pub window: Range<usize>,
}

/// What is done for a slab, with its part of two arrays of nodes.
type Work<'a, T, R, E> = dyn Fn(&Slab, [Window<'_, T>; 2]) -> Result<R, E> + Sync + 'a;

/// All slabs, and the order of the particles.
pub(super) struct Slabs {
    pub all: Vec<Slab>,
    /// Layers of a slab.
    thickness: usize,
    /// Where each particle is, by its number; empty if they are in their first order.
    place: Vec<u32>,
    order: Vec<u32>,
    /// The cell of each particle.
    cell: Vec<u64>,
}

impl Slabs {
    /// Slabs of a grid, not yet with particles. Stencils that are not `near` make it one slab.
    pub fn new<T: Real, const D: usize>(
        lattice: &Lattice<T, D>,
        particles: usize,
        near: bool,
    ) -> Self {
        let layers = lattice.count[D - 1];
        let thickness = layers.div_ceil(MOST_SLABS).max(FEWEST_LAYERS);
        let slabs = layers / thickness;
        let stride = lattice.stride[D - 1];
        if slabs < 3 || particles < FEWEST_PARTICLES || !near {
            let slab = Slab { particles: 0..particles, window: 0..lattice.len() };
            let (place, order, cell) = (Vec::new(), Vec::new(), Vec::new());
            return Self { all: vec![slab], thickness: usize::MAX, place, order, cell };
        }
        // Windows are two slabs wide. What is left of that, particles may drift.
        let drift = (thickness - REACH[0] - REACH[1]) / 2;
        let slab = |s: usize| {
            let (from, to) = (s * thickness, (s + 1) * thickness);
            let before = from.saturating_sub(drift + REACH[0]);
            let is_last = s + 1 == slabs;
            let after = if is_last { layers } else { to + drift + REACH[1] };
            Slab { particles: 0..0, window: before * stride..after * stride }
        };
        Self {
            all: (0..slabs).map(slab).collect(),
            thickness,
            place: (0..particles as u32).collect(),
            order: (0..particles as u32).collect(),
            cell: vec![0; particles],
        }
    }

    /// Where the particle of that number is.
    pub fn place_of(&self, id: usize) -> usize {
        self.place.get(id).map_or(id, |&place| place as usize)
    }

    /// Where the particles of each slab end.
    pub fn ends(&self) -> Vec<usize> {
        self.all.iter().map(|slab| slab.particles.end).collect()
    }

    /// Takes the particles of each slab from where they end, if `ends` divide so many.
    pub fn accept(&mut self, ends: &[usize], particles: usize) -> bool {
        let divides = ends.is_sorted() && ends.last() == Some(&particles);
        if ends.len() != self.all.len() || !divides {
            return false;
        }
        let mut first = 0;
        for (slab, &end) in self.all.iter_mut().zip(ends) {
            slab.particles = first..end;
            first = end;
        }
        true
    }

    /// Remembers where each particle stands, where they do not stand in their first order.
    pub fn stand(&mut self, ids: &[u32]) {
        if self.all.len() > 1 {
            ids.iter().zip(0..).for_each(|(&id, p)| self.place[id as usize] = p);
        }
    }

    /// Sorts the particles, with their `domains` and `weights` if there are such, by the cells of their positions.
    pub fn sort<T: Real, V, W, const D: usize>(
        &mut self,
        lattice: &Lattice<T, D>,
        particles: &mut Particles<T, D>,
        domains: &mut [V],
        weights: &mut [W],
        position: impl Fn(&Particles<T, D>, usize) -> Vector<T, D>,
    ) {
        if self.all.len() == 1 {
            return;
        }
        for (p, cell) in self.cell.iter_mut().enumerate() {
            let cells = lattice.in_cells(&position(particles, p));
            let along = |a: usize| (cells[a].to_f64().max(0.0) as usize).min(lattice.count[a] - 1);
            *cell = (0..D).map(|a| along(a) * lattice.stride[a]).sum::<usize>() as u64;
        }
        let Self { order, cell, .. } = self;
        arrange(order, cell, &particles.id);
        reorder(cell, order);
        reorder(domains, order);
        reorder(weights, order);
        particles.reorder(order);
        self.stand(&particles.id);
        let stride = lattice.stride[D - 1] as u64;
        let mut first = 0;
        let slabs = self.all.len();
        for (s, slab) in self.all.iter_mut().enumerate() {
            let next = ((s + 1) * self.thickness) as u64 * stride;
            let after = self.cell.partition_point(|&cell| cell < next);
            slab.particles = first..if s + 1 == slabs { self.cell.len() } else { after };
            first = slab.particles.end;
        }
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
        let (first, second) = super::threads::both(
            || self.each(numbers.start..middle, before, work, join),
            || self.each(middle..numbers.end, after, work, join),
        );
        Ok(join(first?, second?))
    }
}
