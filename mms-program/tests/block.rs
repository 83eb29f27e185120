//! Compares the block interpreter with the interpreter of one point: random programs, every length, numbers of all kinds.

use std::sync::Arc;

use mms_math::Double;
use mms_math::dispatch::Instructions;
use proptest::prelude::*;

use crate::sampled::sampled_count;

use mms_program::block::{BlockMode, BlockPlan, Blockwise, Prepared, Scratch, ScratchPool};
use mms_program::interpret::{Interpreter, Point};
use mms_program::{Instr, Op, Value};
use mms_symbolic::expr::Stage;
use mms_symbolic::expr::{Function, Rational, Small, Symbol};
use mms_symbolic::sorted::SortedMap;

/// Outputs that compiled code computes in two loops, or in one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Output {
    TwoLoops,
    Expected(usize),
}

type Program = mms_program::Program<Output>;

const DIMENSION: usize = 2;

/// Leaves of all stages, and exact and inexact numbers.
fn leaves() -> Vec<Op> {
    let mut leaves = vec![
        Op::Constant(Rational::from_parts(1.into(), 3_u8.into())),
        Op::Constant(Rational::from(-2)),
        Op::Pi,
        Op::Input(Symbol::Parameter(0)),
        Op::Input(Symbol::Parameter(1)),
        Op::Input(Symbol::Time),
    ];
    for axis in 0..DIMENSION {
        leaves.push(Op::Input(Symbol::Coordinate(axis)));
        leaves.push(Op::Input(Symbol::Normal(axis)));
        leaves.push(Op::Input(Symbol::Gradient(axis, 1 - axis)));
    }
    leaves
}

/// A program of these operations: what to do, and the operands among earlier values, as fractions. The last values are the
/// results of two outputs, one of which compiled code may compute in two loops.
fn program(recipe: &[(u8, u16, u16)]) -> Program {
    let mut ops = leaves();
    for (what, a, b) in recipe {
        let value = |fraction: u16| Value(((usize::from(fraction) * ops.len()) >> 16) as u32);
        let (a, b) = (value(*a), value(*b));
        // Most operations of programs, and the fused ones, are sums and products.
        ops.push(match what % 32 {
            0..8 => Op::Add(a, b),
            8..14 => Op::Subtract(a, b),
            14..22 => Op::Multiply(a, b),
            22 | 23 => Op::Divide(a, b),
            24 => Op::Negate(a),
            _ => {
                let functions = at_points();
                let (function, small) = functions[usize::from(*what) * 7 % functions.len()];
                match function.arity() {
                    1 => Op::Unary(function, small, a),
                    _ => Op::Binary(function, a, b),
                }
            }
        });
    }
    let last = |count: usize| -> Vec<Value> {
        (ops.len() - count..ops.len()).map(|index| Value(index as u32)).collect()
    };
    let outputs = SortedMap::from([
        (quantity(), last(4)),
        (Output::Expected(0), last(9)),
        (Output::Expected(1), vec![Value(0), Value(5), Value(6)]),
    ]);
    in_stage_order(ops, outputs)
}

/// The plan as compiled code computes the outputs.
fn plan_of(program: &Program, outputs: &[Output]) -> BlockPlan {
    BlockPlan::new(program, outputs, |output| output == Output::TwoLoops)
}

fn quantity() -> Output {
    Output::TwoLoops
}

fn in_stage_order(ops: Vec<Op>, outputs: SortedMap<Output, Vec<Value>>) -> Program {
    let mut stages: Vec<Stage> = Vec::new();
    for op in &ops {
        let of_operands = op.operands().map(|operand| stages[operand.index()]);
        stages.push(match op {
            Op::Input(symbol) => Stage::of(*symbol),
            _ => of_operands.fold(Stage::Parameter, Stage::join),
        });
    }
    let mut order: Vec<usize> = (0..ops.len()).collect();
    order.sort_by_key(|index| stages[*index]);
    let mut renamed = vec![Value(0); ops.len()];
    order.iter().enumerate().for_each(|(new, old)| renamed[*old] = Value(new as u32));
    let instr = |old: &usize| {
        let op = ops[*old].map(|value| renamed[value.index()]);
        Instr { op, stage: stages[*old] }
    };
    let rename = |(output, values): (Output, Vec<Value>)| {
        (output, values.into_iter().map(|value| renamed[value.index()]).collect())
    };
    Program {
        instrs: order.iter().map(instr).collect(),
        outputs: outputs.into_iter().map(rename).collect(),
    }
}

