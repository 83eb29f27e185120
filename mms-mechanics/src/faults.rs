//! Fault injection: the wrong expressions of a defect. Without the feature `defects` each function returns the right one.

use crate::defect::{Defect, on};
use crate::divergence::Terms;
use mms_symbolic::expr::{Expr, Graph, HALF};

/// The terms of Div P.
pub(super) fn divergence(graph: &mut Graph, mut terms: Terms, jacobian: Expr) -> Terms {
    let zero = |graph: &mut Graph, slots: &mut [Expr]| slots.fill(graph.number(0));
    if on(Defect::SecondInvariant) {
        zero(graph, &mut terms.coefficients[1..2]);
    }
    if on(Defect::PressureGradient) {
        zero(graph, &mut terms.slopes[2]);
    }
    if on(Defect::VolumeGradient) {
        terms.log_volume.iter_mut().for_each(|slope| *slope = graph.mul(jacobian, *slope));
    }
    if on(Defect::DivergenceIndex) {
        for tensor in [&mut terms.deformation, &mut terms.cubic, &mut terms.inverse] {
            *tensor = tensor.transpose();
        }
    }
    if on(Defect::GradedModuli) {
        zero(graph, &mut terms.graded);
    }
    if on(Defect::FibrePull) {
        for [(_, pull), _] in terms.fibres.iter_mut().flatten() {
            *pull = graph.number(0);
        }
    }
    terms
}

/// The gradient of div u, in Div P at small strain.
pub(super) fn dilatation(graph: &mut Graph, right: Vec<Expr>) -> Vec<Expr> {
    if on(Defect::SmallDilatation) { vec![graph.number(0); right.len()] } else { right }
}

/// The velocity of a rotated body, which the Coriolis term has twice; the defect halves it.
pub(super) fn turned_velocity(graph: &mut Graph, right: &[Expr]) -> Vec<Expr> {
    if !on(Defect::Coriolis) {
        return right.to_vec();
    }
    right.iter().map(|rate| graph.scale(*rate, HALF)).collect()
}

/// b = a - Div P/rho0.
pub(super) fn body_force(
    graph: &mut Graph,
    right: Expr,
    [acceleration, divergence]: [Expr; 2],
    [density, per_volume]: [Expr; 2],
) -> Expr {
    if on(Defect::ForceSign) {
        let specific = graph.div(divergence, density);
        return graph.add(acceleration, specific);
    }
    if on(Defect::ForcePresentDensity) {
        let present = graph.mul(density, per_volume);
        let specific = graph.div(divergence, present);
        return graph.sub(acceleration, specific);
    }
    if on(Defect::InertiaDropped) {
        let specific = graph.div(divergence, density);
        return graph.scale(specific, -1);
    }
    if on(Defect::ForcePerVolume) {
        return graph.mul(right, density);
    }
    right
}

/// The model for the motion and its b, if they are derived with other moduli than the solver's stress.
#[cfg(feature = "defects")]
pub fn moduli(
    graph: &mut Graph,
    field: &mms_spec::FieldSpec,
    material: &mms_spec::MaterialSpec,
    model: &super::Model,
) -> Option<super::Model> {
    let names = field.material.arguments.iter().map(|(name, _)| name.value.as_str());
    let names: Vec<_> = names.collect();
    let place = |name: &str| names.iter().position(|other| *other == name);
    let (lambda, mu) = (place("lambda")?, place("mu")?);
    let mut arguments = model.arguments.clone();
    if on(Defect::LambdaDropped) {
        arguments[lambda] = graph.number(0);
    } else if on(Defect::ModuliSwapped) {
        arguments.swap(lambda, mu);
    } else {
        return None;
    }
    let energy = super::model::energy_with(graph, field, material, &arguments, &model.givens)?;
    Some(super::Model { energy, ..model.clone() })
}
