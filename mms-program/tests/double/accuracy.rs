//! Errors compared with 77 digits, in units of 2^-104 of the true value.
//!
//! The bounds are the errors at several times as many arguments, rounded up a little.

use mms_math::{Double, Scalar};
use mms_program::precise::Precise;

use super::sample::Random;
use super::sample::Range::{
    self, Above, Around, Below, Between, Magnitudes, Positive, QuarterTurns, QuartersOfHalves,
};
use super::{COUNT, exact, rounded};
use crate::sampled::sampled_count;

/// The error in units of 2^-104 of the true value; infinite if one is 0 or undefined and the other is not.
fn error(found: Double, expected: &Precise) -> f64 {
    let zero = Precise::from_f64(0.0);
    if !expected.is_defined() || expected.clone().magnitude().at_most(&zero) {
        let agrees = if expected.is_defined() { found == 0.0.into() } else { found.low().is_nan() };
        return if agrees { 0.0 } else { f64::INFINITY };
    }
    let relative = (exact(found) - expected.clone()) / expected.clone();
    let relative = relative.magnitude().to_f64();
    // A NaN is not an error of 0.
    if relative.is_nan() { f64::INFINITY } else { relative * 104_f64.exp2() }
}

/// A function of one argument, its reference, its bound, and the range of its arguments.
struct Unary {
    name: &'static str,
    function: fn(Double) -> Double,
    reference: fn(Precise) -> Precise,
    bound: f64,
    ranges: &'static [Range],
}

/// A function of two arguments, likewise: the ranges are in pairs.
struct Binary {
    name: &'static str,
    function: fn(Double, Double) -> Double,
    reference: fn(Precise, Precise) -> Precise,
    bound: f64,
    ranges: &'static [(Range, Range)],
}

/// The largest error in a range, and the argument that has it.
fn worst<T: core::fmt::Debug>(mut sample: impl FnMut(&mut Random) -> (T, f64)) -> (f64, String) {
    let mut random = Random(2026);
    let mut largest = (0.0, String::new());
    for _ in 0..sampled_count(COUNT, 3) {
        let (argument, error) = sample(&mut random);
        if error > largest.0 {
            largest = (error, format!("{argument:?}"));
        }
    }
    largest
}

fn judge(name: &str, range: &dyn core::fmt::Debug, bound: f64, (error, at): (f64, String)) {
    assert!(error <= bound, "{name} of {range:?}: {error} units at {at}, bound {bound}");
    println!("{name} of {range:?}: {error}");
}

fn check_unary(cases: &[Unary]) {
    for case in cases {
        for &range in case.ranges {
            let largest = worst(|random| {
                let x = random.of(range);
                (x, error((case.function)(x), &(case.reference)(exact(x))))
            });
            judge(case.name, &range, case.bound, largest);
        }
    }
}

fn check_binary(cases: &[Binary]) {
    for case in cases {
        for &(first, second) in case.ranges {
            let largest = worst(|random| {
                let (a, b) = (random.of(first), random.of(second));
                let expected = (case.reference)(exact(a), exact(b));
                ((a, b), error((case.function)(a, b), &expected))
            });
            judge(case.name, &(first, second), case.bound, largest);
        }
    }
}

/// sin(pi x) with the nearest integer subtracted first, which is exact: next to large integers 77 digits of pi are too few.
fn sin_pi(x: Precise) -> Precise {
    let count = x.to_f64().round();
    let sine = ((x - Precise::from_f64(count)) * Precise::pi()).sin();
    if count % 2.0 == 0.0 { sine } else { -sine }
}

fn cos_pi(x: Precise) -> Precise {
    sin_pi(x + Precise::from_f64(0.5))
}

