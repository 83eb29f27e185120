//! The cost of an operation in intervals and in many digits, in the steps of [`mms_symbolic::work`].

use mms_symbolic::expr::{Function, Rational, steps_of_length};

/// The steps of an operation on intervals.
const OF_INTERVALS: u64 = 4;
/// The steps of a function at both bounds of an interval, by sums of doubles.
const QUICK: u64 = 150;
/// The steps of a function at both bounds of an interval, in arbitrary precision.
const SLOW: u64 = 15_000;
/// The steps in arbitrary precision of functions that take several times as much.
const SLOWER: u64 = 40_000;

/// The largest angle that is reduced quickly.
const LARGEST_QUICK_ANGLE: f64 = 1e5;
/// The further steps per bit of an angle that is reduced in arbitrary precision.
const FOR_EACH_BIT: f64 = 80.0;

/// The steps of an operation in 256 bits.
const OF_DIGITS: u64 = 40;
/// The steps of a function in 256 bits by a short series.
const SHORT: u64 = 6_000;
/// The steps of a function in 256 bits by a long series, or by several.
const LONG: u64 = 12_000;

/// The steps of rounding a number.
const ROUNDED: u64 = 20;

/// Whether the magnitude of each bound is 0 or infinite, where values are known, or within this range, where sums of doubles
/// decide.
fn is_within(bounds: [f64; 2], least: f64, greatest: f64) -> bool {
    let is_told =
        |size: f64| size == 0.0 || size.is_infinite() || (least..greatest).contains(&size);
    bounds.into_iter().all(|bound| is_told(bound.abs()))
}

/// The steps of an operation on intervals, or of a function of an interval with these bounds.
pub fn of_interval(function: Option<Function>, [lower, upper]: [f64; 2]) -> u64 {
    let Some(function) = function else { return OF_INTERVALS };
    let farthest = lower.abs().max(upper.abs());
    match function {
        Function::WithinTurns | Function::WithinTurnsPi => OF_INTERVALS,
        Function::Sin | Function::Cos | Function::SinPi | Function::CosPi | Function::Tan
            if farthest > LARGEST_QUICK_ANGLE =>
        {
            SLOW + (FOR_EACH_BIT * farthest.log2().min(1024.0)) as u64
        }
        // Near 0 the value is too close to the argument for the fast way to separate them.
        Function::Sin | Function::SinPi if lower != 0.0 && lower.abs().min(upper.abs()) < 1e-8 => {
            SLOW
        }
        Function::Exp if !is_within([lower, upper], 1e-20, 600.0) => SLOW,
        Function::Ln1p | Function::Ln1pRest if !is_within([lower, upper], 1e-10, 1e200) => SLOW,
        Function::Sqrt | Function::Cbrt | Function::Ln | Function::Powf
            if !is_within([lower, upper], 1e-200, 1e200) =>
        {
            SLOWER
        }
        Function::Sqrt
        | Function::Cbrt
        | Function::Exp
        | Function::Ln
        | Function::Ln1p
        | Function::Ln1pRest
        | Function::Sin
        | Function::SinPi
        | Function::Cos
        | Function::CosPi => QUICK,
        Function::Powf => 8 * QUICK,
        Function::Asin | Function::Acos | Function::Atan | Function::Atan2 => SLOWER,
        _ => SLOW,
    }
}

/// The steps of an operation in this many bits, or of a function of a number with this binary exponent.
pub fn of_digits(function: Option<Function>, bits: usize, exponent: isize) -> u64 {
    let words = (bits / 256) as u64;
    let Some(function) = function else { return OF_DIGITS * words };
    let of_few = match function {
        Function::WithinTurns | Function::WithinTurnsPi => OF_DIGITS,
        Function::Sqrt | Function::Cbrt => 4 * OF_DIGITS,
        // A large angle is reduced with as many more digits.
        Function::Sin | Function::SinPi | Function::Cos | Function::CosPi | Function::Tan => {
            SHORT + SHORT * exponent.clamp(0, 1 << 12) as u64 / 256
        }
        Function::Exp | Function::ExpM1 => SHORT,
        _ => LONG,
    };
    of_few * words * words
}

/// The steps of rounding a number.
pub fn of_constant(number: &Rational) -> u64 {
    ROUNDED + steps_of_length(number)
}
