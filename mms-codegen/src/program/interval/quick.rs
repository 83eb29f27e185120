//! Elementary functions at one number in the sum of two doubles, with a bound of the error: a
//! hundred times faster than arbitrary precision, which is left with what they cannot decide.
//!
//! The arithmetic is that of Joldes, Muller & Popescu (Tight and rigorous error bounds for basic
//! building blocks of double-word arithmetic, 2017): each operation errs by less than 2^-102 of its
//! result. What is declared below is some hundred times what all of them, and the series that are
//! cut off, make together.

/// The declared errors: of an exponential, a power and a root relative to it, of the others in
/// absolute terms.
const ERROR: f64 = 1.0 / (1u128 << 88) as f64;

/// Larger angles are reduced elsewhere.
const LARGEST_ANGLE: f64 = 1e5;

/// An exponential of less is far from the least and the greatest numbers, and so is its opposite's.
const LARGEST_EXPONENT: f64 = 600.0;

/// ln 2 and pi/2 as sums of doubles that do not overlap.
const LN_2: [f64; 2] = [core::f64::consts::LN_2, 2.319_046_813_846_299_6e-17];
const QUARTER: [f64; 3] =
    [core::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17, -1.497_384_904_859_169_8e-33];

/// A number as the sum of two doubles, of which the second is less than the last digit of the first.
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

    /// Divided by a small integer.
    fn over(self, divisor: f64) -> Double {
        let quotient = self.0 / divisor;
        let rest = (-quotient).mul_add(divisor, self.0) + self.1;
        sum(quotient, rest / divisor)
    }

    /// The neighbouring numbers that the value lies between, given the error; `None` where that is
    /// not certain.
    fn around(self, error: f64) -> Option<(f64, f64)> {
        let Double(near, rest) = sum(self.0, self.1);
        match near.is_finite() && rest.abs() > error {
            true if rest > 0.0 => Some((near, near.next_up())),
            true => Some((near.next_down(), near)),
            false => None,
        }
    }
}

/// e^x for |x| <= 600.
fn exponential(x: Double) -> Double {
    let turns = (x.0 / LN_2[0]).round();
    let [coarse, fine] = LN_2.map(|part| product(turns, part));
    let rest = x.minus(coarse).minus(fine);
    // |rest| < 0.35, and 0.35^26/26! < 2^-127.
    let mut series = Double(1.0, 0.0);
    for n in (1..=26).rev() {
        series = Double(1.0, 0.0).plus(rest.times(series).over(f64::from(n)));
    }
    // Two powers of two, since that of 1010 and that of -1010 are no numbers by themselves.
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

/// The logarithm of a positive number, from one that is nearly right: ln z = y + ln(z e^-y).
fn logarithm(z: Double, y: f64) -> Option<Double> {
    if y.is_nan() || y.abs() > LARGEST_EXPONENT {
        return None;
    }
    let small = z.times(exponential(Double(-y, 0.0))).minus(Double(1.0, 0.0));
    // Beyond the square there is less than 10^-36.
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

/// Whether no product of three such numbers or their roots leaves the range of normal numbers.
fn is_moderate(x: f64) -> bool {
    (1e-200..1e200).contains(&x.abs())
}

/// The square root: that of hardware is the nearest number, and the sign of x - y^2 tells on which
/// side it lies.
pub fn sqrt(x: f64) -> Option<(f64, f64)> {
    if !is_moderate(x) {
        return None;
    }
    let root = x.sqrt();
    let Double(square, rest) = product(root, root);
    // x and the rounded square are neighbours, so that their difference is a number itself.
    let excess = x - square;
    Some(match excess > rest {
        _ if excess == rest => (root, root),
        true => (root, root.next_up()),
        false => (root.next_down(), root),
    })
}

/// The cube root, from one that is nearly right: y + (x - y^3)/(3 y^2).
pub fn cbrt(x: f64) -> Option<(f64, f64)> {
    if !is_moderate(x) {
        return None;
    }
    let root = x.cbrt();
    let square = product(root, root);
    let rest = Double(x, 0.0).minus(square.times(Double(root, 0.0)));
    let correction = rest.0 / (3.0 * square.0);
    // Beyond the first order there is less than 10^-28 of the root.
    if correction.abs() > 1e-14 * root.abs() {
        return None;
    }
    sum(root, correction).around(root.abs() * ERROR)
}

/// An angle less its quarter turns, and how many these are.
fn reduced(x: f64) -> Option<(Double, i64)> {
    if x.is_nan() || x.abs() > LARGEST_ANGLE {
        return None;
    }
    let turns = (x / QUARTER[0]).round();
    let rest = QUARTER.iter().fold(Double(x, 0.0), |rest, part| rest.minus(product(turns, *part)));
    Some((rest, turns as i64))
}

/// The greatest number of quarter turns that is at most an angle, and the least that is at least it.
pub fn quarters(x: f64) -> Option<[i64; 2]> {
    let (rest, turns) = reduced(x)?;
    match rest.0 {
        _ if x == 0.0 => Some([0, 0]),
        rest if rest > ERROR => Some([turns, turns + 1]),
        rest if rest < -ERROR => Some([turns - 1, turns]),
        _ => None,
    }
}

/// The series of x^n/n! with alternating signs, from n = 0 or 1 in steps of 2.
fn alternating(x: Double, first: u32) -> Double {
    let square = x.times(x);
    // |x| < 0.8, and 0.8^30/30! < 2^-116.
    let mut series = Double(1.0, 0.0);
    for n in (first + 2..=30 + first).rev().step_by(2).map(f64::from) {
        series = Double(1.0, 0.0).minus(square.times(series).over(n * (n - 1.0)));
    }
    if first == 1 { x.times(series) } else { series }
}

/// sin(x + shift pi/2).
fn circular(x: f64, shift: i64) -> Option<(f64, f64)> {
    let (rest, turns) = reduced(x)?;
    let value = match (turns + shift).rem_euclid(4) {
        0 => alternating(rest, 1),
        1 => alternating(rest, 0),
        2 => Double(0.0, 0.0).minus(alternating(rest, 1)),
        _ => Double(0.0, 0.0).minus(alternating(rest, 0)),
    };
    value.around(ERROR)
}

pub fn sin(x: f64) -> Option<(f64, f64)> {
    if x == 0.0 {
        return Some((0.0, 0.0));
    }
    circular(x, 0)
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
    use crate::program::precise::Precise;
    use mms_math::Scalar as _;

    /// Whether 77 digits agree that a value lies between two neighbours, or is both.
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
}
