//! Dual numbers of several directions, compared with dual numbers of one direction.

use mms_math::Scalar as _;
use mms_program::dual::Dual;
use mms_program::interpret::Number;
use mms_program::interpret::{binary, unary};
use mms_program::interval::Interval;
use mms_program::multi_dual::{Bounds, MultiDual};
use mms_symbolic::expr::Function;
use mms_symbolic::expr::Small;

/// The results of all operations on two numbers.
fn made<T: Number>(x: T, y: T) -> Vec<T> {
    let mut made = vec![
        x.clone() + y.clone(),
        x.clone() - y.clone(),
        y.clone() - x.clone(),
        x.clone() * y.clone(),
        y.clone() / x.clone(),
        x.clone() / y.clone(),
        -x.clone(),
        x.clone().square(),
        binary(Function::Atan2, x.clone(), y.clone()),
        binary(Function::Powf, x.clone(), y.clone()),
        binary(Function::Powf, y.clone(), x.clone()),
    ];
    let functions = Function::ALL.iter().filter(|function| function.arity() == 1);
    let functions = functions.map(|function| (*function, None));
    let small = [Small::NearZero, Small::WithinOne].map(Some);
    let small = [Function::Sin, Function::Cos].map(|function| small.map(|it| (function, it)));
    let functions = functions.chain(small.into_iter().flatten());
    made.extend(functions.map(|(function, small)| unary(function, small, x.clone() * y.clone())));
    let whole = made.iter().cloned().reduce(|sum, term| sum + term);
    made.extend(whole);
    made
}

/// Compares a direction in which x changes, one in which y does, and one in which neither does.
fn assert_same<T: Bounds>(x: T, y: T, is_same: impl Fn(T, T) -> bool) {
    let of_fan = made(MultiDual::variable(x, 1), MultiDual::variable(y, 4));
    for (direction, moves) in [(1, [1.0, 0.0]), (4, [0.0, 1.0]), (2, [0.0, 0.0])] {
        let [a, b] = [0, 1].map(|it: usize| T::from_f64(moves[it]));
        let of_dual = made(Dual { value: x, slope: a }, Dual { value: y, slope: b });
        for (index, (fan, dual)) in of_fan.iter().zip(of_dual).enumerate() {
            assert!(is_same(fan.value, dual.value), "value {index}: {fan:?}, {dual:?}");
            let slope = fan.slope(direction);
            assert!(is_same(slope, dual.slope), "slope {index}: {slope:?}, {:?}", dual.slope);
        }
    }
}

/// Bounds of boxes where everything is defined, where roots and powers end, and where nothing is known.
#[test]
fn a_fan_has_the_bounds_of_dual_numbers() {
    let boxes = [
        [Interval::new(0.25, 0.5), Interval::new(0.125, 0.75)],
        [Interval::new(0.0, 0.5), Interval::new(0.25, 0.25)],
        [Interval::new(-0.5, 0.5), Interval::new(0.5, 2.0)],
        [Interval::UNDEFINED, Interval::new(0.5, 2.0)],
        [Interval::from_f64(0.0), Interval::from_f64(0.5)],
    ];
    for [x, y] in boxes {
        // The sign of 0 is irrelevant for a bound.
        let is_same = |a: Interval, b: Interval| {
            (a.is_defined() == b.is_defined())
                && (!a.is_defined() || a.lower() == b.lower() && a.upper() == b.upper())
        };
        assert_same(x, y, is_same);
        let [x, y] = [(x, 1.0), (y, -0.5)]
            .map(|(value, slope)| Dual { value, slope: Interval::from_f64(slope) });
        assert_same(x, y, |a, b| is_same(a.value, b.value) && is_same(a.slope, b.slope));
    }
}
