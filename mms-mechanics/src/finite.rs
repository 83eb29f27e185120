//! Stress and its divergence from a strain-energy density W(I1, I2, J, I4).
//!
//! With C = F^T F, the 3-D invariants I1 = tr C, I2 = ((tr C)^2 - tr C^2)/2, J = det F, and the squared stretch I4 = a0.C a0 of
//! fibres in the unit reference direction a0,
//!
//! ```text
//! P = dW/dF = alpha F + beta F C + gamma F^-T + delta (F a0) x a0,
//! alpha = 2 (W_1 + I1 W_2),  beta = -2 W_2,  gamma = J W_J,  delta = 2 W_4
//! ```
//!
//! (Bonet & Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, 2008, chapter 6; Holzapfel, Nonlinear Solid
//! Mechanics, 2000, section 6.7). W is stored as a function of i1 = I1 - 3, i2 = I2 - 3, j = J - 1 and i4 = I4 - 1, which are
//! computed from H without cancellation, and of X, if a material parameter depends on it. P is rearranged in powers of the
//! strain, with s0 = alpha + beta + gamma, s1 = alpha + 2 beta, s2 = beta:
//!
//! ```text
//! P   = F^-T (s0 I + s1 (C - I) + s2 (C - I)^2)
//! tau = s0 I + s1 (B - I) + s2 (B - I)^2
//! ```
//!
//! s0 and s1 are multiplied out in the invariants: terms of the size of the modulus that cancel at F = I do so in exact
//! numbers, for every way of typing W.
//!
//! The divergence is not computed as the derivative of these components, whose expressions would grow with the material, but by
//! tensor algebra, linear in the second derivatives u_i,JK:
//!
//! ```text
//! (Div P)_i = alpha Lap u_i + F_iJ alpha,J + beta (F C)_iJ,J + (F C)_iJ beta,J + (gamma,J - gamma g_J) F^-1_Ji
//!             + f_i (a0_J delta,J + delta a0_J,J) + delta (a0_K a0_J u_i,KJ + F_iK a0_J a0_K,J)
//! g_J = F^-1_Kk u_k,KJ = (ln J),J          f = F a0
//! ```
//!
//! alpha,J and similar gradients follow from the derivatives by i1, i2, j, i4 and from explicit dependence on X. So b needs no
//! second derivative of W by F, and u is differentiated twice at most. a0 has three components; the components along dimensions
//! that a field lacks have no effect on stretches.

use crate::divergence::Terms;
use crate::faults;
use crate::invariant::{FIBRE, FIRST, SECOND, VOLUME};
use crate::kinematics::{Fibre, Motion, Strain, total};
use crate::material::{Gradient, at, chained_gradient, explicit_gradient, gradient};
use crate::tensor::{Tensor, dot};
use mms_symbolic::expr::{Expr, Graph, Rational, Symbol};
use mms_symbolic::pass::cancellation::avoid_cancellation;
use mms_symbolic::pass::differentiate::differentiate;
use mms_symbolic::pass::expand::expand;
use mms_symbolic::pass::factor::factor;

/// The coefficients of the stress, as functions of the invariants.
#[derive(Clone, Debug)]
pub(super) struct Finite {
    /// The variables of W.
    symbols: &'static [Symbol],
    /// The coefficient of F.
    alpha: Expr,
    /// The coefficient of F C.
    beta: Expr,
    /// The coefficient of F^-T.
    gamma: Expr,
    /// The coefficient of (F a0) x a0, if there are fibres.
    delta: Option<Expr>,
    /// The coefficients of I, C - I and (C - I)^2 in F^T P, without fibres.
    strain_form: [Expr; 3],
}

impl Finite {
    /// Differentiates W, a function of the departures `symbols`.
    pub fn new(graph: &mut Graph, energy: Expr, symbols: &'static [Symbol]) -> Self {
        let slopes =
            [FIRST, SECOND, VOLUME].map(|invariant| differentiate(graph, &[energy], invariant)[0]);
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
        // Terms that cancel at F = I must do so here, for W may be written such that they do not.
        let [constant, linear] = expand(graph, &[constant, linear], symbols)[..] else {
            unreachable!("as many roots as were given")
        };
        let constant = avoid_cancellation(graph, &[constant])[0];
        let coefficients = factor(graph, &[alpha, beta, gamma, constant, linear]);
        let [alpha, beta, gamma, constant, linear] = coefficients[..] else {
            unreachable!("as many roots as were given")
        };
        let delta = symbols.contains(&FIBRE).then(|| {
            let slope = differentiate(graph, &[energy], FIBRE)[0];
            let twice = graph.scale(slope, 2);
            factor(graph, &[twice])[0]
        });
        Finite { symbols, alpha, beta, gamma, delta, strain_form: [constant, linear, beta] }
    }

