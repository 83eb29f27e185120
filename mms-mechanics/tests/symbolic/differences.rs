//! The rules of differences, compared with the expressions as written, in 77 digits.

use mms_symbolic::expr::{Expr, Function, Graph, Rational, Symbol};
use mms_symbolic::pass::difference::difference;

use super::evaluation::{place, values};
use super::recipe::SpaceTimePoint;

const FUNCTIONS: [Function; 13] = [
    Function::Cbrt,
    Function::Exp,
    Function::ExpM1,
    Function::Ln,
    Function::Ln1p,
    Function::Sin,
    Function::Cos,
    Function::Tan,
    Function::Sinh,
    Function::Cosh,
    Function::Tanh,
    Function::Asin,
    Function::Atan,
];

/// Every function, quotients and powers of X + t, and a product.
fn written(graph: &mut Graph) -> Vec<Expr> {
    let [x, t] = [Symbol::Coordinate(0), Symbol::Time].map(|symbol| graph.symbol(symbol));
    let sum = graph.add(x, t);
    let mut written: Vec<Expr> =
        FUNCTIONS.into_iter().map(|function| graph.call(function, &[sum])).collect();
    written.push(graph.call(Function::Acos, &[sum]));
    written.push(graph.call(Function::Powf, &[sum, sum]));
    let product = [written[0], written[5]];
    written.push(graph.mul(product[0], product[1]));
    for (numerator, denominator) in [(3, 1u8), (6, 1), (-1, 1), (-4, 1), (1, 2), (-5, 3), (7, 20)] {
        let exponent = Rational::from_parts(numerator.into(), u32::from(denominator).into());
        written.push(graph.power(sum, exponent));
    }
    written
}

#[test]
fn limit_and_rest_are_the_whole() {
    let mut graph = Graph::default();
    let written = written(&mut graph);
    let parts = difference(&mut graph, &written, Symbol::Time);
    let parts: Vec<_> = parts.into_iter().map(|parts| parts.expect("a value at 0")).collect();
    for (x, t) in [(0.3, 0.2), (0.3, -0.25), (0.75, 0.125), (0.6, 1e-20)] {
        let wholes = values(&graph, &written, &place(x, 0.5, t));
        for (index, whole) in wholes.into_iter().enumerate() {
            let both = [parts[index].limit, parts[index].rest];
            let [limit, rest] = values(&graph, &both, &place(x, 0.5, t)).try_into().expect("two");
            let error = (limit + rest - whole).magnitude().to_f64();
            assert!(error < 1e-70, "{:?} at {x} and {t}: {error:e}", graph.node(written[index]));
        }
    }
}

#[test]
fn nothing_cancels_in_the_rest() {
    let mut graph = Graph::default();
    let written = written(&mut graph);
    let parts = difference(&mut graph, &written, Symbol::Time);
    // The last power has a base that may be 0 at some X, and stays a difference.
    for (index, parts) in parts.into_iter().enumerate().take(written.len() - 1) {
        let rest = parts.expect("a value at 0").rest;
        let exact = values(&graph, &[rest], &place(0.3, 0.5, 1e-12))[0].to_f64();
        let at = SpaceTimePoint { coordinates: [0.3, 0.5], time: 1e-12 };
        let rounded: f64 = values(&graph, &[rest], &at)[0];
        let error = (rounded / exact - 1.0).abs();
        assert!(error < 8.0 * f64::EPSILON, "{:?}: {error:e}", graph.node(written[index]));
    }
}

/// ln cosh t = t^2/2 - t^4/12 + .., ln cos t = -t^2/2 - t^4/12 - ..: functions that are 0 at arguments other than 0.
#[test]
fn nothing_cancels_where_functions_are_0_elsewhere_than_at_0() {
    let mut graph = Graph::default();
    let t = graph.symbol(Symbol::Time);
    let written = [Function::Cosh, Function::Cos].map(|function| {
        let inner = graph.call(function, &[t]);
        graph.call(Function::Ln, &[inner])
    });
    let parts = difference(&mut graph, &written, Symbol::Time).into_iter();
    let rests: Vec<_> = parts.map(|parts| parts.expect("a value at 0").rest).collect();
    for t in [1e-3_f64, 1e-9, 1e-30] {
        let at = SpaceTimePoint { coordinates: [0.3, 0.5], time: t };
        let found: Vec<f64> = values(&graph, &rests, &at);
        for (found, sign) in found.into_iter().zip([1.0, -1.0]) {
            let exact = t * t * (sign / 2.0 - t * t / 12.0);
            assert!((found / exact - 1.0).abs() < 1e-12, "{found:e}, not {exact:e}");
        }
    }
}

#[test]
fn what_has_no_value_at_0_has_no_difference() {
    let mut graph = Graph::default();
    let t = graph.symbol(Symbol::Time);
    let reciprocal = graph.power(t, -1);
    assert_eq!(difference(&mut graph, &[reciprocal], Symbol::Time), [None]);
}
