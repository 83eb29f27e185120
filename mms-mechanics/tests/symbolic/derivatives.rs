//! Derivatives compared with dual numbers, which use no expressions, and with finite differences of order 6 in 77 digits.

use mms_math::Scalar as _;
use mms_program::dual::Dual;
use mms_program::precise::Precise;
use mms_symbolic::expr::print::Names;
use mms_symbolic::expr::{Expr, Function, Graph, Rational};
use mms_symbolic::pass::differentiate::differentiate;
use proptest::prelude::*;

use crate::sampled::sampled_count;

use super::evaluation::{close, place, places, power_of_ten, ratio, value_and_extent, values};
use super::recipe::{SpaceTimePoint, X, any_recipe, built, evaluate};

/// The place with X as the variable of a derivative.
fn varied(at: &SpaceTimePoint<Precise>) -> SpaceTimePoint<Dual<Precise>> {
    let [x, y] = at.coordinates.clone();
    SpaceTimePoint {
        coordinates: [Dual::variable(x), Dual::constant(y)],
        time: Dual::constant(at.time.clone()),
    }
}

/// The central difference of order 6 in X (Fornberg, Mathematics of Computation 51, 1988, table 1): its error is step^6/140
/// times the seventh derivative.
fn difference(
    at: &SpaceTimePoint<Precise>,
    f: impl Fn(&SpaceTimePoint<Precise>) -> Precise,
) -> Precise {
    let step = power_of_ten(10);
    let shifted = |steps: i32| {
        let mut at = at.clone();
        at.coordinates[0] = at.coordinates[0].clone() + ratio(steps, 1) * step.clone();
        f(&at)
    };
    let pair = |steps: i32| shifted(steps) - shifted(-steps);
    (ratio(45, 1) * pair(1) - ratio(9, 1) * pair(2) + pair(3)) / (ratio(60, 1) * step.clone())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(sampled_count(256, 3) as u32))]

    #[test]
    fn derivatives_are_those_of_dual_numbers(recipe in any_recipe()) {
        let mut graph = Graph::default();
        let root = built(&mut graph, &recipe)?;
        let slope = differentiate(&mut graph, &[root], X)[0];
        for at in places() {
            let (derived, extent) = value_and_extent(&graph, slope, &at);
            let Some(scale) = extent.moderate() else { continue };
            // Evaluates by the recipe, which involves no graph, and by the program.
            let dual = varied(&at);
            let by_recipe = evaluate(&recipe, &dual, &mut |_| ()).slope;
            let by_program = values(&graph, &[root], &dual).remove(0).slope;
            for other in [by_recipe, by_program] {
                if other.is_defined() && derived.is_defined() {
                    prop_assert!(
                        close(&derived, &other, scale, 30),
                        "{:e} {:e} at {at:?}", derived.to_f64(), other.to_f64()
                    );
                }
            }
        }
    }

    #[test]
    fn derivatives_are_the_limits_of_differences(recipe in any_recipe()) {
        let mut graph = Graph::default();
        let root = built(&mut graph, &recipe)?;
        let slope = differentiate(&mut graph, &[root], X)[0];
        for at in places() {
            let (derived, extent) = value_and_extent(&graph, slope, &at);
            let (_, of_root) = value_and_extent(&graph, root, &at);
            let (Some(scale), Some(_)) = (extent.moderate(), of_root.moderate()) else { continue };
            let found = difference(&at, |at| values(&graph, &[root], at).remove(0));
            // With step 1e-10 the error of the difference is 1e-60 of the seventh derivative, and 1e-67 of the value.
            if found.is_defined() && derived.is_defined() {
                prop_assert!(
                    close(&derived, &found, scale, 20),
                    "{:e} {:e} at {at:?}", derived.to_f64(), found.to_f64()
                );
            }
        }
    }
}

/// Expressions of every function, by each of its arguments, and fractional powers.
fn every_function(graph: &mut Graph) -> Vec<Expr> {
    let x = graph.symbol(X);
    let (third, two) = (graph.number(Rational::from_parts(1.into(), 3u8.into())), graph.number(2));
    let inner = [graph.mul(x, third), graph.div(two, x)];
    let mut roots = Vec::new();
    for function in Function::ALL {
        for argument in inner {
            let arguments: &[&[Expr]] = match function.arity() {
                1 => &[&[argument]],
                _ => &[&[argument, two], &[two, argument], &[argument, x]],
            };
            roots.extend(arguments.iter().map(|arguments| graph.call(*function, arguments)));
        }
    }
    // An offset is an atom of coordinates alone.
    let offset = graph.offset(x, third);
    roots.extend([graph.power(offset, 3), graph.call(Function::Sin, &[offset])]);
    for (numerator, denominator) in [(1, 2), (-3, 2), (5, 3), (-1, 7)] {
        let exponent = Rational::from_parts(numerator.into(), u8::into(denominator));
        roots.push(graph.power(inner[0], exponent));
    }
    roots
}

#[test]
fn every_function_has_its_derivative() {
    let mut graph = Graph::default();
    let roots = every_function(&mut graph);
    let slopes = differentiate(&mut graph, &roots, X);
    let mut compared = 0;
    for x in [0.43, 2.1, 2.9] {
        let at = place(x, 0.0, 0.0);
        let found = values(&graph, &slopes, &at);
        let duals = values(&graph, &roots, &varied(&at));
        for (index, root) in roots.iter().enumerate() {
            let limit = difference(&at, |at| values(&graph, &[*root], at).remove(0));
            if limit.is_defined() {
                let text = graph.print(*root, &Names::default());
                let (slope, dual) = (&found[index], &duals[index].slope);
                // The seventh derivative of tan near its pole is 1e10 or so.
                assert!(close(slope, &limit, 1.0, 40), "{text}: {:e}", slope.to_f64());
                assert!(close(slope, dual, 100.0, 70), "{text}: {:e}", slope.to_f64());
                compared += 1;
            }
        }
    }
    // Only asin and acos are undefined at some of the points.
    assert!(compared > 3 * roots.len() - 10, "{compared} of {}", 3 * roots.len());
}

#[test]
fn second_derivatives_are_those_of_duals_of_duals() {
    let mut graph = Graph::default();
    let roots = every_function(&mut graph);
    let first = differentiate(&mut graph, &roots, X);
    let second = differentiate(&mut graph, &first, X);
    let at = place(2.1, 0.0, 0.0);
    let x = Dual::variable(Dual::variable(at.coordinates[0].clone()));
    let constant = Dual::from_f64(0.0);
    let varied = SpaceTimePoint { coordinates: [x, constant.clone()], time: constant };
    let duals = values(&graph, &roots, &varied);
    for ((root, found), dual) in roots.iter().zip(values(&graph, &second, &at)).zip(duals) {
        let text = graph.print(*root, &Names::default());
        assert_eq!(found.is_defined(), dual.slope.slope.is_defined(), "{text}");
        if found.is_defined() {
            assert!(close(&found, &dual.slope.slope, 100.0, 65), "{text}: {:e}", found.to_f64());
        }
    }
}
