#include <cmath>

#define FIELD_FUNCTION inline

/// A number of twice the digits of a double: the unevaluated sum of two.
struct wide {
    double high, low;
};

/// A double as a number of twice the digits.
FIELD_FUNCTION wide wide_of(double value)
{
    return {value, 0.0};
}

/// The rounded sum and its error (Knuth, 1969).
FIELD_FUNCTION wide two_sum(double a, double b)
{
    const double sum = a + b;
    const double second = sum - a;
    return {sum, (a - (sum - second)) + (b - second)};
}

/// A sum and its smaller correction as a number. A correction that is not finite is dropped.
FIELD_FUNCTION wide settled(double sum, double rest)
{
    const double high = sum + rest;
    return std::isfinite(rest) && std::isfinite(high) ? wide{high, rest - (high - sum)} : wide_of(sum);
}

/// The upper half of the digits (Dekker, 1971). Volatile, so that nothing is fused.
FIELD_FUNCTION double upper_half(double value)
{
    const volatile double scaled = 134217729.0 * value;
    const double kept = scaled;
    return kept - (kept - value);
}

/// The rounded product and its error (Dekker, 1971).
FIELD_FUNCTION wide two_product(double a, double b)
{
    const volatile double rounded = a * b;
    const double product = rounded;
    const double a_upper = upper_half(a), b_upper = upper_half(b);
    const double a_lower = a - a_upper, b_lower = b - b_upper;
    const double crossed = (a_upper * b_upper - product) + a_upper * b_lower + a_lower * b_upper;
    return {product, crossed + a_lower * b_lower};
}

FIELD_FUNCTION wide operator-(wide a)
{
    return {-a.high, -a.low};
}

/// Joldes, Muller and Popescu (2017), algorithm 6.
FIELD_FUNCTION wide operator+(wide a, wide b)
{
    const wide high = two_sum(a.high, b.high);
    const wide low = two_sum(a.low, b.low);
    const wide first = settled(high.high, high.low + low.high);
    return settled(first.high, first.low + low.low);
}

FIELD_FUNCTION wide operator-(wide a, wide b)
{
    return a + -b;
}

FIELD_FUNCTION wide operator*(wide a, wide b)
{
    const wide product = two_product(a.high, b.high);
    return settled(product.high, product.low + (a.high * b.low + a.low * b.high));
}

/// Three quotients of high parts, each of what the last has left over.
FIELD_FUNCTION wide operator/(wide a, wide b)
{
    const double first = a.high / b.high;
    const wide rest = a - b * wide_of(first);
    const double second = rest.high / b.high;
    const wide last = rest - b * wide_of(second);
    const wide quotient = settled(first, second);
    return settled(quotient.high, quotient.low + last.high / b.high);
}

FIELD_FUNCTION wide wide_ldexp(wide a, int shift)
{
    return settled(std::ldexp(a.high, shift), std::ldexp(a.low, shift));
}

FIELD_FUNCTION double nearest_integer(double value)
{
    return std::floor(value + 0.5);
}

/// One step of Newton's method from a double.
FIELD_FUNCTION wide wide_sqrt(wide a)
{
    const double root = std::sqrt(a.high);
    const wide rest = a - two_product(root, root);
    return settled(root, rest.high / (2.0 * root));
}

FIELD_FUNCTION wide wide_cbrt(wide a)
{
    const double root = std::cbrt(a.high);
    const wide rest = a - two_product(root, root) * wide_of(root);
    return settled(root, rest.high / (3.0 * root * root));
}

/// exp(a) - 1 for |a| <= 0.4, by its series.
FIELD_FUNCTION wide exp_m1_series(wide a)
{
    wide sum = wide_of(0.0);
    for (int n = 26; n > 0; n--) {
        sum = a * (wide_of(1.0) + sum) / wide_of(n);
    }
    return sum;
}

FIELD_FUNCTION wide wide_exp(wide a)
{
    // ln 2 in three parts; the first two have 42 bits, so that their products with exponents are exact.
    const double ln_2_parts[3] = {0.6931471805598903, 5.49792301870721e-14, 1.1612227229362532e-26};
    if (!(std::fabs(a.high) < 708.0)) {
        return wide_of(std::exp(a.high));
    }
    const double count = nearest_integer(a.high / ln_2_parts[0]);
    for (const double part : ln_2_parts) {
        a = a - wide_of(count * part);
    }
    return wide_ldexp(wide_of(1.0) + exp_m1_series(a), static_cast<int>(count));
}

