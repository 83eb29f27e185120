//! Stress, its divergence and the body force, in terms of the named components of F.
//!
//! With P = alpha F + beta F C + W,J cof F + 2 W,I4 (F a0) x a0, alpha = 2 (W,I1 + I1 W,I2) and
//! beta = -2 W,I2, and since the divergence of cof F vanishes (the Piola identity),
//!
//! ```text
//! (Div P)_i = (alpha F_iJ + beta (F C)_iJ + 2 W,I4 (F a0)_i a0_J),J + cof F_iJ (W,J),J
//! ```
//!
//! See Bonet & Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, 2008, chapter 6. In
//! one dimension W is a function of F alone, and P its derivative.

use super::axisymmetric::spreading;
use super::balance::{balance, balances, current, density, givens, measures, traction};
use super::energy::Energy;
use super::fibres::Fibres;
use super::motion::{Formulas, Quantities};
use super::name::{Along, Name};
use super::reading::Reading;
use super::small_strain;
use mms_codegen::compile::Compiled;
use mms_mechanics::invariant::InvariantKind;
use mms_mechanics::tensor::{Tensor, dot};
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::{Expr, HALF, Rational};

/// The positions of the invariants in their list.
pub(super) const I1: usize = 0;
pub(super) const I2: usize = 1;
pub(super) const J: usize = 2;
pub(super) const I4: usize = 3;

/// Adds J and everything that follows from W and the density.
pub(super) fn derive(
    reading: &mut Reading,
    compiled: &Compiled,
    formulas: &Formulas,
    quantities: &mut Quantities,
) {
    let density = density(reading, compiled, formulas);
    givens(reading, compiled, formulas, quantities);
    let energy = Energy::read(reading, compiled, formulas, quantities);
    let fibres = Fibres::read(reading, compiled, formulas, quantities);
    let solid = match (&compiled.model.kind, quantities.dimension) {
        (InvariantKind::SmallStrain, _) => {
            small_strain::derive(reading, compiled, quantities, &energy)
        }
        (_, 1) => line(reading, compiled, quantities, &energy, fibres.as_ref()),
        _ => space(reading, compiled, quantities, &energy, fibres.as_ref()),
    };
    measures(reading, compiled, quantities);
    quantities.add(reading, compiled, Quantity::DivP, &solid);
    balance(reading, compiled, quantities, density);
    current(reading, compiled, quantities, density);
    traction(reading, compiled, quantities);
    balances(reading, compiled, quantities);
}

/// One dimension: W(F), P = dW/dF, Div P = dP/dX. Returns Div P.
fn line(
    reading: &mut Reading,
    compiled: &Compiled,
    quantities: &mut Quantities,
    energy: &Energy,
    fibres: Option<&Fibres>,
) -> Vec<Expr> {
    let stretch = quantities.component(reading, Quantity::DeformationGradient, 0);
    quantities.add(reading, compiled, Quantity::Jacobian, &[stretch]);
    let graph = &mut reading.graph;
    let square = graph.power(stretch, 2);
    let (one, two) = (graph.number(1), graph.number(2));
    let first = graph.add(square, two);
    let double = graph.scale(square, 2);
    let second = graph.add(double, one);
    // dI1/dF = 2 F, dI2/dF = 4 F, dJ/dF = 1, dI4/dF = 2 F a0_1^2.
    let (twice, fourfold) = (graph.scale(stretch, 2), graph.scale(stretch, 4));
    let mut values = vec![(I1, first), (I2, second), (J, stretch)];
    let mut inner = vec![twice, fourfold, one];
    if let Some(fibres) = fibres {
        let along = reading.graph.power(fibres.direction[0], 2);
        values.push((I4, fibres.stretch));
        inner.push(reading.graph.mul(twice, along));
    }
    let chained: Vec<_> = values
        .iter()
        .zip(inner)
        .map(|((invariant, _), inner)| {
            let slope = energy.slope(reading, *invariant);
            let slope = energy.at(reading, slope, &values);
            (reading.graph.mul(slope, inner), Rational::ONE)
        })
        .collect();
    let stress = reading.graph.sum(chained);
    let stress = reading.tidy(stress);
    let energy = energy.at(reading, energy.value, &values);
    quantities.add(reading, compiled, Quantity::StrainEnergy, &[energy]);
    quantities.add(reading, compiled, Quantity::FirstPiolaKirchhoff, &[stress]);
    let divergence = reading.derivative(stress, Along::Coordinate(0));
    vec![reading.tidy(divergence)]
}

