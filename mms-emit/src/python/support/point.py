import math


def _cbrt(x):
    """The real cube root, with a step of Newton's method."""
    if x == 0.0:
        return x
    root = math.copysign(abs(x) ** (1.0 / 3.0), x)
    return root - (root - x / (root * root)) / 3.0


def _sin_pi(x):
    """sin(pi x): whole turns, and then quarters, are taken off without error."""
    turn = math.remainder(x, 2.0)
    quarters = round(2.0 * turn)
    angle = math.pi * (turn - 0.5 * quarters)
    if abs(quarters) == 2:
        return -math.sin(angle)
    return quarters * math.cos(angle) if quarters else math.sin(angle)


def _cos_pi(x):
    """cos(pi x), in the same way."""
    turn = abs(math.remainder(x, 2.0))
    quarters = round(2.0 * turn)
    angle = math.pi * (turn - 0.5 * quarters)
    if quarters == 2:
        return -math.cos(angle)
    return -math.sin(angle) if quarters else math.cos(angle)


def _ln_1p_rest(x):
    """x - ln(1 + x): with s = x/(2 + x), x - 2 s = x s; beyond s = 1/5 the difference itself."""
    if not -1.0 / 3.0 <= x <= 0.5:
        return x - math.log1p(x)
    s = x / (2.0 + x)
    total = 0.0
    for n in range(25, 1, -2):
        total = total * (s * s) + 1.0 / n
    return s * (x - 2.0 * (s * s) * total)
