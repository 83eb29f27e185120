//! Polygons in the plane, filled with the parts of quadrilaterals that lie along their edges.

use mms_math::polygon::{Vertex, area, contains, edge, normal, quadrilaterals};

use super::{Filling, Piece};
use crate::field::Face;
use crate::real::{Matrix, Vector};

/// A polygon in double precision.
pub struct Polygon<'a> {
    /// The vertices, in order, clockwise or counter-clockwise.
    pub vertices: Vec<Vertex>,
    /// The names of the edges.
    pub names: &'a [&'static str],
}

/// A vector of the plane; further components are 0.
fn vector<const D: usize>(place: Vertex) -> Vector<f64, D> {
    Vector::from_fn(|axis, _| place.get(axis).copied().unwrap_or(0.0))
}

impl Polygon<'_> {
    /// The face at an edge.
    pub fn face(&self, first: usize) -> Face {
        Face::Edge(first, self.names.get(first).copied().unwrap_or("edge"))
    }

    /// The faces of the polygon.
    pub fn faces(&self) -> Vec<Face> {
        (0..self.vertices.len()).map(|first| self.face(first)).collect()
    }

    /// Lower and upper corner of the smallest box around the polygon.
    pub fn bounding_box<const D: usize>(&self) -> [Vector<f64, D>; 2] {
        let mut corners = [f64::INFINITY, f64::NEG_INFINITY].map(Vector::<f64, D>::repeat);
        for vertex in &self.vertices {
            let point = vector(*vertex);
            corners = [corners[0].inf(&point), corners[1].sup(&point)];
        }
        corners
    }

    /// Boxes of one size whose middles lie inside.
    pub fn fill_cartesian<const D: usize>(&self, spacing: &Vector<f64, D>) -> Filling<D> {
        super::lattice(self.bounding_box(), spacing, |point| {
            contains(&self.vertices, [point[0], point[1]])
        })
    }

    /// Fills the polygon with parts of quadrilaterals, cut into about equal parts along both of their sides.
    pub fn fill_fitted<const D: usize>(&self, spacing: &Vector<f64, D>) -> Filling<D> {
        let mut filling = Filling::default();
        let spacing = spacing.iter().copied().fold(f64::INFINITY, f64::min);
        for quad in quadrilaterals(&self.vertices) {
            let counts = quad.lengths().map(|length| (length / spacing).round().max(1.0) as usize);
            let steps = counts.map(|count| 1.0 / count as f64);
            // A clockwise polygon has clockwise parts.
            let side = area(&quad.corners).signum();
            for k in 0..counts[0] * counts[1] {
                let at = [k % counts[0], k / counts[0]];
                let middle: [f64; 2] =
                    std::array::from_fn(|axis| (at[axis] as f64 + 0.5) * steps[axis]);
                let mut slopes = quad.slopes(middle);
                if side < 0.0 {
                    slopes.swap(0, 1);
                }
                let order = if side < 0.0 { [1, 0] } else { [0, 1] };
                let mut half_edges = Matrix::<f64, D>::zeros();
                let mut edges = [Vertex::default(); 2];
                for (column, axis) in order.into_iter().enumerate() {
                    edges[column] = slopes[column].map(|slope| slope * steps[axis]);
                    half_edges.set_column(column, &vector(edges[column].map(|edge| edge / 2.0)));
                }
                let particle = filling.position.len();
                for (axis, first) in quad.edges.into_iter().enumerate() {
                    let Some(first) = first.filter(|_| at[1 - axis] == 0) else { continue };
                    let (mut place, [from, to]) = (middle, edge(&self.vertices, first));
                    place[1 - axis] = 0.0;
                    // Each edge has two sides of quadrilaterals, half as long as it is.
                    let length = (to[0] - from[0]).hypot(to[1] - from[1]) / 2.0 * steps[axis];
                    filling.pieces.push(Piece {
                        face: self.face(first),
                        particle,
                        position: vector(quad.point(place)),
                        area: vector(normal(&self.vertices, first)) * length,
                    });
                }
                filling.position.push(vector(quad.point(middle)));
                filling.volume.push(edges[0][0] * edges[1][1] - edges[0][1] * edges[1][0]);
                filling.half_edges.push(half_edges);
            }
        }
        filling
    }
}