    /// P = F^-T (s0 I + s1 (C - I) + s2 (C - I)^2) + delta (F a0) x a0: each term is small where the
    /// strain is.
    pub fn first_piola_kirchhoff(&self, graph: &mut Graph, strain: &Strain) -> Tensor {
        let stress = self.polynomial(graph, strain, &strain.right);
        let stress = strain.inverse.transpose().mul(graph, &stress);
        self.with_fibres(graph, strain, stress, |fibre| &fibre.reference)
    }

    /// tau = s0 I + s1 (B - I) + s2 (B - I)^2 + delta (F a0) x (F a0) with B = F F^T: P F^T needs no
    /// inverse.
    pub fn kirchhoff(&self, graph: &mut Graph, strain: &Strain) -> Tensor {
        let stress = self.polynomial(graph, strain, &strain.left);
        self.with_fibres(graph, strain, stress, |fibre| &fibre.present)
    }

    fn polynomial(&self, graph: &mut Graph, strain: &Strain, base: &Tensor) -> Tensor {
        let coefficients = at(graph, strain, &self.strain_form);
        let identity = Tensor::identity(graph, base.dimension());
        let square = base.mul(graph, base);
        let mut stress = identity.scale(graph, coefficients[0]);
        for (power, coefficient) in [(base, coefficients[1]), (&square, coefficients[2])] {
            let term = power.scale(graph, coefficient);
            stress = stress.add(graph, &term);
        }
        stress
    }

    /// Adds delta (F a0) x v, if there are fibres.
    fn with_fibres(
        &self,
        graph: &mut Graph,
        strain: &Strain,
        stress: Tensor,
        v: impl Fn(&Fibre) -> &[Expr],
    ) -> Tensor {
        let (Some(delta), Some(fibre)) = (self.delta, &strain.fibre) else { return stress };
        let delta = at(graph, strain, &[delta])[0];
        let pull = Tensor::outer(graph, &fibre.present, v(fibre)).scale(graph, delta);
        stress.add(graph, &pull)
    }

    /// Div P from its terms: see [`crate::divergence`]. The gradients alpha,J etc. are taken through the strain, the graded
    /// part through X; g_J = F^-1_Kk u_k,KJ.
    pub fn divergence(&self, graph: &mut Graph, motion: &Motion) -> Vec<Expr> {
        let dimension = motion.displacement.len();
        let strain = &motion.strain;
        let laplacian = motion.laplacian(graph);
        let right = {
            let identity = Tensor::identity(graph, dimension);
            identity.add(graph, &strain.right)
        };
        let cubic = strain.deformation.mul(graph, &right);
        let roots = [self.alpha, self.beta, self.gamma];
        let slopes = roots.map(|root| chained_gradient(graph, motion, root, self.symbols));
        let graded = self.graded_divergence(graph, strain);
        let values = at(graph, strain, &roots);
        let cubic_divergence = cubic_divergence(graph, motion, &right, &laplacian);
        let terms = Terms {
            deformation: strain.deformation.clone(),
            cubic,
            inverse: strain.inverse.clone(),
            coefficients: [values[0], values[1], values[2]],
            slopes,
            laplacian,
            cubic_divergence,
            log_volume: motion.log_volume_gradient.clone(),
            graded,
            fibres: self.fibre_divergence(graph, motion),
        };
        faults::divergence(graph, terms, strain.jacobian).sum(graph)
    }

    /// dP_iJ/dX_J at fixed H, for moduli that depend on X: like P itself it is small at small strains, while the gradients of
    /// alpha, beta and gamma are not.
    fn graded_divergence(&self, graph: &mut Graph, strain: &Strain) -> Vec<Expr> {
        let dimension = strain.gradient.dimension();
        let slopes = self.strain_form.map(|root| explicit_gradient(graph, strain, root));
        let square = strain.right.mul(graph, &strain.right);
        let pulled: Vec<Expr> = (0..dimension)
            .map(|row| {
                let linear =
                    (0..dimension).map(|axis| (strain.right.at(row, axis), slopes[1][axis]));
                let linear = dot(graph, linear);
                let quadratic = (0..dimension).map(|axis| (square.at(row, axis), slopes[2][axis]));
                let quadratic = dot(graph, quadratic);
                total(graph, &[slopes[0][row], linear, quadratic])
            })
            .collect();
        strain.inverse.transpose().apply(graph, &pulled)
    }

