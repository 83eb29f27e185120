//! Evaluates expressions at a few places of the body, in double-double, and finds which are 0 there, and which are 0 for all
//! parameters.

use mms_math::coordinates::System;
use mms_math::polygon;
use mms_math::{Double, Scalar as _};

use crate::extent::{Block, Region, halton, spread};
use crate::model::Model;
use mms_program::interpret::{Number as _, binary, unary};
use mms_symbolic::expr::{ByExpr, Expr, Graph, Node, Rational, Symbol};

/// The number of places, anywhere, where an identity is tested.
const ANYWHERE: usize = 24;
/// The least number of these places at which the values must be finite.
const ENOUGH: usize = 6;

/// The steps of evaluating a node.
pub(super) const STEPS_OF_VALUE: u64 = 20;

/// The size relative to its largest term below which a sum of 31 digits counts as 0.
const CANCELLED: f64 = 1e-24;

/// Values of the parameters, of X and of t.
#[derive(Clone, Debug)]
pub(super) struct SamplePoint {
    pub parameters: Vec<Double>,
    pub coordinates: Vec<Double>,
    pub time: Double,
}

/// Whether the sum of expressions is 0 for all parameters, X and t, although some term is not.
pub(super) fn cancel(graph: &mut Graph, model: &Model, terms: &[Expr]) -> bool {
    let sum = graph.sum(terms.iter().map(|term| (*term, Rational::ONE)));
    let places = anywhere(graph, model, &defaults(graph, model), None);
    let values = evaluate(graph, &[&[sum], terms].concat(), &places);
    let is_something = |value: &Double| value.to_f64().is_finite() && value.to_f64() != 0.0;
    let counts = |index: &usize| terms.iter().any(|term| is_something(&values[*term][*index]));
    let sums = (0..places.len()).filter(counts).map(|index| values[sum][index]);
    is_identity(&sums.collect::<Vec<_>>())
}

/// Whether some values are finite, and all of these are 0.
pub(super) fn vanishes(values: &[Double]) -> bool {
    let mut finite = values.iter().filter(|value| value.to_f64().is_finite()).peekable();
    finite.peek().is_some() && finite.all(|value| value.to_f64() == 0.0)
}

/// Whether values are 0 at enough places to be 0 for any signs of the parameters and of X.
pub(super) fn is_identity(values: &[Double]) -> bool {
    let finite = values.iter().filter(|value| value.to_f64().is_finite()).count();
    finite >= ENOUGH && vanishes(values)
}

/// The defaults of the parameters.
pub(super) fn defaults(graph: &Graph, model: &Model) -> Vec<Double> {
    let mut place = nowhere(&[]);
    for parameter in &model.parameters {
        let value = value(graph, parameter.default, &place);
        place.parameters.push(value);
    }
    place.parameters
}

/// The bounds of the body and of the time window.
pub(super) fn bounds(model: &Model) -> Vec<Expr> {
    [&model.domain.body.values()[..], &model.domain.time].concat()
}

/// `count` places of the body.
pub(super) fn places(
    graph: &Graph,
    model: &Model,
    parameters: &[Double],
    count: usize,
) -> Vec<SamplePoint> {
    // The first points of the sequence have simple fractions, where X may equal Y.
    let fractions: Vec<[Double; 4]> = (101..101 + count).map(halton).collect();
    places_at(graph, model, parameters, &fractions)
}

/// The corners of the body, its middle and the middles of edges and faces, at the first time and halfway.
pub(super) fn edges(graph: &Graph, model: &Model, parameters: &[Double]) -> Vec<SamplePoint> {
    let dimension = model.space.coordinates();
    let ends = [0.0, 0.5, 1.0].map(Double::from_f64);
    let of_index = |index: usize| {
        let fraction = |axis: usize| match axis {
            3 => ends[index % 2],
            _ if axis < dimension => ends[index / 3usize.pow(axis as u32) % 3],
            _ => ends[0],
        };
        [0, 1, 2, 3].map(fraction)
    };
    let fractions: Vec<[Double; 4]> = (0..3usize.pow(dimension as u32)).map(of_index).collect();
    places_at(graph, model, parameters, &fractions)
}

