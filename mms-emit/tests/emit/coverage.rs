//! Every operation and every function, at every stage, in every language.

use mms_codegen::{Compiled, compile};
use mms_emit::Subject;
use mms_mechanics::Output;
use mms_program::Op;
use mms_program::interpret::Interpreter;
use mms_program::precise::Precise;
use mms_program::schedule::schedule;
use mms_spec::Space;
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::{Expr, Function, Graph, Rational, Symbol};
use mms_symbolic::sorted::{SortedMap, SortedSet};

use super::build::{can_prove, ports, prove, quick};
use super::sampled::{all_is_tried, sampled};

/// A field of three dimensions: its quantities have room for many formulas.
const FIELD: &str = r#"
[field]
title = "Every operation"
dimension = 3
[parameters]
a = { value = 0.3125 }
b = { value = 0.6875 }
[displacement]
u = ["a*b*X*t/100", "0", "0"]
[material]
model = "neo_hookean"
lambda = 1
mu = 1
density = 1
[domain]
shape = "box"
lower = [0.125, 0.25, 0.125]
upper = [0.375, 0.5, 0.25]
time = [0.25, 0.75]
"#;

/// Each function of an argument between 0.1 and 0.8, and of its other arguments.
fn functions(graph: &mut Graph, x: Expr, y: Expr) -> Vec<Expr> {
    let alone = |function: &&Function| !function.takes_turns_off();
    let mut calls: Vec<Expr> = (Function::ALL.iter().filter(alone))
        .map(|function| match function.arity() {
            1 => graph.call(*function, &[x]),
            _ => graph.call(*function, &[x, y]),
        })
        .collect();
    // Arguments that are reduced, and negative arguments.
    for (function, factor) in [
        (Function::Sin, 40),
        (Function::Cos, -40),
        (Function::Tan, 3),
        (Function::SinPi, 41),
        (Function::CosPi, -41),
        (Function::Exp, 20),
        (Function::ExpM1, -9),
        (Function::Ln, 1000),
        (Function::Ln1p, 100),
        (Function::Ln1pRest, -1),
        (Function::Sinh, -9),
        (Function::Cosh, 9),
        (Function::Tanh, -30),
        (Function::Cbrt, -9),
        (Function::Asin, -1),
        (Function::Acos, -1),
        (Function::Atan, -9),
    ] {
        let argument = graph.scale(x, factor);
        calls.push(graph.call(function, &[argument]));
    }
    for (height, width) in [(1, -1), (-1, -1), (-1, 1)] {
        let (height, width) = (graph.scale(x, height), graph.scale(y, width));
        calls.push(graph.call(Function::Atan2, &[height, width]));
    }
    calls
}

/// Sines and cosines of angles whose whole turns are removed before a point is known, and of other angles.
fn within_turns(graph: &mut Graph, x: Expr) -> Vec<Expr> {
    let mut calls = Vec::new();
    for (within, functions) in [
        (Function::WithinTurns, [Function::Sin, Function::Cos]),
        (Function::WithinTurnsPi, [Function::SinPi, Function::CosPi]),
    ] {
        for (function, factor) in
            functions.into_iter().flat_map(|it| [(it, -4001), (it, 40_000_000)])
        {
            let angle = graph.scale(x, factor);
            let angle = graph.call(within, &[angle]);
            calls.push(graph.call(function, &[angle]));
        }
    }
    calls
}

/// Every pair of an operation inside another one, which brackets must keep apart.
fn pairs(graph: &mut Graph, x: Expr, y: Expr, z: Expr) -> Vec<Expr> {
    type Operation = fn(&mut Graph, Expr, Expr) -> Expr;
    let operations: [Operation; 4] = [Graph::add, Graph::sub, Graph::mul, Graph::div];
    let mut all = Vec::new();
    for outer in operations {
        for inner in operations {
            let left = inner(graph, x, y);
            let right = inner(graph, y, z);
            all.push(outer(graph, left, z));
            all.push(outer(graph, x, right));
        }
        let minus = graph.scale(y, -1);
        all.push(outer(graph, x, minus));
        let half = graph.number(Rational::from_parts((-1).into(), 2_u8.into()));
        all.push(outer(graph, x, half));
    }
    all
}

/// A formula of nesting depth `depth`.
fn nest(graph: &mut Graph, x: Expr, y: Expr, depth: usize) -> Expr {
    (0..depth).fold(x, |inner, _| {
        let outer = graph.mul(inner, y);
        let outer = graph.add(outer, x);
        graph.call(Function::Tanh, &[outer])
    })
}

/// The difference of a value and its nearest double, times 2^48: it shows digits that only a computation with twice the
/// digits has.
fn rest(graph: &mut Graph, expr: Expr, parameters: &[Precise]) -> Expr {
    let output = Output::Expected(0);
    let program = schedule(graph, &SortedMap::from([(output, vec![expr])]));
    let value = Interpreter::new(&program, parameters).output(output)[0].to_f64();
    let near = graph.number(Rational::try_from(value).expect("a finite value"));
    let rest = graph.sub(expr, near);
    graph.scale(rest, 1_u64 << 48)
}

