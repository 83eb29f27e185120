//! The dimension check compared with arithmetic: a formula has the dimension that the check finds if and only if its value
//! follows every change of the base units.
//!
//! The way is independent: the symbols are multiplied by the effect of a change of units, and the formula is evaluated in 77
//! digits, before and after.

use mms_math::Scalar as _;
use mms_mechanics::Output;
use mms_mechanics::resolve::Scope;
use mms_program::interpret::{Interpreter, Number as _};
use mms_program::precise::Precise;
use mms_program::schedule::schedule;
use mms_spec::Formula;
use mms_spec::source::Sources;
use mms_spec::syntax::{Ast, parse};
use mms_spec::units::{Dimension, Formulas, Measure, Unit};
use mms_symbolic::expr::{Graph, Rational, Symbol};
use mms_symbolic::sorted::SortedMap;
use proptest::prelude::*;

use crate::sampled::sampled_count;
use proptest::strategy::ValueTree as _;
use proptest::test_runner::TestRunner;

/// Pairs of symbols of one dimension, in exponents of mass, length and time. No two values are
/// related, so that no difference cancels.
const PAIRS: [(&str, &str, [i8; 3]); 4] = [
    ("x", "length", [0, 1, 0]),
    ("t", "period", [0, 0, 1]),
    ("young", "mu", [1, -1, -2]),
    ("rho", "rho0", [1, -3, 0]),
];

/// The symbols in the order of the parameters, with their dimensions and values.
fn symbols() -> Vec<(&'static str, [i8; 3], Precise)> {
    let pairs = PAIRS.iter().flat_map(|(a, b, dimension)| [(*a, *dimension), (*b, *dimension)]);
    let value = |index: usize| Precise::from_f64(((index * index + 2) as f64).sqrt() / 3.0);
    pairs.enumerate().map(|(index, (name, of))| (name, of, value(index))).collect()
}

/// Formulas, most of which have a dimension; the two sides of a difference are never nearly equal. With `losing`, operands may
/// drop out, as in 0*a or a^0.
fn formulas(losing: bool) -> impl Strategy<Value = String> {
    let symbol = prop::sample::select(symbols().iter().map(|it| it.0).collect::<Vec<_>>());
    let number = prop::sample::select(vec!["2", "0.3", "pi", "7e-1"]);
    let leaf = prop_oneof![
        6 => symbol.prop_map(String::from),
        1 => number.prop_map(String::from),
        1 => Just(if losing { "0" } else { "1" }.to_string()),
    ];
    leaf.prop_recursive(5, 40, 2, move |part| {
        let ratio = prop::sample::select(PAIRS.to_vec()).prop_map(|(a, b, _)| format!("{a}/{b}"));
        let exponent = prop::sample::select(vec!["2", "3", "(-1)", "(1/2)", "-(2/3)"]);
        let alike = (part.clone(), ratio);
        let pair = (part.clone(), part.clone());
        prop_oneof![
            3 => pair.clone().prop_map(|(a, b)| format!("({a})*({b})")),
            3 => pair.clone().prop_map(|(a, b)| format!("({a})/({b})")),
            2 => (part.clone(), exponent).prop_map(|(a, n)| format!("({a})^{n}")),
            2 => alike.clone().prop_map(|(a, r)| format!("({a}) + ({a})*{r}")),
            2 => alike.clone().prop_map(|(a, r)| format!("{r}*({a}) - ({a})")),
            1 => alike.clone().prop_map(|(a, r)| format!("hypot({a}, {r}*({a}))")),
            1 => part.clone().prop_map(move |a| if losing { format!("({a})^0") } else { a }),
            1 => alike.clone().prop_map(move |(a, r)| if losing { format!("({a})/({a})") } else { r }),
            1 => alike.clone().prop_map(move |(a, r)| if losing { format!("atan2(2*({a}), {r}*({a}))") } else { r }),
            1 => part.clone().prop_map(|a| format!("sqrt(({a})^2)*cbrt({a})")),
            1 => alike.prop_map(|(a, r)| format!("({a})*ln(1 + {r})")),
            1 => part.clone().prop_map(|a| format!("tanh({a})")),
            1 => pair.clone().prop_map(|(a, b)| format!("exp(-(atan({a})))*({b})")),
            1 => pair.prop_map(|(a, b)| format!("({a}) + ({b})")),
        ]
    })
}

fn parsed(text: &str) -> Ast {
    let mut sources = Sources::default();
    let id = sources.add("formula", text);
    let formula = Formula::plain(text, sources.span(id, 0, text.len()));
    let mut diagnostics = Vec::new();
    parse(&formula, &mut diagnostics).unwrap_or_else(|| panic!("{text}: {diagnostics:?}"))
}

/// The result of the check: a dimension, 0 (which fits any), or an error of units. `None` if neither the check nor the compiler
/// accepts the formula, such as a division by 0.
fn claim(ast: &Ast) -> Option<Result<Option<Dimension>, usize>> {
    let mut names = Formulas::default();
    names.define("pi", Some(Measure::of(Dimension::NONE)));
    for (name, dimension, _) in symbols() {
        names.define(name, Some(Measure::of(Dimension::mechanical(dimension))));
    }
    let mut diagnostics = Vec::new();
    match names.infer(ast, &mut diagnostics) {
        Some(measure) => Some(Ok(measure.dimension)),
        None => (!diagnostics.is_empty()).then_some(Err(diagnostics.len())),
    }
}

