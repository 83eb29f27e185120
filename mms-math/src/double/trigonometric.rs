//! The circular functions and their inverses.

use core::f64::consts::{FRAC_2_PI, FRAC_PI_2, PI};

use super::Double;
use super::exact::{exact_sum, exponent, nearest_integer, two_product};
use super::series::{COSINE, INVERSE_TANGENT, SINE, polynomial};
use crate::{FEW_HALF_TURNS, FEW_RADIANS, LARGEST_ANGLE};

/// pi and the inverse tangents of 1/2 and 1, both parts rounded to nearest.
pub(super) const DOUBLE_PI: Double = Double { high: PI, low: 1.2246467991473532e-16 };
const HALF_PI: Double = DOUBLE_PI.scaled(-1);
const ATAN_HALF: Double = Double { high: 0.4636476090008061, low: 2.2698777452961687e-17 };
const ATAN_ONE: Double = DOUBLE_PI.scaled(-2);

/// pi/2 to 322 bits, each part the remainder of the previous ones, rounded to nearest. The number nearest to a multiple of
/// pi/2, with a factor of up to 2^50, may have 220 bits in common with it.
const HALF_PI_PARTS: [f64; 6] = [
    FRAC_PI_2,
    6.123233995736766e-17,
    -1.4973849048591698e-33,
    5.562271104316826e-50,
    2.836115989820158e-66,
    8.724931080676243e-84,
];

/// The sine, for |x| <= 0.8.
fn sine(x: Double) -> Double {
    // A zero keeps its sign, which sums would lose.
    if x.high == 0.0 {
        return x;
    }
    let square = -(x * x);
    x + x * square * polynomial(square, &SINE, 8)
}

/// The cosine, for |x| <= 0.8.
fn cosine(x: Double) -> Double {
    let square = -(x * x);
    Double::ONE + square * polynomial(square, &COSINE, 8)
}

/// The sine of `rest` plus this number of quarter turns.
fn sine_of_turn(quarters: i64, rest: Double) -> Double {
    match quarters & 3 {
        0 => sine(rest),
        1 => cosine(rest),
        2 => -sine(rest),
        _ => -cosine(rest),
    }
}

/// The number of quarter turns nearest to an angle, and the remainder; NaN if the angle is NaN or too large.
fn quarter_turns(angle: Double) -> (i64, Double) {
    if angle.high.is_nan() || angle.high.abs() > LARGEST_ANGLE {
        return (0, Double::NAN);
    }
    let count = nearest_integer(angle.high * FRAC_2_PI);
    (count as i64, if count == 0.0 { angle } else { less_quarters(angle, count) })
}

/// Subtracts a whole number of quarter turns, below 2^51, from an angle.
fn less_quarters(angle: Double, count: f64) -> Double {
    let [a, b, c, d, e, f] = HALF_PI_PARTS.map(|part| two_product(-count, part));
    let rest = exact_sum([
        f.1, f.0, e.1, e.0, d.1, d.0, c.1, c.0, b.1, b.0, a.1, a.0, angle.low, angle.high,
    ]);
    Double::new(rest[0], rest[1])
}

/// An angle in half turns minus whole turns, of less than two half turns.
fn less_whole_turns(angle: Double) -> Double {
    Double::new(angle.high % 2.0, angle.low % 2.0)
}

/// The number of quarter turns nearest to an angle in units of pi, and the remainder in radians: exact up to the factor pi of
/// the remainder.
fn quarter_turns_of_half(angle: Double) -> (i64, Double) {
    let within_a_turn = less_whole_turns(angle);
    let count = nearest_integer(2.0 * within_a_turn.high);
    // Infinite angles, for which `%` is NaN, pass through.
    (count as i64, (within_a_turn - Double::of(0.5 * count)) * DOUBLE_PI)
}

