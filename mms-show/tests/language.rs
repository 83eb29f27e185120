//! Formulas are written as field files write them.

use mms_show::language::Language;
use mms_show::walk::write;
use mms_symbolic::expr::Graph;
use mms_symbolic::expr::print::Names;
use proptest::prelude::*;

#[path = "../../mms-mechanics/tests/symbolic/read.rs"]
mod read;
#[path = "../../mms-mechanics/tests/symbolic/recipe.rs"]
#[allow(dead_code, reason = "other tests evaluate recipes too")]
mod recipe;

proptest! {
    #[test]
    fn a_written_expression_reads_back_as_itself(recipe in recipe::recipe()) {
        let mut graph = Graph::default();
        let root = recipe::built(&mut graph, &recipe)?;
        let text = write(&graph, root, &Names::default(), &Language);
        prop_assert_eq!(read::read(&mut graph, &text), Ok(root), "{}", text);
    }
}
