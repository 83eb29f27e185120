//! Symbolic differentiation: one rule per operation.

use std::collections::BTreeMap;

use crate::expr::{Expr, Function, Graph, Node, Rational, Symbol};

/// The partial derivatives of `roots` by `symbol`, all other symbols held fixed.
pub fn differentiate(graph: &mut Graph, roots: &[Expr], symbol: Symbol) -> Vec<Expr> {
    let zero = graph.number(0);
    let mut derivatives = BTreeMap::<Expr, Expr>::new();
    for expr in graph.reachable(roots) {
        let node = graph.node(expr).clone();
        let moves = node.children().any(|child| derivatives[&child] != zero);
        let derivative = match node {
            Node::Symbol(leaf) if leaf == symbol => graph.number(1),
            _ if !moves => zero,
            Node::Number(_) | Node::Pi | Node::Symbol(_) => zero,
            Node::Sum(_, terms) => {
                graph.sum(terms.into_iter().map(|(term, factor)| (derivatives[&term], factor)))
            }
            Node::Product(factors) => product_rule(graph, &factors, &derivatives),
            Node::Call(function, arguments) => {
                chain_rule(graph, expr, function, &arguments, &derivatives)
            }
        };
        derivatives.insert(expr, derivative);
    }
    roots.iter().map(|root| derivatives[root]).collect()
}

/// d(prod b^e) = sum e b^(e-1) db (the other factors).
fn product_rule(
    graph: &mut Graph,
    factors: &[(Expr, Rational)],
    derivatives: &BTreeMap<Expr, Expr>,
) -> Expr {
    let mut terms = Vec::new();
    for (index, (base, exponent)) in factors.iter().enumerate() {
        if graph.is_zero(derivatives[base]) {
            continue;
        }
        let mut term = factors.to_vec();
        term[index].1 -= Rational::ONE;
        term.push((derivatives[base], Rational::ONE));
        terms.push((graph.product(term), exponent.clone()));
    }
    graph.sum(terms)
}

/// d f(a, ..) = sum (df/da) da.
fn chain_rule(
    graph: &mut Graph,
    value: Expr,
    function: Function,
    arguments: &[Expr],
    derivatives: &BTreeMap<Expr, Expr>,
) -> Expr {
    let mut terms = Vec::new();
    for (index, argument) in arguments.iter().enumerate() {
        let inner = derivatives[argument];
        if !graph.is_zero(inner) {
            let outer = partial(graph, value, function, arguments, index);
            terms.push((graph.mul(outer, inner), Rational::ONE));
        }
    }
    graph.sum(terms)
}

/// The partial derivative of `value = function(arguments)` by the argument of that index.
fn partial(
    graph: &mut Graph,
    value: Expr,
    function: Function,
    arguments: &[Expr],
    index: usize,
) -> Expr {
    let x = arguments[0];
    match function {
        Function::Sqrt => reciprocal_of_scaled(graph, value, 2),
        Function::Cbrt => {
            let square = graph.power(value, 2);
            reciprocal_of_scaled(graph, square, 3)
        }
        Function::Exp => value,
        Function::Ln => graph.power(x, -1),
        Function::Ln1p => {
            let shifted = shifted(graph, x, 1);
            graph.power(shifted, -1)
        }
        Function::Sin => graph.call(Function::Cos, &[x]),
        Function::Cos => {
            let sin = graph.call(Function::Sin, &[x]);
            graph.scale(sin, -1)
        }
        // 1 + tan^2 and 1 - tanh^2 reuse the value itself.
        Function::Tan => one_plus_square(graph, value, 1),
        Function::Sinh => graph.call(Function::Cosh, &[x]),
        Function::Cosh => graph.call(Function::Sinh, &[x]),
        Function::Tanh => one_plus_square(graph, value, -1),
        Function::Asin => reciprocal_root(graph, x),
        Function::Acos => {
            let root = reciprocal_root(graph, x);
            graph.scale(root, -1)
        }
        Function::Atan => {
            let denominator = one_plus_square(graph, x, 1);
            graph.power(denominator, -1)
        }
        Function::Atan2 => {
            // atan2(y, x): by y it is x/(x^2 + y^2), by x it is -y/(x^2 + y^2).
            let (y, x) = (arguments[0], arguments[1]);
            let squares = [graph.power(x, 2), graph.power(y, 2)];
            let radius = graph.add(squares[0], squares[1]);
            let (numerator, sign) = if index == 0 { (x, 1) } else { (y, -1) };
            let quotient = graph.div(numerator, radius);
            graph.scale(quotient, sign)
        }
        Function::Powf => {
            // b^e: by b it is e b^e / b, by e it is b^e ln b.
            let (base, exponent) = (arguments[0], arguments[1]);
            if index == 0 {
                let slope = graph.div(value, base);
                graph.mul(exponent, slope)
            } else {
                let logarithm = graph.call(Function::Ln, &[base]);
                graph.mul(value, logarithm)
            }
        }
    }
}

fn shifted(graph: &mut Graph, x: Expr, constant: i32) -> Expr {
    let constant = graph.number(constant);
    graph.add(constant, x)
}

fn one_plus_square(graph: &mut Graph, x: Expr, sign: i32) -> Expr {
    let square = graph.power(x, 2);
    let square = graph.scale(square, sign);
    shifted(graph, square, 1)
}

fn reciprocal_of_scaled(graph: &mut Graph, x: Expr, factor: i32) -> Expr {
    let scaled = graph.scale(x, factor);
    graph.power(scaled, -1)
}

/// (1 - x^2)^(-1/2).
fn reciprocal_root(graph: &mut Graph, x: Expr) -> Expr {
    let radicand = one_plus_square(graph, x, -1);
    graph.power(radicand, Rational::from_parts((-1).into(), 2u8.into()))
}