/// Two and three dimensions. Returns Div P.
fn space(
    reading: &mut Reading,
    compiled: &Compiled,
    quantities: &mut Quantities,
    energy: &Energy,
    fibres: Option<&Fibres>,
) -> Vec<Expr> {
    let dimension = quantities.dimension;
    let deformation = quantities.tensor(reading, Quantity::DeformationGradient);
    let (cofactors, jacobian) = volume(reading, compiled, quantities, &deformation);
    let by_second = energy.slope(reading, I2);
    let right = (!reading.graph.is_zero(by_second))
        .then(|| quantities.symmetric(reading, Quantity::RightCauchyGreen));
    let mut values = invariants(reading, &deformation, right.as_ref(), jacobian);
    values.extend(fibres.map(|fibres| (I4, fibres.stretch)));
    let whole = energy.at(reading, energy.value, &values);
    quantities.add(reading, compiled, Quantity::StrainEnergy, &[whole]);
    let [w1, w2, wj] = [I1, I2, J].map(|invariant| slope(reading, energy, invariant, &values));
    let graph = &mut reading.graph;
    let scaled = graph.mul(values[0].1, w2);
    let alpha = graph.add(w1, scaled);
    let alpha = graph.scale(alpha, 2);
    let beta = graph.scale(w2, -2);
    let cubic = right.map(|right| deformation.mul(&mut reading.graph, &right));
    let pull = fibres.map(|fibres| {
        let slope = slope(reading, energy, I4, &values);
        (fibres, reading.graph.scale(slope, 2))
    });
    let shear = Tensor::from_fn(dimension, |row, column| {
        let graph = &mut reading.graph;
        let mut terms = vec![graph.mul(alpha, deformation.at(row, column))];
        terms.extend(cubic.as_ref().map(|cubic| graph.mul(beta, cubic.at(row, column))));
        terms.extend(pull.map(|(fibres, pull)| {
            let factors = [pull, fibres.present[row], fibres.direction[column]];
            graph.product(factors.map(|factor| (factor, Rational::ONE)))
        }));
        graph.sum(terms.into_iter().map(|term| (term, Rational::ONE)))
    });
    let stress = Tensor::from_fn(dimension, |row, column| {
        let pressure = reading.graph.mul(wj, cofactors.at(row, column));
        let stress = reading.graph.add(shear.at(row, column), pressure);
        reading.tidy(stress)
    });
    quantities.add(reading, compiled, Quantity::FirstPiolaKirchhoff, stress.components());
    divergence(reading, quantities, &shear, &cofactors, wj)
}

/// The derivative of W by an invariant, by name where that is shorter.
pub(super) fn slope(
    reading: &mut Reading,
    energy: &Energy,
    invariant: usize,
    values: &[(usize, Expr)],
) -> Expr {
    let slope = energy.slope(reading, invariant);
    let slope = energy.at(reading, slope, values);
    let name = Name::plain("W").derivative(Along::Invariant(invariant));
    // W_J multiplies a cofactor in every component, and is differentiated.
    if invariant == J && !reading.is_leaf(slope) {
        return reading.helper(name, slope, "derived");
    }
    reading.named(name, slope, "derived")
}

/// cof F, and J by name, of a plane or of space.
pub(super) fn volume(
    reading: &mut Reading,
    compiled: &Compiled,
    quantities: &mut Quantities,
    deformation: &Tensor,
) -> (Tensor, Expr) {
    second_gradient(reading, quantities, deformation);
    let cofactors = cofactors(reading, deformation);
    let jacobian = jacobian(reading, compiled, quantities, deformation, &cofactors);
    (cofactors, jacobian)
}

