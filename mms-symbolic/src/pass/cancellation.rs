//! Cancellation rewriting: replaces sums that cancel at small arguments by forms that do not. k cos a - k becomes -2 k
//! sin(a/2)^2, and (1 + e)^2 - 1 becomes 2 e + e^2.
//!
//! A sum is a polynomial in atoms. Some atoms are the sum of a number and a part that vanishes with their argument:
//!
//! ```text
//! cos a = 1 - 2 sin^2(a/2)      exp a = 1 + exp_m1 a     sqrt(c + q) = sqrt c + q/(sqrt c + sqrt(c + q))
//! cosh a = 1 + 2 sinh^2(a/2)    (1 + q)^p = 1 + exp_m1(p ln_1p q)     1/(c + q) = 1/c - q/(c (c + q))
//! ```
//!
//! (Goldberg, What Every Computer Scientist Should Know About Floating-Point Arithmetic, 1991, section 1.4, and Kahan, Branch
//! Cuts, 1987, have similar formulas.) A rewriting is applied only if terms then cancel in exact numbers.

use super::horner::{flat_view, integral_power, nested};
use super::polynomial::Polynomial;
use super::relations::latest_stage;
use super::substitute::rebuild;
use crate::expr::{Expr, Function, Graph, HALF, Node, Rational};
use crate::sorted::{SortedMap, SortedSet};

/// The largest depth of sums within sums that are opened.
const DEPTH: usize = 6;

/// The largest number of rounds for one sum, each with other atoms.
const ROUNDS: usize = 6;

/// Rewrites every sum in `roots` that cancels.
pub fn avoid_cancellation(graph: &mut Graph, roots: &[Expr]) -> Vec<Expr> {
    rebuild(graph, roots, |graph, node| {
        let made = graph.remake(node);
        stable(graph, made)
    })
}

fn stable(graph: &mut Graph, expr: Expr) -> Expr {
    let Some(mut view) = flat_view(graph, expr) else { return expr };
    let mut splits = Splits::default();
    let mut changed = false;
    for _ in 0..ROUNDS {
        let Some(next) = splits.cancel(graph, &view) else { break };
        view = next;
        changed = true;
    }
    if changed { nested(graph, view, &latest_stage) } else { expr }
}

/// An atom as a factor, and whether it divides.
type Factor = (Expr, bool);

/// The parts of an atom.
#[derive(Clone)]
enum Parts {
    /// A number plus a part that vanishes with the argument.
    Limit(Polynomial),
    /// The terms of a sum.
    Terms(Polynomial),
}

/// The parts of atoms, as far as they were needed.
#[derive(Default)]
struct Splits(SortedMap<Factor, Option<Parts>>);

impl Splits {
    /// The polynomial with the fewest atoms split that make terms of it cancel.
    fn cancel(&mut self, graph: &mut Graph, view: &Polynomial) -> Option<Polynomial> {
        let mut chosen = self.reachable(graph, view, true);
        let mut result = self.split(graph, view, &chosen);
        if result.is_none() {
            chosen = self.reachable(graph, view, false);
            result = self.split(graph, view, &chosen);
        }
        let (mut best, cancelled) = result?;
        if !cancelled {
            return None;
        }
        // Sums without functions first: they are short as they are.
        let (sums, calls): (Vec<_>, Vec<_>) = chosen
            .iter()
            .copied()
            .partition(|(atom, _)| matches!(graph.node(*atom), Node::Sum(..)));
        for atom in sums.into_iter().chain(calls) {
            chosen.remove(&atom);
            match self.split(graph, view, &chosen) {
                Some((fewer, true)) => best = fewer,
                _ => drop(chosen.insert(atom)),
            }
        }
        Some(best)
    }

