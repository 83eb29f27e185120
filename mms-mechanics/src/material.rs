//! Hyperelasticity: everything about stress follows from a strain-energy density W.
//!
//! This module has the parts common to both kinds of strain; `finite.rs` has the algebra of F, and `small_strain.rs` the
//! algebra of eps = (H + H^T)/2. A dimension that a field lacks has the stretch 1.

use crate::expansion;
use crate::finite::{self, Finite};
use crate::invariant::InvariantKind;
use crate::kinematics::{Motion, Strain};
use crate::small_strain::{self, SmallStrain};
use crate::tensor::{Tensor, dot};
use mms_symbolic::expr::{Expr, Graph, HALF, Rational, Symbol};
use mms_symbolic::pass::differentiate::differentiate;
use mms_symbolic::pass::factor::factor;
use mms_symbolic::pass::relations::Relations;
use mms_symbolic::pass::substitute::substitute;
use mms_symbolic::sorted::SortedMap;

/// A strain-energy density and the coefficients of its stress, as functions of the invariants.
#[derive(Clone, Debug)]
pub struct Law {
    /// W.
    energy: Expr,
    /// W in a form of second order in the strain.
    second_order: Expr,
    stress: Stress,
}

#[derive(Clone, Debug)]
enum Stress {
    Finite(Finite),
    SmallStrain(SmallStrain),
}

impl Law {
    /// Derives the coefficients of the stress from W, a density of that kind.
    pub fn new(graph: &mut Graph, energy: Expr, kind: &InvariantKind) -> Self {
        let stress = match kind {
            InvariantKind::Isotropic | InvariantKind::Fibrous(_) => {
                Stress::Finite(Finite::new(graph, energy, kind.symbols()))
            }
            InvariantKind::SmallStrain => Stress::SmallStrain(SmallStrain::new(graph, energy)),
        };
        let second_order = match kind {
            InvariantKind::Isotropic | InvariantKind::Fibrous(_) => {
                expansion::of_second_order(graph, energy)
            }
            InvariantKind::SmallStrain => energy,
        };
        Law { energy, second_order, stress }
    }

    /// W at a strain, from its form of second order.
    pub fn energy(&self, graph: &mut Graph, strain: &Strain) -> Expr {
        at(graph, strain, &[self.second_order])[0]
    }

    /// W at a strain as typed, with errors of the size of eps.
    pub fn typed_energy(&self, graph: &mut Graph, strain: &Strain) -> Expr {
        at(graph, strain, &[self.energy])[0]
    }

    /// P = dW/dF.
    pub fn first_piola_kirchhoff(&self, graph: &mut Graph, strain: &Strain) -> Tensor {
        match &self.stress {
            Stress::Finite(law) => law.first_piola_kirchhoff(graph, strain),
            Stress::SmallStrain(law) => law.first_piola_kirchhoff(graph, strain),
        }
    }

    /// tau = P F^T.
    pub fn kirchhoff(&self, graph: &mut Graph, strain: &Strain) -> Tensor {
        match &self.stress {
            Stress::Finite(law) => law.kirchhoff(graph, strain),
            Stress::SmallStrain(law) => {
                let stress = law.first_piola_kirchhoff(graph, strain);
                stress.mul(graph, &strain.deformation.transpose())
            }
        }
    }

    /// Div P, linear in the second gradient of u, so that small strains lose nothing.
    pub fn divergence(&self, graph: &mut Graph, motion: &Motion) -> Vec<Expr> {
        match &self.stress {
            Stress::Finite(law) => law.divergence(graph, motion),
            Stress::SmallStrain(law) => law.divergence(graph, motion),
        }
    }

    /// rho0 times the square of the speed of the fastest wave at F = I: n.Q(n) n of the acoustic tensor Q, for a longitudinal
    /// wave along n.
    ///
    /// In an isotropic solid no wave is faster. With fibres it is the greater of two, along the fibres and across them. It is
    /// assumed that W is stiffest in one of these directions, and stiffer in stretch than in shear.
    pub fn fastest_modulus(&self, graph: &mut Graph, kind: &InvariantKind) -> Expr {
        let InvariantKind::Fibrous(_) = kind else { return self.longitudinal_modulus(graph, kind) };
        let [along, across] = [1, 0].map(|component| {
            let direction = vec![graph.number(component)];
            self.longitudinal_modulus(graph, &InvariantKind::Fibrous(direction))
        });
        // The greater of a and b is half of a + b + |a - b|.
        let difference = graph.sub(along, across);
        let square = graph.power(difference, 2);
        let distance = graph.power(square, half());
        graph.sum([along, across, distance].map(|term| (term, half())))
    }

    /// dP_11/dF_11 at F = I, of a stretch along the first axis.
    fn longitudinal_modulus(&self, graph: &mut Graph, kind: &InvariantKind) -> Expr {
        let stretch = Symbol::Gradient(0, 0);
        let component = graph.symbol(stretch);
        let gradient = Tensor::from_components(1, vec![component]);
        let strain = Strain::new(graph, gradient, kind, &Relations::default());
        let stress = self.first_piola_kirchhoff(graph, &strain).at(0, 0);
        let slope = differentiate(graph, &[stress], stretch);
        let zero = graph.number(0);
        substitute(graph, &slope, &SortedMap::from([(stretch, zero)]))[0]
    }
}

