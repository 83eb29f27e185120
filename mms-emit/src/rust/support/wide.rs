/// A number of twice the digits of an `f64`: the unevaluated sum of two.
#[derive(Clone, Copy, Debug)]
pub struct Wide {
    high: f64,
    low: f64,
}

impl core::ops::Neg for Wide {
    type Output = Wide;
    fn neg(self) -> Wide {
        wide_parts(-self.high, -self.low)
    }
}

impl core::ops::Add for Wide {
    type Output = Wide;
    /// Joldes, Muller and Popescu (2017), algorithm 6.
    fn add(self, other: Wide) -> Wide {
        let high = two_sum(self.high, other.high);
        let low = two_sum(self.low, other.low);
        let first = settled(high.high, high.low + low.high);
        settled(first.high, first.low + low.low)
    }
}

impl core::ops::Sub for Wide {
    type Output = Wide;
    fn sub(self, other: Wide) -> Wide {
        self + -other
    }
}

impl core::ops::Mul for Wide {
    type Output = Wide;
    fn mul(self, other: Wide) -> Wide {
        let product = two_product(self.high, other.high);
        settled(product.high, product.low + (self.high * other.low + self.low * other.high))
    }
}

impl core::ops::Div for Wide {
    type Output = Wide;
    /// Three quotients of high parts; the second and third divide the remainder of the one before.
    fn div(self, other: Wide) -> Wide {
        let first = self.high / other.high;
        let rest = self - other * wide_of(first);
        let second = rest.high / other.high;
        let rest = rest - other * wide_of(second);
        let quotient = settled(first, second);
        settled(quotient.high, quotient.low + rest.high / other.high)
    }
}

/// An `f64` as a number of twice the digits.
fn wide_of(value: f64) -> Wide {
    Wide { high: value, low: 0.0 }
}

/// A constant: the nearest `f64`, and the nearest `f64` to the remainder.
fn wide_parts(high: f64, low: f64) -> Wide {
    Wide { high, low }
}

/// The rounded sum and its error (Knuth, 1969).
fn two_sum(a: f64, b: f64) -> Wide {
    let sum = a + b;
    let second = sum - a;
    wide_parts(sum, (a - (sum - second)) + (b - second))
}

/// A sum and its smaller correction as a number. A correction that is not finite is dropped.
fn settled(sum: f64, rest: f64) -> Wide {
    let high = sum + rest;
    match rest.is_finite() && high.is_finite() {
        true => wide_parts(high, rest - (high - sum)),
        false => wide_of(sum),
    }
}

/// The upper half of the digits (Dekker, 1971).
fn upper_half(value: f64) -> f64 {
    let scaled = 134217729.0 * value;
    scaled - (scaled - value)
}

/// The rounded product and its error (Dekker, 1971).
fn two_product(a: f64, b: f64) -> Wide {
    let product = a * b;
    let (a_upper, b_upper) = (upper_half(a), upper_half(b));
    let (a_lower, b_lower) = (a - a_upper, b - b_upper);
    let crossed = (a_upper * b_upper - product) + a_upper * b_lower + a_lower * b_upper;
    wide_parts(product, crossed + a_lower * b_lower)
}

/// 2^shift times the number, in two steps: 2^shift alone may be out of range.
fn wide_ldexp(a: Wide, shift: i32) -> Wide {
    let power = |shift: i32| f64::from_bits(((1023 + shift) as u64) << 52);
    let (first, second) = (power(shift / 2), power(shift - shift / 2));
    settled(a.high * first * second, a.low * first * second)
}

fn nearest_integer(value: f64) -> f64 {
    Real::floor(value + 0.5)
}

/// One step of Newton's method from an `f64`.
fn wide_sqrt(a: Wide) -> Wide {
    let root = Real::sqrt(a.high);
    let rest = a - two_product(root, root);
    settled(root, rest.high / (2.0 * root))
}

fn wide_cbrt(a: Wide) -> Wide {
    let root = Real::cbrt(a.high);
    let rest = a - two_product(root, root) * wide_of(root);
    settled(root, rest.high / (3.0 * root * root))
}

/// exp(a) - 1 for |a| <= 0.4, by its series.
fn exp_m1_series(a: Wide) -> Wide {
    let mut sum = wide_of(0.0);
    for n in (1..27).rev() {
        sum = a * (wide_of(1.0) + sum) / wide_of(f64::from(n));
    }
    sum
}

