//! Isotropic hyperelasticity: stress and its divergence from a strain-energy density W(I1, I2, J).
//!
//! With C = F^T F and the 3-D invariants I1 = tr C, I2 = ((tr C)^2 - tr C^2)/2, J = det F,
//!
//! ```text
//! P = dW/dF = alpha F + beta F C + gamma F^-T,
//! alpha = 2 (W_1 + I1 W_2),  beta = -2 W_2,  gamma = J W_J
//! ```
//!
//! (Bonet & Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, 2008, chapter 6; the
//! dimensions that a field lacks contribute a stretch of one). W is held as a function of
//! i1 = I1 - 3, i2 = I2 - 3 and j = J - 1, which are formed from H without cancellation.

use std::collections::BTreeMap;

use super::kinematics::{Motion, Strain, total};
use super::tensor::{Tensor, dot};
use crate::expr::{Expr, Graph, Rational, Symbol};
use crate::pass::differentiate::differentiate;
use crate::pass::factor::factor;
use crate::pass::relations::Relations;
use crate::pass::substitute::substitute;

/// i1 = I1 - 3.
pub const FIRST: Symbol = Symbol::Invariant(0);
/// i2 = I2 - 3.
pub const SECOND: Symbol = Symbol::Invariant(1);
/// j = J - 1.
pub const VOLUME: Symbol = Symbol::Invariant(2);
const INVARIANTS: [Symbol; 3] = [FIRST, SECOND, VOLUME];

/// A strain-energy density and the coefficients of its stress, as functions of i1, i2 and j.
#[derive(Clone, Debug)]
pub struct Law {
    /// W.
    energy: Expr,
    /// The coefficient of F.
    alpha: Expr,
    /// The coefficient of F C.
    beta: Expr,
    /// The coefficient of F^-T.
    gamma: Expr,
    /// The coefficients of I, C - I and (C - I)^2 in F^T P.
    strain_form: [Expr; 3],
}

impl Law {
    /// From W.
    pub fn new(graph: &mut Graph, energy: Expr) -> Self {
        let slopes = INVARIANTS.map(|invariant| differentiate(graph, &[energy], invariant)[0]);
        let [w1, w2, wj] = [0, 1, 2].map(|k| factor(graph, &[slopes[k]])[0]);
        let [first, jacobian] = [(FIRST, 3), (VOLUME, 1)].map(|(invariant, at_identity)| {
            let (shift, value) = (graph.symbol(invariant), graph.number(at_identity));
            graph.add(shift, value)
        });
        let first_w2 = graph.mul(first, w2);
        let alpha = graph.add(w1, first_w2);
        let alpha = graph.scale(alpha, 2);
        let beta = graph.scale(w2, -2);
        let gamma = graph.mul(jacobian, wj);
        // F^T P = alpha C + beta C^2 + gamma I, rearranged in powers of C - I.
        let constant = total(graph, &[alpha, beta, gamma]);
        let linear = graph.sum([(alpha, Rational::ONE), (beta, Rational::from(2))]);
        let coefficients = factor(graph, &[alpha, beta, gamma, constant, linear]);
        let [alpha, beta, gamma, constant, linear] = coefficients[..] else {
            unreachable!("as many roots as were given")
        };
        Law { energy, alpha, beta, gamma, strain_form: [constant, linear, beta] }
    }

    /// W at a strain.
    pub fn energy(&self, graph: &mut Graph, strain: &Strain) -> Expr {
        self.at(graph, strain, &[self.energy])[0]
    }

    /// P = F^-T (s0 I + s1 (C - I) + s2 (C - I)^2): each term is small where the strain is.
    pub fn first_piola_kirchhoff(&self, graph: &mut Graph, strain: &Strain) -> Tensor {
        let stress = self.polynomial(graph, strain, &strain.right);
        strain.inverse.transpose().mul(graph, &stress)
    }

    /// tau = s0 I + s1 (B - I) + s2 (B - I)^2 with B = F F^T: P F^T needs no inverse.
    pub fn kirchhoff(&self, graph: &mut Graph, strain: &Strain) -> Tensor {
        self.polynomial(graph, strain, &strain.left)
    }

    fn polynomial(&self, graph: &mut Graph, strain: &Strain, base: &Tensor) -> Tensor {
        let coefficients = self.at(graph, strain, &self.strain_form);
        let identity = Tensor::identity(graph, base.dimension());
        let square = base.mul(graph, base);
        let mut stress = identity.scale(graph, coefficients[0]);
        for (power, coefficient) in [(base, coefficients[1]), (&square, coefficients[2])] {
            let term = power.scale(graph, coefficient);
            stress = stress.add(graph, &term);
        }
        stress
    }