    /// The atoms that can be split, in the polynomial and in its sums; sums without any function only if `plain` is set.
    fn reachable(
        &mut self,
        graph: &mut Graph,
        view: &Polynomial,
        plain: bool,
    ) -> SortedSet<Factor> {
        let mut found = SortedSet::new();
        let mut open = vec![(view.clone(), 0)];
        while let Some((polynomial, depth)) = open.pop() {
            for (atom, power) in polynomial.terms.keys().flatten() {
                let place = (*atom, *power < 0);
                let is_sum = matches!(graph.node(*atom), Node::Sum(..));
                let is_left = is_sum && !plain && !has_function(graph, *atom);
                if depth > DEPTH || is_left || found.contains(&place) {
                    continue;
                }
                match self.of(graph, place) {
                    Some(Parts::Limit(_)) => drop(found.insert(place)),
                    Some(Parts::Terms(terms)) => {
                        found.insert(place);
                        open.push((terms, depth + 1));
                    }
                    None => {}
                }
            }
        }
        found
    }

    fn of(&mut self, graph: &mut Graph, place: Factor) -> Option<Parts> {
        if let Some(known) = self.0.get(&place) {
            return known.clone();
        }
        let (atom, divides) = place;
        let limit = if divides { divided(graph, atom) } else { limit(graph, atom) };
        let parts = match limit {
            Some(limit) => Some(Parts::Limit(polynomial(graph, limit))),
            None if divides => None,
            None => flat_view(graph, atom).map(Parts::Terms),
        };
        self.0.insert(place, parts.clone());
        parts
    }

    /// The polynomial with those atoms split, and whether terms cancelled. `None` if it has too many.
    fn split(
        &mut self,
        graph: &mut Graph,
        view: &Polynomial,
        chosen: &SortedSet<Factor>,
    ) -> Option<(Polynomial, bool)> {
        let mut cancelled = false;
        let (mut opened, mut sums) = (SortedMap::<Factor, Polynomial>::new(), Vec::new());
        for place in chosen {
            match self.of(graph, *place)? {
                Parts::Limit(parts) => drop(opened.insert(*place, parts)),
                Parts::Terms(terms) => sums.push((*place, terms)),
            }
        }
        // Inner sums have smaller handles.
        for (place, terms) in sums {
            let terms = put_in(&terms, &opened, &mut cancelled)?;
            opened.insert(place, terms);
        }
        // Only cancellation in the sum itself counts.
        cancelled = false;
        let split = put_in(view, &opened, &mut cancelled)?;
        Some((split, cancelled))
    }
}

/// The polynomial with atoms replaced, and whether terms cancelled.
fn put_in(
    view: &Polynomial,
    parts: &SortedMap<Factor, Polynomial>,
    cancelled: &mut bool,
) -> Option<Polynomial> {
    let mut total = Polynomial::default();
    let mut met = SortedSet::new();
    for (monomial, coefficient) in &view.terms {
        let mut product = Polynomial::constant(coefficient.clone());
        for (atom, power) in monomial {
            let factor = match parts.get(&(*atom, *power < 0)) {
                Some(parts) => parts.power(power.unsigned_abs(), Some)?,
                None => Polynomial::power_of(*atom, *power),
            };
            product = product.times(&factor)?;
        }
        met.extend(product.terms.keys().cloned());
        total = total.plus(&product, &Rational::ONE)?;
    }
    *cancelled |= met.len() > total.terms.len();
    Some(total)
}

/// The polynomial of a number plus a factor times a vanishing part.
fn polynomial(graph: &mut Graph, (at, factor, small): Split) -> Polynomial {
    let factors = match graph.node(small).clone() {
        Node::Product(factors) => factors,
        _ => vec![(small, Rational::ONE)],
    };
    let powers = factors.into_iter();
    let monomial = powers.map(|(base, power)| integral_power(graph, base, &power));
    let mut monomial = monomial.collect::<Option<Vec<_>>>().unwrap_or_else(|| vec![(small, 1)]);
    monomial.sort();
    let mut split = Polynomial::constant(at);
    split.add(monomial, factor);
    split
}

/// A number, and a factor times an expression that vanishes with the argument.
type Split = (Rational, Rational, Expr);

