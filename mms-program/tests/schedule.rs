//! Schedules, compared by their operations.

use mms_program::Op;
use mms_program::interpret::{Interpreter, Point};
use mms_program::schedule::{Cost, Steps, schedule};
use mms_symbolic::expr::{Expr, Graph, Stage};
use mms_symbolic::expr::{Rational, Symbol};
use mms_symbolic::sorted::SortedMap;

/// 256 X (a X + t Y) and 256 Y (a Y + t X); without a if `bare`.
fn components(graph: &mut Graph, bare: bool) -> Vec<Expr> {
    let a = graph.symbol(Symbol::Parameter(0));
    let t = graph.symbol(Symbol::Time);
    let [x, y] = [0, 1].map(|axis| graph.symbol(Symbol::Coordinate(axis)));
    let mut component = |x: Expr, y: Expr| {
        let first = if bare { x } else { graph.mul(a, x) };
        let second = graph.mul(t, y);
        let sum = graph.add(first, second);
        let product = graph.mul(x, sum);
        graph.scale(product, 256)
    };
    vec![component(x, y), component(y, x)]
}

fn scheduled(bare: bool) -> (usize, Vec<f64>) {
    let mut graph = Graph::default();
    let components = components(&mut graph, bare);
    let output = 0;
    let program = schedule(&graph, &SortedMap::from([(output, components)]));
    let operations = program.operations(&[output]);
    let mut interpreter = Interpreter::new(&program, &[0.75]);
    interpreter.set_time(&0.5);
    interpreter.set_point(&interpreter.plan(&[output]), Point::at(&[1.5, -0.25]));
    let at_point = operations[&Stage::Point] + operations[&Stage::PointTime];
    (at_point, interpreter.output(output))
}

#[test]
fn numbers_move_into_sums_where_that_costs_nothing_at_a_point() {
    // Each component: two products, a sum and X times it. Everything else does not depend on X.
    assert_eq!(scheduled(false), (8, vec![384.0, -36.0]));
    // A term without an early factor leaves 256 at the point.
    assert_eq!(scheduled(true).0, 8);
}

/// The operations of the one output that is scheduled for an expression, outputs last.
fn operations(graph: &Graph, root: Expr) -> Vec<Op> {
    let program = schedule(graph, &SortedMap::from([(0, vec![root])]));
    program.instrs.into_iter().map(|instr| instr.op).collect()
}

#[test]
fn products_of_points_are_added_to_constants_and_differences_of_coordinates_are_not() {
    let mut graph = Graph::default();
    let a = graph.symbol(Symbol::Parameter(0));
    let [x, y] = [0, 1].map(|axis| graph.symbol(Symbol::Coordinate(axis)));
    let (one, minus_one) = (Rational::ONE, Rational::NEG_ONE);
    let last_two = |graph: &Graph, root: Expr| {
        let operations = operations(graph, root);
        operations[operations.len() - 2..].to_vec()
    };
    // (x - y) + a: the difference is exact where x and y are large.
    let root = graph.sum([(a, one.clone()), (x, one.clone()), (y, minus_one.clone())]);
    assert!(matches!(last_two(&graph, root)[..], [Op::Subtract(..), Op::Add(..)]));
    // (a + x^2) - y^2: two multiply-adds.
    let [x, y] = [x, y].map(|it| graph.mul(it, it));
    let root = graph.sum([(a, one.clone()), (x, one), (y, minus_one)]);
    assert!(matches!(last_two(&graph, root)[..], [Op::Add(..), Op::Subtract(..)]));
}

#[test]
fn what_x_determines_is_divided_before_it_is_multiplied_by_parameters() {
    let mut graph = Graph::default();
    let a = graph.symbol(Symbol::Parameter(0));
    let [x, y] = [0, 1].map(|axis| graph.symbol(Symbol::Coordinate(axis)));
    let factors = [(a, Rational::ONE), (x, Rational::ONE), (y, Rational::NEG_ONE)];
    let root = graph.product(factors);
    let operations = operations(&graph, root);
    assert!(matches!(operations[3..], [Op::Divide(..), Op::Multiply(..)]), "{operations:?}");
}

#[test]
fn fewer_steps_are_not_bought_with_more_at_each_time_or_elsewhere() {
    let cost = Cost { per_point: 32, total: 40, late: 16 };
    let before = Steps { per_point: 20, cost, late: 10 };
    let better = Steps { per_point: 19, ..before };
    assert!(before.is_worth(better));
    assert!(!before.is_worth(before));
    assert!(!before.is_worth(Steps { late: 11, ..better }));
    let with = |per_point, total| Steps { cost: Cost { per_point, total, late: 16 }, ..better };
    // A sixteenth more operations at a point, and eight that are done once.
    assert!(before.is_worth(with(34, 50)));
    assert!(!before.is_worth(with(35, 51)));
    assert!(!before.is_worth(with(34, 51)));
}
