//! Properties of the symbolic core over random expressions. The second route is arithmetic in 77
//! digits: finite differences for derivatives, evaluation for simplification.

use std::collections::BTreeMap;

use mms_codegen::expr::print::Names;
use mms_codegen::expr::resolve::Scope;
use mms_codegen::expr::{Expr, Function, Graph, Rational, Symbol};
use mms_codegen::pass::differentiate::differentiate;
use mms_codegen::pass::factor::factor;
use mms_codegen::pass::substitute::substitute;
use mms_codegen::program::interpret::{Interpreter, Number as _, Point};
use mms_codegen::program::precise::Precise;
use mms_codegen::program::schedule::schedule;
use mms_codegen::program::{Output, Program};
use mms_codegen::show::language::Language;
use mms_codegen::show::walk::write;
use mms_codegen::simplify::{cheaper, cost};
use mms_codegen::source::Sources;
use mms_codegen::spec::Formula;
use mms_codegen::syntax;
use mms_math::Scalar as _;
use proptest::prelude::*;

const X: Symbol = Symbol::Coordinate(0);

/// A recipe for an expression in X, Y and t; `build` follows it.
#[derive(Clone, Debug)]
enum Recipe {
    Number(i32, u8),
    Leaf(u8),
    Add(Box<Recipe>, Box<Recipe>),
    Multiply(Box<Recipe>, Box<Recipe>),
    Power(Box<Recipe>, i8),
    Call(u8, Box<Recipe>),
}

fn recipe() -> impl Strategy<Value = Recipe> {
    let leaf = prop_oneof![
        (-9..9, 1_u8..9).prop_map(|(n, d)| Recipe::Number(n, d)),
        (0_u8..4).prop_map(Recipe::Leaf),
    ];
    leaf.prop_recursive(5, 40, 2, |inner| {
        let inner = inner.prop_map(Box::new);
        prop_oneof![
            (inner.clone(), inner.clone()).prop_map(|(a, b)| Recipe::Add(a, b)),
            (inner.clone(), inner.clone()).prop_map(|(a, b)| Recipe::Multiply(a, b)),
            (inner.clone(), -2..4_i8).prop_map(|(a, e)| Recipe::Power(a, e)),
            (0_u8..8, inner).prop_map(|(f, a)| Recipe::Call(f, a)),
        ]
    })
}

/// Functions that are defined everywhere on the real line, so that few samples are lost.
const EVERYWHERE: [Function; 8] = [
    Function::Sin,
    Function::Cos,
    Function::Atan,
    Function::Tanh,
    Function::Exp,
    Function::Sinh,
    Function::Cosh,
    Function::Cbrt,
];

/// The expression of a recipe; `None` where it divides by what is exactly 0.
fn build(graph: &mut Graph, recipe: &Recipe) -> Option<Expr> {
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
            graph.call(EVERYWHERE[*function as usize % EVERYWHERE.len()], &[a])
        }
    })
}

/// The value of a recipe, by plain arithmetic on its own tree: no graph is involved. `largest`
/// becomes the largest magnitude on the way, which is what rounding errors are relative to.
fn evaluate(recipe: &Recipe, x: &Precise, largest: &mut f64) -> Precise {
    let value = match recipe {
        Recipe::Number(numerator, denominator) => ratio(*numerator, u32::from(*denominator)),
        Recipe::Leaf(0) => x.clone(),
        Recipe::Leaf(1) => ratio(-2, 5),
        Recipe::Leaf(2) => ratio(3, 7),
        Recipe::Leaf(_) => Precise::pi(),
        Recipe::Add(a, b) => evaluate(a, x, largest) + evaluate(b, x, largest),
        Recipe::Multiply(a, b) => evaluate(a, x, largest) * evaluate(b, x, largest),
        Recipe::Power(a, exponent) => {
            let base = evaluate(a, x, largest);
            let power =
                (0..exponent.unsigned_abs()).fold(ratio(1, 1), |power, _| power * base.clone());
            if *exponent < 0 { ratio(1, 1) / power } else { power }
        }
        Recipe::Call(function, a) => {
            let a = evaluate(a, x, largest);
            match EVERYWHERE[*function as usize % EVERYWHERE.len()] {
                Function::Sin => a.sin(),
                Function::Cos => a.cos(),
                Function::Atan => a.atan(),
                Function::Tanh => a.tanh(),
                Function::Exp => a.exp(),
                Function::Sinh => a.sinh(),
                Function::Cosh => a.cosh(),
                Function::Cbrt => a.cbrt(),
                other => unreachable!("{other:?} is not defined everywhere"),
            }
        }
    };
    if value.is_defined() {
        let magnitude = value.to_f64().abs();
        // A rounded zero such as sin(pi): what it is divided or rooted into means nothing.
        let rounded = magnitude > 0.0 && magnitude < 1e-50;
        *largest = if rounded { f64::INFINITY } else { largest.max(magnitude) };
    }
    value
}

