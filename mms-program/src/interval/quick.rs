//! Elementary functions at one number in the sum of two doubles, with a bound of the error: a hundred times faster than
//! arbitrary precision, which handles the undecided arguments.
//!
//! The arithmetic follows Joldes, Muller & Popescu (Tight and rigorous error bounds for basic building blocks of double-word
//! arithmetic, 2017): the error of each operation is less than 2^-102 of its result. The declared errors are about a hundred
//! times the sum of all these and of the truncated series.

/// The declared errors: relative for an exponential, a power and a root, absolute for the others.
const ERROR: f64 = 1.0 / (1u128 << 88) as f64;

/// The largest angle that is reduced here.
const LARGEST_ANGLE: f64 = 1e5;

/// The largest exponent here: e to it and to its negative are far from the greatest and the least numbers.
const LARGEST_EXPONENT: f64 = 600.0;

/// The error of an angle less its quarter turns, in addition to its own part of `ERROR`, if nearly all of it cancels: the
/// truncated digits of pi/2, times 2^16 quarter turns, and the roundings of the remainder of an angle after its first 53
/// digits.
const ERROR_OF_ANGLE: f64 = 1.0 / (1u128 << 125) as f64;

/// The angle below which the cosine, except at 0, lies between 1 and the number before it; and likewise the sine beside the
/// angle.
const FLAT: f64 = 1.0 / (1u128 << 28) as f64;

/// ln 2 and pi/2 as sums of doubles that do not overlap.
const LN_2: [f64; 2] = [core::f64::consts::LN_2, 2.319_046_813_846_299_6e-17];
const QUARTER: [f64; 3] =
    [core::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17, -1.497_384_904_859_169_8e-33];

/// The coefficients 1/n! that need all digits; the rest are single doubles.
const EXPONENTIAL: [Double; 14] = [
    Double(1.0, 0.0),
    Double(1.0, 0.0),
    Double(0.5, 0.0),
    Double(0.166_666_666_666_666_66, 9.251_858_538_542_97e-18),
    Double(0.041_666_666_666_666_664, 2.312_964_634_635_742_7e-18),
    Double(0.008_333_333_333_333_333, 1.156_482_317_317_871_4e-19),
    Double(0.001_388_888_888_888_889, -5.300_543_954_373_577e-20),
    Double(0.000_198_412_698_412_698_4, 1.720_955_829_342_070_5e-22),
    Double(2.480_158_730_158_73e-5, 2.151_194_786_677_588_2e-23),
    Double(2.755_731_922_398_589_3e-6, -1.858_393_274_046_472e-22),
    Double(2.755_731_922_398_589e-7, 2.376_771_462_225_029_7e-23),
    Double(2.505_210_838_544_172e-8, -1.448_814_070_935_912e-24),
    Double(2.087_675_698_786_81e-9, -1.207_345_059_113_26e-25),
    Double(1.605_904_383_682_161_3e-10, 1.258_529_458_875_209_8e-26),
];
const EXPONENTIAL_REST: [f64; 13] = [
    1.147_074_559_772_972_5e-11,
    7.647_163_731_819_816e-13,
    4.779_477_332_387_385e-14,
    2.811_457_254_345_520_6e-15,
    1.561_920_696_858_622_5e-16,
    8.220_635_246_624_33e-18,
    4.110_317_623_312_165e-19,
    1.957_294_106_339_126_3e-20,
    8.896_791_392_450_574e-22,
    3.868_170_170_630_684e-23,
    1.611_737_571_096_118_4e-24,
    6.446_950_284_384_474e-26,
    2.479_596_263_224_797_6e-27,
];

