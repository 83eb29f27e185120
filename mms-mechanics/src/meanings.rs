//! The meanings of the names of parameters: symbols, or constants.

use mms_spec::ParameterSpec;
use mms_symbolic::expr::{Expr, Graph, Symbol};
use mms_symbolic::pass::substitute::substitute;
use mms_symbolic::sorted::SortedMap;

/// The meanings of the names of parameters in the formulas of a field: symbols, or constants.
#[derive(Debug, Default)]
pub(crate) struct Meanings {
    /// The value of each parameter so far, if all have their defaults.
    defaults: SortedMap<Symbol, Expr>,
}

impl Meanings {
    /// The meaning of the next parameter, given its default in terms of the parameters before it.
    pub(crate) fn next(
        &mut self,
        graph: &mut Graph,
        parameter: &ParameterSpec,
        default: Option<Expr>,
    ) -> Option<Expr> {
        let symbol = Symbol::Parameter(self.defaults.len());
        let leaf = graph.symbol(symbol);
        let value = default.map(|default| substitute(graph, &[default], &self.defaults)[0]);
        // A parameter whose formula has failed keeps its symbol as its value.
        self.defaults.insert(symbol, value.unwrap_or(leaf));
        if parameter.frozen { value } else { default.map(|_| leaf) }
    }
}