fn wide_exp(a: Wide) -> Wide {
    // ln 2 in three parts; the first two have 42 bits, so that their products with exponents are exact.
    const LN_2_PARTS: [f64; 3] = [0.6931471805598903, 5.49792301870721e-14, 1.1612227229362532e-26];
    if !(Real::magnitude(a.high) < 708.0) {
        return wide_of(Real::exp(a.high));
    }
    let count = nearest_integer(a.high / LN_2_PARTS[0]);
    let rest = LN_2_PARTS.iter().fold(a, |rest, part| rest - wide_of(count * part));
    wide_ldexp(wide_of(1.0) + exp_m1_series(rest), count as i32)
}

fn wide_exp_m1(a: Wide) -> Wide {
    if Real::magnitude(a.high) < 0.4 { exp_m1_series(a) } else { wide_exp(a) - wide_of(1.0) }
}

/// artanh(a)/a - 1 for |a| <= 0.2, by its series.
fn artanh_excess(a: Wide) -> Wide {
    let square = a * a;
    let mut sum = wide_of(0.0);
    for n in (1..26).rev() {
        sum = square * (sum + wide_of(1.0) / wide_of(f64::from(2 * n + 1)));
    }
    sum
}

/// ln(1 + a) = 2 artanh(a/(2 + a)), for -1/3 <= a <= 1/2.
fn ln_1p_series(a: Wide) -> Wide {
    let ratio = a / (a + wide_of(2.0));
    wide_ldexp(ratio + ratio * artanh_excess(ratio), 1)
}

/// The exponent e of 2^(e - 1) <= value < 2^e, of a positive number.
fn binary_exponent(value: f64) -> i32 {
    match (value.to_bits() >> 52) as i32 {
        0 => binary_exponent(value * 18014398509481984.0) - 54,
        biased => biased - 1022,
    }
}

fn wide_ln(a: Wide) -> Wide {
    if !(a.high > 0.0 && a.high.is_finite()) {
        return wide_of(Real::ln(a.high));
    }
    let mut count = binary_exponent(a.high);
    if wide_ldexp(a, -count).high < core::f64::consts::FRAC_1_SQRT_2 {
        count -= 1;
    }
    let ln_2 = wide_parts(core::f64::consts::LN_2, 2.3190468138462996e-17);
    ln_2 * wide_of(f64::from(count)) + ln_1p_series(wide_ldexp(a, -count) - wide_of(1.0))
}

fn wide_ln_1p(a: Wide) -> Wide {
    let is_small = a.high > -0.25 && a.high < 0.4;
    if is_small { ln_1p_series(a) } else { wide_ln(wide_of(1.0) + a) }
}

/// a - ln(1 + a): with s = a/(2 + a), a - 2 s = a s.
fn wide_ln_1p_rest(a: Wide) -> Wide {
    if a.high < -1.0 / 3.0 || a.high > 0.5 {
        return a - wide_ln_1p(a);
    }
    let ratio = a / (a + wide_of(2.0));
    ratio * (a - wide_ldexp(artanh_excess(ratio), 1))
}

fn wide_pi() -> Wide {
    wide_parts(core::f64::consts::PI, 1.2246467991473532e-16)
}

/// -a^2/(m (m - 1)) (1 - a^2/((m - 2)(m - 3)) (1 - ...)), from the term m = n down.
fn circular_series(a: Wide, n: i32) -> Wide {
    let square = -(a * a);
    let mut sum = wide_of(0.0);
    let mut m = n;
    while m > 1 {
        sum = square * (wide_of(1.0) + sum) / wide_of(f64::from(m * (m - 1)));
        m -= 2;
    }
    sum
}

/// sin(quarters pi/2 + rest), for |rest| <= 0.8.
fn sine_of_turn(quarters: f64, rest: Wide) -> Wide {
    let turn = ((quarters % 4.0) as i32).rem_euclid(4);
    let result = match turn % 2 {
        0 => rest + rest * circular_series(rest, 31),
        _ => wide_of(1.0) + circular_series(rest, 32),
    };
    if turn < 2 { result } else { -result }
}

/// angle - count pi/2, for angles up to 2^50.
fn less_quarters(angle: Wide, count: f64) -> Wide {
    const HALF_PI_PARTS: [f64; 4] = [
        core::f64::consts::FRAC_PI_2,
        6.123233995736766e-17,
        -1.4973849048591698e-33,
        5.562271104316826e-50,
    ];
    HALF_PI_PARTS.iter().fold(angle, |rest, part| rest - two_product(count, *part))
}

