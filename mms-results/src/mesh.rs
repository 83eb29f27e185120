//! A mesh: its cells of full dimension, their sizes and middles, and edges that belong to one cell alone.

use crate::Cells;
use crate::cell::{CellShape, gauss};
use crate::norm::length;

/// A mesh in the reference configuration.
#[derive(Clone, Copy, Debug)]
pub struct Mesh<'a> {
    /// The cells; cells of a lower dimension than the mesh are ignored.
    pub cells: &'a Cells,
    /// X of the points, one after the other.
    pub points: &'a [f64],
    /// The dimension of the mesh.
    pub dimension: usize,
    /// Whether it is the meridian of a body of revolution: each place represents a ring, and integrals are per radian.
    pub is_meridian: bool,
}

impl<'a> Mesh<'a> {
    /// The cells of the dimension of the mesh, with their positions.
    pub fn full(&self) -> impl Iterator<Item = (usize, &'static CellShape, &'a [usize])> {
        let dimension = self.dimension;
        self.cells.iter().enumerate().filter_map(move |(cell, (kind, points))| {
            let shape = CellShape::of(kind, points.len()).filter(|it| it.dimension == dimension)?;
            Some((cell, shape, points))
        })
    }

    /// A cell type that may have the dimension of the mesh and is not known.
    pub fn unknown(&self) -> Option<u8> {
        let lines = [1, 2, 4];
        let is_unknown = |(kind, points): &(u8, &[usize])| {
            !lines.contains(kind) && CellShape::of(*kind, points.len()).is_none()
        };
        self.cells.iter().find(is_unknown).map(|(kind, _)| kind)
    }

    /// Whether the shape functions of all its cells are known.
    pub fn has_functions(&self) -> bool {
        self.full().all(|(_, shape, _)| shape.has_functions())
    }

    /// The lowest degree of its cells, if all cells have one.
    pub fn degree(&self) -> Option<u32> {
        self.full().map(|(_, shape, _)| shape.degree()).min().filter(|it| *it > 0)
    }

