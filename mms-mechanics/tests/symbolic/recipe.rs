//! Random expressions: a recipe is a tree that can be built in a graph, written differently, or
//! evaluated by plain arithmetic without any graph.

use mms_program::interpret::Number;
use mms_symbolic::expr::{Expr, Function, Graph, Rational, Symbol};
use proptest::prelude::*;

/// The symbol of a recipe that tests differentiate by.
pub const X: Symbol = Symbol::Coordinate(0);

/// A recipe for an expression in X, Y and t.
#[derive(Clone, Debug)]
pub enum Recipe {
    Number(i32, u8),
    Leaf(u8),
    Add(Box<Recipe>, Box<Recipe>),
    Multiply(Box<Recipe>, Box<Recipe>),
    Power(Box<Recipe>, i8),
    Call(Function, Box<Recipe>),
    Pair(Function, Box<Recipe>, Box<Recipe>),
}

/// Functions that are defined everywhere on the real line, so that few samples are lost.
const EVERYWHERE: &[Function] = &[
    Function::Sin,
    Function::Cos,
    Function::Atan,
    Function::Tanh,
    Function::Exp,
    Function::Sinh,
    Function::Cosh,
    Function::Cbrt,
];

fn functions(arity: usize) -> Vec<Function> {
    // Turns are taken off for sines and cosines only.
    let is_one = |function: &Function| function.arity() == arity && !function.takes_turns_off();
    Function::ALL.iter().copied().filter(is_one).collect()
}

/// Recipes that have a value nearly everywhere.
pub fn recipe() -> impl Strategy<Value = Recipe> {
    let call = prop::sample::select(EVERYWHERE);
    growing(move |inner| {
        (call.clone(), inner).prop_map(|(function, a)| Recipe::Call(function, Box::new(a))).boxed()
    })
}

/// Recipes of every function, many of which have a value in a part of space only.
pub fn any_recipe() -> impl Strategy<Value = Recipe> {
    let (single, pair) = (prop::sample::select(functions(1)), prop::sample::select(functions(2)));
    growing(move |inner| {
        prop_oneof![
            3 => (single.clone(), inner.clone())
                .prop_map(|(function, a)| Recipe::Call(function, Box::new(a))),
            1 => (pair.clone(), inner.clone(), inner)
                .prop_map(|(function, a, b)| Recipe::Pair(function, Box::new(a), Box::new(b))),
        ]
        .boxed()
    })
}

fn growing(
    calls: impl Fn(BoxedStrategy<Recipe>) -> BoxedStrategy<Recipe> + 'static,
) -> impl Strategy<Value = Recipe> {
    let leaf = prop_oneof![
        (-9..9, 1_u8..9).prop_map(|(n, d)| Recipe::Number(n, d)),
        (0_u8..4).prop_map(Recipe::Leaf),
    ];
    leaf.prop_recursive(5, 40, 2, move |inner| {
        let boxed = inner.clone().prop_map(Box::new);
        prop_oneof![
            (boxed.clone(), boxed.clone()).prop_map(|(a, b)| Recipe::Add(a, b)),
            (boxed.clone(), boxed.clone()).prop_map(|(a, b)| Recipe::Multiply(a, b)),
            (boxed, -2..4_i8).prop_map(|(a, e)| Recipe::Power(a, e)),
            calls(inner.boxed()),
        ]
    })
}

/// The expression of a recipe; `None` if it divides by an exact 0.
pub fn build(graph: &mut Graph, recipe: &Recipe) -> Option<Expr> {
    Some(match recipe {
        Recipe::Number(numerator, denominator) => {
            graph.number(Rational::from_parts((*numerator).into(), (*denominator).into()))
        }
        Recipe::Leaf(0) => graph.symbol(X),
        Recipe::Leaf(1) => graph.symbol(Symbol::Coordinate(1)),
        Recipe::Leaf(2) => graph.symbol(Symbol::Time),
        Recipe::Leaf(_) => graph.pi(),
        Recipe::Add(a, b) => {
            let (a, b) = (build(graph, a)?, build(graph, b)?);
            graph.add(a, b)
        }
        Recipe::Multiply(a, b) => {
            let (a, b) = (build(graph, a)?, build(graph, b)?);
            graph.mul(a, b)
        }
        Recipe::Power(a, exponent) => {
            let a = build(graph, a)?;
            if graph.is_zero(a) && *exponent < 0 {
                return None;
            }
            graph.power(a, i32::from(*exponent))
        }
        Recipe::Call(function, a) => {
            let a = build(graph, a)?;
            graph.call(*function, &[a])
        }
        Recipe::Pair(function, a, b) => {
            let (a, b) = (build(graph, a)?, build(graph, b)?);
            graph.call(*function, &[a, b])
        }
    })
}

