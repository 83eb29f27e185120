//! A mesh: its cells of full dimension, their sizes and middles, and the edges that one cell alone has.

use crate::Cells;
use crate::cell::Shape;
use crate::norm::length;

/// A mesh in the reference configuration.
#[derive(Clone, Copy, Debug)]
pub struct Mesh<'a> {
    /// Its cells; those of a lower dimension than its own are left out.
    pub cells: &'a Cells,
    /// X of its points, one after the other.
    pub points: &'a [f64],
    /// Its dimension.
    pub dimension: usize,
}

impl<'a> Mesh<'a> {
    /// Cells of the dimension of the mesh, by their positions.
    pub fn full(&self) -> impl Iterator<Item = (usize, &'static Shape, &'a [usize])> {
        let dimension = self.dimension;
        self.cells.iter().enumerate().filter_map(move |(cell, (kind, points))| {
            let shape = Shape::of(kind).filter(|shape| shape.dimension == dimension)?;
            (shape.nodes.len() == points.len()).then_some((cell, shape, points))
        })
    }

    /// The types of cells that may be of the dimension of the mesh, and are not known.
    pub fn unknown(&self) -> Option<u8> {
        let lines = [1, 2, 4];
        self.cells
            .types
            .iter()
            .copied()
            .find(|kind| Shape::of(*kind).is_none() && !lines.contains(kind))
    }

    /// The lowest degree of its cells, if there are such.
    pub fn degree(&self) -> Option<u32> {
        self.full().map(|(_, shape, _)| shape.degree()).min()
    }

    pub(crate) fn point(&self, point: usize) -> &'a [f64] {
        &self.points[point * self.dimension..][..self.dimension]
    }

    /// The shortest and the longest of the longest edges of the cells; `None` where there are none of full dimension.
    pub fn sizes(&self) -> Option<[f64; 2]> {
        let longest = |(_, shape, points): (usize, &'static Shape, &[usize])| {
            let edges = shape.edges().into_iter();
            edges
                .map(|[a, b]| length(self.point(points[a]), self.point(points[b])))
                .fold(0.0, f64::max)
        };
        let both = |range: Option<[f64; 2]>, size: f64| {
            Some(range.map_or([size; 2], |[least, most]| [least.min(size), most.max(size)]))
        };
        self.full().map(longest).fold(None, both)
    }

    /// X at the middle of the reference cell of each, of all cells of full dimension.
    pub fn middles(&self) -> Vec<f64> {
        let middle = |(_, shape, points): (usize, &'static Shape, &'a [usize])| {
            let values = shape.values(shape.middle());
            let of = move |axis| {
                points.iter().zip(&values).map(|(&point, n)| n * self.point(point)[axis]).sum()
            };
            (0..self.dimension).map(of).collect::<Vec<f64>>()
        };
        self.full().flat_map(middle).collect()
    }

    /// How far the cells around inner edges are out of balance: the distance from the middle of an edge to the mean of the
    /// middles of its cells, over its length, as a root mean square. It is 0 where cells are copies and half turns of each
    /// other. `is_inner` tells whether the middle of an edge lies within the body. `None` without such an edge.
    pub fn imbalance(&self, is_inner: &dyn Fn(&[f64]) -> bool) -> Option<f64> {
        let dimension = self.dimension;
        let middles = self.middles();
        let mut edges = Vec::new();
        for (own, (_, shape, points)) in middles.chunks(dimension).zip(self.full()) {
            for ends in shape.edges() {
                edges.push((ends.map(|it| self.point(points[it])), own));
            }
        }
        edges.sort_by_cached_key(|(ends, _)| edge_key(*ends));
        let (mut sum, mut count) = (0.0, 0);
        for around in edges.chunk_by(|a, b| edge_key(a.0) == edge_key(b.0)) {
            let [a, b] = around[0].0;
            let middle: Vec<f64> = a.iter().zip(b).map(|(a, b)| (a + b) / 2.0).collect();
            if is_inner(&middle) {
                let mean = |axis: usize| {
                    around.iter().map(|(_, own)| own[axis]).sum::<f64>() / around.len() as f64
                };
                let mean: Vec<f64> = (0..dimension).map(mean).collect();
                sum += (length(&mean, &middle) / length(a, b)).powi(2);
                count += 1;
            }
        }
        (count > 0).then(|| (sum / f64::from(count)).sqrt())
    }

    /// Edges of cells in a plane that no other cell has, each as X of its ends and of the node between them, if there is
    /// one; of those with ends that are asked for.
    pub fn free_edges(&self, is_asked: &dyn Fn([&[f64]; 2]) -> bool) -> Vec<Vec<&'a [f64]>> {
        let mut found = Vec::new();
        for (_, shape, points) in self.full() {
            for ends @ [a, b] in shape.edges() {
                let places = ends.map(|it| self.point(points[it]));
                if is_asked(places) {
                    let middle =
                        [0, 1, 2].map(|at| (shape.nodes[a][at] + shape.nodes[b][at]) / 2.0);
                    let between = shape.nodes.iter().position(|it| *it == middle);
                    let between = between.map(|it| self.point(points[it]));
                    found.push(places.into_iter().chain(between).collect::<Vec<_>>());
                }
            }
        }
        let key = |edge: &Vec<&[f64]>| edge_key([edge[0], edge[1]]);
        found.sort_by_key(key);
        let alone = found.chunk_by(|a, b| key(a) == key(b)).filter(|it| it.len() == 1);
        alone.map(|it| it[0].clone()).collect()
    }
}

