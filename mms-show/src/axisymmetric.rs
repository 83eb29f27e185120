//! The terms that the turning basis adds to gradients and divergences, as on paper: fractions over R.

use super::reading::Reading;
use mms_mechanics::tensor::Tensor;
use mms_spec::Space;
use mms_symbolic::expr::{Expr, Rational, Symbol};

/// The component of H along the hoop in a row: -u_theta/R, 0 and u_R/R.
pub(super) fn around(reading: &mut Reading, displacement: &[Expr], row: usize) -> Expr {
    let radius = reading.graph.symbol(Symbol::Coordinate(0));
    match row {
        0 => {
            let turned = reading.graph.div(displacement[2], radius);
            reading.graph.scale(turned, -1)
        }
        2 => reading.graph.div(displacement[0], radius),
        _ => reading.graph.number(0),
    }
}

/// The terms of a row of the divergence of a tensor beside derivatives: (T_11 - T_33)/R, T_21/R and (T_31 + T_13)/R.
pub(super) fn spreading(
    reading: &mut Reading,
    space: Space,
    tensor: &Tensor,
    row: usize,
) -> Option<(Expr, Rational)> {
    if !space.is_axisymmetric() {
        return None;
    }
    let graph = &mut reading.graph;
    let sum = match row {
        0 => graph.sub(tensor.at(0, 0), tensor.at(2, 2)),
        1 => tensor.at(1, 0),
        _ => graph.add(tensor.at(2, 0), tensor.at(0, 2)),
    };
    let radius = graph.symbol(Symbol::Coordinate(0));
    Some((graph.div(sum, radius), Rational::ONE))
}
