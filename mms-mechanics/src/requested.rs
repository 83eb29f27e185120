//! Quantities on request: S, pressure, von Mises stress and the small strain.
//!
//! Pressure and von Mises stress are of three dimensions. So the stress is computed for H padded with zeros for the dimensions
//! that a field lacks: plane strain, or uniaxial strain, by W itself. A rigid motion on top changes none of the stresses:
//!
//! ```text
//! S = F^-1 P     p = -tr(sigma)/3     von Mises = sqrt(3/2 s:s),  s = sigma + p I
//! ```
//!
//! At small strain there is one stress: S and sigma are P.

use crate::derivation::{Derivation, TooLarge, within_bound};
use crate::invariant::InvariantKind;
use crate::kinematics::{Strain, gradient_of};
use crate::material::Law;
use crate::model::Model;
use crate::tensor::Tensor;
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::{Expr, Graph, HALF, Rational};
use mms_symbolic::pass::relations::Relations;

/// The components of a quantity on request; none of any other.
///
/// # Errors
/// A derivation that outgrows the graph.
pub fn requested(
    graph: &mut Graph,
    model: &Model,
    derivation: &Derivation,
    quantity: Quantity,
) -> Result<Vec<Expr>, TooLarge> {
    let dimension = model.displacement.len();
    let gradient = match (&model.rigid, derivation.quantities.get(&Quantity::DisplacementGradient))
    {
        (None, Some(gradient)) => Tensor::from_components(dimension, gradient.clone()),
        _ => gradient_of(graph, model, &model.displacement),
    };
    let zero = graph.number(0);
    let padded = Tensor::from_fn(3, |row, column| match row.max(column) < dimension {
        true => gradient.at(row, column),
        false => zero,
    });
    let kind = match (&model.kind, &model.fibre) {
        (InvariantKind::Fibrous(_), Some(direction)) => InvariantKind::Fibrous(direction.clone()),
        (other, _) => other.clone(),
    };
    let strain = Strain::new(graph, padded, &kind, &Relations::default());
    let law = Law::new(graph, model.energy, &kind);
    let is_small = kind == InvariantKind::SmallStrain;
    let components = match quantity {
        Quantity::SecondPiolaKirchhoff => {
            let first = law.first_piola_kirchhoff(graph, &strain);
            let second = if is_small { first } else { strain.inverse.mul(graph, &first) };
            Tensor::from_fn(dimension, |row, column| second.at(row, column)).components().to_vec()
        }
        Quantity::SmallStrain => {
            let own = derivation.quantities.get(&Quantity::DisplacementGradient);
            let gradient =
                own.map_or(gradient, |own| Tensor::from_components(dimension, own.clone()));
            let transposed = gradient.transpose();
            let sum = gradient.add(graph, &transposed);
            let half = graph.number(HALF);
            sum.scale(graph, half).components().to_vec()
        }
        Quantity::Pressure => {
            let stress = cauchy(graph, &law, &strain, is_small);
            vec![pressure(graph, &stress)]
        }
        Quantity::VonMises => {
            let stress = cauchy(graph, &law, &strain, is_small);
            vec![von_mises(graph, &stress)]
        }
        _ => Vec::new(),
    };
    within_bound(graph, "stress")?;
    Ok(components)
}

fn cauchy(graph: &mut Graph, law: &Law, strain: &Strain, is_small: bool) -> Tensor {
    if is_small {
        return law.first_piola_kirchhoff(graph, strain);
    }
    let per_volume = graph.power(strain.jacobian, -1);
    law.kirchhoff(graph, strain).scale(graph, per_volume)
}

fn pressure(graph: &mut Graph, stress: &Tensor) -> Expr {
    let trace = stress.trace(graph);
    graph.scale(trace, Rational::from_parts((-1).into(), 3u8.into()))
}

/// Computes the von Mises stress from differences of the normal stresses, in which the pressure cancels: s:s = ((s1 - s2)^2 +
/// (s2 - s3)^2 + (s3 - s1)^2)/3 and the squares of the shear stresses.
fn von_mises(graph: &mut Graph, stress: &Tensor) -> Expr {
    let three_halves = Rational::from_parts(3.into(), 2u8.into());
    let mut terms = Vec::new();
    for row in 0..3 {
        let next = (row + 1) % 3;
        let difference = graph.sub(stress.at(row, row), stress.at(next, next));
        terms.push((graph.power(difference, 2), HALF));
        for shear in [stress.at(row, next), stress.at(next, row)] {
            terms.push((graph.power(shear, 2), three_halves.clone()));
        }
    }
    let square = graph.sum(terms);
    graph.power(square, HALF)
}