/// The inputs of a point: X, N and H.
#[derive(Clone, Debug)]
struct Given<T> {
    coordinates: [T; DIMENSION],
    normal: [T; DIMENSION],
    gradient: [T; DIMENSION * DIMENSION],
}

impl<T: Blockwise> Given<T> {
    fn of(&self, symbol: Symbol) -> T {
        match symbol {
            Symbol::Coordinate(axis) => self.coordinates[axis],
            Symbol::Normal(axis) => self.normal[axis],
            Symbol::Gradient(row, column) => self.gradient[row * DIMENSION + column],
            _ => unreachable!("no input of a point"),
        }
    }
}

/// `count` points with numbers that are taken from `numbers` in turn.
fn given<T: Blockwise>(count: usize, numbers: &[f64]) -> Vec<Given<T>> {
    let mut numbers = numbers.iter().map(|number| T::from_f64(*number)).cycle();
    let mut next = || numbers.next().expect("a cycle of some numbers");
    let mut point = || Given {
        coordinates: std::array::from_fn(|_| next()),
        normal: std::array::from_fn(|_| next()),
        gradient: std::array::from_fn(|_| next()),
    };
    (0..count).map(|_| point()).collect()
}

const PARAMETERS: [f64; 2] = [0.7, -1.3];
const TIME: f64 = 0.37;

/// All components of all outputs, point by point, in blocks.
fn in_blocks<T: Blockwise>(
    prepared: &Prepared<T>,
    scratch: &mut Scratch<T>,
    outputs: usize,
    points: &[Given<T>],
) -> Vec<Vec<T>> {
    let mut found = vec![Vec::new(); points.len()];
    prepared.run(
        scratch,
        T::from_f64(TIME),
        points.len(),
        &mut |start, inputs| {
            for (symbol, column) in inputs.columns() {
                let points = &points[start..];
                column.iter_mut().zip(points).for_each(|(to, point)| *to = point.of(symbol));
            }
        },
        &mut |start, results| {
            for component in (0..outputs).flat_map(|output| results.components(output)) {
                (0..results.count()).for_each(|k| found[start + k].push(component.at(k)));
            }
        },
    );
    found
}

/// The outputs by the interpreter of one point.
fn one_by_one<T: Blockwise>(
    program: &Program,
    outputs: &[Output],
    points: &[Given<T>],
) -> Vec<Vec<T>> {
    let mut interpreter = Interpreter::new(program, &PARAMETERS.map(T::from_f64));
    interpreter.set_time(&T::from_f64(TIME));
    let plan = interpreter.plan(outputs);
    let mut at = |point: &Given<T>| {
        let Given { coordinates, normal, gradient } = point;
        interpreter.set_point(&plan, Point { coordinates, normal, gradient });
        outputs.iter().flat_map(|output| interpreter.output(*output)).collect()
    };
    points.iter().map(&mut at).collect()
}

/// Asserts that both have the same bits; values that are not numbers have none.
fn agree<T: Blockwise>(found: &[Vec<T>], expected: &[Vec<T>], what: impl std::fmt::Display) {
    assert_eq!(found.len(), expected.len(), "{what}");
    for (point, (found, expected)) in found.iter().zip(expected).enumerate() {
        assert_eq!(found.len(), expected.len(), "{what}");
        for (found, expected) in found.iter().zip(expected) {
            let none = |number: &T| format!("{number:?}").contains("NaN");
            let same = found.is_same(*expected) || none(found) && none(expected);
            assert!(same, "{what}, point {point}: {found:?}, but one by one {expected:?}");
        }
    }
}

fn prepared<T: Blockwise>(plan: &Arc<BlockPlan>, mode: BlockMode) -> Prepared<T> {
    Prepared::new(plan.clone(), mode, &PARAMETERS.map(T::from_f64))
}

/// Compares all ways to run a program with the interpreter, and with each other.
fn hold<T: Blockwise>(program: &Program, numbers: &[f64], count: usize) {
    let outputs: Vec<Output> = program.outputs.keys().copied().collect();
    let plan = Arc::new(plan_of(program, &outputs));
    let points = given::<T>(count, numbers);
    let expected = one_by_one(program, &outputs, &points);
    let mut scratch = Scratch::default();
    let mut run =
        |mode: BlockMode| in_blocks(&prepared(&plan, mode), &mut scratch, outputs.len(), &points);
    let mut fused: Option<(Instructions, Vec<Vec<T>>)> = None;
    for instructions in Instructions::all() {
        agree(&run(BlockMode::portable_with(instructions)), &expected, instructions);
        let found = run(BlockMode::fused_with(instructions));
        match &fused {
            // Either no products are fused, or all are.
            _ if instructions == Instructions::BASELINE && !cfg!(target_arch = "aarch64") => {
                agree(&found, &expected, instructions);
            }
            Some((other, known)) => agree(&found, known, format!("{instructions}, {other}")),
            None => fused = Some((instructions, found)),
        }
    }
}

