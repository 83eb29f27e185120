//! Reassociates constants: if a and b depend on parameters or t, and c is a number, a + b (c + x) becomes (a + b c) + b x,
//! which saves one addition at every point.
//!
//! The rule applies if nothing else reads c + x. A parameter c stays with x: it may be as large as x, and be set to any number.

use super::Operands;
use super::substitute::rebuild;
use crate::expr::{Expr, Graph, Node, Rational};
use crate::sorted::SortedMap;

/// Adds the constants of inner sums in `roots` to the outer sums.
pub fn reassociate(graph: &mut Graph, roots: &[Expr]) -> Vec<Expr> {
    let mut gathered = roots.to_vec();
    loop {
        let before = gathered;
        gathered = outwards(graph, &before);
        if gathered == before {
            return gathered;
        }
    }
}

/// Moves every constant one sum outwards: after that their sums have other readers.
fn outwards(graph: &mut Graph, roots: &[Expr]) -> Vec<Expr> {
    let readers = graph.readers(roots, |_| true);
    rebuild(graph, roots, |graph, node| match node {
        Node::Sum(constant, terms)
            if !constant.is_zero() || terms.iter().any(|(term, _)| is_early(graph, *term)) =>
        {
            let opened = terms.into_iter().flat_map(|term| opened(graph, &readers, term)).collect();
            graph.remake(Node::Sum(constant, opened))
        }
        other => graph.remake(other),
    })
}

/// A term; or the two terms that replace it, if it consists of early factors and one sum with a constant.
fn opened(
    graph: &mut Graph,
    readers: &SortedMap<Expr, usize>,
    (term, coefficient): (Expr, Rational),
) -> Operands {
    let Node::Product(factors) = graph.node(term).clone() else { return vec![(term, coefficient)] };
    let (early, late): (Operands, Operands) =
        factors.into_iter().partition(|(factor, _)| is_early(graph, *factor));
    if let [(sum, power)] = late.as_slice()
        && power.is_one()
        && readers.get(sum) == Some(&1)
        && let Node::Sum(constant, terms) = graph.node(*sum).clone()
        && !constant.is_zero()
    {
        let early = graph.product(early);
        let rest = graph.sum(terms);
        let product = graph.mul(early, rest);
        return vec![(product, coefficient.clone()), (early, coefficient * constant)];
    }
    vec![(term, coefficient)]
}

/// Whether an expression needs no X.
fn is_early(graph: &Graph, expr: Expr) -> bool {
    !graph.stage(expr).needs_point()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expr::Symbol;

    #[test]
    fn constants_meet_where_there_is_one_already() {
        let mut graph = Graph::default();
        let [a, b] = [0, 1].map(|index| graph.symbol(Symbol::Parameter(index)));
        let x = graph.symbol(Symbol::Coordinate(0));
        let two = graph.number(2);
        let inner = graph.add(x, two);
        let product = graph.mul(b, inner);
        let root = graph.add(a, product);
        let products = [(b, x), (b, two)].map(|(a, b)| (graph.mul(a, b), Rational::ONE));
        let expected = graph.sum(products.into_iter().chain([(a, Rational::ONE)]));
        assert_eq!(reassociate(&mut graph, &[root]), [expected]);
        // A sum that is read elsewhere, or is a root, is computed anyway: moving its constant would only move an addition.
        let square = graph.mul(inner, inner);
        assert_eq!(reassociate(&mut graph, &[root, square]), [root, square]);
        assert_eq!(reassociate(&mut graph, &[root, inner]), [root, inner]);
        let plain = graph.add(x, product);
        assert_eq!(reassociate(&mut graph, &[plain]), [plain]);
    }

    #[test]
    fn numbers_go_all_the_way_out() {
        let mut graph = Graph::default();
        let [a, b] = [0, 1].map(|index| graph.symbol(Symbol::Parameter(index)));
        let (t, x) = (graph.symbol(Symbol::Time), graph.symbol(Symbol::Coordinate(0)));
        let two = graph.number(2);
        // a + 3 t (b (x + 2) + 2)
        let innermost = graph.add(x, two);
        let inner = graph.mul(b, innermost);
        let middle = graph.add(inner, two);
        let outer = graph.mul(t, middle);
        let root = graph.sum([(a, Rational::ONE), (outer, Rational::from(3))]);
        // (a + 6 t) + 3 t (b x + 2 b)
        let [first, second] = [x, two].map(|factor| (graph.mul(b, factor), Rational::ONE));
        let kept = graph.sum([first, second]);
        let kept = graph.mul(t, kept);
        let terms = [(a, 1), (t, 6), (kept, 3)];
        let expected = graph.sum(terms.map(|(term, number)| (term, Rational::from(number))));
        assert_eq!(reassociate(&mut graph, &[root]), [expected]);
    }
}
