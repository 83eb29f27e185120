//! The multivariate Horner scheme: a x + a y + b becomes a (x + y) + b, a nested sum. The most frequent factor of the terms is
//! taken out first. A sum that is a square is written as a square.

use super::polynomial::{Monomial, Polynomial, product};
use super::substitute::rebuild;
use crate::expr::{Expr, Graph, Node, Rational};
use crate::sorted::SortedMap;

/// The largest number of terms; longer sums stay as they are, since the work can grow with the square of their length.
const MAX_TERMS: usize = 2000;

/// Nests every sum in `roots`. Factors of a lower rank are taken out first.
pub fn horner(graph: &mut Graph, roots: &[Expr], rank: &dyn Fn(&Graph, Expr) -> u8) -> Vec<Expr> {
    rebuild(graph, roots, |graph, node| {
        let made = graph.remake(node);
        match flat_view(graph, made) {
            Some(polynomial) => nested(graph, polynomial, rank),
            None => made,
        }
    })
}

/// A sum as a polynomial in the bases of its products, which are not multiplied out.
pub(super) fn flat_view(graph: &mut Graph, expr: Expr) -> Option<Polynomial> {
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
        // A fractional power becomes a power of a root (`integral_power`), whose handle may sort differently than the handle of
        // its base.
        let mut monomial = monomial;
        monomial.sort();
        view.add(monomial, coefficient);
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
pub(super) fn nested(
    graph: &mut Graph,
    polynomial: Polynomial,
    rank: &dyn Fn(&Graph, Expr) -> u8,
) -> Expr {
    // The outermost sum is first.
    let mut levels = Vec::new();
    let mut level = Nesting::new(graph, polynomial, rank);
    loop {
        if let Some(inner) = level.take_most_frequent(graph, rank) {
            levels.push(level);
            level = Nesting::new(graph, inner, rank);
            continue;
        }
        let inner = level.finish(graph);
        let Some(outer) = levels.pop() else { return inner };
        level = outer;
        level.parts.push((inner, Rational::ONE));
    }
}

/// A sum that is being nested.
struct Nesting {
    /// The common factors of all terms.
    common: Monomial,
    /// The terms that are not nested yet.
    rest: Polynomial,
    /// The number of these terms that have each factor.
    counts: Counts,
    /// The parts that are nested already.
    parts: Vec<(Expr, Rational)>,
}

impl Nesting {
    /// Starts a level: common factors of all terms are taken out at once, so that every further factor is in some terms only.
    fn new(graph: &mut Graph, polynomial: Polynomial, rank: &dyn Fn(&Graph, Expr) -> u8) -> Self {
        let (common, mut rest) = take_common(polynomial);
        let mut parts = Vec::new();
        if let Some((factor, root)) = rest.as_square() {
            let root = nested(graph, root, rank);
            parts.push((graph.power(root, 2), factor));
            rest = Polynomial::default();
        }
        let mut counts = Counts::default();
        rest.terms.keys().for_each(|monomial| counts.add(monomial, 1));
        Nesting { common, rest, counts, parts }
    }

    /// Takes out the terms with the most frequent factor, if at least two terms have it.
    fn take_most_frequent(
        &mut self,
        graph: &Graph,
        rank: &dyn Fn(&Graph, Expr) -> u8,
    ) -> Option<Polynomial> {
        let (atom, sign) = self.counts.most_frequent(graph, rank)?;
        let terms = std::mem::take(&mut self.rest.terms);
        let (with, without): (SortedMap<_, _>, _) =
            terms.into_iter().partition(|(monomial, _)| power_in(monomial, atom, sign) > 0);
        with.keys().for_each(|monomial| self.counts.add(monomial, -1));
        self.rest = Polynomial { terms: without };
        Some(Polynomial { terms: with })
    }

    fn finish(mut self, graph: &mut Graph) -> Expr {
        for (monomial, coefficient) in self.rest.terms {
            self.parts.push((product(graph, &monomial), coefficient));
        }
        let sum = graph.sum(self.parts);
        let common = product(graph, &self.common);
        graph.mul(common, sum)
    }
}

/// The number of terms that have each factor, as a multiplier and as a divisor.
#[derive(Default)]
struct Counts(SortedMap<(Expr, i32), i32>);

impl Counts {
    fn add(&mut self, monomial: &Monomial, count: i32) {
        for (atom, exponent) in monomial {
            *self.0.get_or_default((*atom, exponent.signum())) += count;
        }
    }

    /// The most frequent factor, and the sign of its exponent; at least two terms have it.
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
    if polynomial.terms.len() < 2 {
        return (Monomial::new(), polynomial);
    }
    let mut monomials = polynomial.terms.keys();
    let mut common = monomials.next().cloned().unwrap_or_default();
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

/// The magnitude of the exponent of `atom` if it has this sign, else 0.
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
