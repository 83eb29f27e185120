//! The second-order remainder of an expression: f less its linear part in a symbol e, such that nothing cancels. For f = f0 + e
//! f1 + f2 the remainder is f2.
//!
//! The calculus extends [`difference`](super::difference) by one order. With r = f - f0:
//!
//! ```text
//! f g       f0 g2 + e f1 (g - g0) + f2 g            ln      f2/f0 - ln_1p_rest(r/f0)
//! 1/f       (r^2/f - f2)/f0^2                       exp     exp f0 (f2 + ln_1p_rest(exp_m1 r))
//! y = f^(1/n)   (f2 - h^2 s)/(n y0^(n-1)),  h = y - y0,  s = sum of (j + 1) y0^j y^(n-2-j)
//! ```
//!
//! for exp_m1 r - r is h - ln_1p h with h = exp_m1 r, and y^n = y0^n + n y0^(n-1) h + h^2 s. The remainder of a cosine at 0 is
//! -2 sin(r/2)^2, and 2 sinh(r/2)^2 for a hyperbolic cosine.
//!
//! The remainder is needed if Div P or b is of second order in the amplitude, such as Div P of a harmonic motion, or b of a
//! wave at the material's own speed: half of a small amplitude reduces it to a quarter, and terms of first order would cancel
//! in rounded numbers. The linear part is omitted if it is 0 for all parameters. If it is 0 at their defaults only, it is added
//! to the rest in factored form, so that its terms cancel in the parameters, which have twice the digits.

use crate::expr::{Expr, Function, Graph, HALF, Node, Rational, Symbol};
use crate::sorted::SortedMap;

/// The largest order of a root that is split.
const MAX_ROOT: u32 = 12;
/// The greatest exponent of a power that is split.
const MAX_POWER: u32 = 64;

/// An expression to second order in the symbol: its limit, its slope times the symbol, and the rest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Parts {
    /// f0, the value of the expression where the symbol is 0.
    pub limit: Expr,
    /// f1, the derivative there.
    pub slope: Expr,
    /// f2, the rest.
    pub rest: Expr,
}

/// Splits each root; `None` for one that has an operation without a rule.
pub fn curvature(graph: &mut Graph, roots: &[Expr], symbol: Symbol) -> Vec<Option<Parts>> {
    let symbol = graph.symbol(symbol);
    let mut split = Split { symbol, known: SortedMap::new() };
    for expr in graph.reachable(roots) {
        let term = split.term(graph, expr);
        split.known.insert(expr, term);
    }
    let parts = |root: &Expr| {
        let Term { limit, slope, second, .. } = split.known[root]?;
        Some(Parts { limit, slope, rest: second })
    };
    roots.iter().map(parts).collect()
}

/// The parts of an expression.
#[derive(Clone, Copy)]
struct Term {
    limit: Expr,
    slope: Expr,
    /// The expression less its limit.
    first: Expr,
    /// The expression less its linear part.
    second: Expr,
    /// The whole expression: as the sum of its parts if the limit is 0.
    whole: Expr,
}

struct Split {
    symbol: Expr,
    known: SortedMap<Expr, Option<Term>>,
}

impl Split {
    fn term(&self, graph: &mut Graph, expr: Expr) -> Option<Term> {
        let node = graph.node(expr).clone();
        let zero = graph.number(0);
        if expr == self.symbol {
            let slope = graph.number(1);
            return Some(Term { limit: zero, slope, first: expr, second: zero, whole: expr });
        }
        let mut moves = false;
        for child in node.children() {
            moves |= !graph.is_zero(self.known[&child]?.first);
        }
        if !moves {
            return Some(Term { limit: expr, slope: zero, first: zero, second: zero, whole: expr });
        }
        match node {
            Node::Number(_) | Node::Pi | Node::Symbol(_) | Node::Offset(_) | Node::Small(..) => {
                None
            }
            Node::Sum(constant, terms) => {
                let mut parts = [const { Vec::new() }; 4];
                parts[0].push((graph.number(1), constant));
                for (term, factor) in terms {
                    let Term { limit, slope, first, second, .. } = self.known[&term]?;
                    for (part, of) in parts.iter_mut().zip([limit, slope, first, second]) {
                        part.push((of, factor.clone()));
                    }
                }
                let [limit, slope, first, second] = parts.map(|terms| graph.sum(terms));
                Some(tidy(graph, Term { limit, slope, first, second, whole: expr }))
            }
            Node::Product(factors) => {
                let mut powers = factors.into_iter().map(|(base, exponent)| {
                    let base = self.known[&base]?;
                    self.power(graph, base, &exponent)
                });
                let mut all = powers.next()??;
                let others: Option<Vec<Term>> = powers.collect();
                for factor in others? {
                    all = self.product(graph, all, factor);
                }
                Some(all)
            }
            Node::Call(function, arguments) => {
                call(graph, function, self.known[arguments.first()?]?, expr)
            }
        }
    }