/// The value of each root at a point, in 77 digits.
fn values(graph: &Graph, roots: &[Expr], x: &Precise) -> Vec<Precise> {
    let outputs = BTreeMap::from([(Output::Expected(0), roots.to_vec())]);
    let program = schedule(graph, &outputs);
    assert_is_ordered(&program);
    let mut interpreter = Interpreter::new(&program, &[]);
    interpreter.set_time(&ratio(3, 7));
    let plan = interpreter.plan(&[Output::Expected(0)]);
    interpreter.set_point(&plan, Point::at(&[x.clone(), ratio(-2, 5)]));
    interpreter.output(Output::Expected(0))
}

/// Operands stand before their users, and are known no later.
fn assert_is_ordered(program: &Program) {
    for (index, instr) in program.instrs.iter().enumerate() {
        for operand in instr.op.operands() {
            assert!(operand.index() < index, "{program}");
            let stage = program.instr(operand).stage;
            assert_eq!(stage.join(instr.stage), instr.stage, "{program}");
        }
    }
}

fn ratio(numerator: i32, denominator: u32) -> Precise {
    Precise::new(&Rational::from_parts(numerator.into(), denominator.into()))
}

fn power_of_ten(exponent: u32) -> Precise {
    let denominator = dashu_int::UBig::from(10u8).pow(exponent as usize);
    Precise::from_rational(&Rational::from_parts(1.into(), denominator))
}

/// Whether two values agree to `digits` digits of the larger, or both are undefined.
fn agree(a: &Precise, b: &Precise, digits: u32) -> bool {
    if !a.is_defined() || !b.is_defined() {
        return a.is_defined() == b.is_defined();
    }
    let difference = (a.clone() - b.clone()).magnitude();
    let scale = a.clone().magnitude() + b.clone().magnitude() + ratio(1, 1);
    difference.at_most(&(scale * power_of_ten(digits)))
}