/// The inverse tangent of small/large, for 0 <= small <= large, neither near the end of its range.
///
/// Subtracts the nearest of 0, atan(1/2) and atan(1), so that the argument of the series is at most 1/4.
fn first_octant(small: Double, large: Double) -> Double {
    let ratio = small.high / large.high;
    let (center, angle) = if ratio < 0.25 {
        (0.0, Double::ZERO)
    } else if ratio < 0.75 {
        (0.5, ATAN_HALF)
    } else {
        (1.0, ATAN_ONE)
    };
    let center = Double::of(center);
    let tangent = if ratio < 0.25 {
        small / large
    } else {
        (small - large * center) / (large + small * center)
    };
    let square = -(tangent * tangent);
    angle + (tangent + tangent * square * polynomial(square, &INVERSE_TANGENT, 13))
}

impl Double {
    pub(super) fn circular_sine(self) -> Self {
        let (quarters, rest) = quarter_turns(self);
        sine_of_turn(quarters, rest)
    }

    pub(super) fn circular_cosine(self) -> Self {
        let (quarters, rest) = quarter_turns(self);
        sine_of_turn(quarters + 1, rest)
    }

    pub(super) fn circular_tangent(self) -> Self {
        let (quarters, rest) = quarter_turns(self);
        sine_of_turn(quarters, rest) / sine_of_turn(quarters + 1, rest)
    }

    pub(super) fn sine_of_half_turns(self) -> Self {
        let (quarters, rest) = quarter_turns_of_half(self);
        sine_of_turn(quarters, rest)
    }

    pub(super) fn cosine_of_half_turns(self) -> Self {
        let (quarters, rest) = quarter_turns_of_half(self);
        sine_of_turn(quarters + 1, rest)
    }

    /// An angle of more than a few radians minus the nearest whole turns, if it can be reduced.
    pub(super) fn less_turns(self) -> Self {
        let magnitude = self.high.abs();
        if !(magnitude > FEW_RADIANS && magnitude <= LARGEST_ANGLE) {
            return self;
        }
        less_quarters(self, 4.0 * nearest_integer(self.high * (0.25 * FRAC_2_PI)))
    }

    /// An angle in half turns, of any size, minus the nearest whole turns.
    pub(super) fn less_pairs_of_half_turns(self) -> Self {
        if self.high.abs() <= FEW_HALF_TURNS {
            return self;
        }
        let within = less_whole_turns(self);
        within - Double::of(2.0 * nearest_integer(0.5 * within.high))
    }

    /// The angle of (`x`, `self`), from the first octant by reflections.
    pub(super) fn angle(self, x: Self) -> Self {
        if self.high.is_nan() || x.high.is_nan() {
            return Double::NAN;
        }
        let (height, width) = (self.magnitude(), x.magnitude());
        // At infinity only directions count: of the axes and of the diagonals.
        let unit = |value: f64| Double::of(if value.is_infinite() { 1.0 } else { 0.0 });
        let (height, width) = if height.high.is_infinite() || width.high.is_infinite() {
            (unit(height.high), unit(width.high))
        } else {
            (height, width)
        };
        let steep = height > width;
        let (small, large) = if steep { (width, height) } else { (height, width) };
        let octant = if small.high == 0.0 {
            Double::ZERO
        } else {
            let shift = -exponent(large.high);
            first_octant(small.scaled(shift), large.scaled(shift))
        };
        let quadrant = if steep { HALF_PI - octant } else { octant };
        let half = if x.high.is_sign_negative() { DOUBLE_PI - quadrant } else { quadrant };
        half.with_sign_of(self.high)
    }

    /// sqrt((1 - x)(1 + x)), the cosine of a sine: only this form keeps all digits next to 1.
    fn complement(self) -> Self {
        ((Double::ONE - self) * (Double::ONE + self)).square_root()
    }

    pub(super) fn inverse_sine(self) -> Self {
        self.angle(self.complement())
    }

    pub(super) fn inverse_cosine(self) -> Self {
        self.complement().angle(self)
    }
}
