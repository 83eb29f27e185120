//! Formulas in the forms that intervals bound best: each variable occurs as few times as possible.

use mms_symbolic::expr::{Expr, Graph, Node, Rational, Symbol, is_negative};
use mms_symbolic::pass::factor::factor;
use mms_symbolic::pass::substitute::rebuild;

/// Takes out common factors and completes squares. Intervals would not see that most of 4 x^3 (1 - x)^4 - 4 x^4 (1 - x)^3
/// cancels.
pub fn compact(graph: &mut Graph, formulas: &[Expr]) -> Vec<Expr> {
    let short = graph.attempt(|graph| {
        let factored = factor(graph, formulas);
        rebuild(graph, &factored, |graph, node| match node {
            Node::Product(factors) => with_squares(graph, factors),
            other => graph.remake(other),
        })
    });
    short.unwrap_or_else(|| formulas.to_vec())
}

/// slope (symbol - root), to a power.
struct Linear {
    symbol: Symbol,
    slope: Rational,
    root: Rational,
    exponent: Rational,
}

/// A product with its factors x - a and x - b as (x - m)^2 - h^2, with m = (a + b)/2 and h = (a - b)/2,
/// whose bounds are its extrema.
fn with_squares(graph: &mut Graph, factors: Vec<(Expr, Rational)>) -> Expr {
    let (mut linear, mut product) = (Vec::new(), Vec::new());
    for (base, exponent) in factors {
        match as_linear(graph, base, &exponent) {
            Some(factor) => linear.push(factor),
            None => product.push((base, exponent)),
        }
    }
    // Factors of one exponent are paired first.
    linear.sort_by(|a, b| b.exponent.cmp(&a.exponent));
    let one = graph.number(1);
    while let Some(first) = linear.pop() {
        let base = graph.symbol(first.symbol);
        let Some(other) = linear.iter_mut().rev().find(|other| other.symbol == first.symbol) else {
            let offset = (one, -(first.root * &first.slope));
            let distance = graph.sum([(base, first.slope), offset]);
            product.push((distance, first.exponent));
            continue;
        };
        let two = Rational::from(2);
        let [middle, half] =
            [(&first.root + &other.root) / &two, (&first.root - &other.root) / &two];
        let scale = &first.slope * &other.slope;
        let distance = graph.sum([(base, Rational::ONE), (one, -middle)]);
        let square = graph.power(distance, 2);
        let whole = graph.sum([(square, scale.clone()), (one, -(&half * &half * scale))]);
        product.push((whole, first.exponent.clone()));
        other.exponent -= first.exponent;
        linear.retain(|other| !other.exponent.is_zero());
    }
    graph.product(product)
}

/// A factor that is linear in one symbol, with numbers for coefficients, to a positive integer power.
fn as_linear(graph: &Graph, base: Expr, exponent: &Rational) -> Option<Linear> {
    if !exponent.is_int() || is_negative(exponent) {
        return None;
    }
    let (symbol, slope, offset) = match graph.node(base) {
        Node::Symbol(symbol) => (*symbol, Rational::ONE, Rational::ZERO),
        Node::Sum(offset, terms) => match terms.as_slice() {
            [(term, slope)] => match graph.node(*term) {
                Node::Symbol(symbol) => (*symbol, slope.clone(), offset.clone()),
                _ => return None,
            },
            _ => return None,
        },
        _ => return None,
    };
    Some(Linear { symbol, root: -offset / &slope, slope, exponent: exponent.clone() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_of_distances_become_squares() {
        let mut graph = Graph::default();
        let x = graph.symbol(Symbol::Coordinate(0));
        let one = graph.number(1);
        let rest = graph.sub(one, x);
        let [cube, fourth] = [graph.power(x, 3), graph.power(rest, 4)];
        let bump = graph.mul(cube, fourth);
        // x^3 (1 - x)^4 = (1/4 - (x - 1/2)^2)^3 (1 - x).
        let part = |parts: u8| Rational::from_parts(1.into(), parts.into());
        let distance = graph.sum([(x, Rational::ONE), (one, -part(2))]);
        let square = graph.power(distance, 2);
        let whole = graph.sum([(one, part(4)), (square, -Rational::ONE)]);
        let cube = graph.power(whole, 3);
        let expected = graph.mul(cube, rest);
        assert_eq!(compact(&mut graph, &[bump]), [expected]);
    }
}
