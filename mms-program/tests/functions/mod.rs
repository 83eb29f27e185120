//! The quick functions of `Lane` and the careful ones of `f32` and `f64`, compared with 77 digits.

use mms_math::{Lane, NEAR_ZERO, Scalar, WITHIN_ONE};
use mms_program::precise::Precise;

use crate::sampled::sampled_count;

type Real = fn(f64) -> f64;

/// A function of one argument in both formats, with each value in an `f64`.
struct Function {
    name: &'static str,
    /// The quick function, without and with fused products.
    quick: [[Real; 2]; 2],
    careful: [Real; 2],
    /// The function of the standard library, in `f64`.
    standard: Real,
    truth: fn(f64) -> Precise,
    /// The largest error in `f64` and `f32`, in units of the last digit.
    bounds: [f64; 2],
    /// The range where the quick function always has a value.
    known: [[f64; 2]; 2],
}

const FORMATS: [Format; 2] = [
    Format { digits: 53, least: f64::MIN_POSITIVE, most: f64::MAX, round: |x| x },
    Format {
        digits: 24,
        least: f32::MIN_POSITIVE as f64,
        most: f32::MAX as f64,
        round: |x| f64::from(x as f32),
    },
];

struct Format {
    digits: i32,
    least: f64,
    most: f64,
    round: fn(f64) -> f64,
}

impl Format {
    /// One unit in the last digit of a value.
    fn unit(&self, value: &Precise) -> Precise {
        let magnitude = value.to_f64().abs().clamp(self.least, self.most);
        let exponent = (magnitude.to_bits() >> 52) as i32 - 1023;
        let half = (exponent + 1 - self.digits) / 2;
        let rest = exponent + 1 - self.digits - half;
        Precise::from_f64(2f64.powi(half)) * Precise::from_f64(2f64.powi(rest))
    }

    /// Whether a value is right to a number of units, or infinite like the true one.
    fn is_right(&self, value: f64, truth: &Precise, units: f64) -> bool {
        if value.is_infinite() {
            let beyond = truth.clone() * Precise::from_f64(value.signum());
            return Precise::from_f64(self.most).at_most(&beyond);
        }
        let error = (Precise::from_f64(value) - truth.clone()).magnitude();
        // Below the normal numbers each intermediate product is rounded to the same last digit.
        let below = truth.clone().magnitude().at_most(&Precise::from_f64(self.least));
        let units = if below { units + 1.0 } else { units };
        error.at_most(&(self.unit(truth) * Precise::from_f64(units)))
    }
}

const EVERYWHERE: [[f64; 2]; 2] = [[-f64::MAX, f64::MAX], [-f64::MAX, f64::MAX]];
const DOMAIN_OF_ARCS: [[f64; 2]; 2] = [[-1.0, 1.0], [-1.0, 1.0]];
const ANGLES: [[f64; 2]; 2] = [[-1048576.0, 1048576.0], [-131072.0, 131072.0]];
const HALF_TURNS: [[f64; 2]; 2] =
    [[-562949953421312.0, 562949953421312.0], [-1048576.0, 1048576.0]];
const EXPONENTS: [[f64; 2]; 2] = [[-708.7, 708.7], [-87.6, 87.6]];
const HYPERBOLIC: [[f64; 2]; 2] = [[-707.0, 707.0], [-86.0, 86.0]];
const LOGARITHMS: [[f64; 2]; 2] = [[3.2e-308, 2.9e307], [1.7e-38, 5.6e37]];
const ABOVE_MINUS_ONE: [[f64; 2]; 2] =
    [[-1.0 + f64::EPSILON, 2.9e307], [-1.0 + f32::EPSILON as f64, 5.6e37]];
/// Normal numbers of both signs, given by their magnitude.
const NORMAL: [[f64; 2]; 2] = [[f64::MIN_POSITIVE, f64::MAX], [f32::MIN_POSITIVE as f64, f64::MAX]];

macro_rules! functions {
    ($($name:ident, $truth:expr, $standard:expr, $bounds:expr, $known:expr;)*) => {
        vec![$(Function {
            name: stringify!($name),
            quick: [
                [|x| Lane::<f64, false>(x).$name().0, |x| Lane::<f64, true>(x).$name().0],
                [
                    |x| Lane::<f32, false>(x as f32).$name().0.into(),
                    |x| Lane::<f32, true>(x as f32).$name().0.into(),
                ],
            ],
            careful: [|x| Scalar::$name(x), |x| Scalar::$name(x as f32).into()],
            standard: $standard,
            truth: $truth,
            bounds: $bounds,
            known: $known,
        }),*]
    };
}

fn of(x: f64) -> Precise {
    Precise::from_f64(x)
}

