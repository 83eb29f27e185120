//! Every pass preserves the value of every expression. A new pass is one more line here.

use mms_mechanics::Output;
use mms_mechanics::candidates::candidates;
use mms_program::Stage;
use mms_program::schedule::{cost, schedule_plainly};
use mms_symbolic::expr::print::Names;
use mms_symbolic::expr::{Graph, Rational, Symbol};
use mms_symbolic::pass::expand::expand;
use mms_symbolic::pass::factor::factor;
use mms_symbolic::pass::horner::horner;
use mms_symbolic::pass::reduce::reduce;
use mms_symbolic::pass::relations::{Relations, latest_stage};
use mms_symbolic::pass::separate::separate;
use mms_symbolic::sorted::SortedMap;
use proptest::prelude::*;

use crate::sampled::sampled_count;

use super::evaluation::{close, places, run, same_value, value_and_extent, values};
use super::read::read;
use super::recipe::{any_recipe, built, recipe};

/// A division by zero stays one if factors are taken out of it.
#[test]
fn nothing_is_taken_out_of_divisions_by_zero() {
    let mut graph = Graph::default();
    let zero = graph.number(0);
    let x = graph.symbol(Symbol::Time);
    let terms = [-1, -2].map(|power| (graph.power(zero, power), Rational::ONE));
    let sum = graph.sum(terms);
    let root = graph.mul(x, sum);
    assert_eq!(factor(&mut graph, &[root, sum]), [root, sum]);
}

/// A sum of powers of one expression that is a square becomes one, with any terms around it.
#[test]
fn squares_are_written_as_such() -> Result<(), TestCaseError> {
    for (sum, square) in [
        ("1 - 32*(X - 1)^2 + 256*(X - 1)^4", "256*((X - 1)^2 - 1/16)^2"),
        ("9 + 6*exp(X) + exp(X)^2", "(exp(X) + 3)^2"),
        ("2*X^6 + 4*X^4 + 6*X^3 + 2*X^2 + 6*X + 9/2", "2*(X*(X^2 + 1) + 3/2)^2"),
        ("X^2 + 2 + X^-2", "(X + 1/X)^2"),
        ("Y*X^5 - 2*Y*X^3 + Y*X", "Y*X*(X^2 - 1)^2"),
        ("t*(Y^4 + 2*Y^2 + 1) + t^2*X", "t*((Y^2 + 1)^2 + t*X)"),
        ("X^4 + 2*X^2 + 2", "X^2*(X^2 + 2) + 2"),
        ("X^3 + 2*X^2 + X", "X*(X + 1)^2"),
        ("X^5 + 2*X^4 + 1", "X^4*(X + 2) + 1"),
    ] {
        let mut graph = Graph::default();
        let [sum, square] = [sum, square].map(|text| read(&mut graph, text));
        let (sum, square) =
            (sum.map_err(TestCaseError::fail)?, square.map_err(TestCaseError::fail)?);
        let nested = horner(&mut graph, &[sum], &latest_stage)[0];
        prop_assert_eq!(nested, square, "{}", graph.print(nested, &Names::default()));
        same_value(&graph, sum, nested)?;
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(sampled_count(256, 3) as u32))]

    #[test]
    fn no_pass_changes_a_value(recipe in any_recipe()) {
        let mut graph = Graph::default();
        let root = built(&mut graph, &recipe)?;
        let relations = Relations::find(&mut graph, &[root]);
        let symbols: Vec<_> = graph.symbols(root).into_iter().collect();
        let mut written = vec![
            factor(&mut graph, &[root]),
            horner(&mut graph, &[root], &latest_stage),
            reduce(&mut graph, &[root], &relations),
            expand(&mut graph, &[root], &symbols),
            separate(&mut graph, &[root]),
        ];
        if let Some(thorough) = relations.thorough() {
            written.push(reduce(&mut graph, &[root], &thorough));
        }
        let candidates = candidates(&mut graph, &SortedMap::from([((), vec![root])]), &relations);
        written.extend(candidates.into_iter().map(|mut it| it.components.remove(&()).expect("all keys")));
        for after in written {
            same_value(&graph, root, after[0])?;
        }
    }

    #[test]
    fn sharing_changes_no_value_and_costs_nothing(
        recipes in proptest::collection::vec(recipe(), 1..5),
    ) {
        let mut graph = Graph::default();
        let roots = recipes.iter().map(|recipe| built(&mut graph, recipe));
        let roots = roots.collect::<Result<Vec<_>, _>>()?;
        let outputs = SortedMap::from([(Output::Expected(0), roots.clone())]);
        let plainly = schedule_plainly(&graph, &outputs);
        for at in places() {
            let (plain, shared) = (run(&plainly, &at), values(&graph, &roots, &at));
            for ((plain, shared), root) in plain.iter().zip(&shared).zip(&roots) {
                if let Some(scale) = value_and_extent(&graph, *root, &at).1.moderate() {
                    prop_assert_eq!(plain.is_defined(), shared.is_defined());
                    prop_assert!(!plain.is_defined() || close(plain, shared, scale, 40));
                }
            }
        }
        let counts = plainly.operations(&[Output::Expected(0)]);
        let per_point = counts[&Stage::Point] + counts[&Stage::PointTime];
        prop_assert!(cost(&graph, &roots).per_point <= per_point);
    }
}

/// The relation of one root may leave no square for the relation of another to replace.
#[test]
fn roots_that_share_their_squares_are_reduced() -> Result<(), TestCaseError> {
    for [first, second] in [
        ["X^2 + Y^2", "X^2 + Y^2 + 1"],
        ["X^2 + Y^2", "X^2 - Y^2"],
        ["X^2 + Y^2", "X^2 + 2*Y^2"],
        ["X^2 + 3*Y^2", "2*X^2 + 6*Y^2 + 5"],
        ["1 + sin(X)^2 + cos(X)^2", "2 + sin(X)^2 + cos(X)^2"],
        ["X^2 + Y^2", "t^2 + X^2 + Y^2"],
    ] {
        let mut graph = Graph::default();
        let text = format!("(sqrt({first}) + 3*sqrt({second}))^4 + X^4*sqrt({second})^3");
        let root = read(&mut graph, &text).map_err(TestCaseError::fail)?;
        let relations = Relations::find(&mut graph, &[root]);
        let thorough = relations.thorough().unwrap_or(relations);
        let reduced = reduce(&mut graph, &[root], &thorough)[0];
        same_value(&graph, root, reduced)?;
    }
    Ok(())
}
