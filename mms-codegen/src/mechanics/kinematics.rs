//! Kinematics: what follows from a displacement, or from its gradient alone.

use super::tensor::{Tensor, dot};
use crate::expr::{Expr, Graph, Rational, Symbol};
use crate::pass::differentiate::differentiate;
use crate::pass::factor::factor;

/// What follows from a displacement gradient H = du/dX at one point.
#[derive(Clone, Debug)]
pub struct Strain {
    /// H.
    pub gradient: Tensor,
    /// F = I + H.
    pub deformation: Tensor,
    /// J - 1.
    pub volume: Expr,
    /// J = det F.
    pub jacobian: Expr,
    /// F^-1.
    pub inverse: Tensor,
    /// C - I = H + H^T + H^T H, twice the Green-Lagrange strain.
    pub right: Tensor,
    /// B - I = H + H^T + H H^T.
    pub left: Tensor,
}

impl Strain {
    /// From the displacement gradient.
    pub fn new(graph: &mut Graph, gradient: Tensor) -> Self {
        let identity = Tensor::identity(graph, gradient.dimension());
        let deformation = identity.add(graph, &gradient);
        let volume = gradient.determinant_less_one(graph);
        let one = graph.number(1);
        let jacobian = graph.add(one, volume);
        let reciprocal = graph.power(jacobian, -1);
        let inverse = deformation.adjugate(graph).scale(graph, reciprocal);
        let transposed = gradient.transpose();
        let symmetric = gradient.add(graph, &transposed);
        let (squared_right, squared_left) =
            (transposed.mul(graph, &gradient), gradient.mul(graph, &transposed));
        let right = symmetric.add(graph, &squared_right);
        let left = symmetric.add(graph, &squared_left);
        Strain { gradient, deformation, volume, jacobian, inverse, right, left }
    }
}

/// What follows from a displacement u(X, t).
#[derive(Clone, Debug)]
pub struct Motion {
    /// u.
    pub displacement: Vec<Expr>,
    /// v = du/dt at fixed X.
    pub velocity: Vec<Expr>,
    /// a = dv/dt at fixed X.
    pub acceleration: Vec<Expr>,
    /// H and what follows from it.
    pub strain: Strain,
    /// d2u_i / dX_J dX_K as one matrix per i.
    pub second_gradient: Vec<Tensor>,
}

impl Motion {
    /// From the displacement.
    pub fn new(graph: &mut Graph, displacement: &[Expr]) -> Self {
        let dimension = displacement.len();
        let displacement = factor(graph, displacement);
        let velocity = derivative(graph, &displacement, Symbol::Time);
        let acceleration = derivative(graph, &velocity, Symbol::Time);
        let columns: Vec<Vec<Expr>> = (0..dimension)
            .map(|axis| derivative(graph, &displacement, Symbol::Coordinate(axis)))
            .collect();
        let gradient = Tensor::from_fn(dimension, |row, column| columns[column][row]);
        let second_gradient = (0..dimension)
            .map(|component| {
                let row: Vec<Expr> = columns.iter().map(|column| column[component]).collect();
                let second: Vec<Vec<Expr>> = (0..dimension)
                    .map(|axis| derivative(graph, &row, Symbol::Coordinate(axis)))
                    .collect();
                Tensor::from_fn(dimension, |j, k| second[k][j])
            })
            .collect();
        let strain = Strain::new(graph, gradient);
        Motion { displacement, velocity, acceleration, strain, second_gradient }
    }

    /// d2u_i / dX_J dX_J.
    pub fn laplacian(&self, graph: &mut Graph) -> Vec<Expr> {
        self.second_gradient.iter().map(|second| second.trace(graph)).collect()
    }

    /// A_mK d2u_m / dX_K dX_J for every J: half the gradient of what A is the derivative of.
    pub fn contract_second_gradient(&self, graph: &mut Graph, with: &Tensor) -> Vec<Expr> {
        let dimension = self.displacement.len();
        (0..dimension)
            .map(|axis| {
                let pairs = (0..dimension * dimension).map(|k| {
                    let (row, column) = (k / dimension, k % dimension);
                    (with.at(row, column), self.second_gradient[row].at(column, axis))
                });
                dot(graph, pairs)
            })
            .collect()
    }
}

fn derivative(graph: &mut Graph, roots: &[Expr], symbol: Symbol) -> Vec<Expr> {
    let derivatives = differentiate(graph, roots, symbol);
    factor(graph, &derivatives)
}

/// The sum of expressions.
pub(super) fn total(graph: &mut Graph, terms: &[Expr]) -> Expr {
    graph.sum(terms.iter().map(|term| (*term, Rational::ONE)))
}