/// The places at these fractions of the way through the body and the time window.
fn places_at(
    graph: &Graph,
    model: &Model,
    parameters: &[Double],
    fractions: &[[Double; 4]],
) -> Vec<SamplePoint> {
    let nowhere = nowhere(parameters);
    let of = |bound: &Expr| value(graph, *bound, &nowhere);
    let extent = model.domain.body.map(of);
    let [first, last] = [0, 1].map(|end: usize| of(&model.domain.time[end]));
    let place = |fractions: &[Double; 4]| SamplePoint {
        parameters: parameters.to_vec(),
        coordinates: extent.point(fractions),
        time: first + (last - first) * fractions[3],
    };
    fractions.iter().map(place).collect()
}

/// The size of a parameter with this default.
pub(super) fn size(default: &Double) -> Double {
    if default.to_f64() == 0.0 { Double::from_f64(1.0) } else { *default }
}

/// Places with parameters, X and t of their usual size and of any sign; the parameter `nothing`, if any, is 0.
pub(super) fn anywhere(
    graph: &Graph,
    model: &Model,
    parameters: &[Double],
    nothing: Option<usize>,
) -> Vec<SamplePoint> {
    let usual: Vec<Double> =
        parameters.iter().map(size).chain(extent(graph, model, parameters)).collect();
    let place = |index: usize| {
        let fractions = spread(index, usual.len());
        let signed = fractions.iter().map(|fraction| {
            Double::from_rational(&(fraction * Rational::from(4) - Rational::from(2)))
        });
        let mut all = usual.iter().zip(signed).map(|(usual, factor)| *usual * factor);
        let mut parameters: Vec<Double> = all.by_ref().take(parameters.len()).collect();
        if let Some(index) = nothing {
            parameters[index] = Double::from_f64(0.0);
        }
        let coordinates = all.by_ref().take(3).collect();
        let time = all.next().unwrap_or(Double::from_f64(0.5));
        SamplePoint { parameters, coordinates, time }
    };
    (101..101 + ANYWHERE).map(place).collect()
}

/// The sizes of the three components of X and of t in the body and in the time window.
fn extent(graph: &Graph, model: &Model, parameters: &[Double]) -> [Double; 4] {
    let nowhere = nowhere(parameters);
    let largest = |bounds: &[Expr]| {
        let bounds = bounds.iter().map(|bound| value(graph, *bound, &nowhere).to_f64().abs());
        let largest = bounds.filter(|bound| bound.is_finite()).fold(0.0, f64::max);
        size(&Double::from_f64(largest))
    };
    let along = |axis: usize| match &model.domain.body {
        Region::Block(Block { system: System::Cartesian, bounds }) => {
            bounds.get(axis).map_or(Double::from_f64(1.0), |bounds| largest(bounds))
        }
        Region::Block(Block { system: System::Polar, bounds }) if axis == 2 => {
            bounds.get(axis).map_or_else(|| largest(&bounds[0][1..]), |bounds| largest(bounds))
        }
        Region::Block(Block { bounds, .. }) => largest(&bounds[0][1..]),
        Region::Polygon(vertices) => {
            largest(&vertices.iter().map(|vertex| vertex[axis.min(1)]).collect::<Vec<_>>())
        }
        Region::Nothing(_) => Double::from_f64(1.0),
    };
    [along(0), along(1), along(2), largest(&model.domain.time)]
}

/// The triangles of a polygon, by the positions of their vertices, with the parameters at their defaults; none for another
/// body.
pub fn triangles(graph: &Graph, model: &Model) -> Vec<[usize; 3]> {
    vertices(graph, model).map_or_else(Vec::new, |vertices| polygon::triangles(&vertices))
}

/// The largest triangle of the polygon.
pub fn largest_triangle(graph: &Graph, model: &Model) -> [usize; 3] {
    let vertices = vertices(graph, model).unwrap_or_default();
    let area = |it: &[usize; 3]| polygon::area(&it.map(|corner| vertices[corner])).abs();
    let triangles = polygon::triangles(&vertices).into_iter();
    triangles.max_by(|a, b| area(a).total_cmp(&area(b))).unwrap_or([0, 1, 2])
}

fn vertices(graph: &Graph, model: &Model) -> Option<Vec<[f64; 2]>> {
    let Region::Polygon(vertices) = &model.domain.body else { return None };
    let defaults = defaults(graph, model);
    let number = |expr: Expr| value_with(graph, expr, &defaults).to_f64();
    Some(vertices.iter().map(|vertex| vertex.map(number)).collect())
}