/// Tells an edge by its ends: pieces of a mesh have points of their own.
fn edge_key(ends: [&[f64]; 2]) -> [[u64; 3]; 2] {
    // -0 is 0.
    let bits = |x: &[f64]| [0, 1, 2].map(|axis| x.get(axis).map_or(0, |it| (it + 0.0).to_bits()));
    let mut ends = ends.map(bits);
    ends.sort_unstable();
    ends
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cells of one type over points of a square of 2 x 2 unit squares.
    fn imbalance(kind: u8, cells: &[&[usize]], middle: [f64; 2]) -> Option<f64> {
        let mut points: Vec<f64> =
            (0..9).flat_map(|at| [f64::from(at % 3), f64::from(at / 3)]).collect();
        points[8..10].copy_from_slice(&middle);
        let count = cells[0].len();
        let cells = Cells {
            types: vec![kind; cells.len()],
            points: cells.concat(),
            ends: (1..=cells.len()).map(|it| it * count).collect(),
        };
        let mesh = Mesh { cells: &cells, points: &points, dimension: 2 };
        mesh.imbalance(&|x| x.iter().all(|it| *it > 0.0 && *it < 2.0))
    }

    #[test]
    fn copies_and_half_turns_of_a_cell_are_in_balance() {
        let quads: [&[usize]; 4] = [&[0, 1, 4, 3], &[1, 2, 5, 4], &[3, 4, 7, 6], &[4, 5, 8, 7]];
        assert_eq!(imbalance(9, &quads, [1.0, 1.0]), Some(0.0));
        assert!(imbalance(9, &quads, [1.1, 1.0]).is_some_and(|it| it > 0.02));
        assert_eq!(
            imbalance(9, &quads[..1], [1.0, 1.0]),
            Some(0.5),
            "half of each edge is missing"
        );
        let one_way: Vec<[usize; 3]> =
            [0, 1, 3, 4].into_iter().flat_map(|a| [[a, a + 1, a + 4], [a, a + 4, a + 3]]).collect();
        let one_way: Vec<&[usize]> = one_way.iter().map(|it| &it[..]).collect();
        assert!(imbalance(5, &one_way, [1.0, 1.0]).is_some_and(|it| it < 1e-15));
        // Mirror images of each other at four of the edges: their middles are a third and not half of the way along it.
        let star: [&[usize]; 8] = [
            &[0, 1, 4],
            &[1, 2, 4],
            &[2, 5, 4],
            &[5, 8, 4],
            &[8, 7, 4],
            &[7, 6, 4],
            &[6, 3, 4],
            &[3, 0, 4],
        ];
        // Four of the eight inner edges are off by a sixth.
        let found = imbalance(5, &star, [1.0, 1.0]).expect("inner edges");
        assert!((found - 72f64.powf(-0.5)).abs() < 1e-15, "{found}");
    }
}
