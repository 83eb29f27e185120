//! The difference f - f0 of an expression f and its value f0 where a symbol is 0, written such that nothing cancels. For the
//! symbol q, sin(c + q) - sin c becomes 2 cos(c + q/2) sin(q/2).
//!
//! The calculus of finite differences is exact at any size of the difference. Each operation has a rule, in terms of the
//! differences f - f0 of its operands:
//!
//! ```text
//! f g       (f - f0) g + f0 (g - g0)               exp     exp f0 exp_m1(f - f0)
//! f^(2 n)   (f^n - f0^n) (f^n + f0^n)              ln      ln_1p((f - f0)/f0)
//! 1/f^n     -(f^n - f0^n)/(f^n f0^n)               sin     2 cos((f + f0)/2) sin((f - f0)/2)
//! f^(1/n)   (f - f0)/(sum of f^(i/n) f0^(1-1/n-i/n))   cos, sinh, cosh likewise
//! f^g       f0^g0 exp_m1(g ln f - g0 ln f0)        tan     sin(f - f0)/(cos f cos f0)
//! atan      atan2(f - f0, 1 + f f0)                tanh    tanh(f - f0) (1 - tanh f tanh f0)
//! ```
//!
//! asin f - asin f0 is the angle whose sine is f c0 - f0 c and whose cosine is c c0 + f f0, with c^2 = 1 - f^2; acos is pi/2
//! less asin. (Boole, A Treatise on the Calculus of Finite Differences, 1860, has the rules of products and functions.)

use crate::expr::{Expr, Function, Graph, HALF, Node, Rational, Stage, Symbol};
use crate::sorted::SortedMap;

/// The largest order of a root that is split.
const MAX_ROOT: u32 = 12;
/// The greatest exponent of a power that is split.
const MAX_POWER: u32 = 64;

/// An expression as the sum of its limit, its value where a symbol is 0, and of the rest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Parts {
    /// The value where the symbol is 0.
    pub limit: Expr,
    /// The rest, which vanishes with the symbol.
    pub rest: Expr,
}

/// Splits each root; `None` for a root that has no value where `symbol` is 0.
pub fn difference(graph: &mut Graph, roots: &[Expr], symbol: Symbol) -> Vec<Option<Parts>> {
    let mut split = Split { symbol, known: SortedMap::new() };
    for expr in graph.reachable(roots) {
        let term = split.term(graph, expr);
        split.known.insert(expr, term);
    }
    let parts =
        |root: &Expr| split.known[root].map(|term| Parts { limit: term.limit, rest: term.rest });
    roots.iter().map(parts).collect()
}

/// The parts of an expression, and their sum.
#[derive(Clone, Copy)]
struct Term {
    limit: Expr,
    rest: Expr,
    /// The rest if the limit is 0, else the expression as written.
    whole: Expr,
}

impl Term {
    fn of(graph: &Graph, whole: Expr, limit: Expr, rest: Expr) -> Term {
        Term { limit, rest, whole: if graph.is_zero(limit) { rest } else { whole } }
    }

    /// The parts of an expression that does not depend on the symbol.
    fn fixed(graph: &mut Graph, whole: Expr) -> Term {
        Term { limit: whole, rest: graph.number(0), whole }
    }

    fn vanishes(&self, graph: &Graph) -> bool {
        graph.is_zero(self.limit)
    }
}

struct Split {
    symbol: Symbol,
    known: SortedMap<Expr, Option<Term>>,
}

impl Split {
    fn term(&self, graph: &mut Graph, expr: Expr) -> Option<Term> {
        let node = graph.node(expr).clone();
        if node == Node::Symbol(self.symbol) {
            let limit = graph.number(0);
            return Some(Term { limit, rest: expr, whole: expr });
        }
        let mut moves = false;
        for child in node.children() {
            moves |= !graph.is_zero(self.known[&child]?.rest);
        }
        if !moves {
            return Some(Term::fixed(graph, expr));
        }
        match node {
            Node::Number(_) | Node::Pi | Node::Symbol(_) => None,
            Node::Sum(constant, terms) => {
                let mut parts = [vec![(graph.number(1), constant)], Vec::new()];
                for (term, coefficient) in terms {
                    let term = self.known[&term]?;
                    parts[0].push((term.limit, coefficient.clone()));
                    parts[1].push((term.rest, coefficient));
                }
                let [limit, rest] = parts.map(|terms| graph.sum(terms));
                Some(Term::of(graph, expr, limit, rest))
            }
            Node::Product(factors) => {
                let mut terms = Vec::new();
                for (base, exponent) in factors {
                    terms.push(power(graph, self.known[&base]?, exponent)?);
                }
                Some(product(graph, expr, &terms))
            }
            Node::Offset(operands) => {
                let [coordinate, place] = operands.map(|operand| self.known[&operand]);
                let limit = graph.offset(coordinate?.limit, place?.limit);
                Some(Term { limit, rest: graph.sub(expr, limit), whole: expr })
            }
            // The node is only made after all differences.
            Node::Small(..) => None,
            Node::Call(function, arguments) => {
                let arguments: Option<Vec<Term>> =
                    arguments.iter().map(|argument| self.known[argument]).collect();
                call(graph, expr, function, &arguments?)
            }
        }
    }
}