    /// Div P, linear in the second gradient of u, so that small strains lose nothing:
    ///
    /// ```text
    /// (Div P)_i = alpha Lap u_i + F_iJ alpha,J + beta (F C)_iJ,J + (F C)_iJ beta,J
    ///           + (gamma,J - gamma g_J) F^-1_Ji,      g_J = F^-1_Kk u_k,KJ = (ln J),J
    /// ```
    pub fn divergence(&self, graph: &mut Graph, motion: &Motion) -> Vec<Expr> {
        let dimension = motion.displacement.len();
        let strain = &motion.strain;
        let laplacian = motion.laplacian(graph);
        let log_volume = &motion.log_volume_gradient;
        let right = {
            let identity = Tensor::identity(graph, dimension);
            identity.add(graph, &strain.right)
        };
        let cubic = strain.deformation.mul(graph, &right);
        let invariants = &motion.invariant_gradients;
        let roots = [self.alpha, self.beta, self.gamma];
        let [alpha_slope, beta_slope, gamma_slope] =
            roots.map(|root| self.gradient(graph, strain, root, invariants));
        let values = self.at(graph, strain, &roots);
        let (alpha, beta, gamma) = (values[0], values[1], values[2]);
        let cubic_divergence = cubic_divergence(graph, motion, &right, &laplacian);
        let pressure: Vec<Expr> = (0..dimension)
            .map(|axis| {
                let product = graph.mul(gamma, log_volume[axis]);
                graph.sub(gamma_slope[axis], product)
            })
            .collect();
        (0..dimension)
            .map(|row| {
                let mut pairs = vec![(alpha, laplacian[row]), (beta, cubic_divergence[row])];
                for axis in 0..dimension {
                    pairs.push((strain.deformation.at(row, axis), alpha_slope[axis]));
                    pairs.push((cubic.at(row, axis), beta_slope[axis]));
                    pairs.push((strain.inverse.at(axis, row), pressure[axis]));
                }
                dot(graph, pairs)
            })
            .collect()
    }

    /// dP_11/dF_11 at F = I: rho0 times the square of the speed of a longitudinal wave, the
    /// fastest in an isotropic solid.
    pub fn longitudinal_modulus(&self, graph: &mut Graph) -> Expr {
        let stretch = Symbol::Gradient(0, 0);
        let component = graph.symbol(stretch);
        let gradient = Tensor::from_components(1, vec![component]);
        let strain = Strain::new(graph, gradient, &Relations::default());
        let stress = self.first_piola_kirchhoff(graph, &strain).at(0, 0);
        let slope = differentiate(graph, &[stress], stretch);
        let zero = graph.number(0);
        substitute(graph, &slope, &BTreeMap::from([(stretch, zero)]))[0]
    }

    /// Functions of the invariants at a strain.
    fn at(&self, graph: &mut Graph, strain: &Strain, roots: &[Expr]) -> Vec<Expr> {
        let [first, second, volume] = strain.invariants;
        let values = BTreeMap::from([(FIRST, first), (SECOND, second), (VOLUME, volume)]);
        substitute(graph, roots, &values)
    }

    /// The total gradient of a function of the invariants and, through graded parameters, of X.
    fn gradient(
        &self,
        graph: &mut Graph,
        strain: &Strain,
        root: Expr,
        invariants: &[Vec<Expr>; 3],
    ) -> Vec<Expr> {
        let slopes = INVARIANTS.map(|invariant| differentiate(graph, &[root], invariant)[0]);
        let slopes = factor(graph, &slopes);
        let slopes = self.at(graph, strain, &slopes);
        (0..strain.gradient.dimension())
            .map(|axis| {
                let explicit = differentiate(graph, &[root], Symbol::Coordinate(axis))[0];
                let explicit = self.at(graph, strain, &[explicit])[0];
                let chained = dot(graph, (0..3).map(|k| (slopes[k], invariants[k][axis])));
                graph.add(explicit, chained)
            })
            .collect()
    }
}

/// (F C)_iJ,J = u_i,JK C_KJ + F_iK (u_m,KJ F_mJ + F_mK Lap u_m).
fn cubic_divergence(
    graph: &mut Graph,
    motion: &Motion,
    right: &Tensor,
    laplacian: &[Expr],
) -> Vec<Expr> {
    let dimension = laplacian.len();
    let deformation = &motion.strain.deformation;
    let first = motion.contract_second_gradient(graph, deformation);
    let transposed = deformation.transpose();
    let inner: Vec<Expr> = (0..dimension)
        .map(|k| {
            let second = dot(graph, (0..dimension).map(|m| (transposed.at(k, m), laplacian[m])));
            graph.add(first[k], second)
        })
        .collect();
    (0..dimension)
        .map(|i| {
            let direct = motion.second_gradient[i].contract(graph, right);
            let rotated = dot(graph, (0..dimension).map(|k| (deformation.at(i, k), inner[k])));
            graph.add(direct, rotated)
        })
        .collect()
}
