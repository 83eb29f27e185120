//! Boxes filled with boxes.

use super::{Filling, Piece};
use crate::field::Face;
use crate::real::{Matrix, Vector};

/// A Cartesian array of equal particles whose domains fill the box.
pub fn fill<const D: usize>(
    lower: &Vector<f64, D>,
    upper: &Vector<f64, D>,
    spacing: &Vector<f64, D>,
) -> Filling<D> {
    let edges = upper - lower;
    let count: [usize; D] =
        std::array::from_fn(|a| (edges[a] / spacing[a]).round().max(1.0) as usize);
    let half = Vector::<f64, D>::from_fn(|a, _| edges[a] / count[a] as f64 / 2.0);
    let volume = half.iter().map(|l| 2.0 * l).product();
    let total = count.iter().product();
    let mut filling = Filling {
        position: Vec::with_capacity(total),
        volume: vec![volume; total],
        half_edges: vec![Matrix::from_diagonal(&half); total],
        pieces: Vec::new(),
    };
    for particle in 0..total {
        let stride = |a: usize| count[..a].iter().product::<usize>();
        let index: [usize; D] = std::array::from_fn(|a| particle / stride(a) % count[a]);
        let position = Vector::from_fn(|a, _| lower[a] + (2 * index[a] + 1) as f64 * half[a]);
        for a in 0..D {
            let mut piece = |face: Face, side: f64| {
                let (mut middle, mut area) = (position, Vector::zeros());
                middle[a] += side * half[a];
                area[a] = side * volume / (2.0 * half[a]);
                filling.pieces.push(Piece { face, particle, position: middle, area });
            };
            if index[a] == 0 {
                piece(Face::Min(a), -1.0);
            }
            if index[a] + 1 == count[a] {
                piece(Face::Max(a), 1.0);
            }
        }
        filling.position.push(position);
    }
    filling
}
