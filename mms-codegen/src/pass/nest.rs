//! Nesting: a x + a y + b = a (x + y) + b, after Horner. The factor that most terms have is taken
//! out first.

use std::collections::BTreeMap;

use super::polynomial::{MAX_TERMS, Monomial, Polynomial, product};
use super::substitute::rebuild;
use crate::expr::{Expr, Graph, Node, Rational};

/// `roots` with every sum below them nested. Factors of a lower rank are taken out first.
pub fn nest(graph: &mut Graph, roots: &[Expr], rank: &dyn Fn(&Graph, Expr) -> u8) -> Vec<Expr> {
    rebuild(graph, roots, |graph, node| {
        let made = graph.remake(node);
        match flat_view(graph, made) {
            Some(polynomial) => nested(graph, polynomial, rank),
            None => made,
        }
    })
}

/// A sum as a polynomial in the bases of its products, which are not multiplied out.
fn flat_view(graph: &mut Graph, expr: Expr) -> Option<Polynomial> {
    let Node::Sum(constant, terms) = graph.node(expr).clone() else { return None };
    if terms.len() > MAX_TERMS {
        return None;
    }
    let mut view = Polynomial::constant(constant);
    for (term, coefficient) in terms {
        let monomial = match graph.node(term).clone() {
            Node::Product(factors) => factors
                .into_iter()
                .map(|(base, exponent)| integral_power(graph, base, &exponent))
                .collect::<Option<Monomial>>()?,
            _ => vec![(term, 1)],
        };
        // Roots of bases have handles in another order than the bases.
        let mut monomial = monomial;
        monomial.sort();
        view = view.plus(&Polynomial::monomial(monomial, coefficient), &Rational::ONE)?;
    }
    Some(view)
}

/// A power as an integer power of a root of its base.
pub(super) fn integral_power(
    graph: &mut Graph,
    base: Expr,
    exponent: &Rational,
) -> Option<(Expr, i32)> {
    let numerator = i32::try_from(exponent.numerator().clone()).ok()?;
    if exponent.is_int() {
        return Some((base, numerator));
    }
    let root = Rational::from_parts(1.into(), exponent.denominator().clone());
    Some((graph.power(base, root), numerator))
}

/// The nested expression of a polynomial.
///
/// What all terms share is taken out at once, so that every further factor parts the terms, and
/// the recursion is no deeper than there are terms.
pub(super) fn nested(
    graph: &mut Graph,
    polynomial: Polynomial,
    rank: &dyn Fn(&Graph, Expr) -> u8,
) -> Expr {
    let (common, mut rest) = take_common(polynomial);
    let mut counts = Counts::default();
    rest.terms.keys().for_each(|monomial| counts.add(monomial, 1));
    let mut parts = Vec::new();
    while let Some((atom, sign)) = counts.most_frequent(graph, rank) {
        let (with, without): (BTreeMap<_, _>, _) =
            rest.terms.into_iter().partition(|(monomial, _)| power_in(monomial, atom, sign) > 0);
        with.keys().for_each(|monomial| counts.add(monomial, -1));
        let inner = nested(graph, Polynomial { terms: with }, rank);
        parts.push((inner, Rational::ONE));
        rest = Polynomial { terms: without };
    }
    for (monomial, coefficient) in rest.terms {
        parts.push((product(graph, &monomial), coefficient));
    }
    let sum = graph.sum(parts);
    let common = product(graph, &common);
    graph.mul(common, sum)
}

/// In how many terms each factor stands, above and below the line.
#[derive(Default)]
struct Counts(BTreeMap<(Expr, i32), i32>);

impl Counts {
    fn add(&mut self, monomial: &Monomial, count: i32) {
        for (atom, exponent) in monomial {
            *self.0.entry((*atom, exponent.signum())).or_default() += count;
        }
    }

    /// The factor, and the sign of its exponent, of most terms; at least of two.
    fn most_frequent(
        &self,
        graph: &Graph,
        rank: &dyn Fn(&Graph, Expr) -> u8,
    ) -> Option<(Expr, i32)> {
        let shared = self.0.iter().filter(|(_, count)| **count > 1);
        let best = shared.min_by_key(|((atom, _), count)| (rank(graph, *atom), -**count));
        best.map(|(factor, _)| *factor)
    }
}

/// The factors that all terms share, and the polynomial without them.
pub(super) fn take_common(polynomial: Polynomial) -> (Monomial, Polynomial) {
    let mut monomials = polynomial.terms.keys();
    let Some(first) = monomials.next().filter(|_| polynomial.terms.len() > 1) else {
        return (Monomial::new(), polynomial);
    };
    let mut common = first.clone();
    for monomial in monomials {
        common.retain_mut(|(atom, exponent)| {
            let sign = exponent.signum();
            *exponent = sign * (*exponent * sign).min(power_in(monomial, *atom, sign));
            *exponent != 0
        });
    }
    if common.is_empty() {
        return (common, polynomial);
    }
    let divide = |monomial: Monomial| {
        common.iter().fold(monomial, |monomial, (atom, power)| divide(monomial, *atom, *power))
    };
    let terms = polynomial.terms.into_iter().map(|(monomial, c)| (divide(monomial), c)).collect();
    (common, Polynomial { terms })
}

/// The magnitude of the exponent of `atom` where it has that sign, or 0.
fn power_in(monomial: &Monomial, atom: Expr, sign: i32) -> i32 {
    let found = monomial.iter().find(|(base, _)| *base == atom);
    found.map_or(0, |(_, exponent)| (exponent * sign).max(0))
}

fn divide(monomial: Monomial, atom: Expr, exponent: i32) -> Monomial {
    let divided = monomial
        .into_iter()
        .map(|(base, power)| (base, if base == atom { power - exponent } else { power }));
    divided.filter(|(_, power)| *power != 0).collect()
}
