//! W about F = I, with a remainder that is exact: terms that cancel at small strains do so in exact numbers, and the remainder
//! is as small as W itself.
//!
//! With A = C - I, i1 = tr A, q the sum of the principal minors of A of two rows, and j = J - 1,
//!
//! ```text
//! i1 = 2 j + k      i2 = 4 j + 2 k + q
//! ```
//!
//! where k and q are of second order in the strain. k is computed from H as |H|^2 - 2 q(H) - 2 det H, or, if a rotation has to
//! cancel, from A as (i1 j - 2 (q + det A))/(2 + j): both are exact at small strains and at large changes of volume. Each part
//! of W is a value at F = I, slopes by j and i4, and a rest of second order; sums, products, powers and logarithms keep that
//! form. Since W and P vanish at F = I, the values and the slopes of all W add up to 0.

use crate::invariant::{EXCESS, FIBRE, FIRST, MINORS, SECOND, VOLUME};
use mms_symbolic::expr::{Expr, Function, Graph, Node, Rational, Symbol};
use mms_symbolic::pass::expand::expand;
use mms_symbolic::pass::factor::factor;
use mms_symbolic::sorted::SortedMap;

/// The limit of powers, and of the order of roots, that are expanded.
const MAX_POWER: i32 = 12;

/// value + departure, and departure = slopes (j, i4) + rest.
#[derive(Clone, Copy, Debug)]
struct Part {
    value: Expr,
    slopes: [Expr; 2],
    rest: Expr,
    departure: Expr,
}

/// W in a form of second order in the strain; unchanged if it has functions that are not expanded.
pub(super) fn of_second_order(graph: &mut Graph, energy: Expr) -> Expr {
    let Some(part) = parts(graph, energy) else { return energy };
    let known: Vec<Symbol> = graph.symbols(energy).into_iter().collect();
    let first = [part.value, part.slopes[0], part.slopes[1]];
    let first = expand(graph, &first, &known);
    let (volume, fibre) = (graph.symbol(VOLUME), graph.symbol(FIBRE));
    let linear = [graph.mul(first[1], volume), graph.mul(first[2], fibre)];
    let terms = [first[0], linear[0], linear[1], part.rest];
    let total = graph.sum(terms.map(|term| (term, Rational::ONE)));
    factor(graph, &[total])[0]
}

fn parts(graph: &mut Graph, energy: Expr) -> Option<Part> {
    let mut parts = SortedMap::<Expr, Part>::new();
    for expr in graph.reachable(&[energy]) {
        let part = match graph.node(expr).clone() {
            // Expressions of coordinates alone, on which moduli may depend.
            Node::Number(_) | Node::Pi | Node::Offset(_) | Node::Small(..) => constant(graph, expr),
            Node::Symbol(symbol) => leaf(graph, expr, symbol),
            Node::Sum(constant, terms) => sum(graph, constant, &terms, &parts),
            Node::Product(factors) => {
                let one = graph.number(1);
                let mut product = constant(graph, one);
                for (base, exponent) in factors {
                    let factor = power(graph, base, &parts[&base], &exponent)?;
                    product = times(graph, &product, &factor);
                }
                product
            }
            Node::Call(function, arguments) => {
                let arguments: Vec<Part> = arguments.iter().map(|it| parts[it]).collect();
                call(graph, expr, function, &arguments)?
            }
        };
        parts.insert(expr, part);
    }
    parts.remove(&energy)
}

fn constant(graph: &mut Graph, value: Expr) -> Part {
    let zero = graph.number(0);
    Part { value, slopes: [zero; 2], rest: zero, departure: zero }
}

fn leaf(graph: &mut Graph, expr: Expr, symbol: Symbol) -> Part {
    let mut number = |value: i32| graph.number(value);
    let (zero, one, two, four) = (number(0), number(1), number(2), number(4));
    let (excess, minors) = (graph.symbol(EXCESS), graph.symbol(MINORS));
    let (slopes, rest) = match symbol {
        FIRST => ([two, zero], excess),
        SECOND => ([four, zero], graph.sum([(excess, Rational::from(2)), (minors, Rational::ONE)])),
        VOLUME => ([one, zero], zero),
        FIBRE => ([zero, one], zero),
        _ => return constant(graph, expr),
    };
    Part { value: zero, slopes, rest, departure: expr }
}

fn sum(
    graph: &mut Graph,
    constant: Rational,
    terms: &[(Expr, Rational)],
    parts: &SortedMap<Expr, Part>,
) -> Part {
    let mut total = |of: &dyn Fn(&Part) -> Expr| {
        graph.sum(terms.iter().map(|(term, coefficient)| (of(&parts[term]), coefficient.clone())))
    };
    let value = total(&|part| part.value);
    let slopes = [0, 1].map(|k| total(&|part: &Part| part.slopes[k]));
    let (rest, departure) = (total(&|part| part.rest), total(&|part| part.departure));
    let constant = graph.number(constant);
    let value = graph.add(constant, value);
    whole(graph, Part { value, slopes, rest, departure })
}

/// Expands the slopes; if they vanish, the departure is the rest, without cancellation.
fn whole(graph: &mut Graph, part: Part) -> Part {
    let known: Vec<Symbol> = part.slopes.iter().flat_map(|slope| graph.symbols(*slope)).collect();
    let slopes = expand(graph, &part.slopes, &known);
    let slopes = [slopes[0], slopes[1]];
    let is_flat = slopes.iter().all(|slope| graph.is_zero(*slope));
    Part { slopes, departure: if is_flat { part.rest } else { part.departure }, ..part }
}