proptest! {
    #[test]
    fn a_printed_expression_reads_back_as_itself(recipe in recipe()) {
        let mut graph = Graph::default();
        let root = build(&mut graph, &recipe);
        prop_assume!(root.is_some());
        let root = root.expect("assumed");
        let mut scope = Scope::default();
        for (name, symbol) in [("X", X), ("Y", Symbol::Coordinate(1)), ("t", Symbol::Time)] {
            let leaf = graph.symbol(symbol);
            scope.define(name, Some(leaf));
        }
        let pi = graph.pi();
        scope.define("pi", Some(pi));
        let names = Names::default();
        for text in [graph.print(root, &names), write(&graph, root, &names, &Language)] {
            let mut sources = Sources::default();
            let source = sources.add("printed", text.clone());
            let formula = Formula::plain(&text, sources.span(source, 0, text.len()));
            let mut diagnostics = Vec::new();
            let ast = syntax::parse(&formula, &mut diagnostics);
            let again = ast.and_then(|ast| scope.resolve(&mut graph, &ast, &mut diagnostics));
            prop_assert_eq!(again, Some(root), "{}: {:?}", text, diagnostics);
        }
    }

    #[test]
    fn canonical_form_has_the_value_of_what_was_written(recipe in recipe()) {
        let mut graph = Graph::default();
        let root = build(&mut graph, &recipe);
        prop_assume!(root.is_some());
        let root = root.expect("assumed");
        let x = ratio(11, 13);
        let mut largest = 1.0;
        let written = evaluate(&recipe, &x, &mut largest);
        let canonical = values(&graph, &[root], &x).remove(0);
        prop_assume!(largest < 1e15);
        // What was undefined as written may have cancelled: x/x is 1.
        if written.is_defined() {
            let error = (written.clone() - canonical.clone()).magnitude().to_f64();
            prop_assert!(error <= 1e-40 * largest * largest, "{:?} {:?}", written.to_f64(), canonical.to_f64());
        }
    }

    #[test]
    fn derivatives_are_the_limits_of_differences(recipe in recipe()) {
        let mut graph = Graph::default();
        let root = build(&mut graph, &recipe);
        prop_assume!(root.is_some());
        let root = root.expect("assumed");
        let slope = differentiate(&mut graph, &[root], X)[0];
        let (x, step) = (ratio(11, 13), power_of_ten(20));
        let at = |x: &Precise, root| values(&graph, &[root], x).remove(0);
        let ahead = at(&(x.clone() + step.clone()), root);
        let behind = at(&(x.clone() - step.clone()), root);
        // Differences of large values keep too few of the 77 digits.
        prop_assume!(ahead.clone().magnitude().at_most(&Precise::from_f64(1e10)));
        let difference = (ahead - behind) / (step * ratio(2, 1));
        // The central difference errs by step^2 u'''/6: 40 digits less those of u'''.
        let slope = at(&x, slope);
        if slope.is_defined() && difference.is_defined() {
            prop_assert!(agree(&slope, &difference, 15), "{:?} {:?}", slope.to_f64(), difference.to_f64());
        }
    }

    #[test]
    fn simplifying_changes_no_value_and_costs_nothing(recipe in recipe()) {
        let mut graph = Graph::default();
        let root = build(&mut graph, &recipe);
        prop_assume!(root.is_some());
        let root = root.expect("assumed");
        let factored = factor(&mut graph, &[root])[0];
        let x = ratio(11, 13);
        let [before, after] = [root, factored].map(|root| values(&graph, &[root], &x).remove(0));
        if before.is_defined() {
            prop_assert!(agree(&before, &after, 60));
        }
        let chosen = cheaper(&mut graph, vec![root])[0];
        prop_assert!(chosen == root || chosen == factored);
        prop_assert!(cost(&graph, &[chosen]) <= cost(&graph, &[root]));
    }

    #[test]
    fn substituting_a_symbol_for_itself_changes_nothing(recipe in recipe()) {
        let mut graph = Graph::default();
        let root = build(&mut graph, &recipe);
        prop_assume!(root.is_some());
        let root = root.expect("assumed");
        let x = graph.symbol(X);
        prop_assert_eq!(substitute(&mut graph, &[root], &BTreeMap::from([(X, x)])), vec![root]);
    }

    #[test]
    fn sums_and_products_do_not_depend_on_order(a in recipe(), b in recipe(), c in recipe()) {
        let mut graph = Graph::default();
        let roots = [&a, &b, &c].map(|recipe| build(&mut graph, recipe));
        prop_assume!(roots.iter().all(Option::is_some));
        let [a, b, c] = roots.map(|root| root.expect("assumed"));
        let (ab, cb) = (graph.add(a, b), graph.add(c, b));
        prop_assert_eq!(graph.add(ab, c), graph.add(cb, a));
        let (ab, cb) = (graph.mul(a, b), graph.mul(c, b));
        prop_assert_eq!(graph.mul(ab, c), graph.mul(cb, a));
    }
}

