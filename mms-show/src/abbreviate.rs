//! Abbreviates formulas: one that would be too long for a line is put together from named parts.

use super::reading::Reading;
use mms_symbolic::expr::{Expr, Node, Rational};
use mms_symbolic::sorted::SortedMap;

/// The longest right-hand side, in characters of text.
pub(super) const LINE: usize = 72;

/// A part that occurs more than once in a long formula has a name from this length on.
const REPEATED: usize = 24;

impl Reading {
    /// The expressions with parts named `k1`, `k2`, ... such that each fits on a line. Short expressions stay unchanged.
    pub fn abbreviated(&mut self, roots: &[Expr]) -> Vec<Expr> {
        let is_long = roots.iter().any(|root| self.length(*root) > LINE);
        if !is_long {
            return roots.to_vec();
        }
        let uses = self.uses(roots);
        let mut shorter = SortedMap::<Expr, Expr>::new();
        for expr in self.graph.reachable(roots) {
            let node = with_operands(self.graph.node(expr), &shorter);
            let mut made = self.graph.remake(node);
            made = self.fitted(made);
            let is_root = roots.contains(&expr);
            if uses[&expr] > 1 && !is_root && self.length(made) >= REPEATED {
                made = self.numbered(made);
            }
            shorter.insert(expr, made);
        }
        roots.iter().map(|root| shorter[root]).collect()
    }

    /// The number of times that each part is an operand.
    fn uses(&self, roots: &[Expr]) -> SortedMap<Expr, usize> {
        let mut uses = SortedMap::new();
        for expr in self.graph.reachable(roots) {
            uses.get_or_insert_with(expr, || 0);
            for child in self.graph.node(expr).children() {
                *uses.get_or_insert_with(child, || 0) += 1;
            }
        }
        uses
    }

    /// An expression whose operands each fit on a line, shortened to fit too.
    fn fitted(&mut self, mut expr: Expr) -> Expr {
        while self.length(expr) > LINE {
            let Some(shorter) = self.with_longest_named(expr).or_else(|| self.halved(expr)) else {
                // A long number, or names of a hundred characters: there is nothing to break.
                return expr;
            };
            if shorter == expr {
                return expr;
            }
            expr = shorter;
        }
        expr
    }

    /// The expression with the longest of its operands named.
    fn with_longest_named(&mut self, expr: Expr) -> Option<Expr> {
        let node = self.graph.node(expr).clone();
        if node.children().count() > 8 {
            // Many operands are put together in groups first.
            return None;
        }
        let operands = node.children().filter(|child| !self.is_leaf(*child));
        let longest = operands.max_by_key(|child| (self.length(*child), *child))?;
        if self.length(longest) < 8 {
            return None;
        }
        let name = self.numbered(longest);
        let node = with_operands(&node, &SortedMap::from([(longest, name)]));
        Some(self.graph.remake(node))
    }

    /// A sum or product of many operands as one of few, each of them a named group.
    fn halved(&mut self, expr: Expr) -> Option<Expr> {
        let node = self.graph.node(expr).clone();
        let (operands, is_sum) = match &node {
            Node::Sum(_, terms) => (terms, true),
            Node::Product(factors) => (factors, false),
            _ => return None,
        };
        let groups = self.groups(operands);
        if groups.len() < 2 && operands.len() < 3 {
            return None;
        }
        let mut parts = Vec::new();
        for group in groups {
            let whole = match is_sum {
                true => self.graph.sum(group),
                false => self.graph.product(group),
            };
            parts.push((
                if self.is_leaf(whole) { whole } else { self.numbered(whole) },
                Rational::ONE,
            ));
        }
        Some(match &node {
            Node::Sum(constant, _) => {
                parts.push((self.graph.number(1), constant.clone()));
                self.graph.sum(parts)
            }
            _ => self.graph.product(parts),
        })
    }

    /// Operands in groups that fit on a line each, in their order.
    fn groups(&self, operands: &[(Expr, Rational)]) -> Vec<Vec<(Expr, Rational)>> {
        // The additional text of an operand: its sign and blanks, its number, parentheses.
        let length = |(operand, number): &(Expr, Rational)| {
            let digits = if number.is_one() { 0 } else { number.to_string().len() + 1 };
            self.length(*operand).saturating_add(digits + 5)
        };
        let mut groups: Vec<Vec<(Expr, Rational)>> = vec![Vec::new()];
        let mut filled = 0_usize;
        for operand in operands {
            let length = length(operand);
            if filled.saturating_add(length) > LINE
                && groups.last().is_some_and(|last| !last.is_empty())
            {
                groups.push(Vec::new());
                filled = 0;
            }
            filled = filled.saturating_add(length);
            if let Some(last) = groups.last_mut() {
                last.push(operand.clone());
            }
        }
        groups
    }
}

/// A node over other operands.
fn with_operands(node: &Node, others: &SortedMap<Expr, Expr>) -> Node {
    let mut node = node.clone();
    node.map_children(|child| others.get(&child).copied().unwrap_or(child));
    node
}
