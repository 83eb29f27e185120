//! What the names of parameters stand for: themselves, or constants.

use mms_spec::ParameterSpec;
use mms_symbolic::expr::{Expr, Graph, Symbol};
use mms_symbolic::pass::substitute::substitute;
use mms_symbolic::sorted::SortedMap;

/// What the names of parameters stand for in the formulas of a field: themselves, or constants.
#[derive(Debug, Default)]
pub(crate) struct Meanings {
    /// The value of each parameter so far, where all have their defaults.
    defaults: SortedMap<Symbol, Expr>,
}

impl Meanings {
    /// What the next parameter stands for, given its default in terms of those before it.
    pub(crate) fn next(
        &mut self,
        graph: &mut Graph,
        parameter: &ParameterSpec,
        default: Option<Expr>,
    ) -> Option<Expr> {
        let symbol = Symbol::Parameter(self.defaults.len());
        let leaf = graph.symbol(symbol);
        let value = default.map(|default| substitute(graph, &[default], &self.defaults)[0]);
        // One whose formula has failed keeps its place.
        self.defaults.insert(symbol, value.unwrap_or(leaf));
        if parameter.frozen { value } else { default.map(|_| leaf) }
    }
}
