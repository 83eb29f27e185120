//! Evaluates expressions at a few places of the body, in double-double: which are 0 there, and which are 0
//! whatever the parameters are.

use mms_math::coordinates::System;
use mms_math::polygon;
use mms_math::{Double, Scalar as _};

use crate::extent::{Block, Region, halton, spread};
use crate::model::Model;
use mms_program::interpret::{Number as _, binary, unary};
use mms_symbolic::expr::{ByExpr, Expr, Graph, Node, Rational, Symbol};

/// At how many places, anywhere, an identity is looked at, and how many of them must have a value.
const ANYWHERE: usize = 24;
const ENOUGH: usize = 6;

/// What it takes to evaluate a node.
pub(super) const STEPS_OF_VALUE: u64 = 20;

/// A sum is 0 where it is less than that of its terms, of 31 digits.
const CANCELLED: f64 = 1e-24;

/// Values of the parameters, of X and of t.
#[derive(Clone, Debug)]
pub(super) struct Spot {
    pub parameters: Vec<Double>,
    pub coordinates: Vec<Double>,
    pub time: Double,
}

/// Whether expressions are 0 together, whatever the parameters, X and t are, and not one by one.
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

/// Whether values are 0 at so many places that they are 0 for any signs of the parameters and of X.
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

/// What the body and the time window are bounded by.
pub(super) fn bounds(model: &Model) -> Vec<Expr> {
    [&model.domain.body.values()[..], &model.domain.time].concat()
}

/// As many places of the body as asked for.
pub(super) fn places(
    graph: &Graph,
    model: &Model,
    parameters: &[Double],
    count: usize,
) -> Vec<Spot> {
    // The first points of the sequence have simple fractions, where X may be Y.
    let fractions: Vec<[Double; 4]> = (101..101 + count).map(halton).collect();
    places_at(graph, model, parameters, &fractions)
}

/// The corners of the body, its middle and those of its edges and faces, at the first time and halfway.
pub(super) fn edges(graph: &Graph, model: &Model, parameters: &[Double]) -> Vec<Spot> {
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
) -> Vec<Spot> {
    let nowhere = nowhere(parameters);
    let of = |bound: &Expr| value(graph, *bound, &nowhere);
    let extent = model.domain.body.map(of);
    let [first, last] = [0, 1].map(|end: usize| of(&model.domain.time[end]));
    let place = |fractions: &[Double; 4]| Spot {
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

/// Places with parameters, X and t of their usual size and of any sign, but for a parameter that is 0.
pub(super) fn anywhere(
    graph: &Graph,
    model: &Model,
    parameters: &[Double],
    nothing: Option<usize>,
) -> Vec<Spot> {
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
        Spot { parameters, coordinates, time }
    };
    (101..101 + ANYWHERE).map(place).collect()
}

/// How large the three components of X and t are in the body and in the time window.
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

/// The triangles of a polygon, by the positions of their vertices, where the parameters have their defaults; none of another
/// body.
pub fn triangles(graph: &Graph, model: &Model) -> Vec<[usize; 3]> {
    vertices(graph, model).map_or_else(Vec::new, |vertices| polygon::triangles(&vertices))
}

/// The largest of them.
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

/// The value of what does not depend on X and t, with these parameters.
pub(super) fn value_with(graph: &Graph, expr: Expr, parameters: &[Double]) -> Double {
    value(graph, expr, &nowhere(parameters))
}

/// Values of the parameters, for what does not depend on X and t.
fn nowhere(parameters: &[Double]) -> Spot {
    Spot { parameters: parameters.to_vec(), coordinates: Vec::new(), time: Double::from_f64(0.0) }
}

fn value(graph: &Graph, expr: Expr, place: &Spot) -> Double {
    evaluate(graph, &[expr], std::slice::from_ref(place))[expr][0]
}

/// Values at some places of everything that some expressions are made of.
pub(super) struct Values {
    /// What they are made of, operands before users.
    pub reached: Vec<Expr>,
    /// Of each, the values at all places.
    values: ByExpr<Vec<Double>>,
}

impl std::ops::Index<Expr> for Values {
    type Output = [Double];

    fn index(&self, expr: Expr) -> &[Double] {
        &self.values[expr]
    }
}

/// The values of everything that `roots` are made of; what cancels is 0.
pub(super) fn evaluate(graph: &Graph, roots: &[Expr], places: &[Spot]) -> Values {
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

/// The value of a node, where `of` has those of its operands.
pub(super) fn at(node: &Node, of: impl Fn(Expr) -> Double, place: &Spot) -> Double {
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
        // A normal, or what is not in a motion.
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
