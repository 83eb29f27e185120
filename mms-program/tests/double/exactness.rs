//! Results without error.

use mms_math::{Double, Scalar};
use mms_program::interpret::Number as _;
use mms_program::precise::Precise;
use mms_symbolic::expr::Rational;

use super::sample::Random;
use super::sample::Range::Magnitudes;
use super::{COUNT, exact, magnitude, of, rounded};

#[test]
fn rationals_are_rounded_once() {
    for (numerator, denominator) in
        [(1_i32, 3_i32), (-2, 7), (22, 7), (-1, 1_000_000_007), (5, 1), (0, 9)]
    {
        let number = Rational::from_parts(numerator.into(), denominator.unsigned_abs().into());
        let nearest = Double::from_rational(&number);
        assert_eq!(nearest, rounded(&Precise::new(&number)), "{number}");
        assert_eq!(nearest, Double::ratio(numerator, denominator), "{number}");
    }
    let digits = "12345678901234567890123456789/1000000000000000000000";
    let number: Rational = digits.parse().expect("a fraction");
    assert_eq!(Double::from_rational(&number), rounded(&Precise::new(&number)));
    assert_eq!(Double::pi(), rounded(&Precise::pi()));
}

/// Asserts that two numbers are the same, to the last bit.
#[track_caller]
fn same(found: Double, expected: Double) {
    assert_eq!((found.to_f64(), found.low()), (expected.to_f64(), expected.low()));
}

#[test]
fn arithmetic_is_exact_where_it_can_be() {
    let mut random = Random(7);
    for _ in 0..COUNT {
        let (a, b) = (random.of(Magnitudes(-300.0, 300.0)), random.of(Magnitudes(-300.0, 300.0)));
        same(a + b, b + a);
        same(a * b, b * a);
        same(a - b, -(b - a));
        same(a - a, of(0.0));
        same(a * of(1.0), a);
        same(a / of(1.0), a);
        same(a / a, of(1.0));
        same(a * of(0.25) / of(0.25), a);
        let (x, y) = (of(a.to_f64()), of(b.to_f64()));
        same(x * y / y, x);
        same((x * x).sqrt(), magnitude(x));
        same(f64::narrow(x.to_f64().widen()).into(), x);
    }
}

#[test]
fn functions_have_their_symmetries_and_exact_values() {
    let mut random = Random(8);
    for _ in 0..COUNT {
        let (a, b) = (random.of(Magnitudes(-40.0, 40.0)), random.of(Magnitudes(-40.0, 40.0)));
        for odd in [Scalar::sin, Scalar::tan, Scalar::sinh, Scalar::tanh, Scalar::atan] {
            same(odd(-a), -odd(a));
        }
        same((-a).cbrt(), -a.cbrt());
        same((-a).cos(), a.cos());
        same((-a).cosh(), a.cosh());
        same((-a).atan2(b), -a.atan2(b));
        let n = of(random.between(-3e9, 3e9).round());
        let half = of(0.5);
        same(n.sin_pi(), of(0.0));
        same((n + half).cos_pi(), of(0.0));
        same((n + n).cos_pi(), of(1.0));
        same((n + n + half).sin_pi(), of(1.0));
        same((n + n - of(1.0)).cos_pi(), of(-1.0));
        same((n + n - half).sin_pi(), of(-1.0));
    }
    let (zero, one) = (of(0.0), of(1.0));
    for at_zero in [Scalar::sqrt, Scalar::exp_m1, Scalar::ln_1p, Scalar::asin, Scalar::ln_1p_rest] {
        same(at_zero(zero), zero);
    }
    for at_zero in [Scalar::exp, Scalar::cos, Scalar::cosh] {
        same(at_zero(zero), one);
    }
    same(one.ln(), zero);
    same(one.acos(), zero);
    same(one.asin(), Double::pi() * of(0.5));
    same(one.atan(), Double::pi() * of(0.25));
}

/// The number of turns that were subtracted from an angle, and its difference from a whole number.
fn turns_between(angle: Double, rest: Double, turn: Precise) -> (f64, f64) {
    let turns = (exact(angle) - exact(rest)) / turn;
    let whole = turns.to_f64().round();
    (whole, (turns - Precise::from_f64(whole)).to_f64())
}

#[test]
fn whole_turns_are_taken_off_large_angles_and_no_others() {
    let two_pi = || Precise::pi() + Precise::pi();
    let mut random = Random(9);
    for _ in 0..COUNT {
        let angle = random.of(Magnitudes(4.7, 49.9));
        let rest = angle.within_turns();
        let (turns, error) = turns_between(angle, rest, two_pi());
        assert!(turns != 0.0 && rest.to_f64().abs() <= 3.3, "{angle:?} {rest:?}");
        // The nearest turns are determined in 53 bits.
        assert!(error.abs() <= 2_f64.powi(-106), "{angle:?} {error:e}");
        assert_eq!(angle.to_f64().within_turns(), of(angle.to_f64()).within_turns().to_f64());

        let rest = angle.within_turns_pi();
        let (turns, error) = turns_between(angle, rest, Precise::from_f64(2.0));
        assert!(turns != 0.0 && rest.to_f64().abs() <= 1.0 && error == 0.0, "{angle:?} {rest:?}");
        let larger = random.of(Magnitudes(50.0, 900.0));
        assert!(larger.within_turns_pi().to_f64().abs() <= 1.0, "{larger:?}");
        same(larger.within_turns_pi().sin_pi(), larger.sin_pi());

        let small = random.of(Magnitudes(-300.0, 3.0));
        same(small.within_turns(), small);
        same(small.within_turns_pi(), small);
        let beyond = random.of(Magnitudes(50.0, 900.0));
        same(beyond.within_turns(), beyond);
    }
}
