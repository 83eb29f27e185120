//! Derives fields about a place far from the origin in coordinates relative to that place.
//!
//! If a body is a million times as far from the origin as it is large, X has six digits less to distinguish its points, and no
//! formula may lose more. k (X - s) - w t is one sum in the graph, k X - k s - w t, and k s - w t would be rounded first; a
//! multiplied-out square has X^2 and s^2 in separate terms. So some numbers are subtracted from the coordinates before anything
//! is derived: a parameter that only occurs subtracted from coordinates, and the corner of a box that is far from the origin.
//! X - s becomes a value of its own, [`Node::Offset`]: to every pass it is a leaf as exact as X is, with the slope 1, and in
//! the program a difference.

use crate::model::Model;
use crate::samples::{defaults, value_with};
use mms_symbolic::expr::{Expr, Graph, Node, Rational, Symbol};
use mms_symbolic::pass::substitute::{coordinates, substitute};
use mms_symbolic::sorted::{SortedMap, SortedSet};

/// The ratio of a coordinate to the size of the body from which the body counts as far from the origin.
const FAR: f64 = 4.0;

/// Replaces the coordinates by coordinates relative to the place of the field, if it has one: parameters that only occur
/// subtracted from coordinates, or a corner of a box that is far from the origin.
pub fn about_its_place(graph: &mut Graph, model: &mut Model) {
    let mut places = said(graph, model);
    places.extend(far_corners(graph, model, &places));
    let offsets = coordinates(graph, places, |graph, coordinate, place| {
        let offset = graph.offset(coordinate, place);
        graph.add(offset, place)
    });
    if !offsets.is_empty() {
        model.map_formulas_of_x(|exprs| substitute(graph, exprs, &offsets));
    }
}

/// The places that parameters define, by axes.
fn said(graph: &mut Graph, model: &Model) -> SortedMap<usize, Expr> {
    let axes: Vec<usize> = (0..model.space.coordinates()).collect();
    let mut places = SortedMap::<usize, Expr>::new();
    for parameter in subtracted(graph, model) {
        let mut some = std::iter::once(&axes[..]).chain(axes.chunks(1));
        let about = some.find(|axes| is_about(graph, model, axes, parameter));
        for axis in about.into_iter().flatten() {
            let others = places.get(axis);
            let place = others.map_or(parameter, |others| graph.add(*others, parameter));
            places.insert(*axis, place);
        }
    }
    places
}

/// Numbers near the lower bounds of a box, if these are far from the known places: multiples of a power of two that is about as
/// large as the box. Every precision represents them, and subtracts them from a coordinate without an error.
fn far_corners(
    graph: &mut Graph,
    model: &Model,
    places: &SortedMap<usize, Expr>,
) -> SortedMap<usize, Expr> {
    let Some(bounds) = model.domain.body.box_bounds() else { return SortedMap::new() };
    let defaults = defaults(graph, model);
    let far = |axis: usize| {
        let number = |expr: Expr| value_with(graph, expr, &defaults).to_f64();
        let (lower, upper) = (number(bounds[axis][0]), number(bounds[axis][1]));
        let (extent, place) = (upper - lower, places.get(&axis).map_or(0.0, |it| number(*it)));
        let step = extent.log2().ceil().exp2();
        let corner = Rational::try_from((lower / step).floor() * step).ok()?;
        let is_far = (lower - place).abs() >= FAR * extent;
        is_far.then(|| (axis, graph.number(corner)))
    };
    (0..bounds.len()).filter_map(far).collect()
}

/// The parameters that occur in a sum with a coordinate.
fn subtracted(graph: &mut Graph, model: &Model) -> SortedSet<Expr> {
    let is = |expr: Expr, wanted: fn(&Symbol) -> bool| match graph.node(expr) {
        Node::Symbol(symbol) => wanted(symbol),
        _ => false,
    };
    let mut found = SortedSet::new();
    for expr in graph.reachable(&model.in_space()) {
        let Node::Sum(_, terms) = graph.node(expr) else { continue };
        let of = |wanted| terms.iter().map(|(term, _)| *term).filter(move |it| is(*it, wanted));
        if of(|symbol| matches!(symbol, Symbol::Coordinate(_))).next().is_some() {
            found.extend(of(|symbol| matches!(symbol, Symbol::Parameter(_))));
        }
    }
    found
}

/// Whether the fields contain a parameter only in differences from coordinates.
fn is_about(graph: &mut Graph, model: &Model, axes: &[usize], parameter: Expr) -> bool {
    graph.with_temporary_nodes(|graph| {
        let places = axes.iter().map(|axis| (*axis, parameter));
        let moved = coordinates(graph, places, Graph::add);
        let fields = substitute(graph, &model.in_space(), &moved);
        !graph.reachable(&fields).contains(&parameter)
    })
}
