//! Operations on `f64` whose round-off is itself an `f64`, and sums of such parts.
//!
//! All functions use plain IEEE arithmetic without a fused multiply-add, so that results are the same on every machine. They
//! are constant functions, so that the compiler can compute coefficients.

/// 2^`exponent`, for exponents of normal numbers.
const fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((1023 + exponent) as u64) << 52)
}

/// `value` 2^`shift`, for |shift| <= 2044: exact unless it overflows or becomes subnormal.
pub(super) const fn scaled(value: f64, shift: i32) -> f64 {
    let half = shift / 2;
    value * power_of_two(half) * power_of_two(shift - half)
}

/// The exponent of two of a positive finite number: 0 for 1 <= value < 2.
pub(super) const fn exponent(value: f64) -> i32 {
    if value < f64::MIN_POSITIVE {
        return exponent(value * power_of_two(64)) - 64;
    }
    (value.to_bits() >> 52) as i32 - 1023
}

/// The nearest integer, for |value| < 2^51: the sum has no bits for anything smaller.
pub(super) const fn nearest_integer(value: f64) -> f64 {
    const FIRST_WITHOUT_FRACTION: f64 = 1.5 * power_of_two(52);
    (value + FIRST_WITHOUT_FRACTION) - FIRST_WITHOUT_FRACTION
}

/// The rounded sum and its error (Knuth, 1969).
pub(super) const fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let second = sum - a;
    (sum, (a - (sum - second)) + (b - second))
}

/// The rounded sum and its error, for |a| >= |b| or a = 0 (Dekker, 1971).
pub(super) const fn ordered_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    (sum, b - (sum - a))
}

/// Two parts of at most 26 bits each, the first rounded to nearest. Uses integers, since Dekker's multiplication by 2^27 + 1
/// would overflow; with integers only the last 2^-27 below the largest number overflow.
const fn split(value: f64) -> (f64, f64) {
    const LOWER: u64 = (1 << 27) - 1;
    let upper = f64::from_bits((value.to_bits() + (1 << 26)) & !LOWER);
    (upper, value - upper)
}

/// The rounded product and its error (Dekker, 1971). Exact unless the error is subnormal, that is for products from 2^-968 up.
pub(super) const fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    let (a_upper, a_lower) = split(a);
    let (b_upper, b_lower) = split(b);
    let crossed = (a_upper * b_upper - product) + a_upper * b_lower + a_lower * b_upper;
    (product, crossed + a_lower * b_lower)
}

/// The sum of all terms, added exactly (Shewchuk, 1997) and cut to its three leading parts, whose
/// error is below 2^-150 of the sum.
pub(super) fn exact_sum<const N: usize>(terms: [f64; N]) -> [f64; 3] {
    let mut parts = [0.0; N];
    for (count, term) in terms.into_iter().enumerate() {
        let mut carry = term;
        for part in &mut parts[..count] {
            (carry, *part) = two_sum(carry, *part);
        }
        parts[count] = carry;
    }
    let mut leading = [0.0; 3];
    let mut place = 0;
    let mut carry = 0.0;
    for part in parts.into_iter().rev() {
        let (sum, rest) = ordered_sum(carry, part);
        carry = sum;
        if rest != 0.0 && place < leading.len() {
            leading[place] = sum;
            place += 1;
            carry = rest;
        }
    }
    if place < leading.len() {
        leading[place] = carry;
    }
    leading
}