/// Evaluates a formula with base units of mass, length and time that are smaller by these factors. `None` if it has no value.
fn evaluate(ast: &Ast, factors: &[Precise; 3]) -> Option<Precise> {
    let mut graph = Graph::default();
    let mut scope = Scope::default();
    let pi = graph.pi();
    scope.define("pi", Some(pi));
    let mut parameters = Vec::new();
    for (index, (name, dimension, value)) in symbols().into_iter().enumerate() {
        let symbol = Symbol::Parameter(index);
        let leaf = graph.symbol(symbol);
        scope.define(name, Some(leaf));
        scope.assume_positive(symbol);
        let exponents = dimension.map(Rational::from);
        parameters.push(value * scale(factors, &exponents));
    }
    let expr = scope.resolve(&mut graph, ast, &mut Vec::new())?;
    let output = Output::Parameter(0);
    let program = schedule(&graph, &SortedMap::from([(output, vec![expr])]));
    let value = Interpreter::new(&program, &parameters).output(output).remove(0);
    value.is_defined().then_some(value)
}

/// The factor by which a value with these exponents grows.
fn scale(factors: &[Precise; 3], exponents: &[Rational]) -> Precise {
    let one = Precise::from_f64(1.0);
    factors.iter().zip(exponents).fold(one, |product, (factor, exponent)| {
        product * factor.clone().powf(Precise::from_rational(exponent))
    })
}

fn factors(mass: f64, length: f64, time: f64) -> [Precise; 3] {
    [mass, length, time].map(Precise::from_f64)
}

/// Whether two values agree to 40 digits; about 67 of the 77 are right.
fn agree(a: &Precise, b: &Precise) -> bool {
    let size = a.clone().magnitude() + b.clone().magnitude();
    let difference = (a.clone() - b.clone()).magnitude();
    difference.at_most(&(size * Precise::from_f64(1e-40)))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(sampled_count(256, 3) as u32))]

    /// Any text of a unit is read or refused at once.
    #[test]
    fn no_text_is_too_much_for_a_unit(text in "([a-zA-Z0-9*/^() .-]|kg|mm|MPa|\\^\\(1/2\\)|\\PC){0,60}") {
        let unit = Unit::known(&text);
        prop_assert!(unit.is_none_or(|unit| !unit.dimension.to_string().is_empty()));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(sampled_count(400, 3) as u32))]

    #[test]
    fn values_follow_a_change_of_units_as_claimed(text in formulas(true)) {
        let ast = parsed(&text);
        let Some(Ok(claim)) = claim(&ast) else { return Ok(()) };
        let changed = factors(1.75, 0.625, 2.5);
        let (before, after) = (evaluate(&ast, &factors(1.0, 1.0, 1.0)), evaluate(&ast, &changed));
        prop_assert_eq!(before.is_some(), after.is_some());
        let (Some(before), Some(after)) = (before, after) else { return Ok(()) };
        let exponents = claim.as_ref().map_or(Dimension::NONE, Clone::clone);
        let expected = before.clone() * scale(&changed, &exponents.exponents()[..3]);
        prop_assert!(agree(&after, &expected), "{} becomes {}", before.to_f64(), after.to_f64());
        prop_assert!(claim.is_some() || before.to_f64() == 0.0, "{}", before.to_f64());
    }
}

/// An expression that is 0 fits any unit, but its power of 0 is the number 1.
#[test]
fn zero_to_the_power_of_zero_is_a_number() {
    let dimension = |text: &str| claim(&parsed(text)).and_then(Result::ok).flatten();
    assert_eq!(dimension("hypot(0/x, 0/x)^0"), Some(Dimension::NONE));
    assert_eq!(dimension("hypot(0/x, 0/x)^2"), None);
}

/// Whether a value follows changes of each base unit by some power: growing one unit by 2 twice must have the same effect both
/// times.
fn follows_any_power(ast: &Ast) -> Option<bool> {
    let value = |factors: [f64; 3]| {
        let [mass, length, time] = factors;
        evaluate(ast, &self::factors(mass, length, time))
    };
    let start = value([1.0; 3])?;
    let mut follows = true;
    for base in 0..3 {
        let grown = |factor: f64| {
            let mut factors = [1.0; 3];
            factors[base] = factor;
            value(factors)
        };
        let (once, twice) = (grown(2.0)?, grown(4.0)?);
        follows &= agree(&(once.clone() * once), &(twice * start.clone()));
    }
    Some(follows)
}

/// A sum of unlike terms may still cancel, as in (x + t)/(x + t); that is rare.
#[test]
fn what_is_refused_follows_no_change_of_units() {
    let mut runner = TestRunner::deterministic();
    let strategy = formulas(false);
    let (mut accepted, mut refused, mut followed) = (0, 0, Vec::new());
    for _ in 0..800 {
        let text = strategy.new_tree(&mut runner).expect("a formula").current();
        let ast = parsed(&text);
        match claim(&ast) {
            Some(Ok(_)) => accepted += 1,
            Some(Err(_)) => match follows_any_power(&ast) {
                Some(true) => followed.push(text),
                Some(false) => refused += 1,
                None => {}
            },
            None => {}
        }
    }
    assert!(accepted > 100, "{accepted} accepted");
    assert!(refused > 100, "{refused} refused");
    assert!(followed.len() * 50 < refused, "{} of {refused}: {followed:#?}", followed.len());
}