    fn product(&self, graph: &mut Graph, f: Term, g: Term) -> Term {
        let limit = graph.mul(f.limit, g.limit);
        let slope = [[f.limit, g.slope], [f.slope, g.limit]];
        let first = [[f.first, g.whole], [f.limit, g.first]];
        let [slope, first] = [slope, first].map(|pairs| products(graph, pairs));
        let bent = graph.mul(self.symbol, f.slope);
        let second = [[f.limit, g.second], [bent, g.first], [f.second, g.whole]];
        let second = products(graph, second);
        let whole = graph.mul(f.whole, g.whole);
        tidy(graph, Term { limit, slope, first, second, whole })
    }

    /// Splits a power by the root of its denominator, products, and the reciprocal.
    fn power(&self, graph: &mut Graph, base: Term, exponent: &Rational) -> Option<Term> {
        if graph.is_zero(base.first) {
            let zero = graph.number(0);
            let whole = graph.power(base.whole, exponent.clone());
            return Some(Term { limit: whole, slope: zero, first: zero, second: zero, whole });
        }
        let is_negative = *exponent < Rational::ZERO;
        let magnitude = if is_negative { -exponent.clone() } else { exponent.clone() };
        let degree = u32::try_from(magnitude.denominator()).ok().filter(|it| *it <= MAX_ROOT)?;
        let count = u32::try_from(magnitude.numerator()).ok().filter(|it| *it <= MAX_POWER)?;
        let root = if degree == 1 { base } else { root(graph, base, degree)? };
        let mut power = root;
        for bit in (0..count.ilog2()).rev() {
            power = self.product(graph, power, power);
            if count >> bit & 1 == 1 {
                power = self.product(graph, power, root);
            }
        }
        if is_negative { reciprocal(graph, power) } else { Some(power) }
    }
}

fn root(graph: &mut Graph, of: Term, degree: u32) -> Option<Term> {
    if graph.is_zero(of.limit) {
        return None;
    }
    let exponent = Rational::from_parts(1.into(), degree.into());
    let [limit, whole] = [of.limit, of.whole].map(|it| graph.power(it, exponent.clone()));
    // y^n - y0^n = (y - y0) sum, and the same for the sum.
    let [mut sum, mut again] = [Vec::new(), Vec::new()];
    for j in 0..degree {
        let powers = |graph: &mut Graph, of_whole: u32| {
            let [at, of] = [(limit, j), (whole, of_whole)].map(|(it, n)| graph.power(it, n));
            graph.mul(at, of)
        };
        sum.push((powers(graph, degree - 1 - j), Rational::ONE));
        if j + 2 <= degree {
            again.push((powers(graph, degree - 2 - j), Rational::from(j + 1)));
        }
    }
    let [sum, again] = [sum, again].map(|terms| graph.sum(terms));
    let first = graph.div(of.first, sum);
    let divisor = graph.power(limit, degree - 1);
    let divisor = graph.scale(divisor, degree);
    let slope = graph.div(of.slope, divisor);
    let square = graph.power(first, 2);
    let bent = graph.mul(square, again);
    let second = graph.sub(of.second, bent);
    let second = graph.div(second, divisor);
    Some(Term { limit, slope, first, second, whole })
}

