//! Stress, its divergence and the body force, in terms of the named components of F.
//!
//! With P = alpha F + beta F C + W,J cof F, alpha = 2 (W,I1 + I1 W,I2) and beta = -2 W,I2, and since
//! the divergence of cof F vanishes (the Piola identity),
//!
//! ```text
//! (Div P)_i = (alpha F_iJ + beta (F C)_iJ),J + cof F_iJ (W,J),J
//! ```
//!
//! See Bonet & Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, 2008, chapter 6. In
//! one dimension W is a function of F alone, and P its derivative.

use super::balance::{balance, current, density, measures, traction};
use super::energy::Energy;
use super::motion::{Formulas, Quantities};
use super::name::{Along, Name};
use super::reading::Reading;
use crate::compile::Compiled;
use crate::expr::{Expr, Rational};
use crate::quantity::Quantity;

/// Adds J and everything that follows from W and the density.
pub(super) fn derive(
    reading: &mut Reading,
    compiled: &Compiled,
    formulas: &Formulas,
    quantities: &mut Quantities,
) {
    let density = density(reading, compiled, formulas);
    let energy = Energy::read(reading, compiled, formulas);
    let solid = match quantities.dimension {
        1 => line(reading, compiled, quantities, &energy),
        _ => space(reading, compiled, quantities, &energy),
    };
    measures(reading, compiled, quantities);
    quantities.add(reading, compiled, Quantity::DivP, &solid);
    balance(reading, compiled, quantities, density);
    current(reading, compiled, quantities, density);
    traction(reading, compiled, quantities);
}

/// One dimension: W(F), P = dW/dF, Div P = dP/dX. Returns Div P.
fn line(
    reading: &mut Reading,
    compiled: &Compiled,
    quantities: &mut Quantities,
    energy: &Energy,
) -> Vec<Expr> {
    let stretch = quantities.component(reading, Quantity::DeformationGradient, 0);
    quantities.add(reading, compiled, Quantity::Jacobian, &[stretch]);
    let graph = &mut reading.graph;
    let square = graph.power(stretch, 2);
    let (one, two) = (graph.number(1), graph.number(2));
    let first = graph.add(square, two);
    let double = graph.scale(square, 2);
    let second = graph.add(double, one);
    // dI1/dF = 2 F, dI2/dF = 4 F, dJ/dF = 1.
    let (twice, fourfold) = (graph.scale(stretch, 2), graph.scale(stretch, 4));
    let values = [first, second, stretch];
    let slopes = energy.slopes(reading);
    let chained: Vec<_> = slopes
        .into_iter()
        .zip([twice, fourfold, one])
        .map(|(slope, inner)| {
            let slope = energy.at(reading, slope, values);
            (reading.graph.mul(slope, inner), Rational::ONE)
        })
        .collect();
    let stress = reading.graph.sum(chained);
    let stress = reading.tidy(stress);
    let energy = energy.at(reading, energy.value, values);
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
) -> Vec<Expr> {
    let dimension = quantities.dimension;
    let deformation = quantities.components(reading, Quantity::DeformationGradient);
    second_gradient(reading, quantities, &deformation);
    let cofactors = cofactors(reading, &deformation, dimension);
    let jacobian = jacobian(reading, compiled, quantities, &deformation, &cofactors);
    let slopes = energy.slopes(reading);
    let right = (!reading.graph.is_zero(slopes[1]))
        .then(|| quantities.symmetric(reading, Quantity::RightCauchyGreen));
    let values = invariants(reading, &deformation, right.as_deref(), jacobian, dimension);
    let whole = energy.at(reading, energy.value, values);
    quantities.add(reading, compiled, Quantity::StrainEnergy, &[whole]);
    let alongs = [Along::FirstInvariant, Along::SecondInvariant, Along::Jacobian];
    let [w1, w2, wj] = [0, 1, 2].map(|k| {
        let slope = energy.at(reading, slopes[k], values);
        let name = Name::plain("W").derivative(alongs[k]);
        match alongs[k] {
            // It stands beside a cofactor in every component, and is differentiated.
            Along::Jacobian if !reading.is_leaf(slope) => reading.helper(name, slope, "derived"),
            _ => reading.named(name, slope, "derived"),
        }
    });
    let graph = &mut reading.graph;
    let scaled = graph.mul(values[0], w2);
    let alpha = graph.add(w1, scaled);
    let alpha = graph.scale(alpha, 2);
    let beta = graph.scale(w2, -2);
    let cubic = right.map(|right| matrix_product(reading, &deformation, &right, dimension));
    let shear: Vec<Expr> = (0..deformation.len())
        .map(|k| {
            let graph = &mut reading.graph;
            let linear = graph.mul(alpha, deformation[k]);
            match &cubic {
                Some(cubic) => {
                    let term = graph.mul(beta, cubic[k]);
                    graph.add(linear, term)
                }
                None => linear,
            }
        })
        .collect();
    let stress: Vec<Expr> = (0..deformation.len())
        .map(|k| {
            let pressure = reading.graph.mul(wj, cofactors[k]);
            let stress = reading.graph.add(shear[k], pressure);
            reading.tidy(stress)
        })
        .collect();
    quantities.add(reading, compiled, Quantity::FirstPiolaKirchhoff, &stress);
    divergence(reading, &shear, &cofactors, wj, dimension)
}

