//! Intervals: exact results, the growth of others, and results that overflow or have no value.

use mms_math::Scalar as _;
use mms_program::interpret::Number as _;
use mms_program::interval::Interval;
use mms_symbolic::expr::Rational;

#[test]
fn exact_results_stay_exact() {
    let of = |value: f64| Interval::new(value, value);
    assert_eq!(of(1.0) + of(2.0), of(3.0));
    assert_eq!(of(0.5) * of(-3.0), of(-1.5));
    assert_eq!(of(-3.0) / of(4.0), of(-0.75));
    assert_eq!(Interval::new(-2.0, 3.0).square(), Interval::new(0.0, 9.0));
    assert_eq!(Interval::new(-2.0, 3.0) * of(-2.0), Interval::new(-6.0, 4.0));
}

#[test]
fn inexact_results_grow_by_one_step() {
    let tenth = Interval::from_rational(&Rational::from_parts(1.into(), 10u8.into()));
    assert_eq!((tenth.lower(), tenth.upper()), (0.1_f64.next_down(), 0.1));
    let third = Interval::new(1.0, 1.0) / Interval::new(3.0, 3.0);
    assert_eq!(third.upper(), third.lower().next_up());
    let sum = Interval::new(1.0, 1.0) + Interval::new(1e-30, 1e-30);
    assert_eq!((sum.lower(), sum.upper()), (1.0, 1.0_f64.next_up()));
}

#[test]
fn what_overflows_is_bounded_on_one_side() {
    let large = Interval::new(f64::MAX, f64::MAX);
    let product = large * large;
    assert_eq!((product.lower(), product.upper()), (f64::MAX, f64::INFINITY));
    let sum = -large - large;
    assert_eq!((sum.lower(), sum.upper()), (f64::NEG_INFINITY, f64::MIN));
    let unbounded = Interval::new(1.0, f64::INFINITY);
    assert_eq!(unbounded / unbounded, Interval::new(0.0, f64::INFINITY));
    assert_eq!(unbounded - unbounded, Interval::new(f64::NEG_INFINITY, f64::INFINITY));
    assert_eq!(unbounded * Interval::new(0.0, 0.0), Interval::new(0.0, 0.0));
    let tiny = Interval::new(f64::MIN_POSITIVE, f64::MIN_POSITIVE);
    let product = tiny * tiny;
    assert_eq!((product.lower(), product.upper()), (0.0, f64::from_bits(1)));
    let power = Rational::from(10).pow(400);
    let beyond = Interval::from_rational(&power);
    assert_eq!((beyond.lower(), beyond.upper()), (f64::MAX, f64::INFINITY));
    let small = Interval::from_rational(&(Rational::ONE / power));
    assert_eq!((small.lower(), small.upper()), (0.0, f64::from_bits(1)));
}

#[test]
fn a_quotient_that_underflows_keeps_its_sign() {
    let (tiny, four) = (f64::from_bits(1), Interval::new(4.0, 4.0));
    assert_eq!(Interval::new(tiny, tiny) / four, Interval::new(0.0, tiny));
    assert_eq!(Interval::new(-tiny, -tiny) / four, Interval::new(-tiny, 0.0));
}

#[test]
fn a_division_by_what_may_be_zero_promises_nothing() {
    let one = Interval::new(1.0, 1.0);
    assert_eq!(one / Interval::new(-1.0, 1.0), Interval::UNDEFINED);
    assert_eq!(one / Interval::new(0.0, 1.0), Interval::UNDEFINED);
    assert!(!(Interval::UNDEFINED * Interval::new(0.0, 0.0)).is_defined());
    assert!(!Interval::new(f64::NAN, 1.0).is_defined());
}

fn assert_tight(interval: Interval, value: f64, steps: u64) {
    assert!(interval.is_defined() && interval.lower() < interval.upper(), "{interval:?}");
    let apart = interval.upper().to_bits().abs_diff(interval.lower().to_bits());
    assert!(apart <= steps, "{interval:?} is {apart} steps wide");
    assert!(interval.contains(value), "{interval:?} lacks {value:e}");
}