/// a b = a0 b0 + (a0 b' + a' b0) + a' b', where a' and b' are the departures.
fn times(graph: &mut Graph, a: &Part, b: &Part) -> Part {
    let mut mixed = |x: Expr, y: Expr, more: Option<Expr>| {
        let (left, right) = (graph.mul(a.value, y), graph.mul(b.value, x));
        let both = graph.add(left, right);
        match more {
            Some(more) => graph.add(both, more),
            None => both,
        }
    };
    let slopes = [0, 1].map(|k| mixed(a.slopes[k], b.slopes[k], None));
    let crossed = graph.mul(a.departure, b.departure);
    let mut mixed = |x: Expr, y: Expr| {
        let (left, right) = (graph.mul(a.value, y), graph.mul(b.value, x));
        graph.sum([left, right, crossed].map(|term| (term, Rational::ONE)))
    };
    let rest = mixed(a.rest, b.rest);
    let departure = mixed(a.departure, b.departure);
    let value = graph.mul(a.value, b.value);
    whole(graph, Part { value, slopes, rest, departure })
}

/// A power of an expression: with its value v and c = 1 + departure/v, it is v to that power times c to that power.
fn power(graph: &mut Graph, base: Expr, part: &Part, exponent: &Rational) -> Option<Part> {
    if graph.is_zero(part.departure) {
        let value = graph.power(base, exponent.clone());
        return Some(constant(graph, value));
    }
    let numerator = i32::try_from(exponent.numerator().clone()).ok()?;
    let order = i32::try_from(exponent.denominator().clone()).ok()?;
    if numerator.abs() > MAX_POWER || order > MAX_POWER {
        return None;
    }
    if order == 1 && numerator > 0 {
        return Some(repeated(graph, part, numerator));
    }
    if graph.is_zero(part.value) {
        return None;
    }
    let scaled = relative(graph, part);
    let root = root(graph, &scaled, order);
    let root = if numerator < 0 { reciprocal(graph, &root) } else { root };
    let power = repeated(graph, &root, numerator.abs());
    let value = graph.power(part.value, exponent.clone());
    let value = constant(graph, value);
    Some(times(graph, &value, &power))
}

fn repeated(graph: &mut Graph, part: &Part, count: i32) -> Part {
    (1..count).fold(*part, |product, _| times(graph, &product, part))
}

/// A part divided by its value.
fn relative(graph: &mut Graph, part: &Part) -> Part {
    let mut over = |expr: Expr| graph.div(expr, part.value);
    let (slopes, rest, departure) =
        (part.slopes.map(&mut over), over(part.rest), over(part.departure));
    Part { value: graph.number(1), slopes, rest, departure }
}

/// The root c of 1 + a: with e = c - 1 = a/(1 + c + ... + c^(n-1)) it is
/// c = 1 + a/n - (sum of binomial(n, m) e^m for m > 1)/n.
fn root(graph: &mut Graph, part: &Part, order: i32) -> Part {
    if order == 1 {
        return *part;
    }
    let whole = graph.add(part.value, part.departure);
    let inverse = Rational::from_parts(1.into(), order.unsigned_abs().into());
    let root = graph.power(whole, inverse.clone());
    let powers: Vec<_> = (0..order).map(|m| (graph.power(root, m), Rational::ONE)).collect();
    let divisor = graph.sum(powers);
    let departure = graph.div(part.departure, divisor);
    let mut rest = vec![(part.rest, inverse.clone())];
    let mut binomial = Rational::from(order);
    for m in 2..=order {
        binomial = binomial * Rational::from(order - m + 1) / Rational::from(m);
        rest.push((graph.power(departure, m), -(binomial.clone() * &inverse)));
    }
    let rest = graph.sum(rest);
    let slopes = part.slopes.map(|slope| graph.scale(slope, inverse.clone()));
    Part { value: part.value, slopes, rest, departure }
}

/// 1/(1 + e) = 1 - e + e^2/(1 + e).
fn reciprocal(graph: &mut Graph, part: &Part) -> Part {
    let whole = graph.add(part.value, part.departure);
    let quotient = graph.div(part.departure, whole);
    let departure = graph.scale(quotient, -1);
    let square = graph.mul(part.departure, quotient);
    let rest = graph.sub(square, part.rest);
    let slopes = part.slopes.map(|slope| graph.scale(slope, -1));
    Part { value: part.value, slopes, rest, departure }
}

/// ln(v (1 + a)) = ln v + a - (a - ln(1 + a)); other functions only if they are constant, or an exponential of second order.
fn call(graph: &mut Graph, expr: Expr, function: Function, arguments: &[Part]) -> Option<Part> {
    if arguments.iter().all(|argument| graph.is_zero(argument.departure)) {
        return Some(constant(graph, expr));
    }
    let [mut argument] = *arguments else { return None };
    match function {
        Function::Ln | Function::Ln1p => {
            if function == Function::Ln1p {
                let one = graph.number(1);
                argument.value = graph.add(one, argument.value);
            }
            if graph.is_zero(argument.value) {
                return None;
            }
            let scaled = relative(graph, &argument);
            let departure = graph.call(Function::Ln1p, &[scaled.departure]);
            let beyond = graph.call(Function::Ln1pRest, &[scaled.departure]);
            let rest = graph.sub(scaled.rest, beyond);
            let value = graph.call(Function::Ln, &[argument.value]);
            Some(Part { value, slopes: scaled.slopes, rest, departure })
        }
        Function::Exp if argument.slopes.iter().all(|slope| graph.is_zero(*slope)) => {
            let value = graph.call(Function::Exp, &[argument.value]);
            let small = graph.call(Function::ExpM1, &[argument.rest]);
            let rest = graph.mul(value, small);
            Some(Part { value, slopes: argument.slopes, rest, departure: rest })
        }
        _ => None,
    }
}
