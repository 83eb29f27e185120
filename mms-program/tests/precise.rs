//! Numbers of 77 digits: the ends of their range, and arguments where functions are exact.

use mms_math::Scalar as _;
use mms_program::precise::{Binary, Precise};

fn of(value: f64) -> Precise {
    Precise::from_f64(value)
}

fn ratio(a: &Precise, b: &Precise) -> f64 {
    (a.clone() / b.clone()).to_f64()
}

#[test]
fn what_is_tiny_or_huge_is_still_a_number() {
    for x in [1e6, 1e7, 1e12, 1e17] {
        let (up, down) = (of(x).exp(), of(-x).exp());
        assert_eq!(ratio(&down, &(of(1.0) / up.clone())), 1.0, "{x}");
        assert_eq!(down.clone().ln().to_f64(), -x);
        assert_eq!(ratio(&of(x).cosh(), &of(x).sinh()), 1.0);
        assert_eq!(ratio(&up, &of(x).sinh()), 2.0);
        assert_eq!((of(x).tanh().to_f64(), of(-x).tanh().to_f64()), (1.0, -1.0));
        assert_eq!(down.clone().exp().to_f64(), 1.0);
        assert_eq!(ratio(&down.clone().exp_m1(), &down), 1.0);
        assert_eq!(of(-x).exp_m1().to_f64(), -1.0);
    }
}

#[test]
fn half_turns_are_exact_where_they_vanish() {
    for x in [0.0, 1.0, -3.0, 1e15] {
        assert_eq!(of(x).sin_pi().to_f64(), 0.0, "{x}");
        assert_eq!(of(x + 0.5).cos_pi().to_f64(), 0.0, "{x}");
    }
    assert_eq!(of(1e6 + 0.5).sin_pi().to_f64(), 1.0);
    assert_eq!(of(1e6 + 1.0).cos_pi().to_f64(), -1.0);
    assert_eq!(ratio(&of(0.25).sin_pi(), &of(0.5).sqrt()), 1.0);
}

#[test]
fn what_is_left_of_a_logarithm_keeps_its_digits() {
    for x in [1e-10, -1e-10, 1e-30] {
        let more = Binary::<1024>::from_f64(x);
        let rest = more.clone() - more.ln_1p();
        let found = of(x).ln_1p_rest();
        let difference = (found.with_bits::<1024>() - rest.clone()) / rest;
        assert!(difference.to_f64().abs() < 1e-70, "{x}");
    }
    assert_eq!(of(1e-300).ln_1p_rest().to_f64(), 0.0);
    assert_eq!(ratio(&of(1e-300).ln_1p_rest(), &(of(1e-300) * of(1e-300))), 0.5);
    assert_eq!(of(0.0).ln_1p_rest().to_f64(), 0.0);
}

#[test]
fn there_is_one_zero() {
    let zero = of(0.0);
    for zero in [zero.clone(), -zero.clone(), zero.clone() * of(-1.0), of(-0.0)] {
        assert_eq!(zero.atan2(of(-1.0)).to_f64(), core::f64::consts::PI);
    }
}

#[test]
fn beyond_all_bounds_large_is_undefined_and_small_is_zero() {
    let zero = of(0.0);
    for x in [1e19, 1e300] {
        assert!(!of(x).exp().is_defined() && !of(x).cosh().is_defined());
        assert!(of(-x).exp().at_most(&zero) && zero.at_most(&of(-x).exp()));
        assert_eq!(of(x).tanh().to_f64(), 1.0);
        assert_eq!(of(-x).exp_m1().to_f64(), -1.0);
    }
    let tiny = (0..70).fold(of(0.5), |tiny, _| tiny.clone() * tiny);
    assert!(tiny.is_defined() && tiny.at_most(&zero));
    let huge = (0..70).fold(of(2.0), |huge, _| huge.clone() * huge);
    assert!(!huge.is_defined());
    // A zero that replaces a too small number may not be a divisor.
    assert!(!(of(1.0) / tiny).is_defined());
}
