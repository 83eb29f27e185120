//! What passes keep: the value of every expression. A new pass is one more line here.

use mms_codegen::expr::Graph;
use mms_codegen::pass::factor::factor;
use mms_codegen::simplify::{cheaper, cost};
use proptest::prelude::*;

use super::evaluation::same_value;
use super::recipe::{any_recipe, built, recipe};

proptest! {
    #[test]
    fn no_pass_changes_a_value(recipe in any_recipe()) {
        let mut graph = Graph::default();
        let root = built(&mut graph, &recipe)?;
        let after = factor(&mut graph, &[root])[0];
        same_value(&graph, root, after)?;
        let after = cheaper(&mut graph, vec![root])[0];
        same_value(&graph, root, after)?;
    }

    #[test]
    fn what_is_chosen_costs_no_more(recipe in recipe()) {
        let mut graph = Graph::default();
        let root = built(&mut graph, &recipe)?;
        let factored = factor(&mut graph, &[root])[0];
        let chosen = cheaper(&mut graph, vec![root])[0];
        prop_assert!(chosen == root || chosen == factored);
        prop_assert!(cost(&graph, &[chosen]) <= cost(&graph, &[root]));
    }
}
