import math


def _settled(total, rest):
    """A sum and its smaller correction as a number; one that is not finite is dropped."""
    high = total + rest
    if math.isfinite(rest) and math.isfinite(high):
        return _Wide(high, rest - (high - total))
    return _Wide(total)


def _two_sum(a, b):
    """The rounded sum and its error (Knuth, 1969)."""
    total = a + b
    second = total - a
    return _Wide(total, (a - (total - second)) + (b - second))


def _upper_half(value):
    """The upper half of the digits (Dekker, 1971)."""
    scaled = 134217729.0 * value
    return scaled - (scaled - value)


def _two_product(a, b):
    """The rounded product and its error (Dekker, 1971)."""
    product = a * b
    a_upper, b_upper = _upper_half(a), _upper_half(b)
    a_lower, b_lower = a - a_upper, b - b_upper
    crossed = (a_upper * b_upper - product) + a_upper * b_lower + a_lower * b_upper
    return _Wide(product, crossed + a_lower * b_lower)


def _ratio(a, b):
    """The quotient of floats, without an error where b is 0."""
    if b != 0.0:
        return a / b
    return math.nan if a == 0.0 or math.isnan(a) else math.copysign(math.inf, a) * math.copysign(1.0, b)


class _Wide:
    """A number of twice the digits of a float: the unevaluated sum of two."""

    __slots__ = ("high", "low")

    def __init__(self, high, low=0.0):
        self.high = high
        self.low = low

    def __neg__(self):
        return _Wide(-self.high, -self.low)

    def __add__(self, other):
        # Joldes, Muller and Popescu (2017), algorithm 6.
        high = _two_sum(self.high, other.high)
        low = _two_sum(self.low, other.low)
        first = _settled(high.high, high.low + low.high)
        return _settled(first.high, first.low + low.low)

    def __sub__(self, other):
        return self + -other

    def __mul__(self, other):
        product = _two_product(self.high, other.high)
        return _settled(product.high, product.low + (self.high * other.low + self.low * other.high))

    def __truediv__(self, other):
        # Three quotients of high parts; the second and third divide the remainder of the one before.
        first = _ratio(self.high, other.high)
        rest = self - other * _Wide(first)
        second = _ratio(rest.high, other.high)
        rest = rest - other * _Wide(second)
        quotient = _settled(first, second)
        return _settled(quotient.high, quotient.low + _ratio(rest.high, other.high))

    def scaled(self, shift):
        """2^shift times the number."""
        return _settled(math.ldexp(self.high, shift), math.ldexp(self.low, shift))


_ONE = _Wide(1.0)


_PI = _Wide(3.141592653589793, 1.2246467991473532e-16)


# ln 2; the first two parts have 42 bits, so that their products with exponents are exact.
_LN_2_PARTS = (0.6931471805598903, 5.49792301870721e-14, 1.1612227229362532e-26)


_HALF_PI_PARTS = (
    1.5707963267948966,
    6.123233995736766e-17,
    -1.4973849048591698e-33,
    5.562271104316826e-50,
)


def _wide_sqrt(a):
    """One step of Newton's method from a float."""
    root = math.sqrt(a.high)
    rest = a - _two_product(root, root)
    return _settled(root, _ratio(rest.high, 2.0 * root))


def _wide_cbrt(a):
    root = math.copysign(abs(a.high) ** (1.0 / 3.0), a.high)
    rest = a - _two_product(root, root) * _Wide(root)
    return _settled(root, _ratio(rest.high, 3.0 * root * root))


def _exp_m1_series(a):
    """exp(a) - 1 for |a| <= 0.4, by its series."""
    total = _Wide(0.0)
    for n in range(26, 0, -1):
        total = a * (_ONE + total) / _Wide(float(n))
    return total


def _wide_exp(a):
    if not abs(a.high) < 708.0:
        return _Wide(math.exp(a.high))
    count = round(a.high / _LN_2_PARTS[0])
    for part in _LN_2_PARTS:
        a = a - _Wide(count * part)
    return (_ONE + _exp_m1_series(a)).scaled(count)


def _wide_exp_m1(a):
    return _exp_m1_series(a) if abs(a.high) < 0.4 else _wide_exp(a) - _ONE


def _artanh_excess(a):
    """artanh(a)/a - 1 for |a| <= 0.2, by its series."""
    square = a * a
    total = _Wide(0.0)
    for n in range(51, 1, -2):
        total = square * (total + _ONE / _Wide(float(n)))
    return total


def _ln_1p_series(a):
    """ln(1 + a) = 2 artanh(a/(2 + a)), for -1/3 <= a <= 1/2."""
    ratio = a / (a + _Wide(2.0))
    return (ratio + ratio * _artanh_excess(ratio)).scaled(1)


def _wide_ln(a):
    if not (a.high > 0.0 and math.isfinite(a.high)):
        return _Wide(math.log(a.high))
    fraction, count = math.frexp(a.high)
    if fraction < 0.7071067811865476:
        count -= 1
    ln_2 = _Wide(0.6931471805599453, 2.3190468138462996e-17)
    return ln_2 * _Wide(float(count)) + _ln_1p_series(a.scaled(-count) - _ONE)


