//! Derivatives of axisymmetric fields: the terms of the basis that turns about the axis, in addition to the derivatives by R
//! and Z.
//!
//! Components refer to the fixed basis e_R, e_Z, e_theta at the reference angle, in this order. Around the hoop a vector turns
//! with its point, so its gradient has a third column, and the gradient of a scalar a third entry 0:
//!
//! ```text
//!         u_R,R   u_R,Z   -u_t/R                 u_R,RR   u_R,RZ   H_Rt,R
//! H_iJ =  u_Z,R   u_Z,Z      0        u_R,JK  =  u_R,ZR   u_R,ZZ   H_Rt,Z    u_Z,tt = u_Z,R/R
//!         u_t,R   u_t,Z    u_R/R                 H_Rt,R   H_Rt,Z   H_tt,R    u_t,tt = -H_Rt,R
//! ```
//!
//! The second gradient is the gradient of H in curvilinear coordinates. Differences of quotients are written as the derivative
//! of one quotient: (u_R,R - u_R/R)/R is (u_R/R),R. All other formulas of mechanics are the three-dimensional ones, and (Div
//! P)_R contains (P_RR - P_tt)/R since its second gradients do. So only u_R, u_t and u_Z,R are divided by R, and R-components
//! of fluxes and directions. R is divided out of each in exact numbers, so that the axis is a point like any other; [`poles`]
//! lists the formulas that R does not divide.

use crate::model::Model;
use crate::tensor::{Tensor, derivative};
use mms_spec::own::{Own, Part};
use mms_symbolic::expr::{ByExpr, Expr, Graph, Node, Rational, Symbol, reachable};
use mms_symbolic::pass::expand::expand;
use mms_symbolic::pass::factor::factor;

/// A formula, as written in the file, whose quotient by R has no value on the axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pole {
    /// The component of the displacement at this index; for the component along the axis, its slope along R.
    Displacement(usize),
    /// The component of the direction of fibres at this index.
    Fibre(usize),
    /// The component along R of a flux.
    Flux(Own),
}

/// H of a vector with three components.
pub(super) fn gradient(graph: &mut Graph, radius: Expr, vector: &[Expr]) -> Tensor {
    let [along, beside] = [0, 1].map(|axis| derivative(graph, vector, Symbol::Coordinate(axis)));
    let stretch = over_radius(graph, radius, vector[0]);
    let turn = over_radius(graph, radius, vector[2]);
    let turn = graph.scale(turn, -1);
    let hoop = [turn, graph.number(0), stretch];
    let columns = [along, beside, hoop.to_vec()];
    Tensor::from_fn(3, |row, column| columns[column][row])
}

/// The second gradient of a vector as one matrix per component, from its gradient.
pub(super) fn second_gradient(graph: &mut Graph, radius: Expr, gradient: &Tensor) -> Vec<Tensor> {
    let [along, beside] = [0, 1].map(|axis| {
        let slopes = derivative(graph, gradient.components(), Symbol::Coordinate(axis));
        Tensor::from_components(3, slopes)
    });
    let around = [
        along.at(2, 2),
        over_radius(graph, radius, gradient.at(1, 0)),
        graph.scale(along.at(0, 2), -1),
    ];
    let of_component = |row: usize| {
        Tensor::from_fn(3, |j, k| match (j.min(k), j.max(k)) {
            (2, 2) => around[row],
            (0, 2) => along.at(row, 2),
            (1, 2) => beside.at(row, 2),
            _ if k == 0 => along.at(row, j),
            _ => beside.at(row, j),
        })
    };
    (0..3).map(of_component).collect()
}

/// Computes Q_R/R, which the divergence of a flux Q adds to the derivatives of its components.
pub(super) fn spreading(graph: &mut Graph, radius: Expr, flux: &[Expr]) -> Expr {
    over_radius(graph, radius, flux[0])
}

/// The formulas of a field, as written in the file, whose quotients by R have no value on the axis.
pub fn poles(graph: &mut Graph, model: &Model) -> Vec<Pole> {
    let Some(radius) = model.radius else { return Vec::new() };
    graph.with_temporary_nodes(|graph| {
        let slope = derivative(graph, &model.displacement[1..2], Symbol::Coordinate(0))[0];
        let displacement = [model.displacement[0], slope, model.displacement[2]];
        let displacement = (0..3).map(|index| (Pole::Displacement(index), displacement[index]));
        let fibre = model.fibre.iter();
        let fibre = fibre.flat_map(|a| [0, 2].map(|index| (Pole::Fibre(index), a[index])));
        let fluxes = model.own.iter().filter(|(own, _)| own.part == Part::Flux);
        let fluxes = fluxes.map(|(own, flux)| (Pole::Flux(*own), flux[0]));
        let divided: Vec<_> = displacement.chain(fibre).chain(fluxes).collect();
        let has_pole = |(_, expr): &(Pole, Expr)| divide(graph, radius, *expr).is_none();
        divided.into_iter().filter(has_pole).map(|(pole, _)| pole).collect()
    })
}

/// The quotient by R; R is divided out if possible.
fn over_radius(graph: &mut Graph, radius: Expr, expr: Expr) -> Expr {
    match divide(graph, radius, expr) {
        Some(quotient) => factor(graph, &[quotient])[0],
        None => graph.div(expr, radius),
    }
}

/// The quotient of an expression that R divides, tried with common factors taken out, and multiplied out.
fn divide(graph: &mut Graph, radius: Expr, expr: Expr) -> Option<Expr> {
    let expr = factor(graph, &[expr])[0];
    divide_terms(graph, radius, expr).or_else(|| {
        let expanded = expand(graph, &[expr], &[Symbol::Coordinate(0)])[0];
        divide_terms(graph, radius, expanded)
    })
}

/// The quotient of an expression if R divides it term by term: all terms of a sum, one factor of a product.
fn divide_terms(graph: &mut Graph, radius: Expr, root: Expr) -> Option<Expr> {
    let operands = |expr: Expr| -> Vec<Expr> {
        match graph.node(expr) {
            _ if expr == radius => Vec::new(),
            Node::Sum(_, terms) => terms.iter().map(|(term, _)| *term).collect(),
            Node::Product(factors) => {
                let whole = factors.iter().filter(|(_, exponent)| *exponent >= Rational::ONE);
                whole.map(|(base, _)| *base).collect()
            }
            _ => Vec::new(),
        }
    };
    let reached = reachable(&[root], Expr::index, |expr| operands(expr).into_iter());
    let mut quotients = ByExpr::<Option<Expr>>::of(&[root]);
    for expr in reached {
        let quotient = match graph.node(expr).clone() {
            _ if expr == radius => Some(graph.number(1)),
            _ if graph.is_zero(expr) => Some(expr),
            Node::Sum(constant, terms) if constant.is_zero() => {
                let divided = terms.into_iter().map(|(term, factor)| {
                    let quotient = (*quotients.get(term)?)?;
                    Some((quotient, factor))
                });
                divided.collect::<Option<Vec<_>>>().map(|terms| graph.sum(terms))
            }
            Node::Product(factors) => {
                let divided = factors.into_iter().find_map(|(base, exponent)| {
                    let quotient = quotients.get(base).copied().flatten()?;
                    (exponent >= Rational::ONE).then_some((base, quotient))
                });
                divided.map(|(base, quotient)| {
                    let powers = [(expr, 1), (base, -1), (quotient, 1)];
                    graph.product(powers.map(|(base, power)| (base, Rational::from(power))))
                })
            }
            _ => None,
        };
        quotients.set(expr, quotient);
    }
    quotients[root]
}