    /// The part of fibres of (Div P)_i as two products, with f = F a0:
    ///
    /// ```text
    /// (delta f_i a0_J),J = f_i (a0_J delta,J + delta a0_J,J)
    ///                    + delta (a0_K a0_J u_i,KJ + F_iK a0_J a0_K,J)
    /// ```
    fn fibre_divergence(
        &self,
        graph: &mut Graph,
        motion: &Motion,
    ) -> Option<Vec<[(Expr, Expr); 2]>> {
        let (root, fibre) = (self.delta?, motion.strain.fibre.as_ref()?);
        let (direction, turning) = (&fibre.reference, motion.fibre_gradient.as_ref()?);
        let slope = gradient(graph, motion, root, self.symbols);
        let delta = at(graph, &motion.strain, &[root])[0];
        let along = dot(graph, direction.iter().copied().zip(slope));
        let spread = turning.trace(graph);
        let spread = graph.mul(delta, spread);
        let pull = graph.add(along, spread);
        let squared = Tensor::outer(graph, direction, direction);
        let turned = turning.apply(graph, direction);
        let turned = motion.strain.deformation.apply(graph, &turned);
        let rows = fibre.present.iter().zip(turned).enumerate();
        let parts = rows.map(|(row, (present, turned))| {
            let stretched = motion.second_gradient[row].contract(graph, &squared);
            [(*present, pull), (delta, graph.add(stretched, turned))]
        });
        Some(parts.collect())
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

/// The derivatives of the invariants by F, with d = delta_ik and so on:
///
/// ```text
/// dI1/dF = 2 F                 d2I1 = 2 d_ik d_JL
/// dI2/dF = 2 (I1 F - F C)      d2I2 = 4 F_iJ F_kL + 2 (I1 d_ik d_JL - d_ik C_LJ - F_iL F_kJ - B_ik d_JL)
/// dJ/dF  = J F^-T              d2J  = J (F^-1_Ji F^-1_Lk - F^-1_Jk F^-1_Li)
/// dI4/dF = 2 (F a0) x a0       d2I4 = 2 d_ik a0_J a0_L
/// ```
pub(super) fn gradients(graph: &mut Graph, strain: &Strain) -> Vec<(Symbol, Gradient)> {
    let dimension = strain.gradient.dimension();
    let identity = Tensor::identity(graph, dimension);
    let (right, left) = (identity.add(graph, &strain.right), identity.add(graph, &strain.left));
    let deformation = &strain.deformation;
    let (two, three) = (graph.number(2), graph.number(3));
    let trace = graph.add(strain.invariants[&FIRST], three);
    let delta = |i: usize, k: usize| identity.at(i, k);

    let value = deformation.scale(graph, two);
    let first = Gradient::new(graph, value, |graph, [i, j, k, l]| {
        graph.product([two, delta(i, k), delta(j, l)].map(|factor| (factor, Rational::ONE)))
    });

    let cubic = deformation.mul(graph, &right);
    let value = Tensor::from_fn(dimension, |i, j| {
        let linear = graph.mul(trace, deformation.at(i, j));
        let half = graph.sub(linear, cubic.at(i, j));
        graph.scale(half, 2)
    });
    let second = Gradient::new(graph, value, |graph, [i, j, k, l]| {
        let pairs = [
            (deformation.at(i, j), deformation.at(k, l), 4),
            (graph.mul(trace, delta(i, k)), delta(j, l), 2),
            (delta(i, k), right.at(l, j), -2),
            (deformation.at(i, l), deformation.at(k, j), -2),
            (left.at(i, k), delta(j, l), -2),
        ];
        let terms = pairs.map(|(a, b, factor)| (graph.mul(a, b), Rational::from(factor)));
        graph.sum(terms)
    });

    let (inverse, jacobian) = (&strain.inverse, strain.jacobian);
    let value = inverse.transpose().scale(graph, jacobian);
    let volume = Gradient::new(graph, value, |graph, [i, j, k, l]| {
        let ahead = graph.mul(inverse.at(j, i), inverse.at(l, k));
        let crossed = graph.mul(inverse.at(j, k), inverse.at(l, i));
        let difference = graph.sub(ahead, crossed);
        graph.mul(jacobian, difference)
    });

    let mut gradients = vec![(FIRST, first), (SECOND, second), (VOLUME, volume)];
    gradients.extend(strain.fibre.as_ref().map(|fibre| {
        let direction = &fibre.reference;
        let value = Tensor::outer(graph, &fibre.present, direction).scale(graph, two);
        let gradient = Gradient::new(graph, value, |graph, [i, j, k, l]| {
            let factors = [two, delta(i, k), direction[j], direction[l]];
            graph.product(factors.map(|factor| (factor, Rational::ONE)))
        });
        (FIBRE, gradient)
    }));
    gradients
}
