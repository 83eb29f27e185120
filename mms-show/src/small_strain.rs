//! Stress and its divergence for a density of the small strain: P = W,t I + 2 W,s eps, with the
//! derivatives of W by tr eps and by eps:eps.

use super::axisymmetric::spreading;
use super::energy::Energy;
use super::motion::Quantities;
use super::name::Name;
use super::reading::Reading;
use super::stress::{slope, volume};
use mms_codegen::compile::Compiled;
use mms_mechanics::tensor::Tensor;
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
    let deformation = quantities.tensor(reading, Quantity::DeformationGradient);
    match dimension {
        1 => quantities.add(reading, compiled, Quantity::Jacobian, deformation.components()),
        _ => drop(volume(reading, compiled, quantities, &deformation)),
    }
    let strain = small_strain(reading, quantities);
    let trace = strain.trace(&mut reading.graph);
    let trace = reading.named(Name::plain("eps_trace"), trace, "derived");
    let square = strain.contract(&mut reading.graph, &strain);
    let square = reading.named(Name::plain("eps_squared"), square, "derived");
    let values = [(TRACE, trace), (SQUARE, square)];
    let whole = energy.at(reading, energy.value, &values);
    quantities.add(reading, compiled, Quantity::StrainEnergy, &[whole]);
    let [pressure, shear] =
        [TRACE, SQUARE].map(|invariant| slope(reading, energy, invariant, &values));
    let stress = Tensor::from_fn(dimension, |row, column| {
        let sheared = reading.graph.mul(shear, strain.at(row, column));
        let mut terms = vec![(sheared, Rational::from(2))];
        if row == column {
            terms.push((pressure, Rational::ONE));
        }
        let stress = reading.graph.sum(terms);
        reading.tidy(stress)
    });
    quantities.add(reading, compiled, Quantity::FirstPiolaKirchhoff, stress.components());
    (0..dimension)
        .map(|row| {
            let mut slopes: Vec<_> = (quantities.axes().enumerate())
                .map(|(axis, along)| {
                    (reading.derivative(stress.at(row, axis), along), Rational::ONE)
                })
                .collect();
            slopes.extend(spreading(reading, quantities.space, &stress, row));
            let sum = reading.graph.sum(slopes);
            reading.tidy(sum)
        })
        .collect()
}

/// eps = (H + H^T)/2, by name.
fn small_strain(reading: &mut Reading, quantities: &Quantities) -> Tensor {
    let dimension = quantities.dimension;
    let gradient = quantities.tensor(reading, Quantity::DisplacementGradient);
    let mut strain: Vec<Expr> = Vec::new();
    Tensor::from_fn(dimension, |row, column| {
        let component = match column < row {
            true => strain[column * dimension + row],
            false => {
                let pair = [gradient.at(row, column), gradient.at(column, row)];
                let value = reading.graph.sum(pair.map(|component| (component, HALF)));
                let index = match dimension {
                    1 => String::new(),
                    _ => format!("{}{}", row + 1, column + 1),
                };
                reading.named(Name::indexed("eps", index), value, "derived")
            }
        };
        strain.push(component);
        component
    })
}