def _wide_ln_1p(a):
    return _ln_1p_series(a) if -0.25 < a.high < 0.4 else _wide_ln(_ONE + a)


def _wide_ln_1p_rest(a):
    """a - ln(1 + a): with s = a/(2 + a), a - 2 s = a s."""
    if a.high < -1.0 / 3.0 or a.high > 0.5:
        return a - _wide_ln_1p(a)
    ratio = a / (a + _Wide(2.0))
    return ratio * (a - _artanh_excess(ratio).scaled(1))


def _circular_series(a, n):
    """-a^2/(m (m - 1)) (1 - a^2/((m - 2)(m - 3)) (1 - ...)), from the term m = n down."""
    square = -(a * a)
    total = _Wide(0.0)
    for m in range(n, 1, -2):
        total = square * (_ONE + total) / _Wide(float(m * (m - 1)))
    return total


def _sine_of_turn(quarters, rest):
    """sin(quarters pi/2 + rest), for |rest| <= 0.8."""
    if quarters % 2 == 0:
        result = rest + rest * _circular_series(rest, 31)
    else:
        result = _ONE + _circular_series(rest, 32)
    return result if quarters % 4 < 2 else -result


def _less_quarters(angle, count):
    """angle - count pi/2, for angles up to 2^50."""
    for part in _HALF_PI_PARTS:
        angle = angle - _two_product(float(count), part)
    return angle


def _sine_of_angle(angle, quarters):
    """sin(angle + quarters pi/2); NaN for angles beyond 2^50."""
    if not abs(angle.high) < 1125899906842624.0:
        return _Wide(math.nan)
    count = round(angle.high / _HALF_PI_PARTS[0])
    return _sine_of_turn(count + quarters, _less_quarters(angle, count))


def _wide_sin(a):
    return _sine_of_angle(a, 0)


def _wide_cos(a):
    return _sine_of_angle(a, 1)


def _wide_tan(a):
    return _wide_sin(a) / _wide_cos(a)


def _sine_of_half_turns(half_turns, quarters):
    """sin(pi half_turns + quarters pi/2); whole turns are subtracted without error."""
    if not math.isfinite(half_turns.high):
        return _Wide(math.nan)
    turn = _two_sum(math.fmod(half_turns.high, 2.0), math.fmod(half_turns.low, 2.0))
    count = round(2.0 * turn.high)
    return _sine_of_turn(count + quarters, (turn - _Wide(0.5 * count)) * _PI)


def _wide_sin_pi(a):
    return _sine_of_half_turns(a, 0)


def _wide_cos_pi(a):
    return _sine_of_half_turns(a, 1)


def _wide_within_turns(a):
    """An angle without its whole turns; angles up to 25 and beyond 2^50 are returned as they are."""
    if not 25.0 < abs(a.high) < 1125899906842624.0:
        return a
    return _less_quarters(a, 4 * round(a.high / math.tau))


def _wide_within_turns_pi(a):
    """An angle in half turns without its whole turns, of any size; angles up to 8 are returned as they are."""
    if not 8.0 < abs(a.high) < math.inf:
        return a
    turn = _two_sum(math.fmod(a.high, 2.0), math.fmod(a.low, 2.0))
    return turn - _Wide(2.0 * round(0.5 * turn.high))


def _wide_sinh(a):
    """(e^a - e^-a)/2: from e = exp_m1(a) as (e + e/(1 + e))/2 where the difference would cancel."""
    if abs(a.high) < 1.0:
        e = _wide_exp_m1(a)
        return (e + e / (_ONE + e)).scaled(-1)
    half = _wide_exp(a).scaled(-1)
    return half - _Wide(0.25) / half


def _wide_cosh(a):
    half = _wide_exp(a).scaled(-1)
    return half + _Wide(0.25) / half


def _wide_tanh(a):
    """e/(e + 2) with e = exp_m1(2 a)."""
    if not abs(a.high) < 40.0:
        return _Wide(math.tanh(a.high))
    e = _wide_exp_m1(a.scaled(1))
    return e / (e + _Wide(2.0))


def _wide_atan2(y, x):
    """The angle of a float, and by how far the point lies off it."""
    angle = math.atan2(y.high, x.high)
    sine, cosine = _wide_sin(_Wide(angle)), _wide_cos(_Wide(angle))
    across, along = y * cosine - x * sine, x * cosine + y * sine
    return _settled(angle, _ratio(across.high, along.high))


def _wide_atan(a):
    return _wide_atan2(a, _ONE)


def _complement(a):
    """The cosine of asin(a): next to 1 only this product keeps all digits."""
    return _wide_sqrt((_ONE - a) * (_ONE + a))


def _wide_asin(a):
    return _wide_atan2(a, _complement(a))


def _wide_acos(a):
    return _wide_atan2(_complement(a), a)


def _wide_powf(base, exponent):
    """base^exponent, for a base that is not negative."""
    if not (base.high > 0.0 and math.isfinite(base.high)):
        return _Wide(base.high**exponent.high)
    return _wide_exp(exponent * _wide_ln(base))
