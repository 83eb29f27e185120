//! Elementary functions at one number in the sum of two doubles, with a bound of the error: a
//! hundred times faster than arbitrary precision, which is left with what they cannot decide.
//!
//! The arithmetic is that of Joldes, Muller & Popescu (Tight and rigorous error bounds for basic
//! building blocks of double-word arithmetic, 2017): each operation errs by less than 2^-102 of its
//! result. What is declared below is some hundred times what all of them, and the series that are
//! cut off, make together.

/// The declared errors: of an exponential relative to it, of the others in absolute terms.
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
fn exponential(x: f64) -> Double {
    let turns = (x / LN_2[0]).round();
    let [coarse, fine] = LN_2.map(|part| product(turns, part));
    let rest = Double(x, 0.0).minus(coarse).minus(fine);
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
    let value = exponential(x);
    value.around(value.0 * ERROR)
}

/// The logarithm of a positive number, from one that is nearly right: ln z = y + ln(z e^-y).
fn logarithm(z: Double, y: f64) -> Option<(f64, f64)> {
    if y.is_nan() || y.abs() > LARGEST_EXPONENT {
        return None;
    }
    let small = z.times(exponential(-y)).minus(Double(1.0, 0.0));
    // Beyond the square there is less than 10^-36.
    if small.0.abs() > 1e-12 {
        return None;
    }
    let correction = small.minus(Double(small.0 * small.0 / 2.0, 0.0));
    Double(y, 0.0).plus(correction).around(ERROR)
}

pub fn ln(x: f64) -> Option<(f64, f64)> {
    logarithm(Double(x, 0.0), x.ln())
}

pub fn ln_1p(x: f64) -> Option<(f64, f64)> {
    if x == 0.0 {
        return Some((0.0, 0.0));
    }
    logarithm(sum(1.0, x), x.ln_1p())
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
