//! A first-order bound of the rounding error of expressions as written, at places of the body, after Wilkinson (Rounding Errors
//! in Algebraic Processes, 1963).

use mms_math::{Double, Scalar as _};

use crate::model::Model;
use crate::samples::{STEPS_OF_VALUE, SamplePoint, Values, at, defaults, evaluate, places};
use mms_program::interpret::Number as _;
use mms_symbolic::expr::{ByExpr, Expr, Graph, Node};

/// The part of an operand's error by which the operand is changed to find its effect.
const PART: f64 = 1e-12;

/// The growth of an error that still counts as about the same.
const ABOUT: f64 = 1.5;

/// The bound, in units of one rounding of the largest value, up to which all forms count as equally good.
const FEW: f64 = 64.0;

/// The ratio to the least bound from which a form is rejected if no bound is that small: a more expensive form must gain a
/// digit at least.
const MUCH: f64 = 16.0;

/// The number of places where errors are bounded.
const PLACES: usize = 4;

/// The places at which rounding errors are bounded.
#[derive(Clone, Debug, Default)]
pub struct Rounding {
    places: Vec<SamplePoint>,
}

impl Rounding {
    /// Chooses some places of the body, with the parameters at their defaults.
    pub fn new(graph: &Graph, model: &Model) -> Self {
        Rounding { places: places(graph, model, &defaults(graph, model), PLACES) }
    }

    /// Whether `after`, which has the same values as `before`, is about as exact.
    pub fn allows(&self, graph: &Graph, before: &[Expr], after: &[Expr]) -> bool {
        self.bound(graph, after) <= ABOUT * self.bound(graph, before)
    }

    /// Whether the bound is so small that no other form is needed.
    pub fn is_small(&self, graph: &Graph, roots: &[Expr]) -> bool {
        self.bound(graph, roots) <= FEW
    }

    /// The first of several forms of the same values with a small bound, or else the first whose bound is not much above the
    /// least.
    pub fn first<'a>(&self, graph: &Graph, ways: &[&'a [Expr]]) -> Option<&'a [Expr]> {
        let mut bounded = Vec::new();
        for way in ways {
            let bound = self.bound(graph, way);
            if bound <= FEW {
                return Some(way);
            }
            bounded.push((*way, bound));
        }
        let least = bounded.iter().map(|(_, bound)| *bound).fold(f64::INFINITY, f64::min);
        let good = bounded.into_iter().find(|(_, bound)| *bound <= MUCH * least);
        good.map(|(way, _)| way)
    }

    /// The largest error of any component at any place, in units of one rounding of the largest value; 0 if nothing is known.
    fn bound(&self, graph: &Graph, roots: &[Expr]) -> f64 {
        let values = evaluate(graph, roots, &self.places);
        let (mut error, mut value) = (0.0, 0.0);
        for (index, place) in self.places.iter().enumerate() {
            if graph.work().is_over() {
                break;
            }
            let errors = self.errors(graph, roots, &values, (index, place));
            for root in roots {
                let (own, size) = (errors[*root], values[*root][index].to_f64().abs());
                if own.is_finite() && size.is_finite() {
                    (error, value) = (f64::max(error, own), f64::max(value, size));
                }
            }
        }
        if error == 0.0 { 0.0 } else { error / value }
    }

    /// The errors of all sub-expressions at a place, in roundings of 1.
    fn errors(
        &self,
        graph: &Graph,
        roots: &[Expr],
        values: &Values,
        (index, place): (usize, &SamplePoint),
    ) -> ByExpr<f64> {
        let mut errors = ByExpr::of(roots);
        for expr in values.reached.iter().copied() {
            let node = graph.node(expr);
            let operands = node.children().count() as u64;
            let evaluations = if matches!(node, Node::Sum(..)) { 1 } else { operands };
            graph.work().spend(STEPS_OF_VALUE * operands * evaluations);
            let of = |child: Expr| values[child][index];
            let value = values[expr][index];
            let error = match graph.stage(expr).needs_point() {
                true => error(node, value, of, &errors, place),
                // This value has more digits until it is stored.
                false => value.to_f64().abs(),
            };
            errors.set(expr, error);
        }
        errors
    }
}

/// The error that operands pass on, plus a new rounding error.
fn error(
    node: &Node,
    value: Double,
    of: impl Fn(Expr) -> Double,
    errors: &ByExpr<f64>,
    place: &SamplePoint,
) -> f64 {
    // For every node except a sum, each operand is changed, and the node is evaluated again.
    let changed = |child: Expr| {
        let change = Double::from_f64(PART * errors[child]);
        let changed = |other| if other == child { of(child) + change } else { of(other) };
        (at(node, changed, place) - value).to_f64().abs() / PART
    };
    let passed_on: f64 = match node {
        Node::Sum(_, terms) => {
            terms.iter().map(|(term, by)| by.to_f64().value().abs() * errors[*term]).sum()
        }
        _ => node.children().map(changed).sum(),
    };
    let rounded = match node {
        Node::Sum(constant, terms) => {
            let mut total = Double::from_rational(constant);
            let partial = terms.iter().map(|(term, coefficient)| {
                total = total + of(*term) * Double::from_rational(coefficient);
                total.to_f64().abs()
            });
            partial.sum()
        }
        _ => node.children().count() as f64 * value.to_f64().abs(),
    };
    passed_on + rounded
}

#[cfg(test)]
mod tests {
    use super::*;
    use mms_symbolic::expr::{Rational, Symbol};

    /// Bounds at X = 1/2 and t = 1/3.
    fn rounding() -> Rounding {
        let [coordinate, time] = [0.5, 1.0 / 3.0].map(Double::from_f64);
        Rounding {
            places: vec![SamplePoint { parameters: vec![], coordinates: vec![coordinate], time }],
        }
    }

    #[test]
    fn what_is_added_and_taken_away_costs_its_digits() {
        let mut graph = Graph::default();
        let (t, x) = (graph.symbol(Symbol::Time), graph.symbol(Symbol::Coordinate(0)));
        let square = graph.mul(x, x);
        let plain = graph.mul(t, square);
        // t x^2 is t (x^2 + k) - k t.
        let mut shifted = |k: i32| {
            let k_itself = graph.number(k);
            let sum = graph.add(square, k_itself);
            let product = graph.mul(t, sum);
            graph.sum([(product, Rational::ONE), (t, Rational::from(-k))])
        };
        let [near, far, farther] = [0, 1000, 1_000_000].map(&mut shifted);
        let rounding = rounding();
        assert_eq!(near, plain);
        assert!(!rounding.allows(&graph, &[plain], &[far]));
        assert!(rounding.allows(&graph, &[far], &[plain]));
        // t and x^2 are rounded once each, and their product at most twice.
        let [of_plain, of_far, of_farther] =
            [plain, far, farther].map(|root| rounding.bound(&graph, &[root]));
        assert!((2.0..8.0).contains(&of_plain), "{of_plain}");
        assert!((1e4..1e5).contains(&of_far), "{of_far}");
        assert!((500.0..2000.0).contains(&(of_farther / of_far)), "{of_farther}");
        let first = |ways: [Expr; 2]| {
            let ways = ways.map(|way| [way]);
            rounding.first(&graph, &ways.each_ref().map(|way| &way[..])).map(|way| way[0])
        };
        assert_eq!(first([far, plain]), Some(plain));
        assert_eq!(first([plain, far]), Some(plain));
        assert_eq!(first([farther, far]), Some(far));
    }
}
