//! The named faces of a body: where they lie, and which way they look.

use crate::model::Body;
use mms_spec::Face;
use mms_symbolic::expr::{Expr, Graph, HALF, Rational, Symbol};
use mms_symbolic::pass::substitute::substitute;
use mms_symbolic::sorted::SortedMap;

/// The radius, among the coordinates of [`polar`].
pub const RADIUS: Symbol = Symbol::Coordinate(0);
/// The angle, among the coordinates of [`polar`].
pub const ANGLE: Symbol = Symbol::Coordinate(1);

/// The outward reference unit normal N of a face as a function of X, one component per dimension.
///
/// It is constant on the faces of a box and on the straight edges of a sector; on the circles of an
/// annulus it is X/R, or -X/R on the inner one.
pub fn normal(graph: &mut Graph, body: &Body, dimension: usize, face: Face) -> Vec<Expr> {
    let along = |graph: &mut Graph, axis: usize, sign: i32| {
        (0..dimension).map(|k| graph.number(if k == axis { sign } else { 0 })).collect()
    };
    match (face, body) {
        (Face::Min(axis), _) => along(graph, axis, -1),
        (Face::Max(axis), _) => along(graph, axis, 1),
        (Face::Inner, _) => radial(graph, -1),
        (Face::Outer, _) => radial(graph, 1),
        (Face::ThetaMin, Body::Annulus { theta, .. }) => tangential(graph, theta[0], -1),
        (Face::ThetaMax, Body::Annulus { theta, .. }) => tangential(graph, theta[1], 1),
        (Face::ThetaMin | Face::ThetaMax, Body::Box { .. }) => {
            unreachable!("a box has no straight edges of a sector")
        }
    }
}

/// X/R or its opposite.
fn radial(graph: &mut Graph, sign: i32) -> Vec<Expr> {
    let radius = radius(graph);
    let scaled = graph.power(radius, -1);
    let scaled = graph.scale(scaled, sign);
    (0..2)
        .map(|axis| {
            let coordinate = graph.symbol(Symbol::Coordinate(axis));
            graph.mul(coordinate, scaled)
        })
        .collect()
}

/// R = sqrt(X^2 + Y^2).
fn radius(graph: &mut Graph) -> Expr {
    let coordinates = [0, 1].map(|axis| graph.symbol(Symbol::Coordinate(axis)));
    let squares = coordinates.map(|coordinate| (graph.power(coordinate, 2), Rational::ONE));
    let square = graph.sum(squares);
    graph.power(square, HALF)
}

/// The direction in which the angle grows, at that angle, or its opposite.
fn tangential(graph: &mut Graph, angle: Expr, sign: i32) -> Vec<Expr> {
    let [sine, cosine] = circular(graph, angle);
    vec![graph.scale(sine, -sign), graph.scale(cosine, sign)]
}

fn circular(graph: &mut Graph, angle: Expr) -> [Expr; 2] {
    use mms_symbolic::expr::Function::{Cos, Sin};
    [Sin, Cos].map(|function| graph.call(function, &[angle]))
}

/// What X is in terms of coordinates between whose bounds the body is a box: of themselves for a
/// box (nothing is replaced), of radius and angle for an annulus, X = R cos theta and Y = R sin
/// theta, which take the places of X and Y.
pub fn polar(graph: &mut Graph, body: &Body) -> SortedMap<Symbol, Expr> {
    if matches!(body, Body::Box { .. }) {
        return SortedMap::new();
    }
    let (radius, angle) = (graph.symbol(RADIUS), graph.symbol(ANGLE));
    let [sine, cosine] = circular(graph, angle);
    let (x, y) = (graph.mul(radius, cosine), graph.mul(radius, sine));
    SortedMap::from([(Symbol::Coordinate(0), x), (Symbol::Coordinate(1), y)])
}

/// The bounds of the coordinates of [`polar`], in their order.
pub fn bounds(body: &Body) -> Vec<[Expr; 2]> {
    match body {
        Body::Box { lower, upper } => {
            lower.iter().zip(upper).map(|(lower, upper)| [*lower, *upper]).collect()
        }
        Body::Annulus { inner, outer, theta } => vec![[*inner, *outer], *theta],
    }
}

/// The coordinate of [`polar`] that is constant on a face, and whether it is at its upper bound.
pub fn fixed_coordinate(face: Face) -> (usize, bool) {
    match face {
        Face::Min(axis) => (axis, false),
        Face::Max(axis) => (axis, true),
        Face::Inner => (0, false),
        Face::Outer => (0, true),
        Face::ThetaMin => (1, false),
        Face::ThetaMax => (1, true),
    }
}

/// The point of a face that a point X of the body stands for, as a function of X: the nearest one on a
/// flat face of a box, that of the same angle on a circle, that of the same radius on an edge.
pub fn projection(graph: &mut Graph, body: &Body, face: Face) -> SortedMap<Symbol, Expr> {
    let (axis, is_upper) = fixed_coordinate(face);
    let bound = bounds(body)[axis][usize::from(is_upper)];
    if matches!(body, Body::Box { .. }) {
        return SortedMap::from([(Symbol::Coordinate(axis), bound)]);
    }
    let point = match face {
        Face::ThetaMin | Face::ThetaMax => {
            let [sine, cosine] = circular(graph, bound);
            let radius = radius(graph);
            [cosine, sine].map(|component| graph.mul(radius, component))
        }
        _ => {
            let direction = radial(graph, 1);
            [0, 1].map(|axis| graph.mul(bound, direction[axis]))
        }
    };
    (0..2).map(Symbol::Coordinate).zip(point).collect()
}

/// The faces that a body has with these values of its parameters: a disc has no inner face, and a
/// whole ring no edges. `declared` are those of its shape.
pub fn present(
    graph: &mut Graph,
    body: &Body,
    declared: Vec<Face>,
    parameters: &SortedMap<Symbol, Expr>,
) -> Vec<Face> {
    let Body::Annulus { inner, theta, .. } = *body else { return declared };
    let pi = graph.pi();
    let turn = [(theta[1], Rational::ONE), (theta[0], Rational::NEG_ONE), (pi, Rational::from(-2))];
    let rest = graph.sum(turn);
    let ends = substitute(graph, &[inner, rest], parameters);
    let (is_disc, is_whole) = (graph.is_zero(ends[0]), graph.is_zero(ends[1]));
    let exists = |face: &Face| match face {
        Face::Inner => !is_disc,
        Face::ThetaMin | Face::ThetaMax => !is_whole,
        Face::Outer | Face::Min(_) | Face::Max(_) => true,
    };
    declared.into_iter().filter(exists).collect()
}
