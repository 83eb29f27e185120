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

fn build(graph: &mut Graph, recipe: &Recipe) -> Expr {
    match recipe {
        Recipe::Number(numerator, denominator) => {
            graph.number(Rational::from_parts((*numerator).into(), (*denominator).into()))
        }
        Recipe::Leaf(0) => graph.symbol(X),
        Recipe::Leaf(1) => graph.symbol(Symbol::Coordinate(1)),
        Recipe::Leaf(2) => graph.symbol(Symbol::Time),
        Recipe::Leaf(_) => graph.pi(),
        Recipe::Add(a, b) => {
            let (a, b) = (build(graph, a), build(graph, b));
            graph.add(a, b)
        }
        Recipe::Multiply(a, b) => {
            let (a, b) = (build(graph, a), build(graph, b));
            graph.mul(a, b)
        }
        Recipe::Power(a, exponent) => {
            let a = build(graph, a);
            let undefined = graph.is_zero(a) && *exponent < 0;
            if undefined { a } else { graph.power(a, i32::from(*exponent)) }
        }
        Recipe::Call(function, a) => {
            let a = build(graph, a);
            graph.call(EVERYWHERE[*function as usize % EVERYWHERE.len()], &[a])
        }
    }
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
        let text = graph.print(root, &Names::default());
        let mut sources = Sources::default();
        let source = sources.add("printed", text.clone());
        let formula = Formula::plain(&text, sources.span(source, 0, text.len()));
        let mut scope = Scope::default();
        for (name, symbol) in [("X", X), ("Y", Symbol::Coordinate(1)), ("t", Symbol::Time)] {
            let leaf = graph.symbol(symbol);
            scope.define(name, Some(leaf));
        }
        let pi = graph.pi();
        scope.define("pi", Some(pi));
        let mut diagnostics = Vec::new();
        let ast = syntax::parse(&formula, &mut diagnostics);
        let again = ast.and_then(|ast| scope.resolve(&mut graph, &ast, &mut diagnostics));
        prop_assert_eq!(again, Some(root), "{}: {:?}", text, diagnostics);
    }

    #[test]
    fn derivatives_are_the_limits_of_differences(recipe in recipe()) {
        let mut graph = Graph::default();
        let root = build(&mut graph, &recipe);
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
        let x = graph.symbol(X);
        prop_assert_eq!(substitute(&mut graph, &[root], &BTreeMap::from([(X, x)])), vec![root]);
    }

    #[test]
    fn sums_and_products_do_not_depend_on_order(a in recipe(), b in recipe(), c in recipe()) {
        let mut graph = Graph::default();
        let [a, b, c] = [&a, &b, &c].map(|recipe| build(&mut graph, recipe));
        let (ab, cb) = (graph.add(a, b), graph.add(c, b));
        prop_assert_eq!(graph.add(ab, c), graph.add(cb, a));
        let (ab, cb) = (graph.mul(a, b), graph.mul(c, b));
        prop_assert_eq!(graph.mul(ab, c), graph.mul(cb, a));
    }
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