#[test]
fn arithmetic_keeps_104_bits() {
    check_binary(&[
        Binary {
            name: "a + b",
            function: |a, b| a + b,
            reference: |a, b| a + b,
            bound: 0.6,
            ranges: &[
                (Magnitudes(-900.0, 1018.0), Magnitudes(-900.0, 1018.0)),
                (Magnitudes(-60.0, 60.0), Magnitudes(-60.0, 60.0)),
                (Between(0.5, 2.0), Between(-2.0, -0.5)),
                (Around(1.0, -110.0, -40.0), Around(-1.0, -110.0, -40.0)),
            ],
        },
        Binary {
            name: "a - b",
            function: |a, b| a - b,
            reference: |a, b| a - b,
            bound: 0.6,
            ranges: &[
                (Between(0.5, 2.0), Between(0.5, 2.0)),
                (Around(1.0, -110.0, -40.0), Around(1.0, -110.0, -40.0)),
            ],
        },
        Binary {
            name: "a * b",
            function: |a, b| a * b,
            reference: |a, b| a * b,
            bound: 1.0,
            ranges: &[
                (Magnitudes(-480.0, 510.0), Magnitudes(-480.0, 510.0)),
                (Between(1.0, 2.0), Between(1.0, 2.0)),
            ],
        },
        Binary {
            name: "a / b",
            function: |a, b| a / b,
            reference: |a, b| a / b,
            bound: 1.0,
            ranges: &[
                (Magnitudes(-480.0, 510.0), Magnitudes(-500.0, 480.0)),
                (Between(1.0, 2.0), Between(1.0, 2.0)),
            ],
        },
    ]);
}

#[test]
fn roots_exponentials_and_logarithms_keep_their_digits() {
    check_unary(&[
        Unary {
            name: "sqrt",
            function: Scalar::sqrt,
            reference: Scalar::sqrt,
            bound: 1.0,
            ranges: &[Positive(-960.0, 1020.0), Between(1.0, 4.0)],
        },
        Unary {
            name: "cbrt",
            function: Scalar::cbrt,
            reference: Scalar::cbrt,
            bound: 1.5,
            ranges: &[Magnitudes(-960.0, 1020.0), Between(1.0, 8.0)],
        },
        Unary {
            name: "exp",
            function: Scalar::exp,
            reference: Scalar::exp,
            bound: 1.0,
            ranges: &[Between(-665.0, 707.0), Magnitudes(-900.0, 0.0), Between(-2.0, 2.0)],
        },
        Unary {
            name: "exp_m1",
            function: Scalar::exp_m1,
            reference: Scalar::exp_m1,
            bound: 1.0,
            ranges: &[Between(-150.0, 707.0), Magnitudes(-900.0, 0.0), Between(-2.0, 2.0)],
        },
        Unary {
            name: "ln",
            function: Scalar::ln,
            reference: Scalar::ln,
            bound: 1.0,
            ranges: &[Positive(-960.0, 1020.0), Around(1.0, -106.0, -1.0), Between(0.4, 2.5)],
        },
        Unary {
            name: "ln_1p",
            function: Scalar::ln_1p,
            reference: Scalar::ln_1p,
            bound: 1.0,
            ranges: &[
                Positive(-960.0, 1020.0),
                Above(-1.0, -106.0, 0.0),
                Around(0.0, -900.0, -1.0),
                Between(-0.7, 2.0),
            ],
        },
        Unary {
            name: "ln_1p_rest",
            function: Scalar::ln_1p_rest,
            reference: |x| x.clone() - x.ln_1p(),
            bound: 3.0,
            ranges: &[
                Positive(0.0, 1020.0),
                Above(-1.0, -106.0, 0.0),
                Around(0.0, -70.0, -1.0),
                Between(-0.5, 1.0),
            ],
        },
    ]);
}

#[test]
fn hyperbolic_functions_keep_their_digits() {
    check_unary(&[
        Unary {
            name: "sinh",
            function: Scalar::sinh,
            reference: Scalar::sinh,
            bound: 1.0,
            ranges: &[Magnitudes(-900.0, 9.46), Between(-2.0, 2.0)],
        },
        Unary {
            name: "cosh",
            function: Scalar::cosh,
            reference: Scalar::cosh,
            bound: 1.0,
            ranges: &[Magnitudes(-900.0, 9.46), Between(-2.0, 2.0)],
        },
        Unary {
            name: "tanh",
            function: Scalar::tanh,
            reference: Scalar::tanh,
            bound: 1.0,
            ranges: &[Magnitudes(-900.0, 9.46), Between(-2.0, 2.0)],
        },
    ]);
}

