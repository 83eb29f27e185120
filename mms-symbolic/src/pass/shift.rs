//! Reuses a subexpression that differs by a constant from another one: if x^2 - 1/16 occurs as a factor or as an operand, a
//! x^2 + b in other sums becomes a (x^2 - 1/16) + (a/16 + b). Only x^2 - 1/16 then reads the product x^2, so that both are
//! fused to one operation. The other sums add a/16 + b, which does not depend on X.
//!
//! If the constant is large, x^2 loses its digits. Callers test the result with `mechanics::rounding`.

use super::Operands;
use super::substitute::rebuild;
use crate::expr::{Expr, Graph, Node, Rational, Stage};
use crate::sorted::{SortedMap, SortedSet};

/// A sum of a product and a constant.
struct Shifted {
    sum: Expr,
    factors: Operands,
    /// The factor of the product.
    coefficient: Rational,
    constant: Rational,
}

/// Sums of a product and a constant, by the first factor of the product.
type ByFactor = SortedMap<Expr, Vec<Shifted>>;

/// Writes products in `roots` in terms of sums that differ from them by constants, if such sums occur.
pub fn shift(graph: &mut Graph, roots: &[Expr]) -> Vec<Expr> {
    let found = graph.reachable(roots).into_iter().filter_map(|sum| as_shifted(graph, sum));
    let (mut sums, mut by_factor) = (SortedSet::new(), ByFactor::new());
    for shifted in found {
        sums.insert(shifted.sum);
        by_factor.get_or_default(shifted.factors[0].0).push(shifted);
    }
    rebuild(graph, roots, |graph, node| {
        let made = graph.remake(node);
        match graph.node(made).clone() {
            Node::Sum(constant, terms) if !sums.contains(&made) => {
                let terms = terms.into_iter();
                let terms = terms.flat_map(|term| in_terms_of(graph, &by_factor, term)).collect();
                graph.remake(Node::Sum(constant, terms))
            }
            _ => made,
        }
    })
}

/// Splits a sum into a constant and a product that needs X and not t.
fn as_shifted(graph: &Graph, sum: Expr) -> Option<Shifted> {
    let Node::Sum(constant, terms) = graph.node(sum) else { return None };
    let [(product, coefficient)] = terms.as_slice() else { return None };
    let Node::Product(factors) = graph.node(*product) else { return None };
    if constant.is_zero() || graph.stage(*product) != Stage::Point {
        return None;
    }
    let (factors, coefficient) = (factors.clone(), coefficient.clone());
    Some(Shifted { sum, factors, coefficient, constant: constant.clone() })
}

/// A term; or the two terms that replace it, if nothing else in it needs X.
fn in_terms_of(
    graph: &mut Graph,
    by_factor: &ByFactor,
    (term, coefficient): (Expr, Rational),
) -> Operands {
    let Node::Product(factors) = graph.node(term).clone() else { return vec![(term, coefficient)] };
    let candidates = factors.iter().filter_map(|(base, _)| by_factor.get(base)).flatten();
    for shifted in candidates {
        let is_own = |power: &&(Expr, Rational)| shifted.factors.contains(power);
        if factors.iter().filter(is_own).count() < shifted.factors.len() {
            continue;
        }
        let others: Operands = factors.iter().filter(|power| !is_own(power)).cloned().collect();
        let others = graph.product(others);
        if !graph.stage(others).needs_point() {
            let coefficient = coefficient / &shifted.coefficient;
            let product = graph.mul(others, shifted.sum);
            let less = -coefficient.clone() * &shifted.constant;
            return vec![(product, coefficient), (others, less)];
        }
    }
    vec![(term, coefficient)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expr::Symbol;

    #[test]
    fn products_are_written_by_what_differs_from_them_by_a_constant() {
        let mut graph = Graph::default();
        let a = graph.symbol(Symbol::Parameter(0));
        let [x, y] = [0, 1].map(|axis| graph.symbol(Symbol::Coordinate(axis)));
        let [one, two] = [1, 2].map(|number| graph.number(number));
        let square = graph.mul(x, x);
        let sum = graph.add(square, two);
        // y (x^2 + 2) + a x^2 + y x^2: the factor of y stays.
        let [first, second, third] =
            [(y, sum), (a, square), (y, square)].map(|(a, b)| graph.mul(a, b));
        let terms = |second: Vec<(Expr, Rational)>| {
            second.into_iter().chain([(first, Rational::ONE), (third, Rational::ONE)])
        };
        let root = graph.sum(terms(vec![(second, Rational::ONE)]));
        let product = graph.mul(a, sum);
        let expected = graph.sum(terms(vec![(product, Rational::ONE), (a, Rational::from(-2))]));
        assert_eq!(shift(&mut graph, &[root]), [expected]);
        // Nothing differs from it by a constant.
        let other = graph.add(square, one);
        let alone = graph.mul(y, square);
        assert_eq!(shift(&mut graph, &[alone]), [alone]);
        assert_eq!(shift(&mut graph, &[other]), [other]);
    }

    #[test]
    fn coefficients_and_other_factors_are_kept() {
        let mut graph = Graph::default();
        let t = graph.symbol(Symbol::Time);
        let [x, y] = [0, 1].map(|axis| graph.symbol(Symbol::Coordinate(axis)));
        let square = graph.mul(x, x);
        let [one, two, three, five] = [1, 2, 3, 5].map(Rational::from);
        let unit = graph.number(1);
        // With w = 3 x^2 + 2, in w y + 5 t x^2: 5 t x^2 = 5/3 t w - 10/3 t.
        let sum = graph.sum([(square, three.clone()), (unit, two.clone())]);
        let first = graph.mul(sum, y);
        let second = graph.mul(t, square);
        let root = graph.sum([(first, one.clone()), (second, five.clone())]);
        let product = graph.mul(t, sum);
        let (more, less) = (&five / &three, -(&five * &two) / &three);
        let expected = graph.sum([(first, one), (product, more), (t, less)]);
        assert_eq!(shift(&mut graph, &[root]), [expected]);
    }
}