/// The field with these formulas as the formulas of its quantities.
fn with_formulas(mut compiled: Compiled, graph: &mut Graph, formulas: &[Expr]) -> Compiled {
    let mut outputs = SortedMap::new();
    let mut left = formulas.iter().copied();
    for quantity in Quantity::pointwise() {
        let count = Space::Cartesian(3).components(quantity.shape());
        let components: Vec<Expr> = left.by_ref().take(count).collect();
        if components.len() == count {
            outputs.insert(Output::Quantity(quantity), components);
        }
    }
    assert!(left.len() < 9, "there is room for all but a few formulas");
    // The domain, as it was.
    let program = &compiled.program;
    let kept = |output: &&Output| matches!(output, Output::Bound(_) | Output::Parameter(_));
    for output in program.outputs.keys().filter(kept) {
        let values = Interpreter::<f64, _>::new(program, &[0.3125, 0.6875]).output(*output);
        let exact = values.into_iter().map(|value| Rational::try_from(value).expect("finite"));
        outputs.insert(*output, exact.map(|value| graph.number(value)).collect());
    }
    compiled.program = schedule(graph, &outputs);
    compiled
}

/// The targets without numbers of twice the digits; the first program, which consists of such digits, is not for them.
const ONE_PRECISION: [&str; 3] = ["ufl", "moose", "karamelo"];

/// A target that takes 15 s for 100 formulas of parameters or of the time, which are computed with twice the digits.
const SLOW: &str = "octave";

#[test]
fn every_operation_and_function_is_right_at_every_stage_in_every_language() {
    let compiled = compile("every_operation", "x.toml", FIELD, &|path| Err(path.into()))
        .unwrap_or_else(|failure| panic!("{failure}"));
    let mut graph = compiled.graph.clone();
    let symbol = |graph: &mut Graph, symbol| graph.symbol(symbol);
    let [a, b, t, x, y, z] = [
        Symbol::Parameter(0),
        Symbol::Parameter(1),
        Symbol::Time,
        Symbol::Coordinate(0),
        Symbol::Coordinate(1),
        Symbol::Coordinate(2),
    ]
    .map(|it| symbol(&mut graph, it));
    let parameters = compiled.parameters::<Precise>(&SortedMap::new());
    let xt = graph.mul(x, t);
    let xt = graph.add(xt, x);
    let mut of_parameters = functions(&mut graph, a, b);
    of_parameters.extend(within_turns(&mut graph, a));
    let rests = of_parameters.iter().map(|it| rest(&mut graph, *it, &parameters)).collect();
    let mut programs: Vec<Vec<Expr>> = vec![rests, of_parameters, Vec::new(), Vec::new()];
    programs[1].extend(functions(&mut graph, t, b));
    programs[1].extend(within_turns(&mut graph, t));
    for (index, [x, y, z]) in [(0, [t, b, a]), (2, [x, y, z]), (3, [xt, y, t])] {
        programs[index].extend(pairs(&mut graph, x, y, z));
        programs[index].push(nest(&mut graph, x, y, 60));
        programs[index].push(graph.pi());
    }
    programs[2].extend(functions(&mut graph, x, y));
    programs[3].extend(functions(&mut graph, xt, y));
    let mut seen = SortedSet::new();
    let targets: Vec<_> = ports().filter(|target| can_prove(target)).collect();
    // The expected results of a program are computed once, for all of its targets.
    let tried = sampled(0..programs.len(), 2).into_iter();
    let pairs = tried.flat_map(|index| targets.iter().map(move |target| (index, target)));
    let pairs = sampled(pairs, 5);
    for (index, formulas) in programs.iter_mut().enumerate() {
        // Each component of each quantity has some formula.
        let room: usize =
            Quantity::pointwise().map(|it| Space::Cartesian(3).components(it.shape())).sum();
        assert!(formulas.len() <= room, "{} formulas, room for {room}", formulas.len());
        *formulas = formulas.iter().copied().cycle().take(room).collect();
        let field = with_formulas(compiled.clone(), &mut graph, formulas);
        for instr in &field.program.instrs {
            if let Op::Unary(function, ..) | Op::Binary(function, ..) = instr.op {
                seen.insert((function, instr.stage));
            }
        }
        let subject = Subject::new(&field);
        for (_, target) in pairs.iter().filter(|(program, _)| *program == index) {
            let is_wide = index < 2;
            if index == 0 && ONE_PRECISION.contains(&target.name)
                || is_wide && target.name == SLOW && !all_is_tried()
            {
                continue;
            }
            // A compiler takes long to optimise functions of a hundred formulas.
            let line = |line| if target.name == "c" { line } else { quick(line) };
            let error = prove(target, &subject, &format!("coverage/{index}"), line);
            println!("{} {index}: {error} eps", target.name);
        }
    }
    // Whole turns are removed before a point is known.
    assert_eq!(seen.len(), 4 * (Function::ALL.len() - 2) + 2 * 2, "{seen:?}");
}
