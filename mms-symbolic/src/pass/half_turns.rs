//! Writes sines and cosines of multiples of pi as functions of the multiple (sinpi, cospi): sin(pi x) subtracts whole turns
//! from x without error, and saves a product, while the sine of a rounded pi x would have an error of eps times the angle. So t
//! after many periods is as exact as t in the first.

use super::substitute::rebuild;
use crate::expr::{Expr, Function, Graph, Node, Rational};

/// Writes the sines and cosines of multiples of pi in `roots` as functions of the multiple.
pub fn half_turns(graph: &mut Graph, roots: &[Expr]) -> Vec<Expr> {
    rebuild(graph, roots, |graph, node| {
        let turned = match &node {
            Node::Call(Function::Sin, angle) => Some((Function::SinPi, angle[0])),
            Node::Call(Function::Cos, angle) => Some((Function::CosPi, angle[0])),
            _ => None,
        };
        match turned.and_then(|(function, angle)| Some((function, by_pi(graph, angle)?))) {
            Some((function, turns)) => graph.call(function, &[turns]),
            None => graph.remake(node),
        }
    })
}

/// The quotient of an angle and pi, if every term of the angle has the factor pi.
fn by_pi(graph: &mut Graph, angle: Expr) -> Option<Expr> {
    match graph.node(angle).clone() {
        Node::Pi => Some(graph.number(1)),
        Node::Product(mut factors) => {
            let pi = graph.pi();
            let place = factors.iter().position(|(base, power)| *base == pi && power.is_one())?;
            factors.remove(place);
            Some(graph.product(factors))
        }
        Node::Sum(constant, terms) if constant.is_zero() => {
            let terms: Option<Vec<(Expr, Rational)>> = terms
                .into_iter()
                .map(|(term, factor)| Some((by_pi(graph, term)?, factor)))
                .collect();
            Some(graph.sum(terms?))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expr::Symbol;

    #[test]
    fn whole_angles_alone_are_turned() {
        let mut graph = Graph::default();
        let (x, pi) = (graph.symbol(Symbol::Coordinate(0)), graph.pi());
        let product = graph.mul(pi, x);
        let twice = graph.scale(product, 2);
        let shifted = graph.add(twice, pi);
        let mixed = graph.add(product, x);
        let sines = [twice, shifted, mixed].map(|angle| graph.call(Function::Sin, &[angle]));
        let turned = half_turns(&mut graph, &sines);
        let turns = graph.scale(x, 2);
        let one = graph.number(1);
        let more = graph.add(turns, one);
        let expected = [turns, more].map(|turns| graph.call(Function::SinPi, &[turns]));
        assert_eq!(turned, [expected[0], expected[1], sines[2]]);
    }
}