    pub(crate) fn point(&self, point: usize) -> &'a [f64] {
        &self.points[point * self.dimension..][..self.dimension]
    }

    /// The shortest and the longest of the longest edges of the cells; `None` without cells of full dimension.
    pub fn sizes(&self) -> Option<[f64; 2]> {
        let longest = |(_, shape, points): (usize, &'static CellShape, &[usize])| {
            let edges = shape.edges().iter();
            edges
                .map(|&[a, b]| length(self.point(points[a]), self.point(points[b])))
                .fold(0.0, f64::max)
        };
        let both = |range: Option<[f64; 2]>, size: f64| {
            Some(range.map_or([size; 2], |[least, most]| [least.min(size), most.max(size)]))
        };
        self.full().map(longest).fold(None, both)
    }

    /// X at the middle of the reference cell, for all cells of full dimension; for polygons at the centre of area.
    pub fn middles(&self) -> Vec<f64> {
        // Most cells have the same shape as the one before.
        let mut last: Option<(&CellShape, Vec<f64>)> = None;
        let mut all = Vec::new();
        for (_, shape, points) in self.full() {
            if !shape.has_functions() {
                all.extend(self.polygon(points).1);
                continue;
            }
            let (_, values) = match last.take().filter(|it| std::ptr::eq(it.0, shape)) {
                Some(known) => last.insert(known),
                None => last.insert((shape, shape.values(shape.middle()))),
            };
            let of = |axis: usize| -> f64 {
                points.iter().zip(&*values).map(|(&point, n)| n * self.point(point)[axis]).sum()
            };
            all.extend((0..self.dimension).map(of));
        }
        all
    }

    /// The area of a polygon in a plane, and its centre, by triangles from its first corner.
    pub(crate) fn polygon(&self, points: &[usize]) -> (f64, [f64; 2]) {
        let corner = |at: usize| self.point(points[at]);
        let first = corner(0);
        let from = |at: usize| [corner(at)[0] - first[0], corner(at)[1] - first[1]];
        let (mut area, mut moment) = (0.0, [0.0; 2]);
        for at in 2..points.len() {
            let (a, b) = (from(at - 1), from(at));
            let own = (a[0] * b[1] - a[1] * b[0]) / 2.0;
            area += own;
            [0, 1].into_iter().for_each(|axis| moment[axis] += own * (a[axis] + b[axis]) / 3.0);
        }
        let by = if area == 0.0 { 0.0 } else { 1.0 / area };
        (area, [0, 1].map(|axis| first[axis] + moment[axis] * by))
    }

    /// The imbalance of the cells around inner edges: the distance from the middle of an edge to the mean of the middles of its
    /// cells, divided by the length of the edge, as a root mean square. It is 0 if cells are copies and half turns of each
    /// other. `is_inner` returns whether the middle of an edge lies within the body. `None` without such an edge.
    pub fn imbalance(&self, is_inner: &dyn Fn(&[f64]) -> bool) -> Option<f64> {
        let dimension = self.dimension;
        let middles = self.middles();
        let mut edges = Vec::new();
        for (own, (_, shape, points)) in middles.chunks(dimension).zip(self.full()) {
            for &ends in shape.edges() {
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

    /// The edges of cells in a plane that belong to one cell alone, each as X of its ends and of the nodes between them, in
    /// order; only edges whose ends satisfy `is_asked`.
    pub fn free_edges(&self, is_asked: &dyn Fn([&[f64]; 2]) -> bool) -> Vec<Vec<&'a [f64]>> {
        let mut found = Vec::new();
        for (_, shape, points) in self.full() {
            for &ends in shape.edges() {
                let places = ends.map(|it| self.point(points[it]));
                if is_asked(places) {
                    let between = shape.between(ends).into_iter().map(|it| self.point(points[it]));
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

/// The area that the ray from the origin to an edge in a plane sweeps, by X of its ends and of the nodes between them: half the
/// integral of x dy - y dx.
pub fn swept(edge: &[&[f64]]) -> f64 {
    let Some(shape) = CellShape::of(68, edge.len()) else { return 0.0 };
    let sum = |values: &[f64], axis: usize| -> f64 {
        values.iter().zip(edge).map(|(value, x)| value * x[axis]).sum()
    };
    let part = |(at, weight): (f64, f64)| {
        let (values, slopes) = (shape.values([at, 0.0, 0.0]), shape.derivatives([at, 0.0, 0.0], 0));
        let (x, by) = ([0, 1].map(|it| sum(&values, it)), [0, 1].map(|it| sum(&slopes, it)));
        weight * (x[0] * by[1] - x[1] * by[0]) / 2.0
    };
    gauss(edge.len()).into_iter().map(part).sum()
}

/// A key of an edge by its ends: pieces of a mesh have copies of points.
fn edge_key(ends: [&[f64]; 2]) -> [[u64; 3]; 2] {
    // -0 becomes 0.
    let bits = |x: &[f64]| [0, 1, 2].map(|axis| x.get(axis).map_or(0, |it| (it + 0.0).to_bits()));
    let mut ends = ends.map(bits);
    ends.sort_unstable();
    ends
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The imbalance of cells of one type over the points of a square of 2 x 2 unit squares.
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
        let mesh = Mesh { cells: &cells, points: &points, dimension: 2, is_meridian: false };
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
        // At four edges the cells are mirror images of each other: their middles are a third and not half of the way along it.
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

    #[test]
    fn edges_of_any_degree_sweep_their_area() {
        let on_circle = |count: usize| -> Vec<[f64; 2]> {
            let at = |part: usize| (part as f64 / (count - 1) as f64 * 1.2).sin_cos();
            let order = [0, count - 1].into_iter().chain(1..count - 1);
            order.map(at).map(|(sin, cos)| [cos, sin]).collect()
        };
        for (count, most) in [(2, 0.15), (3, 2e-2), (4, 2e-3), (5, 2e-4), (7, 2e-6)] {
            let nodes = on_circle(count);
            let edge: Vec<&[f64]> = nodes.iter().map(|it| &it[..]).collect();
            let off = (swept(&edge) - 0.6).abs();
            assert!(off < most, "{count}: {off:e}");
        }
        // A parabola through three points.
        let edge: [&[f64]; 3] = [&[1.0, 0.0], &[0.0, 2.0], &[0.8, 1.1]];
        assert!((swept(&edge) - (4.0 * (1.1 + 1.6) - 2.0) / 6.0).abs() < 1e-15);
    }

    #[test]
    fn polygons_have_areas_and_centres() {
        // A square of 2 x 2 with a triangle of area 1 beside it, in both orientations.
        let points = [0.0, 0.0, 2.0, 0.0, 3.0, 1.0, 2.0, 2.0, 0.0, 2.0];
        for own in [vec![0, 1, 2, 3, 4], vec![3, 2, 1, 0, 4]] {
            let cells = Cells { types: vec![7], points: own, ends: vec![5] };
            let mesh = Mesh { cells: &cells, points: &points, dimension: 2, is_meridian: false };
            let centre = mesh.middles();
            assert!((centre[0] - (4.0 + 7.0 / 3.0) / 5.0).abs() < 1e-15, "{centre:?}");
            assert!((centre[1] - 1.0).abs() < 1e-15, "{centre:?}");
            assert_eq!(mesh.sizes(), Some([2.0; 2]));
            assert!((mesh.volumes().unwrap().iter().sum::<f64>() - 5.0).abs() < 1e-15);
            assert_eq!((mesh.degree(), mesh.has_functions(), mesh.unknown()), (None, false, None));
            assert_eq!(mesh.free_edges(&|_| true).len(), 5);
        }
    }
}
