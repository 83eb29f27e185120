//! The limits within which the functions of the language are analytic, or have a value.
//!
//! Sums, products, whole powers, exp, sinh, cosh, tanh, sin, cos and atan are analytic everywhere. The others have limits, each
//! of which `branches` proves as a sign; `tests/branches.rs` has a test for each:
//!
//! | | is analytic | has a value | proved by |
//! |---|---|---|---|
//! | 1/x, x^-n | x is not 0 | x is not 0 | all quantities are finite; where it cancels, the sign of x |
//! | sqrt(x), x^(p/q) | x > 0 | x >= 0, for a positive power | x > 0 |
//! | hypot(x, y) | not both are 0 | everywhere | x^2 + y^2 > 0; on an annulus it is the radius |
//! | x^y | x > 0 | x > 0 | x has the form of a positive expression, or the file is refused when it is read; then x > 0 |
//! | cbrt(x) | x is not 0 | everywhere | the sign of x |
//! | ln(x), in W ln(J) | x > 0 | x > 0 | x > 0; J > 0 is proved already |
//! | tan(x) | cos(x) is not 0 | cos(x) is not 0 | the sign of cos(x) |
//! | asin(x), acos(x) | -1 < x < 1 | -1 <= x <= 1 | 1 + x > 0, 1 - x > 0 |
//! | atan2(y, x) | y is not 0, or x > 0 | everywhere | the sign of y, or x > 0 |
//!
//! An angle `atan2(y, x)` may pass its cut if only sines and cosines of whole multiples of it, and tangents of halves of these,
//! read it: one more turn changes none of them. Such an angle only needs that y and x are not both 0.

use mms_symbolic::expr::{Expr, Function, Graph, Node, Rational, is_negative};
use mms_symbolic::sorted::{SortedMap, SortedSet};

/// A condition on operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Must {
    /// x > 0.
    BePositive,
    /// x >= 0.
    NotBeNegative,
    /// x is not 0.
    NotVanish,
    /// For (y, x): y is not 0, or x > 0.
    KeepOffCut,
    /// For (y, x): they are not both 0.
    KeepOffOrigin,
}

impl Must {
    /// Whether a value jumps where the condition fails, so that no derivative shows the failure.
    pub fn is_blind(self) -> bool {
        matches!(self, Must::KeepOffCut | Must::KeepOffOrigin)
    }
}

/// A limit of the domain of an operation: the conditions under which it is analytic, and under which it has a value.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Limit {
    /// The condition for being analytic.
    pub analytic: Must,
    /// The condition for having a value; `None` if the operation always has one.
    pub defined: Option<Must>,
    /// The operands that the conditions are about.
    pub operands: Vec<Expr>,
    /// Whether the limit is a pole of a quotient, which has no value either.
    pub is_pole: bool,
}

impl Limit {
    fn new(analytic: Must, defined: impl Into<Option<Must>>, operands: Vec<Expr>) -> Self {
        Limit { analytic, defined: defined.into(), operands, is_pole: false }
    }
}

/// The limits of one operation itself; its operands have their own.
pub fn limits_of(graph: &mut Graph, expr: Expr) -> Vec<Limit> {
    match graph.node(expr).clone() {
        // A number times one other expression.
        Node::Sum(constant, terms) if constant.is_zero() && terms.len() == 1 => {
            match graph.node(terms[0].0) {
                Node::Sum(..) => Vec::new(),
                _ => limits_of(graph, terms[0].0),
            }
        }
        Node::Product(factors) => {
            factors.iter().filter_map(|(base, exponent)| of_power(graph, *base, exponent)).collect()
        }
        Node::Call(function, arguments) => of_call(graph, function, arguments),
        Node::Sum(..)
        | Node::Number(_)
        | Node::Pi
        | Node::Symbol(_)
        | Node::Offset(_)
        | Node::Small(..) => Vec::new(),
    }
}

fn of_power(graph: &Graph, base: Expr, exponent: &Rational) -> Option<Limit> {
    if graph.as_number(base).is_some_and(|number| *number > Rational::ZERO) {
        return None;
    }
    let operands = vec![base];
    match (exponent.is_int(), is_negative(exponent)) {
        (true, false) => None,
        (true, true) => {
            Some(Limit { is_pole: true, ..Limit::new(Must::NotVanish, Must::NotVanish, operands) })
        }
        (false, false) => Some(Limit::new(Must::BePositive, Must::NotBeNegative, operands)),
        (false, true) => Some(Limit::new(Must::BePositive, Must::BePositive, operands)),
    }
}