/// The coefficients (-1)^n/(2n + 1)! and (-1)^n/(2n)! that need all digits; the rest are single doubles.
const SINE: [Double; 9] = [
    Double(1.0, 0.0),
    Double(-0.166_666_666_666_666_66, -9.251_858_538_542_97e-18),
    Double(0.008_333_333_333_333_333, 1.156_482_317_317_871_4e-19),
    Double(-0.000_198_412_698_412_698_4, -1.720_955_829_342_070_5e-22),
    Double(2.755_731_922_398_589_3e-6, -1.858_393_274_046_472e-22),
    Double(-2.505_210_838_544_172e-8, 1.448_814_070_935_912e-24),
    Double(1.605_904_383_682_161_3e-10, 1.258_529_458_875_209_8e-26),
    Double(-7.647_163_731_819_816e-13, -7.038_728_777_334_53e-30),
    Double(2.811_457_254_345_520_6e-15, 1.650_884_273_086_143_3e-31),
];
const SINE_REST: [f64; 7] = [
    -8.220_635_246_624_33e-18,
    1.957_294_106_339_126_3e-20,
    -3.868_170_170_630_684e-23,
    6.446_950_284_384_474e-26,
    -9.183_689_863_795_546e-29,
    1.130_996_288_644_771_6e-31,
    -1.216_125_041_553_518e-34,
];

const COSINE: [Double; 9] = [
    Double(1.0, 0.0),
    Double(-0.5, 0.0),
    Double(0.041_666_666_666_666_664, 2.312_964_634_635_742_7e-18),
    Double(-0.001_388_888_888_888_889, 5.300_543_954_373_577e-20),
    Double(2.480_158_730_158_73e-5, 2.151_194_786_677_588_2e-23),
    Double(-2.755_731_922_398_589e-7, -2.376_771_462_225_029_7e-23),
    Double(2.087_675_698_786_81e-9, -1.207_345_059_113_26e-25),
    Double(-1.147_074_559_772_972_5e-11, -2.065_551_275_283_074_5e-28),
    Double(4.779_477_332_387_385e-14, 4.399_205_485_834_081e-31),
];
const COSINE_REST: [f64; 7] = [
    -1.561_920_696_858_622_5e-16,
    4.110_317_623_312_165e-19,
    -8.896_791_392_450_574e-22,
    1.611_737_571_096_118_4e-24,
    -2.479_596_263_224_797_6e-27,
    3.279_889_237_069_838e-30,
    -3.769_987_628_815_905_4e-33,
];

/// A number as the sum of two doubles, the second of which is less than the last digit of the first.
#[derive(Clone, Copy)]
struct Double(f64, f64);

/// a + b, exactly (Knuth, The Art of Computer Programming 2, section 4.2.2).
fn sum(a: f64, b: f64) -> Double {
    let sum = a + b;
    let rest = sum - a;
    Double(sum, (a - (sum - rest)) + (b - rest))
}

/// a b, exactly.
fn product(a: f64, b: f64) -> Double {
    let product = a * b;
    Double(product, a.mul_add(b, -product))
}

impl Double {
    fn plus(self, other: Double) -> Double {
        let Double(high, low) = sum(self.0, other.0);
        let Double(carry, rest) = sum(self.1, other.1);
        let Double(high, low) = sum(high, low + carry);
        sum(high, low + rest)
    }

    fn minus(self, other: Double) -> Double {
        self.plus(Double(-other.0, -other.1))
    }

    fn times(self, other: Double) -> Double {
        let Double(high, low) = product(self.0, other.0);
        sum(high, low + (self.0 * other.1 + self.1 * other.0))
    }

    /// The neighbouring numbers around the value, given its error; `None` if they are not certain.
    fn around(self, error: f64) -> Option<(f64, f64)> {
        let Double(near, rest) = sum(self.0, self.1);
        match near.is_finite() && rest.abs() > error {
            true if rest > 0.0 => Some((near, near.next_up())),
            true => Some((near.next_down(), near)),
            false => None,
        }
    }
}

/// The sum of c_n x^n for |x| < 0.7. The terms of `rest` make less than 2^-55 of the sum: one double has enough of their
/// digits.
fn polynomial(x: Double, first: &[Double], rest: &[f64]) -> Double {
    let mut value = 0.0;
    for coefficient in rest.iter().rev() {
        value = value * x.0 + coefficient;
    }
    let mut value = Double(value, 0.0);
    for coefficient in first.iter().rev() {
        value = coefficient.plus(x.times(value));
    }
    value
}