fn divergence(
    reading: &mut Reading,
    shear: &[Expr],
    cofactors: &[Expr],
    pressure: Expr,
    dimension: usize,
) -> Vec<Expr> {
    let slopes: Vec<Expr> =
        (0..dimension).map(|axis| reading.derivative(pressure, Along::Coordinate(axis))).collect();
    (0..dimension)
        .map(|row| {
            let mut terms = Vec::new();
            for (axis, slope) in slopes.iter().enumerate() {
                let k = row * dimension + axis;
                terms.push((reading.derivative(shear[k], Along::Coordinate(axis)), Rational::ONE));
                terms.push((reading.graph.mul(cofactors[k], *slope), Rational::ONE));
            }
            let sum = reading.graph.sum(terms);
            reading.tidy(sum)
        })
        .collect()
}

/// F_iJ,K = F_iK,J: the order of derivatives does not matter, and one of the two is enough.
fn second_gradient(reading: &mut Reading, quantities: &Quantities, deformation: &[Expr]) {
    let dimension = quantities.dimension;
    for (k, id) in quantities.ids(Quantity::DeformationGradient).iter().enumerate() {
        let (row, column) = (k / dimension, k % dimension);
        for axis in 0..column {
            let mirrored = deformation[row * dimension + axis];
            let slope = reading.derivative(mirrored, Along::Coordinate(column));
            reading.declare_derivative(*id, Along::Coordinate(axis), slope);
        }
    }
}

/// cof F, row-major: dJ/dF.
fn cofactors(reading: &mut Reading, deformation: &[Expr], dimension: usize) -> Vec<Expr> {
    let at =
        |row: usize, column: usize| deformation[row % dimension * dimension + column % dimension];
    (0..dimension * dimension)
        .map(|k| {
            let (row, column) = (k / dimension, k % dimension);
            let graph = &mut reading.graph;
            if dimension == 2 {
                let sign = if row == column { 1 } else { -1 };
                return graph.scale(at(row + 1, column + 1), sign);
            }
            // Cyclic indices bring the sign along.
            let down = graph.mul(at(row + 1, column + 1), at(row + 2, column + 2));
            let up = graph.mul(at(row + 1, column + 2), at(row + 2, column + 1));
            let minor = graph.sub(down, up);
            let name = Name::indexed("cof", format!("{}{}", row + 1, column + 1));
            reading.named(name, minor, "derived")
        })
        .collect()
}

/// J = F_1J cof F_1J, with J,K = cof F_iJ F_iJ,K.
fn jacobian(
    reading: &mut Reading,
    compiled: &Compiled,
    quantities: &mut Quantities,
    deformation: &[Expr],
    cofactors: &[Expr],
) -> Expr {
    let dimension = quantities.dimension;
    let first_row: Vec<_> = (0..dimension).map(|k| (deformation[k], cofactors[k])).collect();
    let value = dot(reading, first_row);
    quantities.add(reading, compiled, Quantity::Jacobian, &[value]);
    let id = quantities.ids(Quantity::Jacobian)[0];
    let leaf = quantities.component(reading, Quantity::Jacobian, 0);
    if !reading.is_leaf(reading.entries[id].value) {
        for axis in (0..dimension).map(Along::Coordinate) {
            let slopes: Vec<_> = deformation
                .iter()
                .zip(cofactors)
                .map(|(component, cofactor)| (*cofactor, reading.derivative(*component, axis)))
                .collect();
            let slope = dot(reading, slopes);
            reading.declare_derivative(id, axis, slope);
        }
    }
    leaf
}

/// I1 and I2 by name, where the dimensions that a plane lacks contribute stretches of one, and J.
fn invariants(
    reading: &mut Reading,
    deformation: &[Expr],
    right: Option<&[Expr]>,
    jacobian: Expr,
    dimension: usize,
) -> [Expr; 3] {
    let squares: Vec<_> = deformation.iter().map(|component| (*component, *component)).collect();
    let sum = dot(reading, squares);
    let missing = reading.graph.number(i32::from(dimension == 2));
    let first = reading.graph.add(sum, missing);
    let first = reading.named(Name::plain("I1"), first, "derived");
    let Some(right) = right else { return [first, first, jacobian] };
    // I2 = ((tr C)^2 - tr C^2)/2.
    let squares: Vec<_> = right.iter().map(|component| (*component, *component)).collect();
    let contracted = dot(reading, squares);
    let graph = &mut reading.graph;
    let contracted = graph.add(contracted, missing);
    let square = graph.power(first, 2);
    let half = Rational::from_parts(1.into(), 2u8.into());
    let second = graph.sum([(square, half.clone()), (contracted, -half)]);
    let second = reading.named(Name::plain("I2"), second, "derived");
    [first, second, jacobian]
}

/// The sum of products.
pub(super) fn dot(reading: &mut Reading, pairs: Vec<(Expr, Expr)>) -> Expr {
    let graph = &mut reading.graph;
    let terms: Vec<_> = pairs.into_iter().map(|(a, b)| (graph.mul(a, b), Rational::ONE)).collect();
    graph.sum(terms)
}

/// The product of two square matrices, row-major.
pub(super) fn matrix_product(
    reading: &mut Reading,
    left: &[Expr],
    right: &[Expr],
    dimension: usize,
) -> Vec<Expr> {
    (0..dimension * dimension)
        .map(|k| {
            let (row, column) = (k / dimension, k % dimension);
            let pairs = (0..dimension)
                .map(|j| (left[row * dimension + j], right[j * dimension + column]))
                .collect();
            dot(reading, pairs)
        })
        .collect()
}