/// Numbers within the domain of most functions, where all digits are kept, and others: outside the range of the quick
/// functions, subnormal, infinite, NaN.
const MILD: [f64; 11] = [0.3, 1.25, 0.61, 2.0, 0.875, 1.0, 0.14, 0.5, 1.7, 0.043, 0.99];
const WILD: [f64; 17] = [
    0.3,
    -1.25,
    0.0,
    1e9,
    -0.0,
    3e-310,
    0.5,
    f64::INFINITY,
    1e17,
    -1e300,
    1e-40,
    f64::NAN,
    2.0,
    -700.0,
    1e-160,
    f64::NEG_INFINITY,
    0.7,
];

fn recipes() -> impl Strategy<Value = Vec<(u8, u16, u16)>> {
    prop::collection::vec(any::<(u8, u16, u16)>(), 10..80)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(sampled_count(256, 3) as u32))]

    #[test]
    fn random_programs_have_the_bits_of_one_point(recipe in recipes(), count in 1_usize..300) {
        let program = program(&recipe);
        for numbers in [&MILD[..], &WILD] {
            hold::<f64>(&program, numbers, count);
            hold::<f32>(&program, numbers, count);
            hold::<Double>(&program, numbers, count / 4 + 1);
        }
    }
}

/// The random program with coordinates instead of normals and gradients, so that it only needs positions.
fn of_positions(mut program: Program) -> Program {
    for instr in &mut program.instrs {
        if let Op::Input(Symbol::Normal(axis) | Symbol::Gradient(axis, _)) = instr.op {
            instr.op = Op::Input(Symbol::Coordinate(axis));
        }
    }
    program
}

/// Compares runs from stored values of points with runs from the start, at several times.
fn validate_kept<T: Blockwise>(program: &Program, numbers: &[f64], count: usize) {
    let points: Vec<T> =
        given::<T>(count, numbers).iter().flat_map(|point| point.coordinates).collect();
    for output in [quantity(), Output::Expected(0), Output::Expected(1)] {
        let plan = Arc::new(plan_of(program, &[output]));
        let (prepared, components) =
            (prepared::<T>(&plan, BlockMode::portable()), program.outputs[&output].len());
        let (mut scratch, zero) = (Scratch::default(), T::from_f64(0.0));
        let kept = prepared.keep(&mut scratch, DIMENSION, &points);
        for time in [0.37, -2.0, 0.37] {
            let time = T::from_f64(time);
            let mut expected = vec![zero; count * components];
            prepared.at_points(&mut scratch, time, DIMENSION, [&points, &[]], &mut expected);
            let mut found = vec![zero; count * components];
            prepared.at_kept(&mut scratch, time, (DIMENSION, &points, &kept), &mut found);
            agree(&[found], &[expected], format!("{output:?}, {} kept", plan.kept()));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(sampled_count(256, 3) as u32))]

    #[test]
    fn what_is_kept_of_points_changes_no_bit(recipe in recipes(), count in 1_usize..300) {
        let program = of_positions(program(&recipe));
        for numbers in [&MILD[..], &WILD] {
            validate_kept::<f64>(&program, numbers, count);
            validate_kept::<f32>(&program, numbers, count);
            validate_kept::<Double>(&program, numbers, count / 4 + 1);
        }
    }
}

fn at_points() -> Vec<(Function, Option<Small>)> {
    let all = Function::ALL.iter().copied().filter(|function| !function.takes_turns_off());
    let small = [Function::Sin, Function::Cos].into_iter().flat_map(|function| {
        [Small::NearZero, Small::WithinOne].map(|small| (function, Some(small)))
    });
    all.map(|function| (function, None)).chain(small).collect()
}

/// A program that calls each function, sums products, and reads results later.
fn everything() -> Program {
    let functions = at_points().len() as u8;
    let recipe: Vec<_> = (0..2 * u16::from(functions))
        .map(|k| ((25 + k * 32 / 7) as u8 | 24, k.wrapping_mul(7919) | 0x8000, 0xD000 ^ k))
        .chain(
            (0..60_u16)
                .map(|k| ((k * 5 % 24) as u8, k.wrapping_mul(1031) | 0x4000, 0xFFFF - 17 * k)),
        )
        .collect();
    program(&recipe)
}

