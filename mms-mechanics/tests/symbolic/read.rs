//! Expressions from texts.

use mms_mechanics::resolve::Scope;
use mms_spec::Formula;
use mms_spec::source::Sources;
use mms_spec::syntax;
use mms_symbolic::expr::{Expr, Graph, Symbol};

/// The expression of a text in X, Y and t.
pub fn read(graph: &mut Graph, text: &str) -> Result<Expr, String> {
    let mut sources = Sources::default();
    let source = sources.add("printed", text);
    let formula = Formula::plain(text, sources.span(source, 0, text.len()));
    let mut scope = Scope::default();
    for (name, symbol) in
        [("X", Symbol::Coordinate(0)), ("Y", Symbol::Coordinate(1)), ("t", Symbol::Time)]
    {
        let leaf = graph.symbol(symbol);
        scope.define(name, Some(leaf));
    }
    let pi = graph.pi();
    scope.define("pi", Some(pi));
    let mut diagnostics = Vec::new();
    let ast = syntax::parse(&formula, &mut diagnostics);
    let root = ast.and_then(|ast| scope.resolve(graph, &ast, &mut diagnostics));
    root.ok_or_else(|| format!("{text}: {diagnostics:?}"))
}
