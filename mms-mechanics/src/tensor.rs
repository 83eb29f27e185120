//! Small square matrices of expressions.

use mms_symbolic::expr::{Expr, Graph, Rational, Symbol};
use mms_symbolic::pass::cancellation::avoid_cancellation;
use mms_symbolic::pass::differentiate::differentiate;
use mms_symbolic::pass::factor::factor;
use mms_symbolic::pass::reduce::reduce;
use mms_symbolic::pass::relations::Relations;

/// A `dimension` x `dimension` matrix, row-major.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tensor {
    dimension: usize,
    components: Vec<Expr>,
}

impl Tensor {
    /// The matrix whose components `component(row, column)` makes, row by row.
    pub fn from_fn(dimension: usize, mut component: impl FnMut(usize, usize) -> Expr) -> Self {
        let components =
            (0..dimension * dimension).map(|k| component(k / dimension, k % dimension)).collect();
        Tensor { dimension, components }
    }

    /// The matrix of row-major `components`.
    pub fn from_components(dimension: usize, components: Vec<Expr>) -> Self {
        assert_eq!(components.len(), dimension * dimension, "a square matrix");
        Tensor { dimension, components }
    }

    /// The identity.
    pub fn identity(graph: &mut Graph, dimension: usize) -> Self {
        Self::from_fn(dimension, |row, column| graph.number(i32::from(row == column)))
    }

    /// The number of rows.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// The component in `row` and `column`.
    pub fn at(&self, row: usize, column: usize) -> Expr {
        self.components[row * self.dimension + column]
    }

    /// The row-major components.
    pub fn components(&self) -> &[Expr] {
        &self.components
    }

    /// `A^T`.
    pub fn transpose(&self) -> Self {
        Self::from_fn(self.dimension, |row, column| self.at(column, row))
    }

    /// Reduces the components modulo `relations`.
    pub fn reduce(&self, graph: &mut Graph, relations: &Relations) -> Self {
        Self::from_components(self.dimension, reduce(graph, &self.components, relations))
    }

    /// Reduces the components modulo the relations of half the angles, and rewrites sums that cancel at small arguments.
    pub fn avoid_cancellation(&self, graph: &mut Graph, relations: &Relations) -> Self {
        let halved = relations.halve(graph, &self.components);
        let reduced = reduce(graph, &halved, relations);
        Self::from_components(self.dimension, avoid_cancellation(graph, &reduced))
    }

    /// `A + B`.
    pub fn add(&self, graph: &mut Graph, other: &Tensor) -> Self {
        Self::from_fn(self.dimension, |row, column| {
            graph.add(self.at(row, column), other.at(row, column))
        })
    }

    /// `factor A`.
    pub fn scale(&self, graph: &mut Graph, factor: Expr) -> Self {
        Self::from_fn(self.dimension, |row, column| graph.mul(factor, self.at(row, column)))
    }

    /// `A B`.
    pub fn mul(&self, graph: &mut Graph, other: &Tensor) -> Self {
        Self::from_fn(self.dimension, |row, column| {
            dot(graph, (0..self.dimension).map(|k| (self.at(row, k), other.at(k, column))))
        })
    }

    /// `A v`.
    pub fn apply(&self, graph: &mut Graph, vector: &[Expr]) -> Vec<Expr> {
        (0..self.dimension)
            .map(|row| dot(graph, vector.iter().enumerate().map(|(k, v)| (self.at(row, k), *v))))
            .collect()
    }

    /// The outer product of two vectors, whose components are `v_row w_column`.
    pub fn outer(graph: &mut Graph, v: &[Expr], w: &[Expr]) -> Self {
        Self::from_fn(v.len(), |row, column| graph.mul(v[row], w[column]))
    }

    /// The trace.
    pub fn trace(&self, graph: &mut Graph) -> Expr {
        graph.sum((0..self.dimension).map(|k| (self.at(k, k), Rational::ONE)))
    }

    /// `A : B`, the sum of the products of their components.
    pub fn contract(&self, graph: &mut Graph, other: &Tensor) -> Expr {
        let pairs = self.components.iter().copied().zip(other.components.iter().copied());
        dot(graph, pairs)
    }

    /// The sum of the principal minors of `rows` rows.
    pub fn principal_minors(&self, graph: &mut Graph, rows: u32) -> Expr {
        let subsets = (1..1usize << self.dimension).filter(|subset| subset.count_ones() == rows);
        let minors: Vec<_> = subsets
            .map(|subset| {
                let indices: Vec<usize> =
                    (0..self.dimension).filter(|axis| subset >> axis & 1 == 1).collect();
                (self.minor(graph, &indices, &indices), Rational::ONE)
            })
            .collect();
        graph.sum(minors)
    }

    /// det(I + A) - 1, the sum of the principal minors of A: no cancellation where A is small.
    pub fn determinant_less_one(&self, graph: &mut Graph) -> Expr {
        let mut minors = Vec::new();
        for subset in 1..1usize << self.dimension {
            let indices: Vec<usize> =
                (0..self.dimension).filter(|axis| subset >> axis & 1 == 1).collect();
            minors.push((self.minor(graph, &indices, &indices), Rational::ONE));
        }
        graph.sum(minors)
    }

    /// The determinant.
    pub fn determinant(&self, graph: &mut Graph) -> Expr {
        let all: Vec<usize> = (0..self.dimension).collect();
        self.minor(graph, &all, &all)
    }

    /// The inverse: A^-1 = adj A / det A.
    pub fn inverse(&self, graph: &mut Graph) -> Self {
        let determinant = self.determinant(graph);
        let per_determinant = graph.power(determinant, -1);
        self.adjugate(graph).scale(graph, per_determinant)
    }

    /// The adjugate, the inverse times the determinant.
    pub fn adjugate(&self, graph: &mut Graph) -> Self {
        let others = |skip: usize| -> Vec<usize> {
            (0..self.dimension).filter(|index| *index != skip).collect()
        };
        Self::from_fn(self.dimension, |row, column| {
            let minor = self.minor(graph, &others(column), &others(row));
            graph.scale(minor, if (row + column) % 2 == 0 { 1 } else { -1 })
        })
    }

    /// The determinant of some rows and as many columns, by expansion along the first row.
    fn minor(&self, graph: &mut Graph, rows: &[usize], columns: &[usize]) -> Expr {
        let Some((row, rows)) = rows.split_first() else { return graph.number(1) };
        let mut terms = Vec::new();
        for (position, column) in columns.iter().enumerate() {
            let rest: Vec<usize> =
                columns.iter().copied().filter(|other| other != column).collect();
            let minor = self.minor(graph, rows, &rest);
            let sign = if position % 2 == 0 { Rational::ONE } else { Rational::NEG_ONE };
            terms.push((graph.mul(self.at(*row, *column), minor), sign));
        }
        graph.sum(terms)
    }
}

/// The derivatives of components, with common factors taken out.
pub(super) fn derivative(graph: &mut Graph, components: &[Expr], symbol: Symbol) -> Vec<Expr> {
    let derivatives = differentiate(graph, components, symbol);
    factor(graph, &derivatives)
}

/// The sum of the products of pairs.
pub fn dot(graph: &mut Graph, pairs: impl IntoIterator<Item = (Expr, Expr)>) -> Expr {
    let terms: Vec<_> = pairs.into_iter().map(|(a, b)| (graph.mul(a, b), Rational::ONE)).collect();
    graph.sum(terms)
}
