//! Checks that a material is an elastic solid in the undeformed body: W is smooth at F = I, and no wave grows there.
//!
//! The acoustic tensor Q_ik = A_iJkL n_J n_L must have no negative eigenvalue, and must not be 0. One direction n is tested if
//! the solid is isotropic, since all directions are then equal, and some tens of directions if it has fibres. Points of the body
//! are sampled, which is no proof.

use mms_math::Scalar as _;

use super::material::Counterexample;
use super::{Declared, digits};
use crate::materials::shipped;
use mms_mechanics::extent::Extent;
use mms_mechanics::invariant::{INVARIANTS, InvariantKind};
use mms_mechanics::kinematics::Strain;
use mms_mechanics::material::tangent;
use mms_mechanics::model::Model;
use mms_mechanics::tensor::Tensor;
use mms_program::precise::Precise;
use mms_spec::diagnostic::Diagnostic;
use mms_spec::source::Span;
use mms_symbolic::expr::{Expr, Graph, Symbol};
use mms_symbolic::pass::differentiate::differentiate;
use mms_symbolic::pass::relations::Relations;
use mms_symbolic::pass::substitute::substitute;
use mms_symbolic::sorted::SortedMap;

/// The size relative to the entries of a matrix below which a value is 0 up to rounding.
const ROUNDING: f64 = 1e-60;

impl Declared<'_> {
    /// Reports a density that is singular at F = I, or else one that is unstable there.
    pub(super) fn elasticity(&mut self, extent: &Extent<Precise>) {
        if self.smoothness(extent) {
            self.waves(extent);
        }
    }

    /// Checks that W, its slopes and its curvatures by the invariants exist at F = I: the stress and its divergence are made of
    /// them. Reports the first that does not.
    fn smoothness(&mut self, extent: &Extent<Precise>) -> bool {
        let (names, exprs) = curvatures(&mut self.graph, self.model);
        let Some(found) = self.sought_with_arguments(extent, &exprs, |_| true) else {
            return true;
        };
        let Some(index) = found.values.iter().position(|value| !value.is_defined()) else {
            return true;
        };
        let arguments = &self.field.material.arguments;
        match index.checked_sub(arguments.len()) {
            None => {
                let (name, formula) = &arguments[index];
                let message = format!("material parameter `{}` has no finite value", name.value);
                let diagnostic = Diagnostic::error(formula.span, message);
                self.refute(
                    diagnostic,
                    "this is not defined",
                    &found,
                    "it must be a number in the whole body",
                );
            }
            Some(index) => {
                let message = "the strain-energy density is singular at F = I";
                let diagnostic = Diagnostic::error(self.density_of_energy(), message);
                let label = format!("{} has no finite value there", names[index]);
                let help = "the undeformed body has a stress and a stiffness: write W with two derivatives by each invariant at F = I";
                self.refute(diagnostic, &label, &found, help);
            }
        }
        false
    }

    /// Reports a material in which a wave grows at F = I, or none travels: an acoustic tensor Q_ik = A_iJkL n_J n_L has a
    /// negative eigenvalue, or all are 0 (Ogden, Non-linear Elastic Deformations, 1984, section 6.2). A fluid passes: it has
    /// longitudinal waves.
    fn waves(&mut self, extent: &Extent<Precise>) {
        let model = self.model;
        let tangent = stiffness(&mut self.graph, model);
        let normals = normals(&model.kind, model.displacement.len());
        let count = model.arguments.len();
        let found = self
            .sought_with_arguments(extent, &tangent, |it| fault(&it[count..], &normals).is_none());
        let Some(found) = found else { return };
        let Some(fault) = fault(&found.values[count..], &normals) else { return };
        let (message, label) = match fault {
            Fault::Slack => {
                ("this material has no stiffness at F = I", "all its moduli are 0".into())
            }
            Fault::Growth(normal, axis, modulus) => {
                let wave = match (&model.kind, axis) {
                    (InvariantKind::Fibrous(_), _) => {
                        let normal: Vec<_> = normal.iter().map(i32::to_string).collect();
                        format!("a wave along ({}) has a negative modulus", normal.join(", "))
                    }
                    (_, 0) => format!("longitudinal waves have the modulus {}", digits(&modulus)),
                    _ => format!("transverse waves have the modulus {}", digits(&modulus)),
                };
                ("this material is unstable at F = I", wave)
            }
        };
        let span = self.weakest_argument(&found).unwrap_or_else(|| self.density_of_energy());
        let help = "the modulus of a wave is rho0 c^2, in an isotropic solid lambda + 2 mu and mu: c must be real";
        self.refute(Diagnostic::error(span, message), &label, &found, help);
    }

    /// Searches for a point where expressions are wrong, with the material's arguments before them.
    fn sought_with_arguments(
        &self,
        extent: &Extent<Precise>,
        exprs: &[Expr],
        is_right: impl Fn(&[Precise]) -> bool,
    ) -> Option<Counterexample> {
        let exprs = [&self.model.arguments, exprs].concat();
        let moves = |expr: &Expr| self.graph.symbols(*expr).contains(&Symbol::Time);
        // Expressions that change in time are reported when they are read, and so is a graph that is too large.
        if self.graph.is_exhausted() || exprs.iter().any(moves) {
            return None;
        }
        self.sought(extent, &exprs, is_right)
    }

    /// The least of the material's arguments that are not positive; of equals, the last.
    fn weakest_argument(&self, found: &Counterexample) -> Option<Span> {
        let zero = Precise::from_f64(0.0);
        let arguments = self.field.material.arguments.iter().zip(&found.values);
        let weak = arguments.filter(|(_, value)| value.at_most(&zero));
        let least = weak.reduce(|a, b| if b.1.at_most(a.1) { b } else { a });
        least.map(|((_, formula), _)| formula.span)
    }

    /// The place where W is written: the choice of a shipped material in the field file, or the user's own formula.
    fn density_of_energy(&self) -> Span {
        let model = &self.field.material.model;
        if shipped(model.value.raw()).is_some() {
            model.span
        } else {
            self.material.strain_energy.span
        }
    }
}

