//! Splits expressions by binding time: separates the part that X determines from the part that t does. X (a + t (Y + t Z))
//! becomes a X + t (X Y) + t^2 (X Z), so a caller that stores the part of X computes less at every time.
//!
//! A factor is multiplied into the only sum of a product that needs both, if nothing else reads that sum. Sums of one kind stay
//! as written, and two sums are never multiplied out: terms that cancel in one still do.

use super::Operands;
use crate::expr::{Expr, Graph, Node, Rational, Stage};
use crate::sorted::SortedMap;

/// Splits every sum in `roots` that needs both X and t into parts of X and parts of t.
pub fn separate(graph: &mut Graph, roots: &[Expr]) -> Vec<Expr> {
    let readers = graph.readers(roots, |expr| graph.stage(expr) == Stage::PointTime);
    let mut parts = Parts { readers, ..Parts::default() };
    for expr in graph.reachable(roots) {
        if graph.stage(expr) == Stage::PointTime {
            let sum = parts.of(graph, expr);
            parts.sums.insert(expr, sum);
        }
    }
    roots.iter().map(|root| parts.whole(graph, *root)).collect()
}

/// A sum of products: a factor without t for each factor with it.
type Sum = SortedMap<Expr, Expr>;

#[derive(Default)]
struct Parts {
    /// The number of readers of each expression, among the roots and the expressions that need X and t.
    readers: SortedMap<Expr, usize>,
    /// The sums of the expressions that need X and t.
    sums: SortedMap<Expr, Sum>,
    /// The whole expressions of these sums, made on request.
    wholes: SortedMap<Expr, Expr>,
}

impl Parts {
    /// The sum of an expression, given the sums of its operands.
    fn of(&mut self, graph: &mut Graph, expr: Expr) -> Sum {
        match graph.node(expr).clone() {
            Node::Sum(constant, terms) => self.sum(graph, constant, terms),
            Node::Product(factors) => self.product(graph, factors),
            mut node => {
                node.map_children(|child| self.whole(graph, child));
                let made = graph.remake(node);
                alone(graph, made)
            }
        }
    }

    fn sum(&mut self, graph: &mut Graph, constant: Rational, terms: Operands) -> Sum {
        let [without, of_time, both] = by_stage(graph, terms);
        let one = graph.number(1);
        let mut without = graph.sum(without.into_iter().chain([(one, constant)]));
        let mut of_time = graph.sum(of_time);
        // The part of parameters is added to the part of t, if there is one.
        if graph.stage(without) == Stage::Parameter && !graph.is_zero(of_time) {
            of_time = graph.add(of_time, without);
            without = graph.number(0);
        }
        let mut sum = Sum::from([(one, without)]);
        add(graph, &mut sum, (of_time, one), &Rational::ONE);
        for (term, number) in both {
            for product in self.opened(graph, term) {
                add(graph, &mut sum, product, &number);
            }
        }
        sum.retain(|late, factor| !graph.is_zero(*late) && !graph.is_zero(*factor));
        sum
    }

    fn product(&mut self, graph: &mut Graph, factors: Operands) -> Sum {
        let [without, of_time, both] = by_stage(graph, factors);
        let opened = match both.as_slice() {
            [(sum, power)] if power.is_one() => self.opened(graph, *sum),
            _ => {
                let whole = |(base, power)| (self.whole(graph, base), power);
                let wholes: Operands = both.into_iter().map(whole).collect();
                let product = graph.product(wholes);
                alone(graph, product)
            }
        };
        let [without, of_time] = [without, of_time].map(|factors| graph.product(factors));
        let mut sum = Sum::new();
        for (late, factor) in opened {
            let product = (graph.mul(late, of_time), graph.mul(factor, without));
            add(graph, &mut sum, product, &Rational::ONE);
        }
        sum
    }

    /// The sum of an operand; a single term if other expressions read it too.
    fn opened(&mut self, graph: &mut Graph, expr: Expr) -> Sum {
        match self.sums.get(&expr) {
            Some(sum) if sum.len() == 1 || self.readers[&expr] == 1 => sum.clone(),
            _ => {
                let whole = self.whole(graph, expr);
                alone(graph, whole)
            }
        }
    }

    /// The expression that is put together from the parts of another one.
    fn whole(&mut self, graph: &mut Graph, expr: Expr) -> Expr {
        if let Some(whole) = self.wholes.get(&expr) {
            return *whole;
        }
        let Some(sum) = self.sums.get(&expr) else { return expr };
        let product = |(late, factor): (&Expr, &Expr)| (graph.mul(*late, *factor), Rational::ONE);
        let products: Operands = sum.iter().map(product).collect();
        let whole = graph.sum(products);
        self.wholes.insert(expr, whole);
        whole
    }
}

/// The operands that need no t, those without X, and those with both.
fn by_stage(graph: &Graph, operands: Operands) -> [Operands; 3] {
    let mut by_stage = [const { Operands::new() }; 3];
    for operand in operands {
        let part = match graph.stage(operand.0) {
            Stage::Parameter | Stage::Point => 0,
            Stage::Time => 1,
            Stage::PointTime => 2,
        };
        by_stage[part].push(operand);
    }
    by_stage
}

/// Adds a number times a product to a sum.
fn add(graph: &mut Graph, sum: &mut Sum, (late, factor): (Expr, Expr), number: &Rational) {
    let zero = graph.number(0);
    let total = sum.get_or_insert_with(late, || zero);
    *total = graph.sum([(*total, Rational::ONE), (factor, number.clone())]);
}

/// A sum of one term.
fn alone(graph: &mut Graph, expr: Expr) -> Sum {
    Sum::from([(expr, graph.number(1))])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expr::Symbol;

    #[test]
    fn what_t_determines_stands_before_what_x_does() {
        let mut graph = Graph::default();
        let a = graph.symbol(Symbol::Parameter(0));
        let t = graph.symbol(Symbol::Time);
        let [x, y, z] = [0, 1, 2].map(|axis| graph.symbol(Symbol::Coordinate(axis)));
        // x (a + t (y + t z))
        let inner = graph.mul(t, z);
        let inner = graph.add(y, inner);
        let middle = graph.mul(t, inner);
        let middle = graph.add(a, middle);
        let outer = graph.mul(x, middle);
        let one = Rational::ONE;
        let power = |base: Expr, exponent: i32| (base, Rational::from(exponent));
        let parts = [
            vec![power(a, 1), power(x, 1)],
            vec![power(t, 1), power(x, 1), power(y, 1)],
            vec![power(t, 2), power(x, 1), power(z, 1)],
        ];
        let parts = parts.map(|factors| (graph.product(factors), one.clone()));
        let expected = graph.sum(parts);
        assert_eq!(separate(&mut graph, &[outer]), [expected]);
        // If another expression needs the inner sum, it stays a sum.
        let apart = separate(&mut graph, &[outer, inner]);
        let first = graph.mul(a, x);
        let second = graph.product([t, x, inner].map(|factor| (factor, one.clone())));
        assert_eq!(apart, [graph.add(first, second), inner]);
    }
}