/// f g - f0 g0 = (f - f0) g + f0 (g - g0). A vanishing factor makes the product vanish.
fn product(graph: &mut Graph, whole: Expr, factors: &[Term]) -> Term {
    let multiply = |graph: &mut Graph, factors: &[Expr]| {
        graph.product(factors.iter().map(|factor| (*factor, Rational::ONE)))
    };
    let limits: Vec<Expr> = factors.iter().map(|factor| factor.limit).collect();
    let wholes: Vec<Expr> = factors.iter().map(|factor| factor.whole).collect();
    if factors.iter().any(|factor| factor.vanishes(graph)) {
        let rest = multiply(graph, &wholes);
        let limit = graph.number(0);
        return Term { limit, rest, whole: rest };
    }
    let mut terms = Vec::new();
    for (index, factor) in factors.iter().enumerate() {
        let mut term = limits[..index].to_vec();
        term.push(factor.rest);
        term.extend(&wholes[index + 1..]);
        terms.push((multiply(graph, &term), Rational::ONE));
    }
    let (limit, rest) = (multiply(graph, &limits), graph.sum(terms));
    Term::of(graph, whole, limit, rest)
}

/// A power, by the root of its denominator.
fn power(graph: &mut Graph, base: Term, exponent: Rational) -> Option<Term> {
    if exponent.is_one() {
        return Some(base);
    }
    let whole = graph.power(base.whole, exponent.clone());
    if graph.is_zero(base.rest) {
        return Some(Term::fixed(graph, whole));
    }
    let is_negative = exponent < Rational::ZERO;
    if base.vanishes(graph) {
        let limit = graph.number(0);
        let term = Term { limit, rest: whole, whole };
        return (!is_negative).then_some(term);
    }
    let limit = graph.power(base.limit, exponent.clone());
    let magnitude = if is_negative { -exponent.clone() } else { exponent.clone() };
    let degree = u32::try_from(exponent.denominator()).ok().filter(|it| *it <= MAX_ROOT);
    let count = u32::try_from(magnitude.numerator()).ok().filter(|it| *it <= MAX_POWER);
    let (Some(degree), Some(count)) = (degree, count) else {
        let rest = long_power(graph, base, exponent, whole);
        return Some(Term { limit, rest, whole });
    };
    let root = Rational::from_parts(1.into(), degree.into());
    let [of, at] = [base.whole, base.limit].map(|base| graph.power(base, root.clone()));
    let sum = powers(graph, [of, at], degree);
    let of_root = graph.div(base.rest, sum);
    let sum = powers(graph, [of, at], count);
    let mut rest = graph.mul(of_root, sum);
    if is_negative {
        let inverse = [base.whole, base.limit].map(|base| (base, exponent.clone()));
        let inverse = graph.product(inverse);
        rest = graph.mul(rest, inverse);
        rest = graph.scale(rest, -1);
    }
    Some(Term { limit, rest, whole })
}

/// f^r - f0^r for an exponent of many digits: f0^r exp_m1(r ln(f/f0)), if f0 cannot be 0 at single X.
fn long_power(graph: &mut Graph, base: Term, exponent: Rational, whole: Expr) -> Expr {
    let limit = graph.power(base.limit, exponent.clone());
    if exponent.is_int() || graph.stage(base.limit) != Stage::Parameter {
        return graph.sub(whole, limit);
    }
    let logarithm = log_of_quotient(graph, base.rest, base.limit);
    let exponent = graph.scale(logarithm, exponent);
    let factor = graph.call(Function::ExpM1, &[exponent]);
    graph.mul(limit, factor)
}

/// (a^n - b^n)/(a - b), the sum of a^i b^(n - 1 - i).
fn powers(graph: &mut Graph, [a, b]: [Expr; 2], count: u32) -> Expr {
    if count == 1 {
        return graph.number(1);
    }
    let half = count / 2;
    let of_half = powers(graph, [a, b], half);
    let [first, second] = [a, b].map(|it| graph.power(it, half));
    let sum = graph.add(first, second);
    let even = graph.mul(of_half, sum);
    if count.is_multiple_of(2) {
        return even;
    }
    // a^(2 n + 1) - b^(2 n + 1) = (a^(2 n) - b^(2 n)) a + b^(2 n) (a - b).
    let more = graph.mul(even, a);
    let last = graph.power(b, 2 * half);
    graph.add(more, last)
}

