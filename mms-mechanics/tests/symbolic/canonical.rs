//! The canonical form: one handle per expression, with the value of the written expression.

use mms_mechanics::candidates::candidates;
use mms_program::schedule::cost;
use mms_symbolic::expr::print::Names;
use mms_symbolic::expr::{Function, Graph, Rational};
use mms_symbolic::pass::differentiate::differentiate;
use mms_symbolic::pass::relations::Relations;
use mms_symbolic::pass::substitute::substitute;
use mms_symbolic::sorted::SortedMap;
use proptest::prelude::*;

use crate::sampled::sampled_count;

use super::evaluation::{Extent, close, place, places, value_and_extent, values};
use super::read::read;
use super::recipe::{X, any_recipe, build, built, evaluate, recipe, rewritten};

proptest! {
    #![proptest_config(ProptestConfig::with_cases(sampled_count(256, 3) as u32))]

    #[test]
    fn a_printed_expression_reads_back_as_itself(recipe in recipe()) {
        let mut graph = Graph::default();
        let root = built(&mut graph, &recipe)?;
        let names = Names::default();
        let text = graph.print(root, &names);
        prop_assert_eq!(read(&mut graph, &text), Ok(root), "{}", text);
    }

    #[test]
    fn canonical_form_has_the_value_of_what_was_written(recipe in any_recipe()) {
        let mut graph = Graph::default();
        let root = built(&mut graph, &recipe)?;
        for at in places() {
            let mut extent = Extent::new();
            let written = evaluate(&recipe, &at, &mut |value| extent.see(value));
            let (canonical, other) = value_and_extent(&graph, root, &at);
            let (Some(scale), Some(_)) = (extent.moderate(), other.moderate()) else { continue };
            // An undefined written expression may have become defined by cancellation: x/x is 1.
            if written.is_defined() {
                prop_assert!(
                    close(&written, &canonical, scale, 40),
                    "{:e} {:e}", written.to_f64(), canonical.to_f64()
                );
            }
        }
    }

    #[test]
    fn what_is_written_in_another_order_is_the_same_node(recipe in any_recipe()) {
        let mut graph = Graph::default();
        let root = built(&mut graph, &recipe)?;
        let nodes = graph.len();
        let again = build(&mut graph, &recipe);
        prop_assert_eq!(again, Some(root));
        prop_assert_eq!(graph.len(), nodes, "building it again makes no node");
        let other = build(&mut graph, &rewritten(&recipe));
        prop_assert_eq!(
            other, Some(root), "{}", graph.print(root, &Names::default())
        );
    }

    #[test]
    fn substituting_a_symbol_for_itself_changes_nothing(recipe in any_recipe()) {
        let mut graph = Graph::default();
        let root = built(&mut graph, &recipe)?;
        let x = graph.symbol(X);
        prop_assert_eq!(substitute(&mut graph, &[root], &SortedMap::from([(X, x)])), vec![root]);
    }

    #[test]
    fn sums_and_products_do_not_depend_on_order(a in recipe(), b in recipe(), c in recipe()) {
        let mut graph = Graph::default();
        let [a, b, c] = [built(&mut graph, &a)?, built(&mut graph, &b)?, built(&mut graph, &c)?];
        let (ab, cb) = (graph.add(a, b), graph.add(c, b));
        prop_assert_eq!(graph.add(ab, c), graph.add(cb, a));
        let (ab, cb) = (graph.mul(a, b), graph.mul(c, b));
        prop_assert_eq!(graph.mul(ab, c), graph.mul(cb, a));
    }
}

#[test]
fn a_full_graph_is_told_and_never_answers() {
    let whole = |limit: usize| {
        let mut graph = Graph::with_limit(limit);
        let root = read(&mut graph, "sin(X)*cos(X + 1)*exp(X*t)*sin(2*X)").ok()?;
        let slope = differentiate(&mut graph, &[root], X);
        let relations = Relations::find(&mut graph, &slope);
        let candidates = candidates(&mut graph, &SortedMap::from([((), slope)]), &relations);
        let ways = candidates.iter().map(|candidate| &candidate.components[&()]);
        let chosen = ways.min_by_key(|way| cost(&graph, way))?[0];
        let at = place(0.846, -0.4, 0.43);
        let value = values(&graph, &[chosen], &at).remove(0);
        if graph.is_exhausted() {
            // An unknown value counts as no number, least of all as 0.
            let sum = graph.add(chosen, root);
            assert!(!graph.is_zero(sum) && !values(&graph, &[sum], &at)[0].is_defined());
            return None;
        }
        Some(value.to_f64())
    };
    let answer = whole(100_000).expect("an ample graph");
    let mut refused = 0;
    for limit in 0..300 {
        match whole(limit) {
            Some(value) => assert_eq!(value, answer, "limit {limit}"),
            None => refused += 1,
        }
    }
    assert!((10..300).contains(&refused), "{refused}");
}

#[test]
fn roots_of_squares_keep_their_sign() {
    // (x^2)^(1/2) is |x|, not x.
    let mut graph = Graph::default();
    let x = graph.symbol(X);
    let square = graph.power(x, 2);
    let root = graph.call(Function::Sqrt, &[square]);
    assert_ne!(root, x);
    let value = values(&graph, &[root], &place(-3.0, 0.0, 0.0)).remove(0);
    assert_eq!(value.to_f64(), 3.0);
}

#[test]
fn known_values_fold() {
    let mut graph = Graph::default();
    let (pi, nine) = (graph.pi(), graph.number(9));
    let half_turn = graph.scale(pi, Rational::from_parts((-3).into(), 2u8.into()));
    let sine = graph.call(Function::Sin, &[half_turn]);
    assert_eq!(graph.as_number(sine), Some(&Rational::ONE));
    let root = graph.call(Function::Sqrt, &[nine]);
    assert_eq!(graph.as_number(root), Some(&Rational::from(3)));
    let (zero, x) = (graph.number(0), graph.symbol(X));
    let exponential = graph.call(Function::Exp, &[zero]);
    assert_eq!(graph.as_number(exponential), Some(&Rational::ONE));
    let difference = graph.sub(x, x);
    assert!(graph.is_zero(difference));
}