/// The expression of a recipe, for properties of recipes that have one.
pub fn built(graph: &mut Graph, recipe: &Recipe) -> Result<Expr, TestCaseError> {
    build(graph, recipe).ok_or_else(|| TestCaseError::reject("divides by 0"))
}

/// The recipe as another person might write it: the operands of every sum and product in the other order, and grouped the other
/// way.
pub fn rewritten(recipe: &Recipe) -> Recipe {
    let rewritten = |recipe: &Recipe| Box::new(rewritten(recipe));
    match recipe {
        Recipe::Number(..) | Recipe::Leaf(_) => recipe.clone(),
        Recipe::Add(a, b) => match &**b {
            // a + (c + d) is d + (c + a), or (d + a) + c.
            Recipe::Add(c, d) => {
                let inner = Recipe::Add(rewritten(d), rewritten(a));
                Recipe::Add(Box::new(inner), rewritten(c))
            }
            _ => Recipe::Add(rewritten(b), rewritten(a)),
        },
        Recipe::Multiply(a, b) => match &**b {
            Recipe::Multiply(c, d) => {
                let inner = Recipe::Multiply(rewritten(d), rewritten(a));
                Recipe::Multiply(Box::new(inner), rewritten(c))
            }
            _ => Recipe::Multiply(rewritten(b), rewritten(a)),
        },
        Recipe::Power(a, exponent) => match exponent {
            2 => Recipe::Multiply(rewritten(a), rewritten(a)),
            _ => Recipe::Power(rewritten(a), *exponent),
        },
        Recipe::Call(function, a) => Recipe::Call(*function, rewritten(a)),
        Recipe::Pair(function, a, b) => Recipe::Pair(*function, rewritten(a), rewritten(b)),
    }
}

/// A place: X, Y and t.
#[derive(Clone, Debug)]
pub struct SpaceTimePoint<T> {
    pub coordinates: [T; 2],
    pub time: T,
}

/// The value of a recipe, by plain arithmetic on its own tree: no graph is involved. Every intermediate value is passed to
/// `see`.
pub fn evaluate<T: Number>(recipe: &Recipe, at: &SpaceTimePoint<T>, see: &mut impl FnMut(&T)) -> T {
    let value = match recipe {
        Recipe::Number(numerator, denominator) => T::ratio(*numerator, i32::from(*denominator)),
        Recipe::Leaf(axis @ (0 | 1)) => at.coordinates[usize::from(*axis)].clone(),
        Recipe::Leaf(2) => at.time.clone(),
        Recipe::Leaf(_) => T::pi(),
        Recipe::Add(a, b) => evaluate(a, at, see) + evaluate(b, at, see),
        Recipe::Multiply(a, b) => evaluate(a, at, see) * evaluate(b, at, see),
        Recipe::Power(a, exponent) => {
            let base = evaluate(a, at, see);
            let power =
                (0..exponent.unsigned_abs()).fold(T::ratio(1, 1), |power, _| power * base.clone());
            if *exponent < 0 { T::ratio(1, 1) / power } else { power }
        }
        Recipe::Call(function, a) => {
            let a = evaluate(a, at, see);
            match function {
                Function::Sqrt => a.sqrt(),
                Function::Cbrt => a.cbrt(),
                Function::Exp => a.exp(),
                Function::ExpM1 => a.exp_m1(),
                Function::Ln => a.ln(),
                Function::Ln1p => a.ln_1p(),
                Function::Ln1pRest => a.ln_1p_rest(),
                Function::Sin => a.sin(),
                Function::Cos => a.cos(),
                Function::SinPi => a.sin_pi(),
                Function::CosPi => a.cos_pi(),
                Function::WithinTurns => a.within_turns(),
                Function::WithinTurnsPi => a.within_turns_pi(),
                Function::Tan => a.tan(),
                Function::Sinh => a.sinh(),
                Function::Cosh => a.cosh(),
                Function::Tanh => a.tanh(),
                Function::Asin => a.asin(),
                Function::Acos => a.acos(),
                Function::Atan => a.atan(),
                Function::Atan2 | Function::Powf => unreachable!("a pair"),
            }
        }
        Recipe::Pair(function, a, b) => {
            let (a, b) = (evaluate(a, at, see), evaluate(b, at, see));
            match function {
                Function::Atan2 => a.atan2(b),
                _ => a.powf(b),
            }
        }
    };
    see(&value);
    value
}
