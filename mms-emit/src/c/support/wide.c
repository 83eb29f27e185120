#include <math.h>

typedef struct { double high, low; } wide;

/* A double as a number of twice the digits. */
static wide wide_of(double value)
{
    const wide result = {value, 0.0};
    return result;
}

/* A constant: the nearest double, and the nearest double to the remainder. */
static wide wide_parts(double high, double low)
{
    const wide result = {high, low};
    return result;
}

/* The rounded sum and its error (Knuth, 1969). */
static wide two_sum(double a, double b)
{
    const double sum = a + b;
    const double second = sum - a;
    const wide result = {sum, (a - (sum - second)) + (b - second)};
    return result;
}

/* A sum and its smaller correction as a number. A correction that is not finite is dropped. */
static wide settled(double sum, double rest)
{
    const double high = sum + rest;
    const wide result = {high, rest - (high - sum)};
    return isfinite(rest) && isfinite(high) ? result : wide_of(sum);
}

/* The upper half of the digits (Dekker, 1971). Volatile, so that nothing is fused. */
static double upper_half(double value)
{
    const volatile double scaled = 134217729.0 * value;
    return scaled - (scaled - value);
}

/* The rounded product and its error (Dekker, 1971). */
static wide two_product(double a, double b)
{
    const volatile double product = a * b;
    const double a_upper = upper_half(a), b_upper = upper_half(b);
    const double a_lower = a - a_upper, b_lower = b - b_upper;
    const double crossed = (a_upper * b_upper - product) + a_upper * b_lower + a_lower * b_upper;
    const wide result = {product, crossed + a_lower * b_lower};
    return result;
}

static wide wide_neg(wide a)
{
    const wide result = {-a.high, -a.low};
    return result;
}

/* Joldes, Muller and Popescu (2017), algorithm 6. */
static wide wide_add(wide a, wide b)
{
    const wide high = two_sum(a.high, b.high);
    const wide low = two_sum(a.low, b.low);
    const wide first = settled(high.high, high.low + low.high);
    return settled(first.high, first.low + low.low);
}

static wide wide_sub(wide a, wide b)
{
    return wide_add(a, wide_neg(b));
}

static wide wide_mul(wide a, wide b)
{
    const wide product = two_product(a.high, b.high);
    return settled(product.high, product.low + (a.high * b.low + a.low * b.high));
}

/* Three quotients of high parts; the second and third divide the remainder of the one before. */
static wide wide_div(wide a, wide b)
{
    const double first = a.high / b.high;
    const wide rest = wide_sub(a, wide_mul(b, wide_of(first)));
    const double second = rest.high / b.high;
    const wide last = wide_sub(rest, wide_mul(b, wide_of(second)));
    const wide quotient = settled(first, second);
    return settled(quotient.high, quotient.low + last.high / b.high);
}

static wide wide_ldexp(wide a, int shift)
{
    return settled(ldexp(a.high, shift), ldexp(a.low, shift));
}

static double nearest_integer(double value)
{
    return floor(value + 0.5);
}

/* One step of Newton's method from a double. */
static wide wide_sqrt(wide a)
{
    const double root = sqrt(a.high);
    const wide rest = wide_sub(a, two_product(root, root));
    return settled(root, rest.high / (2.0 * root));
}

static wide wide_cbrt(wide a)
{
    const double root = cbrt(a.high);
    const wide rest = wide_sub(a, wide_mul(two_product(root, root), wide_of(root)));
    return settled(root, rest.high / (3.0 * root * root));
}

/* exp(a) - 1 for |a| <= 0.4, by its series. */
static wide exp_m1_series(wide a)
{
    wide sum = {0.0, 0.0};
    for (int n = 26; n > 0; n--) {
        sum = wide_div(wide_mul(a, wide_add(wide_of(1.0), sum)), wide_of(n));
    }
    return sum;
}

static wide wide_exp(wide a)
{
    /* ln 2 in three parts; the first two have 42 bits, so that their products with exponents are exact. */
    const double ln_2_parts[3] = {0.6931471805598903, 5.49792301870721e-14, 1.1612227229362532e-26};
    if (!(fabs(a.high) < 708.0)) {
        return wide_of(exp(a.high));
    }
    const double count = nearest_integer(a.high / ln_2_parts[0]);
    for (int part = 0; part < 3; part++) {
        a = wide_sub(a, wide_of(count * ln_2_parts[part]));
    }
    return wide_ldexp(wide_add(wide_of(1.0), exp_m1_series(a)), (int)(count));
}

