//! The elementary functions of an interval: directed rounding in arbitrary precision at the
//! bounds, and the extrema and poles between them.

use dashu_float::FBig;
use dashu_float::round::mode::{Down, HalfEven, Up};
use dashu_int::IBig;
use dashu_int::ops::CubicRoot as _;
use mms_math::Scalar;

use super::{Interval, quick};

/// The precision of values at a bound before they are rounded outward to double.
const BITS: usize = 64;

type Below = FBig<Down, 2>;
type Above = FBig<Up, 2>;

/// The nearest numbers around the exact value of a rising function at one finite number.
macro_rules! around {
    ($x:expr, $function:ident) => {
        (below(exact_below($x).$function()), above(exact_above($x).$function()))
    };
}

/// The nearest numbers around the exact value of a rising function, without arbitrary precision if possible.
macro_rules! quickly_around {
    ($x:expr, $function:ident) => {
        quick::$function($x).unwrap_or_else(|| around!($x, $function))
    };
}

fn exact_below(x: f64) -> Below {
    Below::try_from(x).unwrap_or(Below::ZERO).with_precision(BITS).value()
}

fn exact_above(x: f64) -> Above {
    Above::try_from(x).unwrap_or(Above::ZERO).with_precision(BITS).value()
}

fn below(value: Below) -> f64 {
    let near = value.to_f64().value();
    match Below::try_from(near) {
        Ok(exact) if near.is_finite() && exact <= value => near,
        _ if near == f64::NEG_INFINITY => near,
        _ => near.next_down(),
    }
}

fn above(value: Above) -> f64 {
    let near = value.to_f64().value();
    match Above::try_from(near) {
        Ok(exact) if near.is_finite() && exact >= value => near,
        _ if near == f64::INFINITY => near,
        _ => near.next_up(),
    }
}

/// The values of a rising function outside a range: the numbers around them.
struct Tails {
    from: f64,
    left: (f64, f64),
    to: f64,
    right: (f64, f64),
}

impl Tails {
    /// Tails of a function that needs none except at infinity.
    fn at_infinity(left: (f64, f64), right: (f64, f64)) -> Self {
        Tails { from: f64::MIN, left, to: f64::MAX, right }
    }

    fn around(&self, x: f64, inside: impl Fn(f64) -> (f64, f64)) -> (f64, f64) {
        if x < self.from {
            self.left
        } else if x > self.to {
            self.right
        } else {
            inside(x)
        }
    }
}

/// An angle in half turns, less `shift` halves, precisely enough to separate it from an integer: no double is closer to a
/// multiple of pi/2 than 2^-62 of it (Muller et al., Handbook of Floating-Point Arithmetic, section 10.1).
fn half_turns(angle: f64, shift: i32) -> FBig<HalfEven, 2> {
    type Float = FBig<HalfEven, 2>;
    // An angle of up to 2^1024 has as many digits before the point.
    const DIGITS: usize = 1024 + 128;
    let angle = Float::try_from(angle).unwrap_or(Float::ZERO).with_precision(DIGITS).value();
    let shift = Float::from(shift).with_precision(DIGITS).value();
    angle / Float::pi(DIGITS) - shift / Float::from(2)
}

/// Whether an interval contains a position (n + shift/2) pi with even n, and one with odd n.
fn positions(interval: Interval, shift: i32) -> (bool, bool) {
    if interval.width() >= 7.0 {
        return (true, true);
    }
    if let (Some([_, first]), Some([last, _])) =
        (quick::quarters(interval.lower), quick::quarters(interval.upper))
    {
        // The position (n + shift/2) pi is quarter turn 2 n + shift.
        let shift = i64::from(shift);
        let (first, last) = ((first - shift + 1).div_euclid(2), (last - shift).div_euclid(2));
        return parities(first.rem_euclid(2) == 0, last - first);
    }
    let first: IBig = half_turns(interval.lower, shift).ceil().to_int().value();
    let last: IBig = half_turns(interval.upper, shift).floor().to_int().value();
    let even = (&first % IBig::from(2)).is_zero();
    parities(even, i64::try_from(last - first).unwrap_or(i64::MAX))
}

/// Whether an even and whether an odd number is among `more + 1` consecutive numbers, whose first one is even or not.
fn parities(even: bool, more: i64) -> (bool, bool) {
    match more {
        ..0 => (false, false),
        0 => (even, !even),
        1.. => (true, true),
    }
}

impl Interval {
    fn rising(self, tails: &Tails, inside: impl Fn(f64) -> (f64, f64)) -> Self {
        let (lower, _) = tails.around(self.lower, &inside);
        let (_, upper) = tails.around(self.upper, &inside);
        Interval::new(lower, upper).only_if(self.defined)
    }

    /// The part within `[from, to]`, defined only if it is the whole interval; `None` if it is empty.
    fn within(self, from: f64, to: f64) -> Option<Self> {
        let part = Interval { lower: self.lower.max(from), upper: self.upper.min(to), ..self };
        (part.lower <= part.upper).then(|| part.only_if(self.lower >= from && self.upper <= to))
    }