fn call(graph: &mut Graph, function: Function, of: Term, expr: Expr) -> Option<Term> {
    let Term { limit: at, slope, first, second, whole } = of;
    match function {
        Function::Ln => logarithm(graph, of, expr),
        Function::Ln1p => {
            let [limit, whole] = [at, whole].map(|it| one_plus(graph, it));
            logarithm(graph, Term { limit, whole, ..of }, expr)
        }
        // x - ln_1p x.
        Function::Ln1pRest => {
            let [limit, whole] = [at, whole].map(|it| one_plus(graph, it));
            let less = logarithm(graph, Term { limit, whole, ..of }, expr)?;
            let limit = graph.call(Function::Ln1pRest, &[at]);
            let pairs = [(slope, less.slope), (first, less.first), (second, less.second)];
            let [slope, first, second] = pairs.map(|(of, less)| graph.sub(of, less));
            Some(tidy(graph, Term { limit, slope, first, second, whole: expr }))
        }
        Function::Exp | Function::ExpM1 => {
            let limit = graph.call(function, &[at]);
            let factor = graph.call(Function::Exp, &[at]);
            let more = graph.call(Function::ExpM1, &[first]);
            let bent = graph.call(Function::Ln1pRest, &[more]);
            let bent = graph.add(second, bent);
            let [slope, first, second] = [slope, more, bent].map(|part| graph.mul(factor, part));
            Some(tidy(graph, Term { limit, slope, first, second, whole: expr }))
        }
        Function::Cos if graph.is_zero(at) => {
            Some(at_crest(graph, [Function::Sin, Function::Cos], -2, of))
        }
        Function::Cosh if graph.is_zero(at) => {
            Some(at_crest(graph, [Function::Sinh, Function::Cosh], 2, of))
        }
        _ => None,
    }
}

/// The sum of products.
fn products<const N: usize>(graph: &mut Graph, pairs: [[Expr; 2]; N]) -> Expr {
    let terms = pairs.map(|[a, b]| (graph.mul(a, b), Rational::ONE));
    graph.sum(terms)
}

/// Omits parts that are 0 from the sums that contain them.
fn tidy(graph: &Graph, mut term: Term) -> Term {
    if graph.is_zero(term.slope) {
        term.first = term.second;
    }
    if graph.is_zero(term.limit) {
        term.whole = term.first;
    }
    term
}

fn reciprocal(graph: &mut Graph, of: Term) -> Option<Term> {
    if graph.is_zero(of.limit) {
        return None;
    }
    let [limit, whole] = [of.limit, of.whole].map(|it| graph.power(it, -1));
    let per_square = graph.power(of.limit, -2);
    let slope = graph.mul(of.slope, per_square);
    let first = graph.product([of.first, limit, whole].map(|it| (it, Rational::ONE)));
    let square = graph.power(of.first, 2);
    let bent = graph.mul(square, whole);
    let second = graph.sub(bent, of.second);
    let second = graph.mul(second, per_square);
    let [slope, first] = [slope, first].map(|part| graph.scale(part, -1));
    Some(Term { limit, slope, first, second, whole })
}

fn logarithm(graph: &mut Graph, of: Term, expr: Expr) -> Option<Term> {
    if graph.is_zero(of.limit) {
        return None;
    }
    let limit = graph.call(Function::Ln, &[of.limit]);
    let [slope, quotient, bent] =
        [of.slope, of.first, of.second].map(|part| graph.div(part, of.limit));
    let first = graph.call(Function::Ln1p, &[quotient]);
    let rest = graph.call(Function::Ln1pRest, &[quotient]);
    let second = graph.sub(bent, rest);
    Some(tidy(graph, Term { limit, slope, first, second, whole: expr }))
}

/// A function of value 1 at 0 whose remainder is `factor` times the square of another function at half the argument.
fn at_crest(graph: &mut Graph, [half, own]: [Function; 2], factor: i32, of: Term) -> Term {
    let middle = graph.scale(of.first, HALF);
    let root = graph.call(half, &[middle]);
    let square = graph.power(root, 2);
    let second = graph.scale(square, factor);
    let (limit, slope) = (graph.number(1), graph.number(0));
    let whole = graph.call(own, &[of.whole]);
    Term { limit, slope, first: second, second, whole }
}

fn one_plus(graph: &mut Graph, x: Expr) -> Expr {
    let one = graph.number(1);
    graph.add(one, x)
}