static wide wide_exp_m1(wide a)
{
    return fabs(a.high) < 0.4 ? exp_m1_series(a) : wide_sub(wide_exp(a), wide_of(1.0));
}

/* artanh(a)/a - 1 for |a| <= 0.2, by its series. */
static wide artanh_excess(wide a)
{
    const wide square = wide_mul(a, a);
    wide sum = {0.0, 0.0};
    for (int n = 51; n > 1; n -= 2) {
        sum = wide_mul(square, wide_add(sum, wide_div(wide_of(1.0), wide_of(n))));
    }
    return sum;
}

/* ln(1 + a) = 2 artanh(a/(2 + a)), for -1/3 <= a <= 1/2. */
static wide ln_1p_series(wide a)
{
    const wide ratio = wide_div(a, wide_add(a, wide_of(2.0)));
    return wide_ldexp(wide_add(ratio, wide_mul(ratio, artanh_excess(ratio))), 1);
}

static wide wide_ln(wide a)
{
    int count = 0;
    if (!(a.high > 0.0 && isfinite(a.high))) {
        return wide_of(log(a.high));
    }
    if (frexp(a.high, &count) < 0.7071067811865476) {
        count--;
    }
    const wide ln_2 = {0.6931471805599453, 2.3190468138462996e-17};
    const wide rest = wide_sub(wide_ldexp(a, -count), wide_of(1.0));
    return wide_add(wide_mul(ln_2, wide_of(count)), ln_1p_series(rest));
}

static wide wide_ln_1p(wide a)
{
    const int is_small = a.high > -0.25 && a.high < 0.4;
    return is_small ? ln_1p_series(a) : wide_ln(wide_add(wide_of(1.0), a));
}

/* a - ln(1 + a): with s = a/(2 + a), a - 2 s = a s. */
static wide wide_ln_1p_rest(wide a)
{
    if (a.high < -1.0 / 3.0 || a.high > 0.5) {
        return wide_sub(a, wide_ln_1p(a));
    }
    const wide ratio = wide_div(a, wide_add(a, wide_of(2.0)));
    return wide_mul(ratio, wide_sub(a, wide_ldexp(artanh_excess(ratio), 1)));
}

static wide wide_pi(void)
{
    const wide result = {3.141592653589793, 1.2246467991473532e-16};
    return result;
}

/* -a^2/(m (m - 1)) (1 - a^2/((m - 2)(m - 3)) (1 - ...)), from the term m = n down. */
static wide circular_series(wide a, int n)
{
    const wide square = wide_neg(wide_mul(a, a));
    wide sum = {0.0, 0.0};
    for (; n > 1; n -= 2) {
        sum = wide_div(wide_mul(square, wide_add(wide_of(1.0), sum)), wide_of(n * (n - 1)));
    }
    return sum;
}

/* sin(quarters pi/2 + rest), for |rest| <= 0.8. */
static wide sine_of_turn(double quarters, wide rest)
{
    const double turned = fmod(quarters, 4.0);
    const int turn = ((int)(turned) + 4) % 4;
    const wide sine = wide_add(rest, wide_mul(rest, circular_series(rest, 31)));
    const wide cosine = wide_add(wide_of(1.0), circular_series(rest, 32));
    const wide result = turn % 2 == 0 ? sine : cosine;
    return turn < 2 ? result : wide_neg(result);
}

/* angle - count pi/2, for angles up to 2^50. */
static wide less_quarters(wide angle, double count)
{
    const double half_pi_parts[4] = {1.5707963267948966, 6.123233995736766e-17,
                                     -1.4973849048591698e-33, 5.562271104316826e-50};
    for (int part = 0; part < 4; part++) {
        angle = wide_sub(angle, two_product(count, half_pi_parts[part]));
    }
    return angle;
}

/* sin(angle + quarters pi/2); NaN for angles beyond 2^50. */
static wide sine_of_angle(wide angle, double quarters)
{
    if (!(fabs(angle.high) < 1125899906842624.0)) {
        return wide_of(angle.high - angle.high);
    }
    const double count = nearest_integer(angle.high / 1.5707963267948966);
    return sine_of_turn(count + quarters, less_quarters(angle, count));
}

