//! Coefficients of Taylor series, computed by the compiler, and their sums.

use super::Double;

/// 1/2!, 1/3!, ...: for exp(x) - 1 - x, in powers of x from x^2 on.
pub(super) const EXPONENTIAL: [Double; 24] = inverse_factorials(2, 1);

/// 1/3!, 1/5!, ...: for sin(x)/x - 1, in powers of -x^2 from the first on.
pub(super) const SINE: [Double; 14] = inverse_factorials(3, 2);

/// 1/2!, 1/4!, ...: for cos(x) - 1, in powers of -x^2 from the first on.
pub(super) const COSINE: [Double; 14] = inverse_factorials(2, 2);

/// 1/3, 1/5, ...: for atan(x)/x - 1 in powers of -x^2, and for artanh(x)/x - 1 in powers of x^2.
pub(super) const INVERSE_TANGENT: [Double; 27] = {
    let mut coefficients = [Double::ZERO; 27];
    let mut index = 0;
    while index < coefficients.len() {
        coefficients[index] = Double::quotient(1.0, (2 * index + 3) as f64);
        index += 1;
    }
    coefficients
};

/// 1/n! for n = first, first + step, ... The factorials used are exact, their quotients rounded.
const fn inverse_factorials<const N: usize>(first: usize, step: usize) -> [Double; N] {
    let mut coefficients = [Double::ZERO; N];
    let mut factorial = Double::ONE;
    let mut n = 1;
    let mut index = 0;
    while index < N {
        while n <= first + step * index {
            factorial = factorial.times(Double::of(n as f64));
            n += 1;
        }
        coefficients[index] = Double::ONE.over(factorial);
        index += 1;
    }
    coefficients
}

/// The sum of coefficients times powers of `x`, by Horner's rule.
///
/// From the coefficient `short` on, terms must be below 2^-54 of the sum: then `f64` has enough digits for them.
pub(super) fn polynomial(x: Double, coefficients: &[Double], short: usize) -> Double {
    let (long, short) = coefficients.split_at(short);
    let tail = short.iter().rev().fold(0.0, |sum, coefficient| sum * x.high + coefficient.high);
    long.iter().rev().fold(Double::of(tail), |sum, &coefficient| sum * x + coefficient)
}
