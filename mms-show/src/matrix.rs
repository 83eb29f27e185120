//! Sums of products, and matrices, row-major.

use super::reading::Reading;
use mms_symbolic::expr::{Expr, Rational};

/// The sum of products.
pub(super) fn dot(reading: &mut Reading, pairs: Vec<(Expr, Expr)>) -> Expr {
    let graph = &mut reading.graph;
    let terms: Vec<_> = pairs.into_iter().map(|(a, b)| (graph.mul(a, b), Rational::ONE)).collect();
    graph.sum(terms)
}

/// The product of two square matrices, row-major.
pub(super) fn matrix_product(
    reading: &mut Reading,
    left: &[Expr],
    right: &[Expr],
    dimension: usize,
) -> Vec<Expr> {
    (0..dimension * dimension)
        .map(|k| {
            let (row, column) = (k / dimension, k % dimension);
            let pairs = (0..dimension)
                .map(|j| (left[row * dimension + j], right[j * dimension + column]))
                .collect();
            dot(reading, pairs)
        })
        .collect()
}

/// The transpose of a square matrix, row-major.
pub(super) fn transpose(matrix: &[Expr], dimension: usize) -> Vec<Expr> {
    (0..matrix.len()).map(|k| matrix[k % dimension * dimension + k / dimension]).collect()
}
