//! Kinematics: what follows from a displacement, or from its gradient alone.

use super::tensor::{Tensor, dot};
use crate::expr::{Expr, Graph, Rational, Symbol};
use crate::pass::differentiate::differentiate;
use crate::pass::factor::factor;
use crate::pass::reduce::reduce;
use crate::pass::relations::Relations;

/// What follows from a displacement gradient H = du/dX at one point.
#[derive(Clone, Debug)]
pub struct Strain {
    /// H.
    pub gradient: Tensor,
    /// F = I + H.
    pub deformation: Tensor,
    /// J = det F.
    pub jacobian: Expr,
    /// F^-1.
    pub inverse: Tensor,
    /// C - I = H + H^T + H^T H, twice the Green-Lagrange strain.
    pub right: Tensor,
    /// B - I = H + H^T + H H^T.
    pub left: Tensor,
    /// I1 - 3, I2 - 3 and J - 1.
    pub invariants: [Expr; 3],
}

impl Strain {
    /// From the displacement gradient, every part reduced modulo `relations`.
    pub fn new(graph: &mut Graph, gradient: Tensor, relations: &Relations) -> Self {
        let identity = Tensor::identity(graph, gradient.dimension());
        let gradient = gradient.reduce(graph, relations);
        let deformation = identity.add(graph, &gradient);
        let transposed = gradient.transpose();
        let symmetric = gradient.add(graph, &transposed);
        let square = transposed.mul(graph, &gradient);
        let right = symmetric.add(graph, &square).reduce(graph, relations);
        let square = gradient.mul(graph, &transposed);
        let left = symmetric.add(graph, &square).reduce(graph, relations);
        let volume = gradient.determinant_less_one(graph);
        let (first, second) = first_invariants(graph, &right);
        let reduced = reduce(graph, &[first, second, volume], relations);
        let invariants = [reduced[0], reduced[1], reduced[2]];
        let one = graph.number(1);
        let jacobian = graph.add(one, invariants[2]);
        let reciprocal = graph.power(jacobian, -1);
        let adjugate = deformation.adjugate(graph).reduce(graph, relations);
        let inverse = adjugate.scale(graph, reciprocal);
        Strain { gradient, deformation, jacobian, inverse, right, left, invariants }
    }
}

/// I1 - 3 = tr (C - I) and I2 - 3 = 2 i1 + (i1^2 - tr (C - I)^2)/2, from C - I.
fn first_invariants(graph: &mut Graph, right: &Tensor) -> (Expr, Expr) {
    let first = right.trace(graph);
    let square = graph.power(first, 2);
    let contracted = right.contract(graph, right);
    let half = Rational::from_parts(1.into(), 2u8.into());
    let terms = [(first, Rational::from(2)), (square, half.clone()), (contracted, -half)];
    (first, graph.sum(terms))
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
    /// (ln J),J = F^-1_Kk u_k,KJ.
    pub log_volume_gradient: Vec<Expr>,
    /// The gradients of I1, I2 and J.
    pub invariant_gradients: [Vec<Expr>; 3],
}

impl Motion {
    /// From the displacement, simplified by `relations` between its parts.
    ///
    /// Where there are any, the invariants have become short, and their gradients are the
    /// derivatives of that; else they are tensor algebra, which shares the second gradient of u.
    pub fn new(graph: &mut Graph, displacement: &[Expr], relations: &Relations) -> Self {
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
        let strain = Strain::new(graph, gradient, relations);
        let mut motion = Motion {
            displacement,
            velocity,
            acceleration,
            strain,
            second_gradient,
            log_volume_gradient: Vec::new(),
            invariant_gradients: Default::default(),
        };
        if relations.is_empty() {
            motion.contract_invariants(graph);
        } else {
            motion.differentiate_invariants(graph, relations);
        }
        motion
    }

    fn differentiate_invariants(&mut self, graph: &mut Graph, relations: &Relations) {
        let dimension = self.displacement.len();
        let invariants = self.strain.invariants;
        let slopes: Vec<Vec<Expr>> = (0..dimension)
            .map(|axis| {
                let slopes = derivative(graph, &invariants, Symbol::Coordinate(axis));
                reduce(graph, &slopes, relations)
            })
            .collect();
        self.invariant_gradients =
            [0, 1, 2].map(|invariant| slopes.iter().map(|slope| slope[invariant]).collect());
        let jacobian = self.strain.jacobian;
        self.log_volume_gradient =
            slopes.iter().map(|slope| graph.div(slope[2], jacobian)).collect();
    }

    /// I1,J = 2 F : F,J;  I2,J = 2 (I1 F - F C) : F,J;  J,J = J F^-T : F,J.
    fn contract_invariants(&mut self, graph: &mut Graph) {
        let strain = &self.strain;
        let identity = Tensor::identity(graph, self.displacement.len());
        let right = identity.add(graph, &strain.right);
        let cubic = strain.deformation.mul(graph, &right);
        let (three, minus_one) = (graph.number(3), graph.number(-1));
        let first = graph.add(strain.invariants[0], three);
        let scaled = strain.deformation.scale(graph, first);
        let second = cubic.scale(graph, minus_one).add(graph, &scaled);
        let mut twice = |with: &Tensor| -> Vec<Expr> {
            let half = self.contract_second_gradient(graph, with);
            half.into_iter().map(|component| graph.scale(component, 2)).collect()
        };
        let (first, second) = (twice(&strain.deformation), twice(&second));
        let transposed = strain.inverse.transpose();
        let log_volume = self.contract_second_gradient(graph, &transposed);
        let volume = log_volume.iter().map(|slope| graph.mul(strain.jacobian, *slope)).collect();
        self.log_volume_gradient = log_volume;
        self.invariant_gradients = [first, second, volume];
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