FIELD_FUNCTION wide wide_exp_m1(wide a)
{
    return std::fabs(a.high) < 0.4 ? exp_m1_series(a) : wide_exp(a) - wide_of(1.0);
}

/// artanh(a)/a - 1 for |a| <= 0.2, by its series.
FIELD_FUNCTION wide artanh_excess(wide a)
{
    const wide square = a * a;
    wide sum = wide_of(0.0);
    for (int n = 51; n > 1; n -= 2) {
        sum = square * (sum + wide_of(1.0) / wide_of(n));
    }
    return sum;
}

/// ln(1 + a) = 2 artanh(a/(2 + a)), for -1/3 <= a <= 1/2.
FIELD_FUNCTION wide ln_1p_series(wide a)
{
    const wide ratio = a / (a + wide_of(2.0));
    return wide_ldexp(ratio + ratio * artanh_excess(ratio), 1);
}

FIELD_FUNCTION wide wide_ln(wide a)
{
    int count = 0;
    if (!(a.high > 0.0 && std::isfinite(a.high))) {
        return wide_of(std::log(a.high));
    }
    if (std::frexp(a.high, &count) < 0.7071067811865476) {
        count--;
    }
    const wide ln_2 = {0.6931471805599453, 2.3190468138462996e-17};
    const wide rest = wide_ldexp(a, -count) - wide_of(1.0);
    return ln_2 * wide_of(count) + ln_1p_series(rest);
}

FIELD_FUNCTION wide wide_ln_1p(wide a)
{
    const bool is_small = a.high > -0.25 && a.high < 0.4;
    return is_small ? ln_1p_series(a) : wide_ln(wide_of(1.0) + a);
}

/// a - ln(1 + a): with s = a/(2 + a), a - 2 s = a s.
FIELD_FUNCTION wide wide_ln_1p_rest(wide a)
{
    if (a.high < -1.0 / 3.0 || a.high > 0.5) {
        return a - wide_ln_1p(a);
    }
    const wide ratio = a / (a + wide_of(2.0));
    return ratio * (a - wide_ldexp(artanh_excess(ratio), 1));
}

FIELD_FUNCTION wide wide_pi()
{
    return {3.141592653589793, 1.2246467991473532e-16};
}

/// -a^2/(m (m - 1)) (1 - a^2/((m - 2)(m - 3)) (1 - ...)), from the term m = n down.
FIELD_FUNCTION wide circular_series(wide a, int n)
{
    const wide square = -(a * a);
    wide sum = wide_of(0.0);
    for (; n > 1; n -= 2) {
        sum = square * (wide_of(1.0) + sum) / wide_of(n * (n - 1));
    }
    return sum;
}

/// The sine of as many quarter turns and of a rest of |rest| <= 0.8.
FIELD_FUNCTION wide sine_of_turn(double quarters, wide rest)
{
    const int turn = (static_cast<int>(std::fmod(quarters, 4.0)) + 4) % 4;
    const wide sine = rest + rest * circular_series(rest, 31);
    const wide cosine = wide_of(1.0) + circular_series(rest, 32);
    const wide result = turn % 2 == 0 ? sine : cosine;
    return turn < 2 ? result : -result;
}

/// What whole quarter turns leave of an angle, up to 2^50.
FIELD_FUNCTION wide less_quarters(wide angle, double count)
{
    const double half_pi_parts[4] = {1.5707963267948966, 6.123233995736766e-17,
                                     -1.4973849048591698e-33, 5.562271104316826e-50};
    for (const double part : half_pi_parts) {
        angle = angle - two_product(count, part);
    }
    return angle;
}

/// The sine of an angle and of as many quarter turns more; not a number beyond 2^50.
FIELD_FUNCTION wide sine_of_angle(wide angle, double quarters)
{
    if (!(std::fabs(angle.high) < 1125899906842624.0)) {
        return wide_of(angle.high - angle.high);
    }
    const double count = nearest_integer(angle.high / 1.5707963267948966);
    return sine_of_turn(count + quarters, less_quarters(angle, count));
}