/// e^x for |x| <= 600.
fn exponential(x: Double) -> Double {
    let turns = (x.0 / LN_2[0]).round();
    let [coarse, fine] = LN_2.map(|part| product(turns, part));
    let rest = x.minus(coarse).minus(fine);
    // |rest| < 0.35, and 0.35^27/27! < 2^-130.
    let series = polynomial(rest, &EXPONENTIAL, &EXPONENTIAL_REST);
    // Two powers of two are needed, since 2^1010 times a sum and 2^-1010 times it may not be representable by themselves.
    let half = (turns / 2.0).trunc();
    let scale = |value: f64| value * 2f64.powi(half as i32) * 2f64.powi((turns - half) as i32);
    Double(scale(series.0), scale(series.1))
}

pub fn exp(x: f64) -> Option<(f64, f64)> {
    if x.abs() > LARGEST_EXPONENT {
        return None;
    }
    let value = exponential(Double(x, 0.0));
    value.around(value.0 * ERROR)
}

/// The logarithm of a positive number, from an approximation: ln z = y + ln(z e^-y).
fn logarithm(z: Double, y: f64) -> Option<Double> {
    if y.is_nan() || y.abs() > LARGEST_EXPONENT {
        return None;
    }
    let small = z.times(exponential(Double(-y, 0.0))).minus(Double(1.0, 0.0));
    // The terms beyond the square are less than 10^-36.
    if small.0.abs() > 1e-12 {
        return None;
    }
    let correction = small.minus(Double(small.0 * small.0 / 2.0, 0.0));
    Some(Double(y, 0.0).plus(correction))
}

pub fn ln(x: f64) -> Option<(f64, f64)> {
    logarithm(Double(x, 0.0), x.ln())?.around(ERROR)
}

pub fn ln_1p(x: f64) -> Option<(f64, f64)> {
    if x == 0.0 {
        return Some((0.0, 0.0));
    }
    logarithm(sum(1.0, x), x.ln_1p())?.around(ERROR)
}

/// base^exponent = e^(exponent ln base) for a positive base.
pub fn power(base: f64, exponent: f64) -> Option<(f64, f64)> {
    let power = logarithm(Double(base, 0.0), base.ln())?.times(Double(exponent, 0.0));
    if power.0.is_nan() || power.0.abs() > LARGEST_EXPONENT || exponent.abs() > LARGEST_EXPONENT {
        return None;
    }
    let value = exponential(power);
    // The exponent multiplies the error of the logarithm.
    value.around(value.0 * ERROR * (2.0 + exponent.abs()))
}

/// Whether products of three such numbers or of their roots stay in the range of normal numbers.
fn is_moderate(x: f64) -> bool {
    (1e-200..1e200).contains(&x.abs())
}

/// The square root: the hardware computes the nearest number, and the sign of x - y^2 determines on which side the root lies.
pub fn sqrt(x: f64) -> Option<(f64, f64)> {
    if !is_moderate(x) {
        return None;
    }
    let root = x.sqrt();
    let Double(square, rest) = product(root, root);
    // x and the rounded square are neighbours, so that their difference is a floating-point number.
    let excess = x - square;
    Some(match excess > rest {
        _ if excess == rest => (root, root),
        true => (root, root.next_up()),
        false => (root.next_down(), root),
    })
}

/// The cube root, from an approximation: y + (x - y^3)/(3 y^2).
pub fn cbrt(x: f64) -> Option<(f64, f64)> {
    if !is_moderate(x) {
        return None;
    }
    let root = x.cbrt();
    let square = product(root, root);
    let rest = Double(x, 0.0).minus(square.times(Double(root, 0.0)));
    let correction = rest.0 / (3.0 * square.0);
    // The terms beyond first order are less than 10^-28 of the root.
    if correction.abs() > 1e-14 * root.abs() {
        return None;
    }
    sum(root, correction).around(root.abs() * ERROR)
}

/// An angle less its quarter turns, and their number.
fn reduced(x: f64) -> Option<(Double, i64)> {
    if x.is_nan() || x.abs() > LARGEST_ANGLE {
        return None;
    }
    let turns = (x / QUARTER[0]).round();
    let rest = QUARTER.iter().fold(Double(x, 0.0), |rest, part| rest.minus(product(turns, *part)));
    Some((rest, turns as i64))
}

/// The greatest number of quarter turns not above an angle, and the least not below it.
pub fn quarters(x: f64) -> Option<[i64; 2]> {
    let (rest, turns) = reduced(x)?;
    match rest.0 {
        _ if x == 0.0 => Some([0, 0]),
        rest if rest > ERROR => Some([turns, turns + 1]),
        rest if rest < -ERROR => Some([turns - 1, turns]),
        _ => None,
    }
}

