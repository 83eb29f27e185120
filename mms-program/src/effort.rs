//! What an operation takes in intervals and in many digits, in the steps of [`mms_symbolic::work`].

use mms_symbolic::expr::{Function, Rational, steps_of_length};

/// An operation on intervals, and a function at both bounds: by sums of doubles, in arbitrary precision, and one that is
/// made of several of these.
const OF_INTERVALS: u64 = 4;
const QUICK: u64 = 150;
const SLOW: u64 = 15_000;
const SLOWER: u64 = 40_000;

/// Angles beyond this are reduced in arbitrary precision, with so much more for each of their bits.
const LARGEST_QUICK_ANGLE: f64 = 1e5;
const FOR_EACH_BIT: f64 = 80.0;

/// An operation in 256 bits, and a function: a short series, and a long one or several.
const OF_DIGITS: u64 = 40;
const SHORT: u64 = 6_000;
const LONG: u64 = 12_000;

/// A number that is rounded.
const ROUNDED: u64 = 20;

/// Whether the magnitude of each bound is 0 or infinite, where functions are known, or between these, where sums of doubles tell
/// them.
fn is_within(bounds: [f64; 2], least: f64, greatest: f64) -> bool {
    let is_told =
        |size: f64| size == 0.0 || size.is_infinite() || (least..greatest).contains(&size);
    bounds.into_iter().all(|bound| is_told(bound.abs()))
}

/// What an operation on intervals takes, or a function of one between these bounds.
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
        // Near 0 the value is too near to the argument for the fast way to tell them apart.
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

/// What an operation takes in so many bits, or a function of a number of this exponent of two.
pub fn of_digits(function: Option<Function>, bits: usize, exponent: isize) -> u64 {
    let words = (bits / 256) as u64;
    let Some(function) = function else { return OF_DIGITS * words };
    let of_few = match function {
        Function::WithinTurns | Function::WithinTurnsPi => OF_DIGITS,
        Function::Sqrt | Function::Cbrt => 4 * OF_DIGITS,
        // A large angle is reduced in as many more digits.
        Function::Sin | Function::SinPi | Function::Cos | Function::CosPi | Function::Tan => {
            SHORT + SHORT * exponent.clamp(0, 1 << 12) as u64 / 256
        }
        Function::Exp | Function::ExpM1 => SHORT,
        _ => LONG,
    };
    of_few * words * words
}

/// What it takes to round a number.
pub fn of_constant(number: &Rational) -> u64 {
    ROUNDED + steps_of_length(number)
}
