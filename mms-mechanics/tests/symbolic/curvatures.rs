//! The rules for remainders of second order, compared with the expressions as written, in 77 digits.

use mms_symbolic::expr::{Expr, Function, Graph, Rational, Symbol};
use mms_symbolic::pass::curvature::curvature;

use super::evaluation::{place, values};
use super::recipe::SpaceTimePoint;

/// Functions, products, quotients, powers and roots of X + t, none of which is 0 at t = 0; and a cosine, a hyperbolic cosine
/// and a square of t.
fn written(graph: &mut Graph) -> Vec<Expr> {
    let [x, t] = [Symbol::Coordinate(0), Symbol::Time].map(|symbol| graph.symbol(symbol));
    let sum = graph.add(x, t);
    let functions =
        [Function::Ln, Function::Ln1p, Function::Ln1pRest, Function::Exp, Function::ExpM1];
    let mut written = functions.map(|function| graph.call(function, &[sum])).to_vec();
    for function in [Function::Cos, Function::Cosh, Function::Ln1pRest] {
        written.push(graph.call(function, &[t]));
    }
    written.push(graph.power(t, 2));
    written.push(graph.product([(written[0], 1.into()), (sum, 1.into()), (t, 3.into())]));
    for (numerator, denominator) in [(2, 1u8), (7, 1), (-1, 1), (-4, 1), (1, 2), (-5, 3), (7, 11)] {
        let exponent = Rational::from_parts(numerator.into(), u32::from(denominator).into());
        written.push(graph.power(sum, exponent));
    }
    written
}

#[test]
fn limit_slope_and_rest_are_the_whole() {
    let mut graph = Graph::default();
    let written = written(&mut graph);
    let parts = curvature(&mut graph, &written, Symbol::Time);
    let parts: Vec<_> = parts.into_iter().map(|parts| parts.expect("a rule")).collect();
    for (x, t) in [(0.3, 0.2), (0.3, -0.25), (0.75, 0.125), (0.6, 1e-20)] {
        let wholes = values(&graph, &written, &place(x, 0.5, t));
        let time = graph.symbol(Symbol::Time);
        let time = values(&graph, &[time], &place(x, 0.5, t))[0].clone();
        for (index, whole) in wholes.into_iter().enumerate() {
            let all = [parts[index].limit, parts[index].slope, parts[index].rest];
            let [limit, slope, rest] =
                values(&graph, &all, &place(x, 0.5, t)).try_into().expect("three");
            let error = (limit + slope * time.clone() + rest - whole).magnitude().to_f64();
            assert!(error < 1e-70, "{:?} at {x} and {t}: {error:e}", graph.node(written[index]));
        }
    }
}

#[test]
fn nothing_cancels_in_what_is_of_second_order() {
    let mut graph = Graph::default();
    let written = written(&mut graph);
    for (index, parts) in curvature(&mut graph, &written, Symbol::Time).into_iter().enumerate() {
        let rest = parts.expect("a rule").rest;
        let exact = values(&graph, &[rest], &place(0.3, 0.5, 1e-9))[0].to_f64();
        let at = SpaceTimePoint { coordinates: [0.3, 0.5], time: 1e-9 };
        let rounded: f64 = values(&graph, &[rest], &at)[0];
        let error = (rounded / exact - 1.0).abs();
        assert!(error < 32.0 * f64::EPSILON, "{:?}: {error:e}", graph.node(written[index]));
    }
}

#[test]
fn what_has_no_rule_has_no_parts() {
    let mut graph = Graph::default();
    let [x, t] = [Symbol::Coordinate(0), Symbol::Time].map(|symbol| graph.symbol(symbol));
    let sum = graph.add(x, t);
    let sine = graph.call(Function::Sin, &[sum]);
    let root = graph.power(t, Rational::from_parts(1.into(), 2u8.into()));
    let reciprocal = graph.power(t, -1);
    let parts = curvature(&mut graph, &[sine, root, reciprocal], Symbol::Time);
    assert_eq!(parts, [None, None, None]);
}