FIELD_FUNCTION wide wide_sin(wide a)
{
    return sine_of_angle(a, 0.0);
}

FIELD_FUNCTION wide wide_cos(wide a)
{
    return sine_of_angle(a, 1.0);
}

FIELD_FUNCTION wide wide_tan(wide a)
{
    return wide_sin(a) / wide_cos(a);
}

/// The same of an angle in half turns, from which whole turns are taken off without error.
FIELD_FUNCTION wide sine_of_half_turns(wide half_turns, double quarters)
{
    if (!std::isfinite(half_turns.high)) {
        return wide_of(half_turns.high - half_turns.high);
    }
    const wide turn = two_sum(std::fmod(half_turns.high, 2.0), std::fmod(half_turns.low, 2.0));
    const double count = nearest_integer(2.0 * turn.high);
    return sine_of_turn(count + quarters, (turn - wide_of(0.5 * count)) * wide_pi());
}

FIELD_FUNCTION wide wide_sin_pi(wide a)
{
    return sine_of_half_turns(a, 0.0);
}

FIELD_FUNCTION wide wide_cos_pi(wide a)
{
    return sine_of_half_turns(a, 1.0);
}

/// An angle of more than a few radians, up to 2^50, less whole turns.
FIELD_FUNCTION wide wide_within_turns(wide a)
{
    const double size = std::fabs(a.high);
    if (!(size > 25.0 && size < 1125899906842624.0)) {
        return a;
    }
    return less_quarters(a, 4.0 * nearest_integer(a.high / 6.283185307179586));
}

/// The same of an angle in half turns, of any size.
FIELD_FUNCTION wide wide_within_turns_pi(wide a)
{
    if (!(std::fabs(a.high) > 8.0 && std::isfinite(a.high))) {
        return a;
    }
    const wide turn = two_sum(std::fmod(a.high, 2.0), std::fmod(a.low, 2.0));
    return turn - wide_of(2.0 * nearest_integer(0.5 * turn.high));
}

/// (e^a - e^-a)/2: from e = exp_m1(a) as (e + e/(1 + e))/2 where the difference would cancel.
FIELD_FUNCTION wide wide_sinh(wide a)
{
    if (std::fabs(a.high) < 1.0) {
        const wide e = wide_exp_m1(a);
        return wide_ldexp(e + e / (wide_of(1.0) + e), -1);
    }
    const wide half = wide_ldexp(wide_exp(a), -1);
    return half - wide_of(0.25) / half;
}

FIELD_FUNCTION wide wide_cosh(wide a)
{
    const wide half = wide_ldexp(wide_exp(a), -1);
    return half + wide_of(0.25) / half;
}

/// e/(e + 2) with e = exp_m1(2 a).
FIELD_FUNCTION wide wide_tanh(wide a)
{
    if (!(std::fabs(a.high) < 40.0)) {
        return wide_of(std::tanh(a.high));
    }
    const wide e = wide_exp_m1(wide_ldexp(a, 1));
    return e / (e + wide_of(2.0));
}

/// The angle of a double, and by how far the point lies off it.
FIELD_FUNCTION wide wide_atan2(wide y, wide x)
{
    const double angle = std::atan2(y.high, x.high);
    const wide sine = wide_sin(wide_of(angle)), cosine = wide_cos(wide_of(angle));
    const wide across = y * cosine - x * sine, along = x * cosine + y * sine;
    return settled(angle, across.high / along.high);
}

FIELD_FUNCTION wide wide_atan(wide a)
{
    return wide_atan2(a, wide_of(1.0));
}

/// The cosine of asin(a): next to 1 only this product keeps all digits.
FIELD_FUNCTION wide complement(wide a)
{
    return wide_sqrt((wide_of(1.0) - a) * (wide_of(1.0) + a));
}

FIELD_FUNCTION wide wide_asin(wide a)
{
    return wide_atan2(a, complement(a));
}

FIELD_FUNCTION wide wide_acos(wide a)
{
    return wide_atan2(complement(a), a);
}

/// Of a base that is not negative.
FIELD_FUNCTION wide wide_powf(wide base, wide exponent)
{
    if (!(base.high > 0.0 && std::isfinite(base.high))) {
        return wide_of(std::pow(base.high, exponent.high));
    }
    return wide_exp(exponent * wide_ln(base));
}