    /// |x|.
    pub fn magnitude(self) -> Self {
        let upper = self.lower.abs().max(self.upper.abs());
        let lower = if self.contains(0.0) { 0.0 } else { self.lower.abs().min(self.upper.abs()) };
        Interval { lower, upper, defined: self.defined }
    }

    /// A sine or cosine whose maxima are at (2 n + shift/2) pi and whose minima lie between them.
    fn wave(self, shift: i32, at: impl Fn(f64) -> (f64, f64)) -> Self {
        if !self.lower.is_finite() || !self.upper.is_finite() {
            return Interval::new(-1.0, 1.0).only_if(self.defined);
        }
        let (maximum, minimum) = positions(self, shift);
        let (first, last) = (at(self.lower), at(self.upper));
        let lower = if minimum { -1.0 } else { first.0.min(last.0) };
        let upper = if maximum { 1.0 } else { first.1.max(last.1) };
        Interval::new(lower, upper).only_if(self.defined)
    }

    /// `self^exponent` for a positive base, from the corners: the power is monotonic in each operand.
    fn positive_power(self, exponent: Interval) -> Self {
        let (mut lower, mut upper) = (f64::INFINITY, f64::NEG_INFINITY);
        for base in self.ends() {
            for exponent in exponent.ends() {
                let (below, above) = power_around(base, exponent);
                (lower, upper) = (lower.min(below), upper.max(above));
            }
        }
        Interval::new(lower, upper).only_if(self.defined && exponent.defined)
    }

    /// Both bounds, or one number if they are equal.
    fn ends(self) -> impl Iterator<Item = f64> + Clone {
        let other = (self.upper > self.lower).then_some(self.upper);
        core::iter::once(self.lower).chain(other)
    }
}

/// The numbers around base^exponent, for a base that is positive or infinite.
fn power_around(base: f64, exponent: f64) -> (f64, f64) {
    if base == 1.0 || exponent == 0.0 {
        return (1.0, 1.0);
    }
    if base.is_infinite() || exponent.is_infinite() {
        let grows = (base > 1.0) == (exponent > 0.0);
        return if grows { (f64::MAX, f64::INFINITY) } else { (0.0, f64::from_bits(1)) };
    }
    if let Some(power) = quick::power(base, exponent) {
        return power;
    }
    // exp(exponent ln base), with every step rounded in one direction.
    let logarithm = (exact_below(base).ln(), exact_above(base).ln());
    let (from, to) = if exponent > 0.0 {
        (logarithm.0, logarithm.1)
    } else {
        let upper = logarithm.1.with_rounding::<Down>();
        (upper, logarithm.0.with_rounding::<Up>())
    };
    let least = below(from * exact_below(exponent));
    let greatest = above(to * exact_above(exponent));
    let power = Interval::new(least, greatest).exp();
    (power.lower, power.upper)
}

/// The nearest numbers around pi/2.
const QUARTER: (f64, f64) = (core::f64::consts::FRAC_PI_2, 1.570_796_326_794_896_8);

const UNIT: (f64, f64) = (1.0 - f64::EPSILON / 2.0, 1.0);
const LARGE: (f64, f64) = (f64::MAX, f64::INFINITY);
const TINY: (f64, f64) = (0.0, 5e-324);

fn minus(around: (f64, f64)) -> (f64, f64) {
    (-around.1, -around.0)
}

impl Scalar for Interval {
    type Wide = Self;

    fn widen(self) -> Self {
        self
    }

    fn narrow(wide: Self) -> Self {
        wide
    }

    fn from_f64(value: f64) -> Self {
        if value.is_finite() { Interval::new(value, value) } else { Interval::UNDEFINED }
    }

    fn ratio(numerator: i32, denominator: i32) -> Self {
        Self::from_f64(f64::from(numerator)) / Self::from_f64(f64::from(denominator))
    }

    fn pi() -> Self {
        // The double nearest to pi is below it.
        Interval::new(core::f64::consts::PI, core::f64::consts::PI.next_up())
    }

    fn sqrt(self) -> Self {
        let Some(part) = self.within(0.0, f64::INFINITY) else { return Interval::UNDEFINED };
        part.rising(&Tails::at_infinity(LARGE, LARGE), |x| quickly_around!(x, sqrt))
    }

    fn cbrt(self) -> Self {
        self.rising(&Tails::at_infinity(minus(LARGE), LARGE), |x| quickly_around!(x, cbrt))
    }

    fn exp(self) -> Self {
        let tails = Tails { from: -746.0, left: TINY, to: 710.0, right: LARGE };
        self.rising(&tails, |x| quickly_around!(x, exp))
    }

    fn exp_m1(self) -> Self {
        let tails = Tails { from: -746.0, left: minus(UNIT), to: 710.0, right: LARGE };
        self.rising(&tails, |x| around!(x, exp_m1))
    }