static wide wide_sin(wide a)
{
    return sine_of_angle(a, 0.0);
}

static wide wide_cos(wide a)
{
    return sine_of_angle(a, 1.0);
}

static wide wide_tan(wide a)
{
    return wide_div(wide_sin(a), wide_cos(a));
}

/* sin(pi half_turns + quarters pi/2); whole turns are subtracted without error. */
static wide sine_of_half_turns(wide half_turns, double quarters)
{
    if (!isfinite(half_turns.high)) {
        return wide_of(half_turns.high - half_turns.high);
    }
    const wide turn = two_sum(fmod(half_turns.high, 2.0), fmod(half_turns.low, 2.0));
    const double count = nearest_integer(2.0 * turn.high);
    const wide rest = wide_mul(wide_sub(turn, wide_of(0.5 * count)), wide_pi());
    return sine_of_turn(count + quarters, rest);
}

static wide wide_sin_pi(wide a)
{
    return sine_of_half_turns(a, 0.0);
}

static wide wide_cos_pi(wide a)
{
    return sine_of_half_turns(a, 1.0);
}

/* An angle without its whole turns; angles up to 25 and beyond 2^50 are returned as they are. */
static wide wide_within_turns(wide a)
{
    const double size = fabs(a.high);
    if (!(size > 25.0 && size < 1125899906842624.0)) {
        return a;
    }
    return less_quarters(a, 4.0 * nearest_integer(a.high / 6.283185307179586));
}

/* An angle in half turns without its whole turns, of any size; angles up to 8 are returned as they are. */
static wide wide_within_turns_pi(wide a)
{
    if (!(fabs(a.high) > 8.0 && isfinite(a.high))) {
        return a;
    }
    const wide turn = two_sum(fmod(a.high, 2.0), fmod(a.low, 2.0));
    return wide_sub(turn, wide_of(2.0 * nearest_integer(0.5 * turn.high)));
}

/* (e^a - e^-a)/2: from e = exp_m1(a) as (e + e/(1 + e))/2 where the difference would cancel. */
static wide wide_sinh(wide a)
{
    if (fabs(a.high) < 1.0) {
        const wide e = wide_exp_m1(a);
        return wide_ldexp(wide_add(e, wide_div(e, wide_add(wide_of(1.0), e))), -1);
    }
    const wide half = wide_ldexp(wide_exp(a), -1);
    return wide_sub(half, wide_div(wide_of(0.25), half));
}

static wide wide_cosh(wide a)
{
    const wide half = wide_ldexp(wide_exp(a), -1);
    return wide_add(half, wide_div(wide_of(0.25), half));
}

/* e/(e + 2) with e = exp_m1(2 a). */
static wide wide_tanh(wide a)
{
    if (!(fabs(a.high) < 40.0)) {
        return wide_of(tanh(a.high));
    }
    const wide e = wide_exp_m1(wide_ldexp(a, 1));
    return wide_div(e, wide_add(e, wide_of(2.0)));
}

/* The angle of a double, and by how far the point lies off it. */
static wide wide_atan2(wide y, wide x)
{
    const double angle = atan2(y.high, x.high);
    const wide sine = wide_sin(wide_of(angle)), cosine = wide_cos(wide_of(angle));
    const wide across = wide_sub(wide_mul(y, cosine), wide_mul(x, sine));
    const wide along = wide_add(wide_mul(x, cosine), wide_mul(y, sine));
    return settled(angle, across.high / along.high);
}

static wide wide_atan(wide a)
{
    return wide_atan2(a, wide_of(1.0));
}

/* The cosine of asin(a): next to 1 only this product keeps all digits. */
static wide complement(wide a)
{
    return wide_sqrt(wide_mul(wide_sub(wide_of(1.0), a), wide_add(wide_of(1.0), a)));
}

static wide wide_asin(wide a)
{
    return wide_atan2(a, complement(a));
}

static wide wide_acos(wide a)
{
    return wide_atan2(complement(a), a);
}

/* base^exponent, for a base that is not negative. */
static wide wide_powf(wide base, wide exponent)
{
    if (!(base.high > 0.0 && isfinite(base.high))) {
        return wide_of(pow(base.high, exponent.high));
    }
    return wide_exp(wide_mul(exponent, wide_ln(base)));
}
