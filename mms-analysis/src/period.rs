//! The period of a motion: the time after which u repeats itself.
//!
//! u repeats itself if it depends on t only through sines and cosines whose angles grow at constant rates that are rational
//! multiples of each other. That is derived from the formula, so a period is proved. It may be a multiple of the least one, as
//! in sin(w t)^2.

use std::fmt;

use mms_codegen::compile::Compiled;
use mms_program::Stage;
use mms_program::interpret::Interpreter;
use mms_program::schedule::schedule_plainly;
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::{Expr, Function, Graph, Node, Rational, Symbol};
use mms_symbolic::pass::differentiate::differentiate;
use mms_symbolic::sorted::{SortedMap, SortedSet};

/// The reason why no period of a displacement is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoPeriod {
    /// The displacement does not depend on t.
    AtRest,
    /// The displacement depends on t other than through sines and cosines of angles with constant rates.
    Unsteady,
    /// Two angles grow at rates whose ratio is no rational number as a formula.
    Incommensurate,
    /// With these parameters the period is not a positive number.
    OutOfRange,
}

impl fmt::Display for NoPeriod {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            NoPeriod::AtRest => "u does not depend on t",
            NoPeriod::Unsteady => {
                "u depends on t in another way than through sines and cosines of w*t + .. with w independent of X"
            }
            NoPeriod::Incommensurate => {
                "the frequencies of u are not known to be multiples of one frequency"
            }
            NoPeriod::OutOfRange => "the period is not a positive number with these parameters",
        })
    }
}

impl std::error::Error for NoPeriod {}

/// A period of the displacement with these parameters: u(X, t + period) = u(X, t) for all X and t.
///
/// # Errors
/// No period is known.
pub fn period(compiled: &Compiled, set: &SortedMap<usize, Rational>) -> Result<f64, NoPeriod> {
    let mut graph = compiled.graph.clone();
    graph.make_room();
    let u = &compiled.derived.quantities[&Quantity::Displacement];
    let rates = rates(&mut graph, u)?;
    let first = *rates.iter().next().ok_or(NoPeriod::AtRest)?;
    let ratios: Option<Vec<Rational>> = rates
        .iter()
        .map(|rate| {
            let ratio = graph.div(*rate, first);
            graph.as_number(ratio).cloned()
        })
        .collect();
    let common = ratios.ok_or(NoPeriod::Incommensurate)?.into_iter().reduce(common);
    let slowest = graph.scale(first, common.unwrap_or(Rational::ONE));
    let turn = graph.pi();
    let turn = graph.scale(turn, 2);
    let period = graph.div(turn, slowest);
    let program = schedule_plainly(&graph, &SortedMap::from([((), vec![period])]));
    let period = Interpreter::new(&program, &compiled.parameters::<f64>(set)).output(())[0];
    let period = period.abs();
    (period > 0.0 && period.is_finite()).then_some(period).ok_or(NoPeriod::OutOfRange)
}

/// The rates of the angles of all sines and cosines that contain t.
fn rates(graph: &mut Graph, roots: &[Expr]) -> Result<SortedSet<Expr>, NoPeriod> {
    let mut rates = SortedSet::new();
    let mut seen = SortedSet::new();
    let mut open = roots.to_vec();
    while let Some(expr) = open.pop() {
        let moves = matches!(graph.stage(expr), Stage::Time | Stage::PointTime);
        if !moves || !seen.insert(expr) {
            continue;
        }
        let node = graph.node(expr).clone();
        if node == Node::Symbol(Symbol::Time) {
            return Err(NoPeriod::Unsteady);
        }
        if let Node::Call(Function::Sin | Function::Cos, angle) = &node {
            let rate = differentiate(graph, angle, Symbol::Time)[0];
            if graph.stage(rate) == Stage::Parameter {
                rates.insert(rate);
                continue;
            }
        }
        open.extend(node.children());
    }
    Ok(rates)
}

/// The largest number of which both are multiples, up to its sign.
fn common(mut a: Rational, mut b: Rational) -> Rational {
    while !b.is_zero() {
        let times = Rational::from((a.clone() / b.clone()).floor());
        (a, b) = (b.clone(), a - times * b);
    }
    a
}