/// dP_iJ/dF_kL of a density of that kind at a strain, in the order of the indices i, J, k, L, the
/// last one fastest. With the invariants I_a and their derivatives G_a = dI_a/dF it is
///
/// ```text
/// dP_iJ/dF_kL = W_ab (G_a)_iJ (G_b)_kL + W_a d(G_a)_iJ/dF_kL
/// ```
pub fn tangent(
    graph: &mut Graph,
    energy: Expr,
    kind: &InvariantKind,
    strain: &Strain,
) -> Vec<Expr> {
    let (symbols, gradients): (Vec<Symbol>, Vec<_>) = match kind {
        InvariantKind::Isotropic | InvariantKind::Fibrous(_) => finite::gradients(graph, strain),
        InvariantKind::SmallStrain => small_strain::gradients(graph, strain),
    }
    .into_iter()
    .unzip();
    let slopes = symbols.iter().map(|a| differentiate(graph, &[energy], *a)[0]);
    let slopes: Vec<Expr> = slopes.collect();
    let first = at(graph, strain, &slopes);
    let second: Vec<Vec<Expr>> = symbols
        .iter()
        .map(|b| {
            let curvatures = differentiate(graph, &slopes, *b);
            at(graph, strain, &curvatures)
        })
        .collect();
    let dimension = strain.gradient.dimension();
    let components = dimension * dimension;
    (0..components * components)
        .map(|place| {
            let (row, column) = (place / components, place % components);
            let mut terms = Vec::new();
            for (a, gradient) in gradients.iter().enumerate() {
                terms.push((graph.mul(first[a], gradient.slopes[place]), Rational::ONE));
                let by_row = gradient.value.components()[row];
                for (b, other) in gradients.iter().enumerate() {
                    let factors = [second[b][a], by_row, other.value.components()[column]];
                    let term = graph.product(factors.map(|factor| (factor, Rational::ONE)));
                    terms.push((term, Rational::ONE));
                }
            }
            graph.sum(terms)
        })
        .collect()
}

fn half() -> Rational {
    HALF
}

/// The derivative of an invariant by F.
pub(super) struct Gradient {
    /// dI/dF_iJ.
    pub value: Tensor,
    /// d2I/dF_iJ dF_kL, in the order of the indices.
    pub slopes: Vec<Expr>,
}

impl Gradient {
    /// Makes a gradient from the derivative and its own derivative, `slope(i, J, k, L)`.
    pub fn new(
        graph: &mut Graph,
        value: Tensor,
        mut slope: impl FnMut(&mut Graph, [usize; 4]) -> Expr,
    ) -> Self {
        let dimension = value.dimension();
        let places = 0..dimension.pow(4);
        let digit = |place: usize, position: u32| place / dimension.pow(position) % dimension;
        let slopes = places
            .map(|place| slope(graph, [3, 2, 1, 0].map(|position| digit(place, position))))
            .collect();
        Gradient { value, slopes }
    }
}

/// Functions of the invariants at a strain.
pub(super) fn at(graph: &mut Graph, strain: &Strain, roots: &[Expr]) -> Vec<Expr> {
    substitute(graph, roots, &strain.invariants)
}

/// The gradient of a function of the invariants at a fixed strain: through graded parameters.
pub(super) fn explicit_gradient(graph: &mut Graph, strain: &Strain, root: Expr) -> Vec<Expr> {
    (0..strain.gradient.dimension())
        .map(|axis| {
            let explicit = differentiate(graph, &[root], Symbol::Coordinate(axis))[0];
            at(graph, strain, &[explicit])[0]
        })
        .collect()
}

/// The total gradient of a function of the invariants and, through graded parameters, of X.
pub(super) fn gradient(
    graph: &mut Graph,
    motion: &Motion,
    root: Expr,
    symbols: &[Symbol],
) -> Vec<Expr> {
    let explicit = explicit_gradient(graph, &motion.strain, root);
    let chained = chained_gradient(graph, motion, root, symbols);
    explicit
        .into_iter()
        .zip(chained)
        .map(|(explicit, chained)| graph.add(explicit, chained))
        .collect()
}

/// The gradient of a function of the invariants through the invariants alone.
pub(super) fn chained_gradient(
    graph: &mut Graph,
    motion: &Motion,
    root: Expr,
    symbols: &[Symbol],
) -> Vec<Expr> {
    let strain = &motion.strain;
    let slopes: Vec<Expr> =
        symbols.iter().map(|symbol| differentiate(graph, &[root], *symbol)[0]).collect();
    let slopes = factor(graph, &slopes);
    let slopes = at(graph, strain, &slopes);
    (0..strain.gradient.dimension())
        .map(|axis| {
            let chained = symbols.iter().zip(&slopes);
            let chained =
                chained.map(|(symbol, slope)| (*slope, motion.invariant_gradients[symbol][axis]));
            dot(graph, chained)
        })
        .collect()
}