#[test]
fn circular_functions_keep_their_digits() {
    check_unary(&[
        Unary {
            name: "sin",
            function: Scalar::sin,
            reference: Scalar::sin,
            bound: 1.0,
            ranges: &[
                Magnitudes(-900.0, 49.8),
                Between(-10.0, 10.0),
                QuarterTurns(10.0),
                QuarterTurns(6e14),
            ],
        },
        Unary {
            name: "cos",
            function: Scalar::cos,
            reference: Scalar::cos,
            bound: 1.0,
            ranges: &[
                Magnitudes(-900.0, 49.8),
                Between(-10.0, 10.0),
                QuarterTurns(10.0),
                QuarterTurns(6e14),
            ],
        },
        Unary {
            name: "tan",
            function: Scalar::tan,
            reference: Scalar::tan,
            bound: 1.5,
            ranges: &[
                Magnitudes(-900.0, 49.8),
                Between(-10.0, 10.0),
                QuarterTurns(10.0),
                QuarterTurns(6e14),
            ],
        },
        Unary {
            name: "sin_pi",
            function: Scalar::sin_pi,
            reference: sin_pi,
            bound: 1.0,
            ranges: &[
                Magnitudes(-900.0, 50.0),
                Between(-3.0, 3.0),
                QuartersOfHalves(10.0),
                QuartersOfHalves(1e15),
            ],
        },
        Unary {
            name: "cos_pi",
            function: Scalar::cos_pi,
            reference: cos_pi,
            bound: 1.0,
            ranges: &[
                Magnitudes(-100.0, 50.0),
                Between(-3.0, 3.0),
                QuartersOfHalves(10.0),
                QuartersOfHalves(1e15),
            ],
        },
    ]);
}

#[test]
fn inverse_circular_functions_keep_their_digits() {
    check_unary(&[
        Unary {
            name: "asin",
            function: Scalar::asin,
            reference: Scalar::asin,
            bound: 1.0,
            ranges: &[
                Magnitudes(-900.0, 0.0),
                Between(-1.0, 1.0),
                Below(1.0, -106.0, -1.0),
                Above(-1.0, -106.0, -1.0),
            ],
        },
        Unary {
            name: "acos",
            function: Scalar::acos,
            reference: Scalar::acos,
            bound: 1.5,
            ranges: &[
                Magnitudes(-900.0, 0.0),
                Between(-1.0, 1.0),
                Below(1.0, -106.0, -1.0),
                Above(-1.0, -106.0, -1.0),
            ],
        },
        Unary {
            name: "atan",
            function: Scalar::atan,
            reference: Scalar::atan,
            bound: 1.0,
            ranges: &[Magnitudes(-900.0, 900.0), Between(-3.0, 3.0)],
        },
    ]);
    check_binary(&[Binary {
        name: "atan2",
        function: Scalar::atan2,
        reference: Scalar::atan2,
        bound: 1.0,
        ranges: &[
            (Magnitudes(-400.0, 400.0), Magnitudes(-500.0, 500.0)),
            (Magnitudes(-3.0, 3.0), Magnitudes(-3.0, 3.0)),
            (Magnitudes(-990.0, -950.0), Magnitudes(-950.0, -900.0)),
            (Magnitudes(1000.0, 1022.0), Magnitudes(1000.0, 1022.0)),
        ],
    }]);
}

/// The exponent is computed from the base so that the power stays in range: 2^(600 times the fraction).
#[test]
fn powers_keep_their_digits() {
    check_binary(&[Binary {
        name: "powf",
        function: |base, fraction| base.powf(exponent_for(base, fraction)),
        reference: |base, fraction| {
            let base = rounded(&base);
            exact(base).powf(exact(exponent_for(base, rounded(&fraction))))
        },
        bound: 7.0,
        ranges: &[
            (Positive(-900.0, 900.0), Between(-1.0, 1.0)),
            (Around(1.0, -100.0, -1.0), Between(-1.0, 1.0)),
            (Around(1.0, -100.0, -1.0), Magnitudes(-100.0, 0.0)),
            (Between(0.1, 4.0), Magnitudes(-10.0, -6.0)),
        ],
    }]);
}

fn exponent_for(base: Double, fraction: Double) -> Double {
    fraction * Double::from(900.0 * core::f64::consts::LN_2 / base.ln().to_f64())
}