fn sin_pi(x: f64) -> Precise {
    let x = x % 2.0;
    if x.fract() == 0.0 { of(0.0) } else { of(x).sin_pi() }
}

fn cos_pi(x: f64) -> Precise {
    let x = x % 2.0;
    if (2.0 * x).fract() == 0.0 && x.fract() != 0.0 { of(0.0) } else { of(x).cos_pi() }
}

fn ln_1p_rest(x: f64) -> Precise {
    if x.abs() > 1e-20 {
        return of(x).ln_1p_rest();
    }
    let x = of(x);
    let series = of(0.5) - x.clone() * (of(1.0) / of(3.0) - x.clone() / of(4.0));
    x.clone() * x * series
}

/// The bounds are the errors at about ten thousand points each, rounded up.
fn functions() -> Vec<Function> {
    functions! {
        sqrt, |x| of(x).sqrt(), f64::sqrt, [0.5, 0.5], [[0.0, f64::MAX], [0.0, f64::MAX]];
        cbrt, |x| of(x).cbrt(), f64::cbrt, [0.9, 0.9], NORMAL;
        exp, |x| of(x).exp(), f64::exp, [1.15, 1.1], EXPONENTS;
        exp_m1, |x| of(x).exp_m1(), f64::exp_m1, [1.05, 1.0], EXPONENTS;
        sinh, |x| of(x).sinh(), f64::sinh, [1.3, 1.2], HYPERBOLIC;
        cosh, |x| of(x).cosh(), f64::cosh, [1.3, 1.6], HYPERBOLIC;
        tanh, |x| of(x).tanh(), f64::tanh, [2.4, 2.4], EVERYWHERE;
        ln, |x| of(x).ln(), f64::ln, [0.9, 0.9], LOGARITHMS;
        ln_1p, |x| of(x).ln_1p(), f64::ln_1p, [1.0, 1.0], ABOVE_MINUS_ONE;
        ln_1p_rest, ln_1p_rest, |x| x - x.ln_1p(), [2.8, 2.6], ABOVE_MINUS_ONE;
        sin, |x| of(x).sin(), f64::sin, [1.1, 1.1], ANGLES;
        cos, |x| of(x).cos(), f64::cos, [1.1, 1.1], ANGLES;
        tan, |x| of(x).tan(), f64::tan, [2.4, 2.4], ANGLES;
        sin_pi, sin_pi, |x| x * f64::NAN, [1.0, 0.9], HALF_TURNS;
        cos_pi, cos_pi, |x| x * f64::NAN, [1.0, 0.9], HALF_TURNS;
        asin, |x| of(x).asin(), f64::asin, [2.0, 2.0], DOMAIN_OF_ARCS;
        acos, |x| of(x).acos(), f64::acos, [1.3, 1.3], DOMAIN_OF_ARCS;
        atan, |x| of(x).atan(), f64::atan, [1.5, 1.4], EVERYWHERE;
    }
}

/// Weyl's sequence, scrambled (Steele, Lea & Flood, 2014).
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^ (mixed >> 31)
    }

    /// A number between -1 and 1.
    fn signed(&mut self) -> f64 {
        (self.bits() as i64) as f64 / 2f64.powi(63)
    }

    /// A magnitude with an exponent from a range.
    fn magnitude(&mut self, least: f64, most: f64) -> f64 {
        (least + (most - least) * self.signed().abs()).exp2()
    }

    /// A number of either sign, of one of the kinds that are hard for functions.
    fn number(&mut self) -> f64 {
        let sign = self.signed().signum();
        let near = self.signed() * self.magnitude(-50.0, -3.0);
        let count = (self.magnitude(0.0, 19.0)).round();
        sign * match self.bits() % 8 {
            0 => self.magnitude(-1022.0, 1023.9),
            1 => self.magnitude(-149.0, 127.9),
            2 => self.magnitude(-30.0, 0.0),
            3 => self.magnitude(0.0, 20.0),
            4 => 4.0 * self.signed(),
            5 => 1.0 + near,
            6 => count * core::f64::consts::FRAC_PI_2 * (1.0 + near),
            _ => 0.5 * count + near,
        }
    }
}

const SPECIAL: [f64; 16] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    -0.5,
    1e-310,
    -5e-324,
    1e-40,
    f64::MIN_POSITIVE,
    f32::MIN_POSITIVE as f64,
    f64::MAX,
    f32::MAX as f64,
    1e22,
    710.0,
    -746.0,
];

#[test]
fn every_function_is_right_to_its_bound_or_not_a_number() {
    let mut random = Random(1);
    for function in functions() {
        let random = (0..sampled_count(1500, 3)).map(|_| random.number());
        for x in random.chain(SPECIAL).collect::<Vec<_>>() {
            for (index, format) in FORMATS.iter().enumerate() {
                check(&function, index, (format.round)(x));
            }
        }
    }
}

