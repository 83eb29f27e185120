//! Quantities that follow from P and Div P: the other measures of stress, the body force, the quantities per volume of the
//! present configuration, the traction.

use super::abbreviate::LINE;
use super::motion::{Formulas, Quantities, derivatives};
use super::name::{Along, Name};
use super::reading::{Reading, Role};
use mms_codegen::compile::Compiled;
use mms_mechanics::invariant::InvariantKind;
use mms_spec::own::Part;
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::Expr;

/// rho0, by name where it is long; 1 if the field has none.
pub(super) fn density(reading: &mut Reading, compiled: &Compiled, formulas: &Formulas) -> Expr {
    let Some(formula) = &compiled.field.material.density else { return reading.graph.number(1) };
    let value = formulas.read(reading, formula, compiled.model.density);
    reading.named(Name::plain("rho0"), value, "material")
}

/// The given fields with their gradients and rates.
pub(super) fn givens(
    reading: &mut Reading,
    compiled: &Compiled,
    formulas: &Formulas,
    quantities: &mut Quantities,
) {
    let spec = &compiled.field;
    let of_material = spec.material.givens.iter().map(|(name, formula)| (&name.value, formula));
    let own = spec.givens.iter().map(|given| (&given.name.value, &given.value));
    let typed: Vec<_> = of_material.chain(own).collect();
    let mut value = reading.graph.number(0);
    for (own, derived) in &compiled.model.own {
        let values = match own.part {
            Part::Value => {
                let formula = typed.iter().find(|(name, _)| **name == own.of);
                value = formula
                    .map_or(derived[0], |(_, formula)| formulas.read(reading, formula, derived[0]));
                vec![value]
            }
            Part::Gradient => {
                let mut slopes: Vec<Expr> = (quantities.axes())
                    .flat_map(|along| derivatives(reading, &[value], along))
                    .collect();
                slopes.resize(quantities.space.vector(), reading.graph.number(0));
                slopes
            }
            Part::Rate => derivatives(reading, &[value], Along::Time),
            _ => continue,
        };
        quantities.add(reading, compiled, Quantity::Own(*own), &values);
    }
}

/// The sources and fluxes of further balances, and the residuals of constraints.
pub(super) fn balances(reading: &mut Reading, compiled: &Compiled, quantities: &mut Quantities) {
    for (own, derived) in &compiled.model.own {
        if Part::OF_GIVEN.contains(&own.part) {
            continue;
        }
        let values: Vec<_> = derived.iter().map(|component| reading.tidy(*component)).collect();
        quantities.add(reading, compiled, Quantity::Own(*own), &values);
    }
}

/// sigma, tau and P^T. They come after P and before Div P, as everywhere. At small strain all are P.
pub(super) fn measures(reading: &mut Reading, compiled: &Compiled, quantities: &mut Quantities) {
    let first = quantities.tensor(reading, Quantity::FirstPiolaKirchhoff);
    let deformation = quantities.tensor(reading, Quantity::DeformationGradient);
    let jacobian = quantities.component(reading, Quantity::Jacobian, 0);
    let nominal = first.transpose();
    quantities.add(reading, compiled, Quantity::NominalStress, nominal.components());
    if compiled.model.kind == InvariantKind::SmallStrain {
        quantities.add(reading, compiled, Quantity::CauchyStress, first.components());
        quantities.add(reading, compiled, Quantity::KirchhoffStress, first.components());
        return;
    }
    let kirchhoff = first.mul(&mut reading.graph, &deformation.transpose());
    let kirchhoff = kirchhoff.components();
    let cauchy: Vec<Expr> =
        kirchhoff.iter().map(|component| reading.graph.div(*component, jacobian)).collect();
    quantities.add(reading, compiled, Quantity::CauchyStress, &cauchy);
    quantities.add(reading, compiled, Quantity::KirchhoffStress, kirchhoff);
}

/// b = a - Div P/rho0 and rho0 b, written out where that fits on a line.
pub(super) fn balance(
    reading: &mut Reading,
    compiled: &Compiled,
    quantities: &mut Quantities,
    density: Expr,
) {
    let acceleration = quantities.components(reading, Quantity::Acceleration);
    let divergence = quantities.components(reading, Quantity::DivP);
    let specific = |reading: &mut Reading, [acceleration, divergence]: [Expr; 2]| {
        let part = reading.graph.div(divergence, density);
        reading.graph.sub(acceleration, part)
    };
    let per_volume = |reading: &mut Reading, [acceleration, divergence]: [Expr; 2]| {
        let inertia = reading.graph.mul(density, acceleration);
        reading.graph.sub(inertia, divergence)
    };
    type Balance<'a> = &'a dyn Fn(&mut Reading, [Expr; 2]) -> Expr;
    let forms: [(Quantity, Balance<'_>); 2] =
        [(Quantity::BodyForce, &specific), (Quantity::BodyForceDensity, &per_volume)];
    for (quantity, form) in forms {
        let mut values = Vec::new();
        let mut shown = Vec::new();
        for (row, pair) in acceleration.iter().zip(&divergence).enumerate() {
            let value = form(reading, [*pair.0, *pair.1]);
            values.push(value);
            let written_out = [Quantity::Acceleration, Quantity::DivP]
                .map(|quantity| reading.entries[quantities.ids(quantity)[row]].value);
            let whole = form(reading, written_out);
            let whole = reading.tidy(whole);
            shown.push(if reading.length(whole) <= LINE { whole } else { value });
        }
        quantities.add(reading, compiled, quantity, &values);
        quantities.show(reading, quantity, &shown);
    }
}

/// rho = rho0/J, div sigma = Div P/J and rho b = rho0 b/J; without J at small strain.
pub(super) fn current(
    reading: &mut Reading,
    compiled: &Compiled,
    quantities: &mut Quantities,
    density: Expr,
) {
    let jacobian = quantities.component(reading, Quantity::Jacobian, 0);
    let divergence = quantities.components(reading, Quantity::DivP);
    let force = quantities.components(reading, Quantity::BodyForceDensity);
    for (quantity, reference) in [
        (Quantity::MassDensity, vec![density]),
        (Quantity::DivSigma, divergence),
        (Quantity::CurrentBodyForceDensity, force),
    ] {
        let values: Vec<Expr> = match compiled.model.kind {
            InvariantKind::SmallStrain => reference,
            _ => reference.into_iter().map(|it| reading.graph.div(it, jacobian)).collect(),
        };
        quantities.add(reading, compiled, quantity, &values);
    }
}

/// T = P N.
pub(super) fn traction(reading: &mut Reading, compiled: &Compiled, quantities: &mut Quantities) {
    let dimension = quantities.dimension;
    let first = quantities.tensor(reading, Quantity::FirstPiolaKirchhoff);
    let zero = reading.graph.number(0);
    let normal: Vec<Expr> = (0..quantities.space.coordinates())
        .map(|axis| {
            let index = if dimension == 1 { String::new() } else { (axis + 1).to_string() };
            let name = reading.taken.fresh(Name::indexed("N", index), "derived");
            let id = reading.push(name, zero, Role::Given);
            reading.leaf(id)
        })
        .collect();
    let traction = first.apply(&mut reading.graph, &normal);
    quantities.add(reading, compiled, Quantity::Traction, &traction);
}
