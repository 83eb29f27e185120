//! Values of expressions in any scalar, and the test whether two of them are the same.

use mms_math::Scalar as _;
use mms_mechanics::{Output, Program};
use mms_program::interpret::{Interpreter, Number, Point};
use mms_program::interval::Interval;
use mms_program::precise::Precise;
use mms_program::schedule::schedule;
use mms_symbolic::expr::{Expr, Graph, Rational};
use mms_symbolic::sorted::SortedMap;
use proptest::prelude::*;

use super::recipe::SpaceTimePoint;

/// The value of each root at a place, by its program.
pub fn values<T: Number>(graph: &Graph, roots: &[Expr], at: &SpaceTimePoint<T>) -> Vec<T> {
    let outputs = SortedMap::from([(Output::Expected(0), roots.to_vec())]);
    run(&schedule(graph, &outputs), at)
}

/// The values of the first output of a program at a place.
pub fn run<T: Number>(program: &Program, at: &SpaceTimePoint<T>) -> Vec<T> {
    assert_is_ordered(program);
    let mut interpreter = Interpreter::new(program, &[]);
    interpreter.set_time(&at.time);
    let plan = interpreter.plan(&[Output::Expected(0)]);
    interpreter.set_point(&plan, Point::at(&at.coordinates));
    interpreter.output(Output::Expected(0))
}

/// Asserts that operands precede their users, and are known no later.
fn assert_is_ordered(program: &Program) {
    for (index, instr) in program.instrs.iter().enumerate() {
        for operand in instr.op.operands() {
            assert!(operand.index() < index, "{program}");
            let stage = program.instr(operand).stage;
            assert_eq!(stage.join(instr.stage), instr.stage, "{program}");
        }
    }
}

pub fn ratio(numerator: i32, denominator: u32) -> Precise {
    Precise::new(&Rational::from_parts(numerator.into(), denominator.into()))
}

pub fn power_of_ten(exponent: u32) -> Precise {
    let denominator = dashu_int::UBig::from(10u8).pow(exponent as usize);
    Precise::from_rational(&Rational::from_parts(1.into(), denominator))
}

/// A place at exact doubles.
pub fn place(x: f64, y: f64, t: f64) -> SpaceTimePoint<Precise> {
    let [x, y, time] = [x, y, t].map(Precise::from_f64);
    SpaceTimePoint { coordinates: [x, y], time }
}

/// Whether two values differ by at most 10^-digits of a scale.
pub fn close(a: &Precise, b: &Precise, scale: f64, digits: u32) -> bool {
    let difference = (a.clone() - b.clone()).magnitude();
    difference.at_most(&(Precise::from_f64(scale) * power_of_ten(digits)))
}

/// The largest number of a computation, to which its rounding errors are relative.
#[derive(Clone, Copy, Debug)]
pub struct Extent(f64);

impl Extent {
    pub fn new() -> Self {
        Extent(1.0)
    }

    pub fn see(&mut self, value: &Precise) {
        let magnitude = value.to_f64().abs();
        // A rounded zero such as sin(pi): quotients and roots of it are meaningless.
        let rounded = magnitude > 0.0 && magnitude < 1e-50;
        if rounded {
            self.0 = f64::INFINITY;
        } else if value.is_defined() {
            self.0 = self.0.max(magnitude);
        }
    }

    /// The scale, if a comparison to 40 digits is meaningful at it.
    pub fn moderate(self) -> Option<f64> {
        (self.0 < 1e15).then_some(self.0 * self.0)
    }
}

/// The value of an expression, and the largest value of its parts.
pub fn value_and_extent(
    graph: &Graph,
    root: Expr,
    at: &SpaceTimePoint<Precise>,
) -> (Precise, Extent) {
    let parts: Vec<Expr> = graph.reachable(&[root]).into_iter().collect();
    let mut extent = Extent::new();
    let values = values(graph, &parts, at);
    values.iter().for_each(|value| extent.see(value));
    let position = parts.iter().position(|part| *part == root).expect("reachable");
    (values[position].clone(), extent)
}

/// Places of either sign, none of them special.
pub fn places() -> Vec<SpaceTimePoint<Precise>> {
    [
        (0.846_1, -0.4, 0.428_6),
        (-0.731, 0.377, 0.917),
        (2.183, 1.297, -0.613),
        (-3.371, -2.039, 1.751),
    ]
    .map(|(x, y, t)| place(x, y, t))
    .into()
}

/// Asserts that two expressions are one function: they are defined at the same places and equal there, to 40 of 77 digits, and
/// no box separates their intervals. Every pass must preserve this.
pub fn same_value(graph: &Graph, before: Expr, after: Expr) -> Result<(), TestCaseError> {
    for at in places() {
        let (a, extent) = value_and_extent(graph, before, &at);
        let (b, other) = value_and_extent(graph, after, &at);
        let (Some(scale), Some(_)) = (extent.moderate(), other.moderate()) else { continue };
        let shown = format!("{:e} became {:e} at {at:?}", a.to_f64(), b.to_f64());
        prop_assert_eq!(a.is_defined(), b.is_defined(), "{}", shown);
        prop_assert!(!a.is_defined() || close(&a, &b, scale, 40), "{}", shown);
    }
    for (x, y, t) in [(0.25, -0.5, 0.125), (-1.5, 0.75, 2.0), (3.0, 2.5, -1.25)] {
        let around = |value: f64| Interval::new(value - 0.0625, value + 0.0625);
        let at = SpaceTimePoint { coordinates: [around(x), around(y)], time: around(t) };
        let boxes = values(graph, &[before, after], &at);
        let values = values(graph, &[before, after], &place(x, y, t));
        let [greatest_lower, least_upper] =
            [boxes[0].lower().max(boxes[1].lower()), boxes[0].upper().min(boxes[1].upper())];
        prop_assert!(greatest_lower <= least_upper, "{boxes:?} are apart at {x}, {y}, {t}");
        for (bounds, value) in boxes.iter().zip(&values) {
            prop_assert!(holds(*bounds, value), "{:e} is not in {bounds:?}", value.to_f64());
        }
    }
    Ok(())
}

/// Whether a value lies within the bounds that were computed for it. The value itself has an error of about 1e-70 of the
/// numbers that it was computed from, which the nearest doubles do not show.
pub fn holds(bounds: Interval, value: &Precise) -> bool {
    !value.is_defined() || {
        let value = value.to_f64();
        bounds.contains(value)
            || bounds.contains(value.next_up())
            || bounds.contains(value.next_down())
    }
}