/// sin(x) and cos(x) for |x| < 0.8; the first truncated term is 0.8^32/32! < 2^-127.
fn sine(x: Double) -> Double {
    x.times(polynomial(x.times(x), &SINE, &SINE_REST))
}

fn cosine(x: Double) -> Double {
    polynomial(x.times(x), &COSINE, &COSINE_REST)
}

/// sin(x + shift pi/2).
fn circular(x: f64, shift: i64) -> Option<(f64, f64)> {
    let (rest, turns) = reduced(x)?;
    let quarter = (turns + shift).rem_euclid(4);
    let (lower, upper) = match quarter % 2 {
        0 => sine(rest).around(rest.0.abs() * ERROR + ERROR_OF_ANGLE)?,
        _ if rest.0.abs() < FLAT => (1_f64.next_down(), 1.0),
        _ => cosine(rest).around(ERROR)?,
    };
    Some(if quarter < 2 { (lower, upper) } else { (-upper, -lower) })
}

pub fn sin(x: f64) -> Option<(f64, f64)> {
    if x == 0.0 {
        return Some((0.0, 0.0));
    }
    match x.abs() < FLAT {
        true if x > 0.0 => Some((x.next_down(), x)),
        true => Some((x, x.next_up())),
        false => circular(x, 0),
    }
}

pub fn cos(x: f64) -> Option<(f64, f64)> {
    if x == 0.0 {
        return Some((1.0, 1.0));
    }
    circular(x, 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::precise::Precise;
    use mms_math::Scalar as _;

    /// Asserts in 77 digits that a value lies between two neighbours, or equals both.
    fn assert_around(found: Option<(f64, f64)>, value: Precise, what: &str) {
        let Some((lower, upper)) = found else { panic!("{what} is left undecided") };
        let (below, above) = (Precise::from_f64(lower), Precise::from_f64(upper));
        assert!(below.at_most(&value) && value.at_most(&above), "{what}: {lower:e} {upper:e}");
        assert!(upper == lower || upper == lower.next_up(), "{what}: {lower:e} {upper:e}");
    }

    #[test]
    fn roots_and_powers_lie_between_neighbours() {
        let mut x = 1e-12;
        while x < 1e12 {
            let exact = || Precise::from_f64(x);
            assert_around(sqrt(x), exact().sqrt(), &format!("sqrt({x:e})"));
            assert_around(cbrt(x), exact().cbrt(), &format!("cbrt({x:e})"));
            for exponent in [-2.0 / 3.0, 1.0 / 3.0, 0.1, -7.3, 11.9] {
                let exact = exact().powf(Precise::from_f64(exponent));
                assert_around(power(x, exponent), exact, &format!("{x:e}^{exponent}"));
            }
            x *= 1.37;
        }
        assert_eq!(sqrt(6.25), Some((2.5, 2.5)));
        assert_eq!(sqrt(1e-300), None);
    }

    /// Searches halve their boxes, so angles are often near quarter turns: sines near 0 and cosines near 1 are decided, too.
    #[test]
    fn waves_lie_between_neighbours_near_quarter_turns() {
        let around = |x: f64| {
            let exact = || Precise::from_f64(x);
            assert_around(sin(x), exact().sin(), &format!("sin({x:e})"));
            assert_around(cos(x), exact().cos(), &format!("cos({x:e})"));
        };
        for turns in (-40..40).chain([-50_000, 777, 63_000]) {
            let near = f64::from(turns) * core::f64::consts::FRAC_PI_2;
            let beside = [1e-3, 1e-6, 3.7e-9, 1e-12].map(|aside| near + aside);
            [near, near.next_up(), near.next_down(), near / 2.0, near / 8.0]
                .into_iter()
                .chain(beside)
                .for_each(around);
        }
        let mut tiny = 1.0;
        while tiny > 1e-30 {
            [tiny, -tiny].into_iter().for_each(around);
            tiny *= 0.37;
        }
        // 6381956970095103 2^797 is the double nearest to a quarter turn, but larger than the angles that are reduced here.
        assert_eq!(sin(6_381_956_970_095_103.0 * 2f64.powi(797)), None);
    }
}
