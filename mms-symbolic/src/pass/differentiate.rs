//! Symbolic differentiation: one rule per operation.
//!
//! An expression that depends on X through one expression k only, such as a function of a radius, is differentiated by k first:
//! dn/dX = (dn/dk) (dk/dX). So the derivative by k stays in one piece, and is the same in all directions.

use super::factor::factored_sum;
use crate::expr::{Expr, Function, Graph, Node, Rational, Symbol};

/// The partial derivatives of `roots` by `symbol`, all other symbols held fixed.
pub fn differentiate(graph: &mut Graph, roots: &[Expr], symbol: Symbol) -> Vec<Expr> {
    let mut slopes = Slopes::up_to(roots);
    for expr in graph.reachable(roots) {
        if graph.is_exhausted() {
            break;
        }
        let node = graph.node(expr).clone();
        if node == Node::Symbol(symbol) {
            slopes.root = Some(expr);
        } else if let Some(kernel) = slopes.kernel(&node) {
            let slope = slopes.local(graph, expr, &node, kernel);
            slopes.of[expr.index()] = Some((kernel, slope));
        }
    }
    let zero = graph.number(0);
    roots
        .iter()
        .map(|root| match slopes.root {
            Some(leaf) if slopes.moves(*root) => slopes.chain(graph, *root, leaf),
            _ => zero,
        })
        .collect()
}

/// The kernel of every expression that depends on the symbol, and the derivative by the kernel.
///
/// The kernel of an expression is the last expression common to all paths from the symbol to it: its immediate dominator
/// (Lengauer & Tarjan, 1979). Every kernel has a kernel in turn, down to the symbol.
struct Slopes {
    root: Option<Expr>,
    /// The kernel and the derivative, by the position of the expression. Paths to a kernel are long, and each step is a
    /// look-up.
    of: Vec<Option<(Expr, Expr)>>,
}

impl Slopes {
    /// An empty table for all sub-expressions of `roots`.
    fn up_to(roots: &[Expr]) -> Self {
        let last = roots.iter().max().map_or(0, |last| last.index() + 1);
        Slopes { root: None, of: vec![None; last] }
    }

    fn moves(&self, expr: Expr) -> bool {
        self.root == Some(expr) || self.of[expr.index()].is_some()
    }

    /// The kernel of an expression that depends on the symbol, and the derivative by it.
    fn step(&self, expr: Expr) -> (Expr, Expr) {
        self.of[expr.index()].expect("only the symbol has no kernel")
    }

    /// The last common kernel of all operands that depend on the symbol; `None` if none does.
    fn kernel(&self, node: &Node) -> Option<Expr> {
        let moving = node.children().filter(|child| self.moves(*child));
        moving.reduce(|a, b| {
            let (mut a, mut b) = (a, b);
            // A kernel has a smaller handle than its expression.
            while a != b {
                let later = if a > b { &mut a } else { &mut b };
                *later = self.step(*later).0;
            }
            a
        })
    }

    /// The derivative of `expr` by one of its kernels: the product of the slopes between.
    fn chain(&self, graph: &mut Graph, expr: Expr, kernel: Expr) -> Expr {
        let mut slopes = Vec::new();
        let mut expr = expr;
        while expr != kernel {
            let (next, slope) = self.step(expr);
            slopes.push((slope, Rational::ONE));
            expr = next;
        }
        graph.product(slopes)
    }

    /// The derivative of a node by its kernel.
    fn local(&self, graph: &mut Graph, expr: Expr, node: &Node, kernel: Expr) -> Expr {
        let mut terms = Vec::new();
        match node {
            Node::Number(_) | Node::Pi | Node::Symbol(_) => {}
            Node::Sum(_, addends) => {
                for (term, coefficient) in addends.iter().filter(|(term, _)| self.moves(*term)) {
                    terms.push((self.chain(graph, *term, kernel), coefficient.clone()));
                }
            }
            // d(prod b^e) = sum e b^(e-1) db (the other factors).
            Node::Product(factors) => {
                for (index, (base, exponent)) in factors.iter().enumerate() {
                    // Results of a full graph are meaningless, and each term takes as long as the product.
                    if self.moves(*base) && !graph.is_exhausted() {
                        let mut term = factors.clone();
                        term[index].1 -= Rational::ONE;
                        term.push((self.chain(graph, *base, kernel), Rational::ONE));
                        terms.push((graph.product(term), exponent.clone()));
                    }
                }
            }
            Node::Offset(operands) => {
                for (operand, sign) in operands.iter().zip([1, -1]) {
                    if self.moves(*operand) {
                        let slope = self.chain(graph, *operand, kernel);
                        terms.push((graph.scale(slope, sign), Rational::ONE));
                    }
                }
            }
            Node::Small(_, angle) => terms.push((self.chain(graph, *angle, kernel), Rational::ONE)),
            // d f(a, ..) = sum (df/da) da.
            Node::Call(function, arguments) => {
                for (index, argument) in arguments.iter().enumerate() {
                    if self.moves(*argument) {
                        let outer = partial(graph, expr, *function, arguments, index);
                        let inner = self.chain(graph, *argument, kernel);
                        terms.push((graph.mul(outer, inner), Rational::ONE));
                    }
                }
            }
        }
        factored_sum(graph, terms)
    }
}

/// The partial derivative of `value = function(arguments)` by the argument at this index.
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
        Function::ExpM1 => graph.call(Function::Exp, &[x]),
        Function::Ln => graph.power(x, -1),
        Function::Ln1p => {
            let shifted = shifted(graph, x, 1);
            graph.power(shifted, -1)
        }
        Function::Ln1pRest => {
            let shifted = shifted(graph, x, 1);
            graph.div(x, shifted)
        }
        Function::SinPi => {
            let cosine = graph.call(Function::CosPi, &[x]);
            times_pi(graph, cosine, 1)
        }
        Function::CosPi => {
            let sine = graph.call(Function::SinPi, &[x]);
            times_pi(graph, sine, -1)
        }
        Function::Sin => graph.call(Function::Cos, &[x]),
        Function::Cos => {
            let sin = graph.call(Function::Sin, &[x]);
            graph.scale(sin, -1)
        }
        Function::WithinTurns | Function::WithinTurnsPi => graph.number(1),
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
            // The derivative of atan2(y, x) is x/(x^2 + y^2) by y, and -y/(x^2 + y^2) by x.
            let (y, x) = (arguments[0], arguments[1]);
            let squares = [graph.power(x, 2), graph.power(y, 2)];
            let radius = graph.add(squares[0], squares[1]);
            let (numerator, sign) = if index == 0 { (x, 1) } else { (y, -1) };
            let quotient = graph.div(numerator, radius);
            graph.scale(quotient, sign)
        }
        Function::Powf => {
            // The derivative of b^e is e b^e / b by b, and b^e ln b by e.
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

fn times_pi(graph: &mut Graph, x: Expr, sign: i32) -> Expr {
    let pi = graph.pi();
    let product = graph.mul(pi, x);
    graph.scale(product, sign)
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