#[test]
fn every_number_of_points_has_the_bits_of_one_point() {
    let program = everything();
    for count in 0..=2 * f64::BLOCK + 1 {
        hold::<f64>(&program, &MILD, count);
    }
    for count in (0..=2 * f32::BLOCK + 1).step_by(3) {
        hold::<f32>(&program, &MILD, count);
    }
    for count in [0, 1, 63, 64, 65, 129] {
        hold::<Double>(&program, &MILD, count);
    }
}

#[test]
fn every_function_of_wild_numbers_has_the_bits_of_one_point() {
    for (function, small) in at_points() {
        let x = Op::Input(Symbol::Coordinate(0));
        let y = Op::Input(Symbol::Coordinate(1));
        let call = match function.arity() {
            1 => Op::Unary(function, small, Value(0)),
            _ => Op::Binary(function, Value(0), Value(1)),
        };
        let outputs = SortedMap::from([(quantity(), vec![Value(2)])]);
        let program = in_stage_order(vec![x, y, call], outputs);
        hold::<f64>(&program, &WILD, 300);
        hold::<f32>(&program, &WILD, 300);
        hold::<f64>(&program, &[-0.0, 1e-320, 0.25, -3.0], 9);
    }
}

/// 1e13 times the time is an angle of many turns, in either unit.
#[test]
fn whole_turns_are_taken_off_as_at_one_point() {
    for (within, wave) in
        [(Function::WithinTurns, Function::Sin), (Function::WithinTurnsPi, Function::CosPi)]
    {
        let ops = vec![
            Op::Constant(Rational::from(10_000_000_000_000_i64)),
            Op::Input(Symbol::Time),
            Op::Multiply(Value(0), Value(1)),
            Op::Unary(within, None, Value(2)),
            Op::Input(Symbol::Coordinate(0)),
            Op::Subtract(Value(4), Value(3)),
            Op::Unary(wave, None, Value(5)),
        ];
        let outputs = SortedMap::from([(quantity(), vec![Value(6)])]);
        let program = in_stage_order(ops, outputs);
        hold::<f64>(&program, &MILD, 130);
        hold::<f32>(&program, &MILD, 260);
        hold::<Double>(&program, &MILD, 65);
    }
}

/// In a sum with a product that has one reader, each operand may be the same at all points, and have either sign.
#[test]
fn fused_products_round_once_or_twice_as_they_should() {
    let [x, y] = [0, 1].map(|axis| Op::Input(Symbol::Coordinate(axis)));
    let [a, b] = [0, 1].map(|index| Op::Input(Symbol::Parameter(index)));
    let mut kinds = 0;
    for factors in [[2, 3], [2, 0], [0, 3]] {
        for term in [0, 1, 2, 3] {
            let [first, second] = factors.map(Value);
            let product = Op::Multiply(first, second);
            for sum in [
                Op::Add(Value(4), Value(term)),
                Op::Subtract(Value(4), Value(term)),
                Op::Subtract(Value(term), Value(4)),
            ] {
                let ops = vec![a.clone(), b.clone(), x.clone(), y.clone(), product.clone(), sum];
                let outputs = SortedMap::from([(Output::Expected(0), vec![Value(5)])]);
                let program = in_stage_order(ops, outputs);
                let plan = plan_of(&program, &[Output::Expected(0)]);
                hold::<f64>(&program, &MILD, 40);
                hold::<f32>(&program, &MILD, 40);
                validate_to_one_rounding(&program, &Arc::new(plan));
                kinds += 1;
            }
        }
    }
    assert_eq!(kinds, 36);
}

/// If products are fused, the result equals the sum in twice the digits: a product of two numbers is exact there.
fn validate_to_one_rounding(program: &Program, plan: &Arc<BlockPlan>) {
    let points = given::<f64>(40, &MILD);
    let wide: Vec<_> = given::<Double>(40, &MILD);
    let expected = one_by_one(program, &[Output::Expected(0)], &wide);
    for instructions in Instructions::all().filter(|it| *it != Instructions::BASELINE) {
        let prepared = prepared(plan, BlockMode::fused_with(instructions));
        let found = in_blocks(&prepared, &mut Scratch::default(), 1, &points);
        for (found, expected) in found.iter().zip(&expected) {
            assert_eq!(found[0].to_bits(), expected[0].to_f64().to_bits());
        }
    }
}