/// W, its slopes and its curvatures by the invariants at F = I, with their names; given fields are at rest.
pub fn curvatures(graph: &mut Graph, model: &Model) -> (Vec<String>, Vec<Expr>) {
    let symbols = model.kind.symbols();
    let (mut names, mut exprs) = (vec!["W".to_string()], vec![model.rest_energy]);
    for (place, a) in symbols.iter().enumerate() {
        let slope = differentiate(graph, &[model.rest_energy], *a)[0];
        names.push(format!("dW/d{}", name(*a)));
        exprs.push(slope);
        for b in &symbols[place..] {
            names.push(format!("d(dW/d{})/d{}", name(*a), name(*b)));
            exprs.push(differentiate(graph, &[slope], *b)[0]);
        }
    }
    let zero = graph.number(0);
    let undeformed: SortedMap<_, _> = symbols.iter().map(|symbol| (*symbol, zero)).collect();
    (names, substitute(graph, &exprs, &undeformed))
}

/// dP/dF at F = I, with each given field at rest.
pub fn stiffness(graph: &mut Graph, model: &Model) -> Vec<Expr> {
    let zero = graph.number(0);
    let gradient = Tensor::from_fn(model.displacement.len(), |_, _| zero);
    let strain = Strain::new(graph, gradient, &model.kind, &Relations::default());
    tangent(graph, model.rest_energy, &model.kind, &strain)
}

/// The name of an invariant in a density.
fn name(symbol: Symbol) -> &'static str {
    INVARIANTS.iter().find(|it| it.symbol == symbol).map_or("?", |invariant| invariant.name)
}

/// Directions in a body, of any length: for an isotropic solid one is enough.
fn normals(kind: &InvariantKind, dimension: usize) -> Vec<Vec<i32>> {
    if !matches!(kind, InvariantKind::Fibrous(_)) {
        return vec![(0..dimension).map(|axis| i32::from(axis == 0)).collect()];
    }
    let components = -2..=2;
    let count = components.clone().count();
    let vector = |index: usize| -> Vec<i32> {
        let digit = |axis: u32| components.start() + (index / count.pow(axis) % count) as i32;
        (0..dimension as u32).map(digit).collect()
    };
    let all = (0..count.pow(dimension as u32)).map(vector);
    // A wave goes both ways.
    all.filter(|normal| normal.iter().find(|it| **it != 0).is_some_and(|first| *first > 0))
        .collect()
}

/// Q_ik = A_iJkL n_J n_L, by rows.
fn acoustic(tangent: &[Precise], normal: &[i32]) -> Vec<Vec<Precise>> {
    let dimension = normal.len();
    let entry = |i: usize, k: usize| {
        let pairs = (0..dimension).flat_map(|j| (0..dimension).map(move |l| (j, l)));
        pairs.fold(Precise::from_f64(0.0), |sum, (j, l)| {
            let place = ((i * dimension + j) * dimension + k) * dimension + l;
            match normal[j] * normal[l] {
                0 => sum,
                weight => sum + tangent[place].clone() * Precise::from_f64(f64::from(weight)),
            }
        })
    };
    (0..dimension).map(|i| (0..dimension).map(|k| entry(i, k)).collect()).collect()
}

/// A mistake in a stiffness.
enum Fault {
    /// A wave along this direction grows: the row and the pivot that show it.
    Growth(Vec<i32>, usize, Precise),
    /// No wave travels along any direction.
    Slack,
}

/// The mistake in dP/dF for waves along these directions, if any.
fn fault(tangent: &[Precise], normals: &[Vec<i32>]) -> Option<Fault> {
    let zero = Precise::from_f64(0.0);
    let mut is_slack = true;
    for normal in normals {
        let acoustic = acoustic(tangent, normal);
        is_slack &= acoustic.iter().flatten().all(|it| it.clone().magnitude().at_most(&zero));
        if let Some((row, pivot)) = negative_pivot(acoustic) {
            return Some(Fault::Growth(normal.clone(), row, pivot));
        }
    }
    is_slack.then_some(Fault::Slack)
}

/// The pivot that proves a negative eigenvalue of a symmetric matrix, with its row: it is negative, or it is 0 in a row that is
/// not 0.
fn negative_pivot(mut matrix: Vec<Vec<Precise>>) -> Option<(usize, Precise)> {
    let size = matrix.iter().flatten().cloned().map(Precise::magnitude);
    let largest = size.reduce(|a, b| if a.at_most(&b) { b } else { a })?;
    let rounding = largest * Precise::from_f64(ROUNDING);
    let is_zero = |value: &Precise| value.clone().magnitude().at_most(&rounding);
    for row in 0..matrix.len() {
        let (above, rest) = matrix.split_at_mut(row + 1);
        let above = &above[row];
        let pivot = &above[row];
        if is_zero(pivot) && above[row..].iter().all(is_zero) {
            continue;
        }
        if pivot.at_most(&rounding) {
            return Some((row, pivot.clone()));
        }
        for below in rest {
            let factor = below[row].clone() / pivot.clone();
            for (entry, over) in below.iter_mut().zip(above) {
                *entry = entry.clone() - factor.clone() * over.clone();
            }
        }
    }
    None
}