/// sin(angle + quarters pi/2); NaN for angles beyond 2^50.
fn sine_of_angle(angle: Wide, quarters: f64) -> Wide {
    if !(Real::magnitude(angle.high) < 1125899906842624.0) {
        return wide_of(f64::NAN);
    }
    let count = nearest_integer(angle.high / core::f64::consts::FRAC_PI_2);
    sine_of_turn(count + quarters, less_quarters(angle, count))
}

fn wide_sin(a: Wide) -> Wide {
    sine_of_angle(a, 0.0)
}

fn wide_cos(a: Wide) -> Wide {
    sine_of_angle(a, 1.0)
}

fn wide_tan(a: Wide) -> Wide {
    wide_sin(a) / wide_cos(a)
}

/// sin(pi half_turns + quarters pi/2); whole turns are subtracted without error.
fn sine_of_half_turns(half_turns: Wide, quarters: f64) -> Wide {
    if !half_turns.high.is_finite() {
        return wide_of(f64::NAN);
    }
    let turn = two_sum(half_turns.high % 2.0, half_turns.low % 2.0);
    let count = nearest_integer(2.0 * turn.high);
    sine_of_turn(count + quarters, (turn - wide_of(0.5 * count)) * wide_pi())
}

fn wide_sin_pi(a: Wide) -> Wide {
    sine_of_half_turns(a, 0.0)
}

fn wide_cos_pi(a: Wide) -> Wide {
    sine_of_half_turns(a, 1.0)
}

/// An angle without its whole turns; angles up to 25 and beyond 2^50 are returned as they are.
fn wide_within_turns(a: Wide) -> Wide {
    let size = Real::magnitude(a.high);
    if !(size > 25.0 && size < 1125899906842624.0) {
        return a;
    }
    less_quarters(a, 4.0 * nearest_integer(a.high / core::f64::consts::TAU))
}

/// An angle in half turns without its whole turns, of any size; angles up to 8 are returned as they are.
fn wide_within_turns_pi(a: Wide) -> Wide {
    if !(Real::magnitude(a.high) > 8.0 && a.high.is_finite()) {
        return a;
    }
    let turn = two_sum(a.high % 2.0, a.low % 2.0);
    turn - wide_of(2.0 * nearest_integer(0.5 * turn.high))
}

/// (e^a - e^-a)/2: from e = exp_m1(a) as (e + e/(1 + e))/2 where the difference would cancel.
fn wide_sinh(a: Wide) -> Wide {
    if Real::magnitude(a.high) < 1.0 {
        let e = wide_exp_m1(a);
        return wide_ldexp(e + e / (wide_of(1.0) + e), -1);
    }
    let half = wide_ldexp(wide_exp(a), -1);
    half - wide_of(0.25) / half
}

fn wide_cosh(a: Wide) -> Wide {
    let half = wide_ldexp(wide_exp(a), -1);
    half + wide_of(0.25) / half
}

/// e/(e + 2) with e = exp_m1(2 a).
fn wide_tanh(a: Wide) -> Wide {
    if !(Real::magnitude(a.high) < 40.0) {
        return wide_of(Real::tanh(a.high));
    }
    let e = wide_exp_m1(wide_ldexp(a, 1));
    e / (e + wide_of(2.0))
}

/// The angle of an `f64`, and by how far the point lies off it.
fn wide_atan2(y: Wide, x: Wide) -> Wide {
    let angle = Real::atan2(y.high, x.high);
    let (sine, cosine) = (wide_sin(wide_of(angle)), wide_cos(wide_of(angle)));
    let (across, along) = (y * cosine - x * sine, x * cosine + y * sine);
    settled(angle, across.high / along.high)
}

fn wide_atan(a: Wide) -> Wide {
    wide_atan2(a, wide_of(1.0))
}

/// The cosine of asin(a): next to 1 only this product keeps all digits.
fn complement(a: Wide) -> Wide {
    wide_sqrt((wide_of(1.0) - a) * (wide_of(1.0) + a))
}

fn wide_asin(a: Wide) -> Wide {
    wide_atan2(a, complement(a))
}

fn wide_acos(a: Wide) -> Wide {
    wide_atan2(complement(a), a)
}

/// base^exponent, for a base that is not negative.
fn wide_powf(base: Wide, exponent: Wide) -> Wide {
    if !(base.high > 0.0 && base.high.is_finite()) {
        return wide_of(Real::powf(base.high, exponent.high));
    }
    wide_exp(exponent * wide_ln(base))
}