/// The parts of an atom at small arguments.
fn limit(graph: &mut Graph, atom: Expr) -> Option<Split> {
    let one = Rational::ONE;
    match graph.node(atom).clone() {
        Node::Call(Function::Cos, angle) => {
            let square = half_square(graph, Function::Sin, angle[0]);
            Some((one, Rational::from(-2), square))
        }
        Node::Call(Function::Cosh, angle) => {
            let square = half_square(graph, Function::Sinh, angle[0]);
            Some((one, Rational::from(2), square))
        }
        Node::Call(Function::Exp, exponent) => {
            let small = graph.call(Function::ExpM1, &exponent);
            Some((one.clone(), one, small))
        }
        Node::Call(Function::Powf, arguments) => {
            let (at, rest) = shifted(graph, arguments[0])?;
            at.is_one().then(|| {
                let small = power_less_one(graph, rest, arguments[1]);
                (one.clone(), one, small)
            })
        }
        // a^3 - b^3 = (a - b) (a^2 + a b + b^2).
        Node::Call(Function::Cbrt, radicand) => {
            let (at, rest) = shifted(graph, radicand[0])?;
            let at = graph.number(at);
            let root = graph.power(at, Rational::from_parts(1.into(), 3u8.into()));
            let at = graph.as_number(root)?.clone();
            let square = graph.power(atom, 2);
            let squared = at.clone() * &at;
            let sum = graph.sum([(atom, at.clone()), (square, Rational::ONE)]);
            let squared = graph.number(squared);
            let sum = graph.add(sum, squared);
            Some((at, one, graph.div(rest, sum)))
        }
        Node::Product(factors) => {
            let [(base, power)] = factors.as_slice() else { return None };
            let (at, rest) = shifted(graph, *base)?;
            let number = graph.number(at.clone());
            let value = graph.power(number, power.clone());
            let value = graph.as_number(value)?.clone();
            if *power == HALF {
                let number = graph.number(value.clone());
                let sum = graph.add(number, atom);
                return Some((value, one, graph.div(rest, sum)));
            }
            at.is_one().then(|| {
                let power = graph.number(power.clone());
                let small = power_less_one(graph, rest, power);
                (one.clone(), one, small)
            })
        }
        _ => None,
    }
}

/// 1/(c + q) = 1/c - q/(c (c + q)).
fn divided(graph: &mut Graph, atom: Expr) -> Option<Split> {
    let (at, rest) = shifted(graph, atom)?;
    let reciprocal = Rational::ONE / at;
    Some((reciprocal.clone(), -reciprocal, graph.div(rest, atom)))
}

/// Splits a sum into a number other than 0 and the rest.
fn shifted(graph: &mut Graph, sum: Expr) -> Option<(Rational, Expr)> {
    let Node::Sum(constant, terms) = graph.node(sum).clone() else { return None };
    if constant.is_zero() {
        return None;
    }
    Some((constant, graph.sum(terms)))
}

fn half_square(graph: &mut Graph, function: Function, angle: Expr) -> Expr {
    let half = graph.scale(angle, HALF);
    let value = graph.call(function, &[half]);
    graph.power(value, 2)
}

/// (1 + q)^p - 1.
fn power_less_one(graph: &mut Graph, rest: Expr, power: Expr) -> Expr {
    let logarithm = graph.call(Function::Ln1p, &[rest]);
    let exponent = graph.mul(power, logarithm);
    graph.call(Function::ExpM1, &[exponent])
}

/// Whether a sum contains a function or a root outside the arguments of functions.
fn has_function(graph: &Graph, sum: Expr) -> bool {
    let mut seen = SortedSet::new();
    let mut open = vec![sum];
    while let Some(expr) = open.pop() {
        if !seen.insert(expr) {
            continue;
        }
        match graph.node(expr) {
            Node::Call(..) | Node::Offset(_) | Node::Small(..) => return true,
            Node::Product(factors) if factors.iter().any(|(_, power)| !power.is_int()) => {
                return true;
            }
            Node::Sum(..) | Node::Product(_) => open.extend(graph.node(expr).children()),
            Node::Number(_) | Node::Pi | Node::Symbol(_) => {}
        }
    }
    false
}