    fn ln(self) -> Self {
        let Some(part) = self.within(0.0, f64::INFINITY) else { return Interval::UNDEFINED };
        let tails =
            Tails { from: f64::from_bits(1), left: minus(LARGE), to: f64::MAX, right: LARGE };
        part.rising(&tails, |x| quickly_around!(x, ln)).only_if(part.lower > 0.0)
    }

    fn ln_1p(self) -> Self {
        let Some(part) = self.within(-1.0, f64::INFINITY) else { return Interval::UNDEFINED };
        let tails = Tails { from: -UNIT.0, left: minus(LARGE), to: f64::MAX, right: LARGE };
        part.rising(&tails, |x| quickly_around!(x, ln_1p)).only_if(part.lower > -1.0)
    }

    fn ln_1p_rest(self) -> Self {
        // The function falls to 0 at 0 and rises from there.
        let Some(part) = self.within(-1.0, f64::INFINITY) else { return Interval::UNDEFINED };
        let at = |x: f64| {
            let point = Interval::new(x, x);
            point - point.ln_1p()
        };
        let ends = [at(part.lower), at(part.upper)];
        let lower =
            if part.contains(0.0) { 0.0 } else { ends[0].lower.min(ends[1].lower).max(0.0) };
        let upper = ends[0].upper.max(ends[1].upper);
        Interval::new(lower, upper).only_if(part.defined && part.lower > -1.0)
    }

    fn sin(self) -> Self {
        self.wave(1, |x| quickly_around!(x, sin))
    }

    fn cos(self) -> Self {
        self.wave(0, |x| quickly_around!(x, cos))
    }

    fn tan(self) -> Self {
        if !self.lower.is_finite()
            || !self.upper.is_finite()
            || positions(self, 1) != (false, false)
        {
            return Interval::UNDEFINED;
        }
        self.rising(&Tails::at_infinity(LARGE, LARGE), |x| around!(x, tan))
    }

    fn sinh(self) -> Self {
        let tails = Tails { from: -711.0, left: minus(LARGE), to: 711.0, right: LARGE };
        self.rising(&tails, |x| around!(x, sinh))
    }

    fn cosh(self) -> Self {
        let tails = Tails { from: 0.0, left: LARGE, to: 711.0, right: LARGE };
        self.magnitude().rising(&tails, |x| around!(x, cosh))
    }

    fn tanh(self) -> Self {
        let tails = Tails { from: -20.0, left: minus(UNIT), to: 20.0, right: UNIT };
        self.rising(&tails, |x| around!(x, tanh))
    }

    fn asin(self) -> Self {
        let Some(part) = self.within(-1.0, 1.0) else { return Interval::UNDEFINED };
        part.rising(&Tails::at_infinity(LARGE, LARGE), |x| around!(x, asin))
    }

    fn acos(self) -> Self {
        let Some(part) = self.within(-1.0, 1.0) else { return Interval::UNDEFINED };
        // The function falls: the bounds are swapped.
        let falling = |x: f64| minus(around!(x, acos));
        -part.rising(&Tails::at_infinity(LARGE, LARGE), falling)
    }

    fn atan(self) -> Self {
        self.rising(&Tails::at_infinity(minus(QUARTER), QUARTER), |x| around!(x, atan))
    }

    fn atan2(self, x: Self) -> Self {
        let defined = self.defined && x.defined;
        let half_turn = Self::pi();
        let quarter = Interval::new(QUARTER.0, QUARTER.1);
        let angle = if x.lower > 0.0 {
            (self / x).atan()
        } else if self.lower > 0.0 {
            quarter - (x / self).atan()
        } else if self.upper < 0.0 {
            -quarter - (x / self).atan()
        } else {
            // The box contains the origin, or the cut on the negative x axis.
            let whole = Interval::new(-half_turn.upper, half_turn.upper);
            return whole.only_if(defined && x.upper < 0.0);
        };
        angle.only_if(defined)
    }

    fn powf(self, exponent: Self) -> Self {
        if self.lower > 0.0 {
            return self.positive_power(exponent);
        }
        let Some(part) = self.within(0.0, f64::INFINITY) else { return Interval::UNDEFINED };
        if exponent.lower <= 0.0 {
            return Interval { lower: 0.0, ..Interval::UNDEFINED };
        }
        // 0 to a positive power is 0; the largest base bounds the rest.
        let largest = Interval { lower: part.upper, ..part };
        let upper = if part.upper > 0.0 { largest.positive_power(exponent).upper } else { 0.0 };
        // A power rises with its base: no value between 0 and the largest base exceeds it.
        Interval::new(0.0, upper).only_if(part.defined && exponent.defined)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_lie_between_neighbours() {
        assert_eq!(QUARTER.0.next_up(), QUARTER.1);
        assert_eq!(UNIT.0, 1.0_f64.next_down());
    }
}
