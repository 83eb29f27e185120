//! Infinities, zeros, domain errors, and the ends of the range, as `f64` has them.

use mms_math::{Double, Scalar};

use super::sample::Random;
use super::sample::Range::{Between, Magnitudes};
use super::{COUNT, magnitude, of};

#[test]
fn what_is_not_an_ordinary_number_follows_f64() {
    const SPECIAL: [f64; 22] = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        0.5,
        -0.5,
        2.0,
        -2.0,
        3.0,
        -3.0,
        2.5,
        -2.5,
        1e300,
        -1e300,
        1e-320,
        -1e-320,
        1000.0,
        -1000.0,
        f64::MAX,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::NAN,
    ];
    type Pair = (&'static str, fn(Double) -> Double, fn(f64) -> f64);
    let unary: [Pair; 17] = [
        ("neg", |x| -x, |x| -x),
        ("sqrt", Scalar::sqrt, Scalar::sqrt),
        ("cbrt", Scalar::cbrt, Scalar::cbrt),
        ("exp", Scalar::exp, Scalar::exp),
        ("exp_m1", Scalar::exp_m1, Scalar::exp_m1),
        ("ln", Scalar::ln, Scalar::ln),
        ("ln_1p", Scalar::ln_1p, Scalar::ln_1p),
        ("sinh", Scalar::sinh, Scalar::sinh),
        ("cosh", Scalar::cosh, Scalar::cosh),
        ("tanh", Scalar::tanh, Scalar::tanh),
        ("asin", Scalar::asin, Scalar::asin),
        ("acos", Scalar::acos, Scalar::acos),
        ("atan", Scalar::atan, Scalar::atan),
        ("sin", Scalar::sin, Scalar::sin),
        ("cos", Scalar::cos, Scalar::cos),
        ("tan", Scalar::tan, Scalar::tan),
        ("ln_1p_rest", Scalar::ln_1p_rest, |x| if x == f64::INFINITY { x } else { x - x.ln_1p() }),
    ];
    let large_angle = |name, x: f64| matches!(name, "sin" | "cos" | "tan") && x.abs() > 1e15;
    for (name, function, of_f64) in unary {
        for x in SPECIAL {
            let found = function(of(x));
            if large_angle(name, x) {
                assert!(found.to_f64().is_nan(), "{name} of {x}: {found:?}");
            } else {
                follows(name, &[x], found, of_f64(x));
            }
        }
    }
    type Triple = (&'static str, fn(Double, Double) -> Double, fn(f64, f64) -> f64);
    let binary: [Triple; 6] = [
        ("add", |a, b| a + b, |a, b| a + b),
        ("sub", |a, b| a - b, |a, b| a - b),
        ("mul", |a, b| a * b, |a, b| a * b),
        ("div", |a, b| a / b, |a, b| a / b),
        ("atan2", Scalar::atan2, Scalar::atan2),
        ("powf", Scalar::powf, Scalar::powf),
    ];
    for (name, function, of_f64) in binary {
        for a in SPECIAL {
            for b in SPECIAL {
                follows(name, &[a, b], function(of(a), of(b)), of_f64(a, b));
            }
        }
    }
}

/// Asserts the same kind of number and the same sign of zero; for ordinary numbers, closeness.
fn follows(name: &str, arguments: &[f64], found: Double, expected: f64) {
    let (high, low) = (found.to_f64(), found.low());
    let agrees = if expected.is_nan() {
        high.is_nan()
    } else if expected == 0.0 || expected.is_infinite() {
        high == expected && high.is_sign_negative() == expected.is_sign_negative() && low == 0.0
    } else {
        (high - expected).abs() <= 4.0 * f64::EPSILON * expected.abs() + 1e-323
    };
    assert!(agrees, "{name} of {arguments:?}: {found:?}, not {expected}");
}

/// Near underflow, and where an intermediate product would overflow, at least the digits of `f64` remain.
#[test]
fn near_the_ends_of_the_range_digits_of_f64_are_left() {
    let mut random = Random(9);
    for range in [Magnitudes(-1070.0, -960.0), Magnitudes(1020.0, 1023.99)] {
        for _ in 0..COUNT {
            let (a, b) = (random.of(range), random.of(Between(0.5, 2.0)));
            let (x, y) = (a.to_f64(), b.to_f64());
            follows("mul", &[x, y], a * b, x * y);
            follows("div", &[x, y], a / b, x / y);
            follows("add", &[x, x], a + a, x + x);
            follows("sub", &[y, x], b - a, y - x);
            follows("sqrt", &[x.abs()], magnitude(a).sqrt(), x.abs().sqrt());
            follows("cbrt", &[x], a.cbrt(), x.cbrt());
            follows("atan2", &[x, y], a.atan2(b), x.atan2(y));
            follows("ln", &[x.abs()], magnitude(a).ln(), x.abs().ln());
        }
    }
}
