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

    /// Edges of cells in a plane that no other cell has, each as X of its ends and of the node between them, if there is
    /// one; of those with ends that are asked for. Edges are told by their ends: pieces of a mesh have points of their own.
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
        let key = |edge: &Vec<&[f64]>| {
            // -0 is 0.
            let mut ends = [edge[0], edge[1]].map(|x| [x[0], x[1]].map(|it| (it + 0.0).to_bits()));
            ends.sort_unstable();
            ends
        };
        found.sort_by_key(key);
        let alone = found.chunk_by(|a, b| key(a) == key(b)).filter(|it| it.len() == 1);
        alone.map(|it| it[0].clone()).collect()
    }
}