fn of_call(graph: &mut Graph, function: Function, arguments: Vec<Expr>) -> Vec<Limit> {
    let x = arguments[0];
    let mut one_and = |sign: i32| {
        let one = graph.number(1);
        vec![graph.sum([(one, Rational::ONE), (x, sign.into())])]
    };
    match function {
        Function::Cbrt => vec![Limit::new(Must::NotVanish, None, vec![x])],
        Function::Ln | Function::Powf => {
            vec![Limit::new(Must::BePositive, Must::BePositive, vec![x])]
        }
        Function::Ln1p | Function::Ln1pRest => {
            vec![Limit::new(Must::BePositive, Must::BePositive, one_and(1))]
        }
        Function::Asin | Function::Acos => [1, -1]
            .map(|sign| Limit::new(Must::BePositive, Must::NotBeNegative, one_and(sign)))
            .into(),
        Function::Tan => {
            let cosine = graph.call(Function::Cos, &[x]);
            vec![Limit::new(Must::NotVanish, Must::NotVanish, vec![cosine])]
        }
        Function::Atan2 => vec![Limit::new(Must::KeepOffCut, None, arguments)],
        Function::Sqrt => vec![Limit::new(Must::BePositive, Must::NotBeNegative, vec![x])],
        Function::Exp
        | Function::ExpM1
        | Function::Sin
        | Function::Cos
        | Function::SinPi
        | Function::CosPi
        | Function::WithinTurns
        | Function::WithinTurnsPi
        | Function::Sinh
        | Function::Cosh
        | Function::Tanh
        | Function::Atan => Vec::new(),
    }
}

/// All limits of some formulas and of their sub-expressions, operands before users.
pub fn limits(graph: &mut Graph, formulas: &[Expr]) -> Vec<Limit> {
    let turning = single_valued_angles(graph, formulas);
    let (mut found, mut seen) = (Vec::new(), SortedSet::new());
    // A sum has only the limits of its terms.
    let is_own = |graph: &Graph, expr: &Expr| !matches!(graph.node(*expr), Node::Sum(..));
    let reachable = graph.reachable(formulas);
    for expr in reachable.into_iter().filter(|expr| is_own(graph, expr)).collect::<Vec<_>>() {
        for mut limit in limits_of(graph, expr) {
            if turning.contains(&expr) && limit.analytic == Must::KeepOffCut {
                limit.analytic = Must::KeepOffOrigin;
            }
            if seen.insert(limit.clone()) {
                found.push(limit);
            }
        }
    }
    found
}

/// Angles, each with its multiple.
type Turns = SortedMap<Expr, Rational>;

/// The angles whose whole turns change no formula.
fn single_valued_angles(graph: &Graph, formulas: &[Expr]) -> SortedSet<Expr> {
    let mut turns = SortedMap::<Expr, Turns>::new();
    let (mut angles, mut seen) = (SortedSet::new(), SortedSet::new());
    for expr in graph.reachable(formulas) {
        let none = Turns::new();
        let of = |expr: &Expr| turns.get(expr).unwrap_or(&none);
        let own = match graph.node(expr) {
            Node::Sum(_, terms) => {
                let mut own = Turns::new();
                for (term, factor) in terms {
                    for (angle, times) in of(term) {
                        *own.get_or_default(*angle) += times * factor;
                    }
                }
                own
            }
            Node::Call(function, arguments) if hides(*function, of(&arguments[0])) => none,
            node => {
                seen.extend(node.children().flat_map(|child| of(&child).keys().copied()));
                match node {
                    Node::Call(Function::Atan2, _) => {
                        angles.insert(expr);
                        Turns::from([(expr, Rational::ONE)])
                    }
                    _ => none,
                }
            }
        };
        turns.insert(expr, own);
    }
    seen.extend(formulas.iter().flat_map(|formula| turns[formula].keys().copied()));
    angles.retain(|angle| !seen.contains(angle));
    angles
}

/// Whether a function keeps its value when each of these angles grows by a whole turn.
fn hides(function: Function, turns: &Turns) -> bool {
    let whole = |parts: i32| turns.values().all(|times| (times * Rational::from(parts)).is_int());
    match function {
        Function::Sin | Function::Cos => whole(1),
        Function::Tan => whole(2),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mms_symbolic::expr::Symbol;

    /// Whether an expression of the angle of (X, Y) changes across the cut of that angle.
    fn sees_cut(make: impl Fn(&mut Graph, Expr) -> Expr) -> bool {
        let mut graph = Graph::default();
        let [x, y] = [0, 1].map(|axis| graph.symbol(Symbol::Coordinate(axis)));
        let angle = graph.call(Function::Atan2, &[y, x]);
        let made = make(&mut graph, angle);
        limits(&mut graph, &[made]).iter().any(|limit| limit.analytic == Must::KeepOffCut)
    }

    #[test]
    fn whole_multiples_of_an_angle_hide_its_turns() {
        let circular = |function: Function, numerator: i32, denominator: u8| {
            sees_cut(|graph, angle| {
                let factor = Rational::from_parts(numerator.into(), denominator.into());
                let time = graph.symbol(Symbol::Time);
                let argument = graph.sum([(angle, factor), (time, Rational::ONE)]);
                graph.call(function, &[argument])
            })
        };
        for times in [1, 3, -4] {
            assert!(!circular(Function::Sin, times, 1) && !circular(Function::Cos, times, 1));
            assert!(!circular(Function::Tan, times, 2));
        }
        assert!(circular(Function::Sin, 1, 2) && circular(Function::Tan, 1, 4));
        assert!(circular(Function::Tanh, 1, 1));
        assert!(sees_cut(|_, angle| angle));
        // One use that changes across the cut is enough.
        assert!(sees_cut(|graph, angle| {
            let sine = graph.call(Function::Sin, &[angle]);
            graph.mul(sine, angle)
        }));
        // Two half turns are a whole one.
        assert!(!sees_cut(|graph, angle| {
            let half = graph.scale(angle, mms_symbolic::expr::HALF);
            let twice = graph.add(half, half);
            graph.call(Function::Cos, &[twice])
        }));
    }
}