#[test]
fn other_parameters_and_times_are_those_of_a_plan_made_anew() {
    // sin(p0 p1 + t) X + (p0 p1 + t) and t Y.
    let mut ops = leaves();
    let place =
        |leaf: Op| Value(leaves().iter().position(|it| *it == leaf).expect("a leaf") as u32);
    let [p, q] = [0, 1].map(|index| place(Op::Input(Symbol::Parameter(index))));
    let [x, y] = [0, 1].map(|axis| place(Op::Input(Symbol::Coordinate(axis))));
    let mut push = |op: Op| {
        ops.push(op);
        Value(ops.len() as u32 - 1)
    };
    let product = push(Op::Multiply(p, q));
    let angle = push(Op::Add(product, place(Op::Input(Symbol::Time))));
    let sine = push(Op::Unary(Function::Sin, None, angle));
    let wave = push(Op::Multiply(sine, x));
    let results =
        vec![push(Op::Add(wave, angle)), push(Op::Multiply(y, place(Op::Input(Symbol::Time))))];
    let outputs = [Output::Expected(0)];
    let program = in_stage_order(ops, SortedMap::from([(outputs[0], results)]));
    let plan = Arc::new(plan_of(&program, &outputs));
    let points = given::<f64>(70, &MILD);
    let mut changed = Prepared::new(plan.clone(), BlockMode::portable(), &[0.2, 0.4]);
    let mut scratch = Scratch::default();
    let before = in_blocks(&changed, &mut scratch, outputs.len(), &points);
    changed.set(&PARAMETERS);
    let after = in_blocks(&changed, &mut scratch, outputs.len(), &points);
    assert_ne!(before, after);
    agree(&after, &one_by_one(&program, &outputs, &points), "parameters set again");
    let mut at = |time: f64| {
        let mut found = Vec::new();
        let point = &points[0];
        changed.run(
            &mut scratch,
            time,
            1,
            &mut |_, inputs| inputs.columns().for_each(|(it, column)| column[0] = point.of(it)),
            &mut |_, results| found.extend(results.components(0).map(|it| it.at(0).to_bits())),
        );
        found
    };
    let (first, second) = (at(0.37), at(0.38));
    assert_ne!(first, second);
    assert_eq!(first, at(0.37));
    // A zero of the other sign is another time.
    let zeros =
        [at(0.0), at(-0.0), at(0.0)].map(|found| f64::from_bits(found[1]).is_sign_negative());
    assert_eq!(zeros, [false, true, false]);
}

#[test]
fn threads_share_a_plan_and_its_parameters() {
    let program = everything();
    let outputs: Vec<Output> = program.outputs.keys().copied().collect();
    let prepared = prepared::<f64>(&Arc::new(plan_of(&program, &outputs)), BlockMode::fused());
    let points = given::<f64>(1000, &MILD);
    let expected = in_blocks(&prepared, &mut Scratch::default(), outputs.len(), &points);
    let pool = ScratchPool::default();
    std::thread::scope(|scope| {
        for thread in 0..8 {
            let (prepared, pool, points, expected) = (&prepared, &pool, &points, &expected);
            scope.spawn(move || {
                for round in 0..20 {
                    // Whole blocks, so that the same blocks are computed again.
                    let from = f64::BLOCK * ((thread + round) % 8);
                    let found =
                        pool.with(|scratch| in_blocks(prepared, scratch, 3, &points[from..]));
                    agree(&found, &expected[from..], thread);
                }
            });
        }
    });
}

#[test]
fn an_output_has_the_bits_that_it_has_alone_beside_others() {
    // Only sums and products: a block with a value that is not a number is computed again.
    let recipe: Vec<_> =
        (0..60_u16).map(|k| ((k * 5 % 22) as u8, 0x4000 | k << 8, !(17 * k))).collect();
    let program = program(&recipe);
    let points = given::<f64>(100, &MILD);
    let outputs: Vec<Output> = program.outputs.keys().copied().collect();
    let found = |outputs: &[Output]| {
        let plan = Arc::new(plan_of(&program, outputs));
        in_blocks(
            &prepared(&plan, BlockMode::fused()),
            &mut Scratch::default(),
            outputs.len(),
            &points,
        )
    };
    let together = found(&outputs);
    let alone: Vec<_> = outputs.iter().map(|output| found(&[*output])).collect();
    for (point, together) in together.iter().enumerate() {
        let alone: Vec<f64> = alone.iter().flat_map(|output| output[point].clone()).collect();
        agree(std::slice::from_ref(together), &[alone], point);
    }
}