/// A function of operands that depend on the symbol.
fn call(graph: &mut Graph, whole: Expr, function: Function, arguments: &[Term]) -> Option<Term> {
    let limits: Vec<Expr> = arguments.iter().map(|argument| argument.limit).collect();
    let wholes: Vec<Expr> = arguments.iter().map(|argument| argument.whole).collect();
    let limit = graph.call(function, &limits);
    let Term { limit: at, rest, whole: of } = arguments[0];
    // Only if the argument also vanishes: for ln at 1, the argument 1 + rest has already lost digits of the rest.
    if graph.is_zero(at) && graph.is_zero(limit) {
        let rest = graph.call(function, &wholes);
        return Some(Term { limit, rest, whole: rest });
    }
    // F((f + f0)/2) G((f - f0)/2).
    let halves = |graph: &mut Graph, [of_sum, of_rest]: [Function; 2], factor: i32| {
        let sum = graph.add(of, at);
        let [sum, rest] = [sum, rest].map(|it| graph.scale(it, HALF));
        let [sum, rest] = [(of_sum, sum), (of_rest, rest)].map(|(f, x)| graph.call(f, &[x]));
        let product = graph.mul(sum, rest);
        graph.scale(product, factor)
    };
    let rest = match function {
        Function::Sin => halves(graph, [Function::Cos, Function::Sin], 2),
        Function::Cos => halves(graph, [Function::Sin, Function::Sin], -2),
        Function::Sinh => halves(graph, [Function::Cosh, Function::Sinh], 2),
        Function::Cosh => halves(graph, [Function::Sinh, Function::Sinh], 2),
        Function::Tan => {
            let sine = graph.call(Function::Sin, &[rest]);
            let cosines = [of, at].map(|angle| graph.call(Function::Cos, &[angle]));
            let divisor = graph.mul(cosines[0], cosines[1]);
            graph.div(sine, divisor)
        }
        // The quotient with cosh f cosh f0 would overflow.
        Function::Tanh => {
            let of = graph.call(Function::Tanh, &[of]);
            let product = graph.mul(of, limit);
            let factor = one_plus(graph, product, -1);
            let difference = graph.call(Function::Tanh, &[rest]);
            graph.mul(difference, factor)
        }
        Function::Exp | Function::ExpM1 => {
            let limit = graph.call(Function::Exp, &[at]);
            let factor = graph.call(Function::ExpM1, &[rest]);
            graph.mul(limit, factor)
        }
        Function::Ln => log_of_quotient(graph, rest, at),
        Function::Ln1p => {
            let at = one_plus(graph, at, 1);
            log_of_quotient(graph, rest, at)
        }
        Function::Cbrt => {
            let [of, at] = [of, at].map(|it| graph.call(Function::Cbrt, &[it]));
            let sum = powers(graph, [of, at], 3);
            graph.div(rest, sum)
        }
        Function::Atan => {
            let product = graph.mul(of, at);
            let along = one_plus(graph, product, 1);
            graph.call(Function::Atan2, &[rest, along])
        }
        Function::Asin => arc(graph, arguments[0]),
        Function::Acos => {
            let arc = arc(graph, arguments[0]);
            graph.scale(arc, -1)
        }
        Function::Powf => {
            let [base, exponent] = [arguments[0], arguments[1]];
            let logarithm = graph.call(Function::Ln, &[base.whole]);
            let first = graph.mul(exponent.rest, logarithm);
            let slope = log_of_quotient(graph, base.rest, base.limit);
            let second = graph.mul(exponent.limit, slope);
            let exponent = graph.add(first, second);
            let factor = graph.call(Function::ExpM1, &[exponent]);
            graph.mul(limit, factor)
        }
        // Two angles of a point may differ by a turn. The other functions occur in no field; for a new function a plain
        // difference is right, with the digits that remain.
        _ => graph.sub(whole, limit),
    };
    Some(Term { limit, rest, whole })
}

/// ln f - ln f0 = ln_1p((f - f0)/f0).
fn log_of_quotient(graph: &mut Graph, rest: Expr, at: Expr) -> Expr {
    let quotient = graph.div(rest, at);
    graph.call(Function::Ln1p, &[quotient])
}

/// asin f - asin f0. Its sine f c0 - f0 c is (f - f0) (c0 + f0 (f + f0)/(c + c0)).
fn arc(graph: &mut Graph, Term { limit: at, rest, whole: of }: Term) -> Expr {
    if graph.is_zero(at) {
        return graph.call(Function::Asin, &[rest]);
    }
    let [cosine, cosine_at] = [of, at].map(|sine| {
        let square = graph.power(sine, 2);
        let square = one_plus(graph, square, -1);
        graph.power(square, HALF)
    });
    let [sum, cosines] = [(of, at), (cosine, cosine_at)].map(|(a, b)| graph.add(a, b));
    let product = graph.mul(at, sum);
    let slope = graph.div(product, cosines);
    let factor = graph.add(cosine_at, slope);
    let across = graph.mul(rest, factor);
    let along = [(cosine, cosine_at), (of, at)].map(|(a, b)| (graph.mul(a, b), Rational::ONE));
    let along = graph.sum(along);
    graph.call(Function::Atan2, &[across, along])
}

/// 1 + `sign` x.
fn one_plus(graph: &mut Graph, x: Expr, sign: i32) -> Expr {
    let one = graph.number(1);
    graph.sum([(one, Rational::ONE), (x, Rational::from(sign))])
}
