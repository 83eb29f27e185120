//! Stress and its divergence for a density of the small strain: P = W,t I + 2 W,s eps, with the
//! derivatives of W by tr eps and by eps:eps.

use super::energy::Energy;
use super::matrix::dot;
use super::motion::Quantities;
use super::name::{Along, Name};
use super::reading::Reading;
use super::stress::{slope, volume};
use mms_codegen::compile::Compiled;
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::{Expr, HALF, Rational};

/// The positions of the invariants in their list.
const TRACE: usize = 4;
const SQUARE: usize = 5;

/// Adds J, W and P, and returns Div P.
pub(super) fn derive(
    reading: &mut Reading,
    compiled: &Compiled,
    quantities: &mut Quantities,
    energy: &Energy,
) -> Vec<Expr> {
    let dimension = quantities.dimension;
    let deformation = quantities.components(reading, Quantity::DeformationGradient);
    match dimension {
        1 => quantities.add(reading, compiled, Quantity::Jacobian, &deformation),
        _ => drop(volume(reading, compiled, quantities, &deformation)),
    }
    let strain = small_strain(reading, quantities);
    let diagonal = (0..dimension).map(|axis| (strain[axis * dimension + axis], Rational::ONE));
    let trace = reading.graph.sum(diagonal);
    let trace = reading.named(Name::plain("eps_trace"), trace, "derived");
    let squares = strain.iter().map(|component| (*component, *component)).collect();
    let square = dot(reading, squares);
    let square = reading.named(Name::plain("eps_squared"), square, "derived");
    let values = [(TRACE, trace), (SQUARE, square)];
    let whole = energy.at(reading, energy.value, &values);
    quantities.add(reading, compiled, Quantity::StrainEnergy, &[whole]);
    let [pressure, shear] =
        [TRACE, SQUARE].map(|invariant| slope(reading, energy, invariant, &values));
    let stress: Vec<Expr> = strain
        .iter()
        .enumerate()
        .map(|(k, component)| {
            let sheared = reading.graph.mul(shear, *component);
            let mut terms = vec![(sheared, Rational::from(2))];
            if k / dimension == k % dimension {
                terms.push((pressure, Rational::ONE));
            }
            let stress = reading.graph.sum(terms);
            reading.tidy(stress)
        })
        .collect();
    quantities.add(reading, compiled, Quantity::FirstPiolaKirchhoff, &stress);
    stress
        .chunks(dimension)
        .map(|row| {
            let slopes: Vec<_> = row
                .iter()
                .enumerate()
                .map(|(axis, component)| {
                    (reading.derivative(*component, Along::Coordinate(axis)), Rational::ONE)
                })
                .collect();
            let sum = reading.graph.sum(slopes);
            reading.tidy(sum)
        })
        .collect()
}

/// eps = (H + H^T)/2, row-major, by name.
fn small_strain(reading: &mut Reading, quantities: &Quantities) -> Vec<Expr> {
    let dimension = quantities.dimension;
    let gradient = quantities.components(reading, Quantity::DisplacementGradient);
    let mut strain: Vec<Expr> = Vec::new();
    for k in 0..gradient.len() {
        let (row, column) = (k / dimension, k % dimension);
        if column < row {
            strain.push(strain[column * dimension + row]);
            continue;
        }
        let pair = [gradient[k], gradient[column * dimension + row]];
        let value = reading.graph.sum(pair.map(|component| (component, HALF)));
        let index =
            if dimension == 1 { String::new() } else { format!("{}{}", row + 1, column + 1) };
        strain.push(reading.named(Name::indexed("eps", index), value, "derived"));
    }
    strain
}