fn divergence(
    reading: &mut Reading,
    quantities: &Quantities,
    shear: &Tensor,
    cofactors: &Tensor,
    pressure: Expr,
) -> Vec<Expr> {
    let slopes: Vec<Expr> =
        quantities.axes().map(|along| reading.derivative(pressure, along)).collect();
    let rows = 0..shear.dimension();
    rows.map(|row| {
        let mut terms = Vec::new();
        for (axis, slope) in slopes.iter().enumerate() {
            let along = quantities.along(axis);
            terms.push((reading.derivative(shear.at(row, axis), along), Rational::ONE));
            terms.push((reading.graph.mul(cofactors.at(row, axis), *slope), Rational::ONE));
        }
        terms.extend(spreading(reading, quantities.space, shear, row));
        let sum = reading.graph.sum(terms);
        reading.tidy(sum)
    })
    .collect()
}

/// F_iJ,K = F_iK,J: the order of derivatives does not matter, and one of the two is enough.
fn second_gradient(reading: &mut Reading, quantities: &Quantities, deformation: &Tensor) {
    let dimension = quantities.dimension;
    for (k, id) in quantities.ids(Quantity::DeformationGradient).iter().enumerate() {
        let (row, column) = (k / dimension, k % dimension);
        if column >= quantities.space.coordinates() {
            continue;
        }
        for axis in 0..column {
            let mirrored = deformation.at(row, axis);
            let slope = reading.derivative(mirrored, quantities.along(column));
            reading.declare_derivative(*id, quantities.along(axis), slope);
        }
    }
}

/// cof F = dJ/dF, in space by name.
fn cofactors(reading: &mut Reading, deformation: &Tensor) -> Tensor {
    let cofactors = deformation.adjugate(&mut reading.graph).transpose();
    if deformation.dimension() < 3 {
        return cofactors;
    }
    Tensor::from_fn(deformation.dimension(), |row, column| {
        let name = Name::indexed("cof", format!("{}{}", row + 1, column + 1));
        reading.named(name, cofactors.at(row, column), "derived")
    })
}

/// J = F_1J cof F_1J, with J,K = cof F_iJ F_iJ,K.
fn jacobian(
    reading: &mut Reading,
    compiled: &Compiled,
    quantities: &mut Quantities,
    deformation: &Tensor,
    cofactors: &Tensor,
) -> Expr {
    let dimension = quantities.dimension;
    let first_row = (0..dimension).map(|k| (deformation.at(0, k), cofactors.at(0, k)));
    let value = dot(&mut reading.graph, first_row);
    quantities.add(reading, compiled, Quantity::Jacobian, &[value]);
    let id = quantities.ids(Quantity::Jacobian)[0];
    let leaf = quantities.component(reading, Quantity::Jacobian, 0);
    if !reading.is_leaf(reading.entries[id].value) {
        for axis in quantities.axes() {
            let slopes = Tensor::from_fn(dimension, |row, column| {
                reading.derivative(deformation.at(row, column), axis)
            });
            let slope = cofactors.contract(&mut reading.graph, &slopes);
            reading.declare_derivative(id, axis, slope);
        }
    }
    leaf
}

/// I1 and I2 by name, where the dimensions that a plane lacks contribute stretches of one, and J. I2
/// is left out where W is no function of it.
fn invariants(
    reading: &mut Reading,
    deformation: &Tensor,
    right: Option<&Tensor>,
    jacobian: Expr,
) -> Vec<(usize, Expr)> {
    let sum = deformation.contract(&mut reading.graph, deformation);
    let missing = reading.graph.number(i32::from(deformation.dimension() == 2));
    let first = reading.graph.add(sum, missing);
    let first = reading.named(Name::plain("I1"), first, "derived");
    let Some(right) = right else { return vec![(I1, first), (J, jacobian)] };
    // I2 = ((tr C)^2 - tr C^2)/2.
    let graph = &mut reading.graph;
    let contracted = right.contract(graph, right);
    let contracted = graph.add(contracted, missing);
    let square = graph.power(first, 2);
    let second = graph.sum([(square, HALF), (contracted, -HALF)]);
    let second = reading.named(Name::plain("I2"), second, "derived");
    vec![(I1, first), (I2, second), (J, jacobian)]
}