#[test]
fn a_point_gives_two_neighbouring_numbers() {
    let of = |value: f64| Interval::new(value, value);
    // Values from the tables of Abramowitz & Stegun, to all digits of a double.
    assert_tight(of(1.0).exp(), core::f64::consts::E, 1);
    assert_tight(of(2.0).ln(), core::f64::consts::LN_2, 1);
    assert_tight(of(2.0).sqrt(), core::f64::consts::SQRT_2, 1);
    assert_tight(of(1.0).atan(), core::f64::consts::FRAC_PI_4, 1);
    assert_tight(of(1.0).sin(), 0.841_470_984_807_896_5, 1);
    assert_tight(of(1.0).cosh(), 1.543_080_634_815_243_8, 1);
    assert_tight(of(2.0).powf(of(0.5)), core::f64::consts::SQRT_2, 2);
    assert_tight(of(1.0).atan2(of(-1.0)), 2.356_194_490_192_345, 4);
    assert_eq!(of(4.0).sqrt(), of(2.0));
    assert_eq!(of(27.0).cbrt(), of(3.0));
    assert_eq!(of(0.0).exp(), of(1.0));
}

#[test]
fn waves_reach_their_extrema() {
    let sin = |lower, upper| Interval::new(lower, upper).sin();
    assert_eq!(sin(1.0, 2.0).upper(), 1.0);
    assert!(sin(1.0, 1.5).upper() < 1.0);
    assert_eq!(sin(4.0, 5.0).lower(), -1.0);
    assert_eq!((sin(1.0, 5.0).lower(), sin(1.0, 5.0).upper()), (-1.0, 1.0));
    assert_eq!(sin(-2.0, -1.0).lower(), -1.0);
    assert_eq!((sin(0.0, 100.0).lower(), sin(0.0, 100.0).upper()), (-1.0, 1.0));
    let cos = Interval::new(-0.5, 0.25).cos();
    assert_eq!(cos.upper(), 1.0);
    assert!(cos.lower() > 0.87, "{cos:?}");
    assert_eq!(Interval::new(3.0, 3.5).cos().lower(), -1.0);
    assert_eq!(Interval::new(0.0, f64::INFINITY).cos(), Interval::new(-1.0, 1.0));
    // 1e22 is far from 0, but only its double is known.
    assert!(Interval::new(1e22, 1e22).sin().width() < 1e-15);
}

#[test]
fn poles_and_domains_are_told() {
    assert_eq!(Interval::new(1.5, 1.6).tan(), Interval::UNDEFINED);
    assert!(Interval::new(-1.5, 1.5).tan().is_defined());
    let root = Interval::new(-1.0, 4.0).sqrt();
    assert_eq!((root.lower(), root.upper(), root.is_defined()), (0.0, 2.0, false));
    assert_eq!(Interval::new(-2.0, -1.0).sqrt(), Interval::UNDEFINED);
    let ln = Interval::new(0.0, 1.0).ln();
    assert_eq!((ln.lower(), ln.upper(), ln.is_defined()), (f64::NEG_INFINITY, 0.0, false));
    assert!(!Interval::new(-1.0, 0.0).ln_1p().is_defined());
    assert!(!Interval::new(0.5, 1.5).asin().is_defined());
    assert!(!Interval::new(-1.0, 1.0).atan2(Interval::new(-1.0, 1.0)).is_defined());
    assert!(Interval::new(-1.0, 1.0).atan2(Interval::new(-2.0, -1.0)).is_defined());
    assert!(!Interval::new(-1.0, 1.0).powf(Interval::new(1.0, 2.0)).is_defined());
    let power = Interval::new(0.0, 2.0).powf(Interval::new(1.0, 2.0));
    assert_eq!((power.lower(), power.is_defined()), (0.0, true));
    assert!((4.0..4.1).contains(&power.upper()), "{power:?}");
    assert!(!Interval::new(0.0, 2.0).powf(Interval::new(-1.0, 2.0)).is_defined());
}

#[test]
fn extremes_are_bounded() {
    let huge = Interval::new(-1e300, 1e300);
    assert_eq!((huge.exp().lower(), huge.exp().upper()), (0.0, f64::INFINITY));
    assert_eq!((huge.tanh().lower(), huge.tanh().upper()), (-1.0, 1.0));
    assert_eq!(huge.cosh().lower(), 1.0);
    assert_eq!(Interval::new(710.0, 711.0).exp().upper(), f64::INFINITY);
    assert!(Interval::new(709.0, 709.0).exp().upper().is_finite());
    assert!(Interval::new(-745.0, -745.0).exp().upper() > 0.0);
    // The double below pi/2 is the nearest.
    let quarter = core::f64::consts::FRAC_PI_2.next_up();
    assert_eq!(huge.atan(), Interval::new(-quarter, quarter));
    let powers = Interval::new(0.5, f64::INFINITY).powf(Interval::new(-1.0, 1e300));
    assert_eq!((powers.lower(), powers.upper()), (0.0, f64::INFINITY));
}
