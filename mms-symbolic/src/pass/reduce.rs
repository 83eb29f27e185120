//! Reduction to normal form: expressions are multiplied out modulo the relations, so that terms cancel.
//!
//! Three kinds of sums stay in one piece: sums without any atom of a relation, sums of functions of one root alone, and sums of
//! more than 200 terms. Reduction is therefore bounded, and may not pay.

use super::horner::{integral_power, nested, take_common};
use super::polynomial::Polynomial;
use super::relations::Relations;
use super::substitute::rebuild;
use crate::expr::{Expr, Graph, Node, Rational};
use crate::sorted::SortedMap;

/// Computes the normal form of `roots` modulo `relations`, nested. Expressions that would become too large stay in one piece.
pub fn reduce(graph: &mut Graph, roots: &[Expr], relations: &Relations) -> Vec<Expr> {
    if relations.is_empty() {
        return roots.to_vec();
    }
    let mut reducer = Reducer { relations, forms: SortedMap::new(), rebuilt: SortedMap::new() };
    for expr in graph.reachable(roots) {
        let form = reducer.form(graph, expr);
        reducer.forms.insert(expr, form);
    }
    let reduced: Vec<Expr> = roots.iter().map(|root| reducer.rebuilt(graph, *root)).collect();
    // Sines and cosines were kept as in the relations, with their angles unchanged.
    let angles: SortedMap<Expr, Expr> = relations
        .angles(graph)
        .filter(|angle| reducer.forms.contains_key(angle))
        .collect::<Vec<_>>()
        .into_iter()
        .map(|angle| (angle, reducer.rebuilt(graph, angle)))
        .collect();
    rebuild(graph, &reduced, |graph, mut node| {
        if let Node::Call(_, arguments) = &mut node {
            for argument in arguments {
                *argument = angles.get(argument).copied().unwrap_or(*argument);
            }
        }
        graph.remake(node)
    })
}

struct Reducer<'a> {
    relations: &'a Relations,
    forms: SortedMap<Expr, Polynomial>,
    rebuilt: SortedMap<Expr, Expr>,
}

impl Reducer<'_> {
    /// The normal form of a node whose operands are in normal form.
    fn form(&mut self, graph: &mut Graph, expr: Expr) -> Polynomial {
        if self.relations.concerns(expr) {
            return Polynomial::power_of(expr, 1);
        }
        match graph.node(expr).clone() {
            Node::Number(number) => Polynomial::constant(number),
            Node::Pi | Node::Symbol(_) => Polynomial::power_of(expr, 1),
            Node::Sum(constant, terms) => {
                let sum = self.sum(graph, constant.clone(), &terms);
                sum.unwrap_or_else(|| self.closed(graph, Node::Sum(constant, terms)))
            }
            Node::Product(factors) => {
                let product = self.product(graph, &factors);
                product.unwrap_or_else(|| self.closed(graph, Node::Product(factors)))
            }
            other @ (Node::Call(..) | Node::Offset(_) | Node::Small(..)) => {
                self.closed(graph, other)
            }
        }
    }

    /// A sum, multiplied out if that is useful; else the common factors of its terms times the rest in one piece.
    fn sum(
        &mut self,
        graph: &mut Graph,
        constant: Rational,
        terms: &[(Expr, Rational)],
    ) -> Option<Polynomial> {
        let mut sum = Polynomial::constant(constant);
        for (term, coefficient) in terms {
            sum = sum.plus(&self.forms[term], coefficient)?;
        }
        if sum.terms.len() < 2 || self.relations.opens(graph, &sum.atoms()) {
            return Some(sum);
        }
        let (common, rest) = take_common(sum);
        let rest = self.nested(graph, rest);
        let rest = self.atom(graph, rest, &Rational::ONE)?;
        self.relations.normal_form(rest.times(&Polynomial::monomial(common, Rational::ONE))?)
    }

    /// A product multiplied out.
    fn product(&mut self, graph: &mut Graph, factors: &[(Expr, Rational)]) -> Option<Polynomial> {
        let mut product = Polynomial::constant(Rational::ONE);
        for (base, exponent) in factors {
            let power = self.power(graph, *base, exponent)?;
            product = self.relations.normal_form(product.times(&power)?)?;
        }
        Some(product)
    }

    fn power(&mut self, graph: &mut Graph, base: Expr, exponent: &Rational) -> Option<Polynomial> {
        if let Some(root) = self.relations.root_of(base) {
            let doubled = exponent * Rational::from(2);
            if doubled.is_int() {
                let doubled = i32::try_from(doubled.numerator().clone()).ok()?;
                return Some(Polynomial::power_of(root, doubled));
            }
        }
        let form = &self.forms[&base];
        if exponent.is_int() {
            let count = i32::try_from(exponent.numerator().clone()).ok()?;
            if let Some((monomial, coefficient)) = form.single() {
                let power = graph.number(coefficient.clone());
                let power = graph.power(power, exponent.clone());
                let coefficient = graph.as_number(power)?.clone();
                let monomial = monomial
                    .iter()
                    .map(|(atom, inner)| Some((*atom, inner.checked_mul(count)?)))
                    .collect::<Option<_>>()?;
                return self.relations.normal_form(Polynomial::monomial(monomial, coefficient));
            }
            if count > 0 {
                return form.power(count as u32, |power| self.relations.normal_form(power));
            }
        }
        let rebuilt = self.rebuilt(graph, base);
        self.atom(graph, rebuilt, exponent)
    }

    /// A power whose base is treated as an atom.
    fn atom(&self, graph: &mut Graph, base: Expr, exponent: &Rational) -> Option<Polynomial> {
        let power = graph.power(base, exponent.clone());
        // A sum is the same factor for every number that multiplies it.
        let (content, primitive) = graph.split_content(power);
        let factors = match graph.node(primitive).clone() {
            Node::Number(number) => return Some(Polynomial::constant(content * number)),
            Node::Product(factors) => factors,
            _ => vec![(primitive, Rational::ONE)],
        };
        let mut monomial = Polynomial::constant(content);
        for (base, exponent) in factors {
            let (atom, exponent) = integral_power(graph, base, &exponent)?;
            monomial = monomial.times(&Polynomial::power_of(atom, exponent))?;
        }
        Some(monomial)
    }

    /// A node kept in one piece, with rebuilt operands.
    fn closed(&mut self, graph: &mut Graph, mut node: Node) -> Polynomial {
        node.map_children(|child| self.rebuilt(graph, child));
        let made = graph.remake(node);
        let atom = self.atom(graph, made, &Rational::ONE);
        atom.unwrap_or_else(|| Polynomial::power_of(made, 1))
    }

    /// The expression of a normal form.
    fn rebuilt(&mut self, graph: &mut Graph, expr: Expr) -> Expr {
        if let Some(rebuilt) = self.rebuilt.get(&expr) {
            return *rebuilt;
        }
        let rebuilt = self.nested(graph, self.forms[&expr].clone());
        self.rebuilt.insert(expr, rebuilt);
        rebuilt
    }

    fn nested(&self, graph: &mut Graph, polynomial: Polynomial) -> Expr {
        nested(graph, polynomial, &|graph, atom| self.relations.rank(graph, atom))
    }
}