/// The value of an expression without X and t, with these parameters.
pub(super) fn value_with(graph: &Graph, expr: Expr, parameters: &[Double]) -> Double {
    value(graph, expr, &nowhere(parameters))
}

/// Values of the parameters, for expressions without X and t.
fn nowhere(parameters: &[Double]) -> SamplePoint {
    SamplePoint {
        parameters: parameters.to_vec(),
        coordinates: Vec::new(),
        time: Double::from_f64(0.0),
    }
}

fn value(graph: &Graph, expr: Expr, place: &SamplePoint) -> Double {
    evaluate(graph, &[expr], std::slice::from_ref(place))[expr][0]
}

/// Values at some places of all sub-expressions of some expressions.
pub(super) struct Values {
    /// The sub-expressions, operands before users.
    pub reached: Vec<Expr>,
    /// The values of each sub-expression at all places.
    values: ByExpr<Vec<Double>>,
}

impl std::ops::Index<Expr> for Values {
    type Output = [Double];

    fn index(&self, expr: Expr) -> &[Double] {
        &self.values[expr]
    }
}

/// Evaluates all sub-expressions of `roots`; a sum that cancels is 0.
pub(super) fn evaluate(graph: &Graph, roots: &[Expr], places: &[SamplePoint]) -> Values {
    let mut values = ByExpr::<Vec<Double>>::of(roots);
    let reached = graph.reachable(roots);
    graph.work().spend(STEPS_OF_VALUE * (reached.len() * places.len()) as u64);
    for expr in reached.iter().copied() {
        let at = |(index, place)| at(graph.node(expr), |child| values[child][index], place);
        let of_places = places.iter().enumerate().map(at).collect();
        values.set(expr, of_places);
    }
    Values { reached, values }
}

/// The value of a node, where `of` returns the values of its operands.
pub(super) fn at(node: &Node, of: impl Fn(Expr) -> Double, place: &SamplePoint) -> Double {
    let zero = Double::from_f64(0.0);
    let without = |value: Double, scale: f64| {
        if value.to_f64().abs() <= CANCELLED * scale { zero } else { value }
    };
    match node {
        Node::Number(number) => Double::from_rational(number),
        Node::Pi => Double::pi(),
        Node::Symbol(Symbol::Parameter(index)) => place.parameters[*index],
        Node::Symbol(Symbol::Time) => place.time,
        Node::Symbol(Symbol::Coordinate(axis)) => place.coordinates[*axis],
        // A normal, or a symbol that no motion contains.
        Node::Symbol(_) => Double::from_f64(0.6),
        Node::Sum(constant, terms) => {
            let constant = Double::from_rational(constant);
            let mut scale = constant.to_f64().abs();
            let sum = terms.iter().fold(constant, |sum, (term, coefficient)| {
                let term = of(*term) * Double::from_rational(coefficient);
                scale = scale.max(term.to_f64().abs());
                sum + term
            });
            without(sum, scale)
        }
        Node::Product(factors) => factors
            .iter()
            .map(|(base, exponent)| power(of(*base), exponent))
            .fold(Double::from_f64(1.0), |product, factor| product * factor),
        Node::Call(function, arguments) => match arguments[..] {
            [a, b] => binary(*function, of(a), of(b)),
            // The sine of a rounded pi is not 0.
            _ => without(unary(*function, None, of(arguments[0])), 1e-4),
        },
        Node::Offset([coordinate, place]) => of(*coordinate) - of(*place),
        Node::Small(_, angle) => of(*angle),
    }
}

fn power(base: Double, exponent: &Rational) -> Double {
    let one = Double::from_f64(1.0);
    let whole = i32::try_from(exponent.numerator().clone()).ok().filter(|_| exponent.is_int());
    let Some(count) = whole else {
        let is_zero = base.to_f64() == 0.0 && *exponent > Rational::ZERO;
        return if is_zero { base } else { base.powf(Double::from_rational(exponent)) };
    };
    let mut power = one;
    for bit in (0..u32::BITS - count.unsigned_abs().leading_zeros()).rev() {
        power = power * power;
        if count.unsigned_abs() >> bit & 1 == 1 {
            power = power * base;
        }
    }
    if count < 0 { one / power } else { power }
}
