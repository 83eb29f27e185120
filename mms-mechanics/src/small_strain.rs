//! Stress and its divergence from a density W(tr eps, eps:eps) of the small strain eps = (H + H^T)/2:
//!
//! ```text
//! P = dW/dF = p I + s eps,   p = W_t,  s = 2 W_s
//! ```
//!
//! with W_t the derivative by tr eps and W_s the derivative by eps:eps. Such a density may not use the other invariants too. W
//! is evaluated as written at any H, though it describes an elastic solid at small H only: it changes under rotations. There is
//! one stress, P = P^T = S = tau = sigma, and rho = rho0 (`derivation::Present`).

use crate::faults;
use crate::invariant::{InvariantKind, SMALL_SQUARE, SMALL_TRACE};
use crate::kinematics::{Motion, Strain};
use crate::material::{Gradient, at, gradient};
use crate::tensor::{Tensor, dot};
use mms_symbolic::expr::{Expr, Graph, HALF, Rational, Symbol};
use mms_symbolic::pass::differentiate::differentiate;
use mms_symbolic::pass::factor::factor;

/// The coefficients of the stress, as functions of tr eps and eps:eps.
#[derive(Clone, Debug)]
pub(super) struct SmallStrain {
    /// The coefficient of I.
    pressure: Expr,
    /// The coefficient of eps.
    shear: Expr,
}

impl SmallStrain {
    /// Differentiates W.
    pub fn new(graph: &mut Graph, energy: Expr) -> Self {
        let [pressure, half] =
            [SMALL_TRACE, SMALL_SQUARE].map(|by| differentiate(graph, &[energy], by)[0]);
        let shear = graph.scale(half, 2);
        let [pressure, shear] = [pressure, shear].map(|root| factor(graph, &[root])[0]);
        SmallStrain { pressure, shear }
    }

    /// P = p I + s eps.
    pub fn first_piola_kirchhoff(&self, graph: &mut Graph, strain: &Strain) -> Tensor {
        let values = at(graph, strain, &[self.pressure, self.shear]);
        let identity = Tensor::identity(graph, strain.gradient.dimension());
        let sheared = strain.small(graph).scale(graph, values[1]);
        identity.scale(graph, values[0]).add(graph, &sheared)
    }

    /// (Div P)_i = p,i + eps_iJ s,J + s (Lap u_i + u_J,iJ)/2.
    pub fn divergence(&self, graph: &mut Graph, motion: &Motion) -> Vec<Expr> {
        let dimension = motion.displacement.len();
        let strain = motion.strain.small(graph);
        let identity = Tensor::identity(graph, dimension);
        let (laplacian, dilatation) =
            (motion.laplacian(graph), motion.contract_second_gradient(graph, &identity));
        let dilatation = faults::dilatation(graph, dilatation);
        let shear = at(graph, &motion.strain, &[self.shear])[0];
        let symbols = InvariantKind::SmallStrain.symbols();
        let [pressure_slope, shear_slope] =
            [self.pressure, self.shear].map(|root| gradient(graph, motion, root, symbols));
        (0..dimension)
            .map(|row| {
                let terms = [laplacian[row], dilatation[row]].map(|term| (term, HALF));
                let curvature = graph.sum(terms);
                let turned = (0..dimension).map(|axis| (strain.at(row, axis), shear_slope[axis]));
                let turned = dot(graph, turned);
                let sheared = graph.mul(shear, curvature);
                graph.sum([pressure_slope[row], turned, sheared].map(|term| (term, Rational::ONE)))
            })
            .collect()
    }
}

/// The derivatives of the invariants by F: for tr eps I and 0, for eps:eps 2 eps and d_ik d_JL + d_iL d_Jk.
pub(super) fn gradients(graph: &mut Graph, strain: &Strain) -> Vec<(Symbol, Gradient)> {
    let identity = Tensor::identity(graph, strain.gradient.dimension());
    let trace = Gradient::new(graph, identity.clone(), |graph, _| graph.number(0));
    let two = graph.number(2);
    let value = strain.small(graph).scale(graph, two);
    let square = Gradient::new(graph, value, |graph, [i, j, k, l]| {
        dot(graph, [(identity.at(i, k), identity.at(j, l)), (identity.at(i, l), identity.at(j, k))])
    });
    vec![(SMALL_TRACE, trace), (SMALL_SQUARE, square)]
}