fn check(function: &Function, index: usize, x: f64) {
    let Function { name, bounds, known, .. } = function;
    let format = &FORMATS[index];
    if !x.is_finite() {
        return;
    }
    let truth = (function.truth)(x);
    for quick in function.quick[index] {
        let value = quick(x);
        let [least, most] = known[index];
        let must_know = least <= x && x <= most || *name == "cbrt" && x.abs() >= least;
        let unknown = value.is_nan() && !must_know;
        let right = unknown || format.is_right(value, &truth, bounds[index]);
        assert!(right, "{name}({x:e}) in format {index}: {value:e} for {:e}", truth.to_f64());
    }
    let careful = (function.careful[index])(x);
    // At a pole the careful function is infinite.
    let right = match truth.is_defined() {
        true => format.is_right(careful, &truth, bounds[index].max(1.0)),
        false => !careful.is_finite(),
    };
    assert!(right, "careful {name}({x:e}): {careful:e} for {:e}", truth.to_f64());
}

#[test]
fn beyond_the_numbers_the_careful_functions_are_the_standard_ones() {
    for function in functions() {
        for x in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
            for (index, format) in FORMATS.iter().enumerate() {
                let expected = (format.round)((function.standard)(x));
                let same = |y: f64| y == expected || y.is_nan() && expected.is_nan();
                let careful = (function.careful[index])(x);
                assert!(same(careful), "{}({x}): {careful}", function.name);
                for quick in function.quick[index] {
                    assert!(quick(x).is_nan() || same(quick(x)), "{}({x})", function.name);
                }
            }
        }
    }
}

#[test]
fn functions_of_two_arguments_are_right_or_not_a_number() {
    let mut random = Random(2);
    for _ in 0..sampled_count(2000, 3) {
        let scale = random.magnitude(-60.0, 60.0);
        let y = scale * random.signed();
        let x = random.signed() * if random.bits().is_multiple_of(2) { scale } else { 1.0 };
        let base =
            if random.bits().is_multiple_of(2) { random.number().abs() } else { 3.0 * x.abs() };
        let exponent = random.signed() * 700.0 / base.ln().abs().max(1e-9);
        for (index, format) in FORMATS.iter().enumerate() {
            let [y, x] = [y, x].map(format.round);
            let [base, exponent] = [base, exponent].map(format.round);
            if !(base.is_finite() && exponent.is_finite()) || base < format.least {
                continue;
            }
            let (angle, power) = (of(y).atan2(of(x)), of(base).powf(of(exponent)));
            for (value, careful) in angles(index, y, x) {
                assert!(format.is_right(value, &angle, [1.6, 1.6][index]), "atan2({y:e}, {x:e})");
                assert_eq!(value, careful);
            }
            for (value, careful) in powers(index, base, exponent) {
                let bound = [1.3, 0.6][index];
                let right = value.is_nan() || format.is_right(value, &power, bound);
                assert!(right, "{base:e}^{exponent:e}: {value:e}");
                let right = format.is_right(careful, &power, bound.max(1.0));
                assert!(right, "{base:e}^{exponent:e}: {careful:e}");
            }
        }
    }
}

/// The values of the quick and of the careful function.
fn angles(format: usize, y: f64, x: f64) -> Vec<(f64, f64)> {
    match format {
        0 => vec![(Lane::<_, false>(y).atan2(Lane(x)).0, Scalar::atan2(y, x))],
        _ => {
            let (y, x) = (y as f32, x as f32);
            vec![(Lane::<_, false>(y).atan2(Lane(x)).0.into(), Scalar::atan2(y, x).into())]
        }
    }
}

fn powers(format: usize, base: f64, exponent: f64) -> [(f64, f64); 2] {
    match format {
        0 => {
            let careful = Scalar::powf(base, exponent);
            let plain = Lane::<_, false>(base).powf(Lane(exponent)).0;
            [(plain, careful), (Lane::<_, true>(base).powf(Lane(exponent)).0, careful)]
        }
        _ => {
            let (base, exponent) = (base as f32, exponent as f32);
            let careful = f64::from(Scalar::powf(base, exponent));
            let plain = Lane::<_, false>(base).powf(Lane(exponent)).0.into();
            [(plain, careful), (Lane::<_, true>(base).powf(Lane(exponent)).0.into(), careful)]
        }
    }
}

/// Functions of [`Scalar`], in the scalars that implement them.
macro_rules! everywhere {
    ($($function:ident),*) => {
        [$((
            |x| Lane::<f64, false>(x).$function().0,
            |x| Lane::<f64, true>(x).$function().0,
            |x| Lane::<f32, false>(x).$function().0,
            |x| Lane::<f32, true>(x).$function().0,
            |x| Scalar::$function(x),
        )),*]
    };
}