/// Every function, by each of its arguments, and fractional powers: the slope against a central
/// difference, at points inside all domains.
#[test]
fn every_function_has_its_derivative() {
    let mut graph = Graph::default();
    let x = graph.symbol(X);
    let (third, two) = (graph.number(Rational::from_parts(1.into(), 3u8.into())), graph.number(2));
    let inner = [graph.mul(x, third), graph.div(two, x)];
    let mut roots = Vec::new();
    for function in Function::ALL {
        for argument in inner {
            let arguments: &[&[Expr]] = match function.arity() {
                1 => &[&[argument]],
                _ => &[&[argument, two], &[two, argument], &[argument, x]],
            };
            roots.extend(arguments.iter().map(|arguments| graph.call(*function, arguments)));
        }
    }
    for (numerator, denominator) in [(1, 2), (-3, 2), (5, 3), (-1, 7)] {
        let exponent = Rational::from_parts(numerator.into(), u8::into(denominator));
        roots.push(graph.power(inner[0], exponent));
    }
    let slopes = differentiate(&mut graph, &roots, X);
    let mut compared = 0;
    for at in [ratio(3, 7), ratio(21, 10), ratio(29, 10)] {
        let step = power_of_ten(20);
        let ahead = values(&graph, &roots, &(at.clone() + step.clone()));
        let behind = values(&graph, &roots, &(at.clone() - step.clone()));
        let slopes = values(&graph, &slopes, &at);
        for ((root, slope), (ahead, behind)) in
            roots.iter().zip(slopes).zip(ahead.into_iter().zip(behind))
        {
            let difference = (ahead - behind) / (step.clone() * ratio(2, 1));
            if difference.is_defined() {
                let text = graph.print(*root, &Names::default());
                assert!(
                    agree(&slope, &difference, 30),
                    "{text}: {:e}, {:e}",
                    slope.to_f64(),
                    difference.to_f64()
                );
                compared += 1;
            }
        }
    }
    // Only asin and acos are undefined at some of the points.
    assert!(compared > 3 * roots.len() - 10, "{compared} of {}", 3 * roots.len());
}

#[test]
fn a_full_graph_is_told_and_never_answers() {
    let recipe = "sin(X)*cos(X + 1)*exp(X*t)*sin(2*X)";
    let whole = |limit: usize| {
        let mut graph = Graph::with_limit(limit);
        let mut sources = Sources::default();
        let source = sources.add("x", recipe);
        let formula = Formula::plain(recipe, sources.span(source, 0, recipe.len()));
        let mut scope = Scope::default();
        for (name, symbol) in [("X", X), ("t", Symbol::Time)] {
            let leaf = graph.symbol(symbol);
            scope.define(name, Some(leaf));
        }
        let mut diagnostics = Vec::new();
        let ast = syntax::parse(&formula, &mut diagnostics).expect("a formula");
        let root = scope.resolve(&mut graph, &ast, &mut diagnostics)?;
        let slope = differentiate(&mut graph, &[root], X);
        let chosen = cheaper(&mut graph, slope)[0];
        (!graph.is_exhausted())
            .then(|| values(&graph, &[chosen], &ratio(11, 13)).remove(0).to_f64())
    };
    let answer = whole(100_000).expect("an ample graph");
    let mut refused = 0;
    for limit in 0..300 {
        match whole(limit) {
            Some(value) => assert_eq!(value, answer, "limit {limit}"),
            None => refused += 1,
        }
    }
    assert!((10..300).contains(&refused), "{refused}");
}

#[test]
fn roots_of_squares_keep_their_sign() {
    // (x^2)^(1/2) is |x|, not x.
    let mut graph = Graph::default();
    let x = graph.symbol(X);
    let square = graph.power(x, 2);
    let root = graph.call(Function::Sqrt, &[square]);
    assert_ne!(root, x);
    let value = values(&graph, &[root], &ratio(-3, 1)).remove(0);
    assert_eq!(value.to_f64(), 3.0);
}

#[test]
fn known_values_fold() {
    let mut graph = Graph::default();
    let (pi, nine) = (graph.pi(), graph.number(9));
    let half_turn = graph.scale(pi, Rational::from_parts((-3).into(), 2u8.into()));
    let sine = graph.call(Function::Sin, &[half_turn]);
    assert_eq!(graph.as_number(sine), Some(&Rational::ONE));
    let root = graph.call(Function::Sqrt, &[nine]);
    assert_eq!(graph.as_number(root), Some(&Rational::from(3)));
    let (zero, x) = (graph.number(0), graph.symbol(X));
    let exponential = graph.call(Function::Exp, &[zero]);
    assert_eq!(graph.as_number(exponential), Some(&Rational::ONE));
    let difference = graph.sub(x, x);
    assert!(graph.is_zero(difference));
}
