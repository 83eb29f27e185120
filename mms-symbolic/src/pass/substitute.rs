//! Rebuilding expressions with other leaves.

use crate::expr::{ByExpr, Expr, Graph, Node, Symbol};
use crate::sorted::SortedMap;

/// `roots` with every symbol that `values` names replaced by its value.
pub fn substitute(
    graph: &mut Graph,
    roots: &[Expr],
    values: &SortedMap<Symbol, Expr>,
) -> Vec<Expr> {
    rebuild(graph, roots, |graph, node| match node {
        Node::Symbol(symbol) => match values.get(&symbol) {
            Some(value) => *value,
            None => graph.symbol(symbol),
        },
        other => graph.remake(other),
    })
}

/// The values for [`substitute`] that `made` computes from each of these coordinates and the place for its axis.
pub fn coordinates(
    graph: &mut Graph,
    places: impl IntoIterator<Item = (usize, Expr)>,
    made: impl Fn(&mut Graph, Expr, Expr) -> Expr,
) -> SortedMap<Symbol, Expr> {
    let made = |(axis, place)| {
        let symbol = Symbol::Coordinate(axis);
        let coordinate = graph.symbol(symbol);
        (symbol, made(graph, coordinate, place))
    };
    places.into_iter().map(made).collect()
}

/// Replaces whole sub-expressions of `roots` if they occur as operands.
pub fn replace(graph: &mut Graph, roots: &[Expr], values: &SortedMap<Expr, Expr>) -> Vec<Expr> {
    let mut replaced = ByExpr::of(roots);
    for expr in graph.reachable(roots) {
        let made = match values.get(&expr) {
            Some(value) => *value,
            None => {
                let mut node = graph.node(expr).clone();
                node.map_children(|child| replaced[child]);
                graph.remake(node)
            }
        };
        replaced.set(expr, made);
    }
    roots.iter().map(|root| replaced[*root]).collect()
}

/// Rebuilds `roots` from their leaves up; `make` receives each node with rebuilt operands.
pub fn rebuild(
    graph: &mut Graph,
    roots: &[Expr],
    mut make: impl FnMut(&mut Graph, Node) -> Expr,
) -> Vec<Expr> {
    let mut rebuilt = ByExpr::of(roots);
    for expr in graph.reachable(roots) {
        let mut node = graph.node(expr).clone();
        node.map_children(|child| rebuilt[child]);
        let made = make(graph, node);
        rebuilt.set(expr, made);
    }
    roots.iter().map(|root| rebuilt[*root]).collect()
}

impl Graph {
    /// The canonical expression of a node whose operands are any expressions.
    pub fn remake(&mut self, node: Node) -> Expr {
        match node {
            Node::Number(number) => self.number(number),
            Node::Pi => self.pi(),
            Node::Symbol(symbol) => self.symbol(symbol),
            Node::Sum(constant, mut terms) => {
                let one = self.number(1);
                terms.push((one, constant));
                self.sum(terms)
            }
            Node::Product(factors) => self.product(factors),
            Node::Call(function, arguments) => self.call(function, &arguments),
            Node::Offset([coordinate, place]) => self.offset(coordinate, place),
            Node::Small(small, angle) => self.small(small, angle),
        }
    }
}
