//! The traction on a face, as an expression in the coordinates of the body: each point of the body
//! stands for the point of the face that it projects to.

use std::collections::BTreeMap;

use crate::expr::{Expr, Function, Graph, Rational, Symbol};
use crate::mechanics::model::{Body, Model};
use crate::pass::substitute::substitute;
use crate::spec::Face;

/// `traction` with X on the face and N its outward unit normal.
pub fn on_face(graph: &mut Graph, body: &Body, face: Face, traction: &[Expr]) -> Vec<Expr> {
    let values = match body {
        Body::Box { lower, upper } => on_box(graph, lower, upper, face),
        Body::Annulus { inner, outer, theta } => on_annulus(graph, [*inner, *outer], *theta, face),
    };
    substitute(graph, traction, &values)
}

/// Along an axis.
fn on_box(graph: &mut Graph, lower: &[Expr], upper: &[Expr], face: Face) -> BTreeMap<Symbol, Expr> {
    let (axis, bound, sign) = match face {
        Face::Min(axis) => (axis, lower[axis], -1),
        Face::Max(axis) => (axis, upper[axis], 1),
        Face::Inner | Face::Outer | Face::ThetaMin | Face::ThetaMax => return BTreeMap::new(),
    };
    let mut values = BTreeMap::from([(Symbol::Coordinate(axis), bound)]);
    for other in 0..lower.len() {
        let component = graph.number(if other == axis { sign } else { 0 });
        values.insert(Symbol::Normal(other), component);
    }
    values
}

/// Along a radius to a circle, or at the same radius to an edge.
fn on_annulus(
    graph: &mut Graph,
    radii: [Expr; 2],
    theta: [Expr; 2],
    face: Face,
) -> BTreeMap<Symbol, Expr> {
    let [x, y] = [0, 1].map(|axis| graph.symbol(Symbol::Coordinate(axis)));
    let squares = [x, y].map(|coordinate| (graph.power(coordinate, 2), Rational::ONE));
    let square = graph.sum(squares);
    let radius = graph.power(square, Rational::from_parts(1.into(), 2u8.into()));
    let mut along_radius = |length: Expr, sign: i32| {
        let direction = [x, y].map(|coordinate| graph.div(coordinate, radius));
        let point = direction.map(|component| graph.mul(length, component));
        (point, direction.map(|component| graph.scale(component, sign)))
    };
    let (point, normal) = match face {
        Face::Inner => along_radius(radii[0], -1),
        Face::Outer => along_radius(radii[1], 1),
        Face::ThetaMin => edge(graph, radius, theta[0], 1),
        Face::ThetaMax => edge(graph, radius, theta[1], -1),
        Face::Min(_) | Face::Max(_) => return BTreeMap::new(),
    };
    let axes = (0..2).flat_map(|axis| {
        [(Symbol::Coordinate(axis), point[axis]), (Symbol::Normal(axis), normal[axis])]
    });
    axes.collect()
}

/// The point of a radius at an angle, and the normal of that ray: `sign` turns it clockwise.
fn edge(graph: &mut Graph, radius: Expr, angle: Expr, sign: i32) -> ([Expr; 2], [Expr; 2]) {
    let [cosine, sine] =
        [Function::Cos, Function::Sin].map(|function| graph.call(function, &[angle]));
    let point = [cosine, sine].map(|component| graph.mul(radius, component));
    (point, [graph.scale(sine, sign), graph.scale(cosine, -sign)])
}

/// The faces that a body has with the default parameters: a disc has no inner face, and a whole
/// ring no edges. `values` are those of the parameters.
pub fn faces(graph: &mut Graph, model: &Model, declared: Vec<Face>, values: &[Expr]) -> Vec<Face> {
    let Body::Annulus { inner, theta, .. } = model.domain.body else { return declared };
    let values = values.iter().enumerate();
    let values = values.map(|(index, value)| (Symbol::Parameter(index), *value)).collect();
    let pi = graph.pi();
    let turn = graph.scale(pi, 2);
    let angle = graph.sub(theta[1], theta[0]);
    let rest = graph.sub(angle, turn);
    let [inner, rest] = substitute(graph, &[inner, rest], &values)[..] else { return declared };
    let (is_disc, is_whole) = (graph.is_zero(inner), graph.is_zero(rest));
    let exists = |face: &Face| match face {
        Face::Inner => !is_disc,
        Face::ThetaMin | Face::ThetaMax => !is_whole,
        Face::Outer | Face::Min(_) | Face::Max(_) => true,
    };
    declared.into_iter().filter(exists).collect()
}