#[test]
fn of_a_small_angle_no_reduction_is_needed() {
    type Everywhere =
        (fn(f64) -> f64, fn(f64) -> f64, fn(f32) -> f32, fn(f32) -> f32, fn(f64) -> f64);
    let near_zero: [Everywhere; 2] = everywhere!(sin_near_zero, cos_near_zero);
    let within_one: [Everywhere; 2] = everywhere!(sin_within_one, cos_within_one);
    let mut random = Random(3);
    for (limit, [sine, cosine]) in [(NEAR_ZERO, near_zero), (WITHIN_ONE, within_one)] {
        for _ in 0..sampled_count(1000, 3) {
            let single = (random.signed() * limit) as f32;
            let x = f64::from(single) * (1.0 - f64::EPSILON);
            // An error of the cosine is compared with a number near 1.
            let is_cosine = |format: usize, found: f64, x: f64| {
                let error = (of(found) - of(x).cos()).magnitude();
                error.at_most(&(FORMATS[format].unit(&of(0.75)) * of(2.0)))
            };
            for (sine, cosine) in [(sine.0(x), cosine.0(x)), (sine.1(x), cosine.1(x))] {
                assert!(FORMATS[0].is_right(sine, &of(x).sin(), 2.0), "sin({x})");
                assert!(is_cosine(0, cosine, x), "cos({x})");
            }
            let x = f64::from(single);
            for (sine, cosine) in
                [(sine.2(single), cosine.2(single)), (sine.3(single), cosine.3(single))]
            {
                assert!(FORMATS[1].is_right(sine.into(), &of(x).sin(), 2.0), "sin({x})");
                assert!(is_cosine(1, cosine.into(), x), "cos({x})");
            }
        }
        for x in [limit + 1e-6, -2.0, f64::NAN, f64::INFINITY] {
            assert!(sine.0(x).is_nan() && cosine.1(x).is_nan());
            assert!(sine.2(x as f32).is_nan() && cosine.3(x as f32).is_nan());
        }
        for x in [NEAR_ZERO + 1e-6, -2.0, 1e5, 1e300] {
            assert_eq!([sine.4(x), cosine.4(x)], [Scalar::sin(x), Scalar::cos(x)], "{x}");
        }
    }
    let between = 0.5 * (NEAR_ZERO + WITHIN_ONE);
    assert_eq!(Scalar::sin_within_one(between), Scalar::sin_near_zero(between));
    assert_eq!(Scalar::cos_within_one(between), Scalar::cos_near_zero(between));
}

#[test]
fn whole_and_half_turns_have_exact_values() {
    for n in (-9..9).map(f64::from).chain([1e5, 1e9, 1e15, 1e300]) {
        assert_eq!((Scalar::sin_pi(n), Scalar::cos_pi(n).abs()), (0.0, 1.0), "{n}");
        if n.abs() < 1e15 {
            assert_eq!((Scalar::sin_pi(n + 0.5).abs(), Scalar::cos_pi(n + 0.5)), (1.0, 0.0), "{n}");
        }
    }
}

#[test]
fn odd_functions_keep_the_sign_of_zero() {
    type Function = fn(f64) -> f64;
    let functions: [(&str, Function); 11] = [
        ("cbrt", Scalar::cbrt),
        ("exp_m1", Scalar::exp_m1),
        ("ln_1p", Scalar::ln_1p),
        ("sin", Scalar::sin),
        ("tan", Scalar::tan),
        ("sin_pi", Scalar::sin_pi),
        ("sinh", Scalar::sinh),
        ("tanh", Scalar::tanh),
        ("asin", Scalar::asin),
        ("atan", Scalar::atan),
        ("sqrt", Scalar::sqrt),
    ];
    for (name, function) in functions {
        for zero in [0.0f64, -0.0] {
            assert_eq!(function(zero).to_bits(), zero.to_bits(), "{name}({zero})");
        }
    }
}

#[test]
fn a_loop_gives_the_bits_of_single_calls() {
    let mut random = Random(4);
    let arguments: Vec<f64> = (0..1024).map(|_| random.number()).collect();
    macro_rules! compare {
        ($($name:ident)*) => {
            $(
                let many: Vec<Lane<f64, false>> =
                    arguments.iter().map(|x| Lane(*x).$name()).collect();
                for (x, together) in arguments.iter().zip(many) {
                    let alone = std::hint::black_box(Lane::<_, false>(*x)).$name().0;
                    let same = alone.to_bits() == together.0.to_bits();
                    assert!(same || alone.is_nan() && together.0.is_nan(), "{x:e}");
                }
            )*
        };
    }
    compare!(sin cos tan sin_pi cos_pi exp exp_m1 ln ln_1p ln_1p_rest);
    compare!(sqrt cbrt sinh cosh tanh asin acos atan);
}
