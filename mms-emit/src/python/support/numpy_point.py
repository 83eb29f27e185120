import numpy as np


def _sin_pi(x):
    """sin(pi x): whole turns, and then quarters, are taken off without error."""
    turn = x - 2.0 * np.rint(0.5 * x)
    quarters = np.rint(2.0 * turn)
    angle = np.pi * (turn - 0.5 * quarters)
    odd = np.copysign(np.cos(angle), quarters)
    even = np.where(np.abs(quarters) > 1.5, -np.sin(angle), np.sin(angle))
    return np.where(np.abs(np.abs(quarters) - 1.0) < 0.5, odd, even)


def _cos_pi(x):
    """cos(pi x), in the same way."""
    turn = np.abs(x - 2.0 * np.rint(0.5 * x))
    quarters = np.rint(2.0 * turn)
    angle = np.pi * (turn - 0.5 * quarters)
    even = np.where(quarters > 1.5, -np.cos(angle), np.cos(angle))
    return np.where(np.abs(quarters - 1.0) < 0.5, -np.sin(angle), even)


def _ln_1p_rest(x):
    """x - ln(1 + x): with s = x/(2 + x), x - 2 s = x s; beyond s = 1/5 the difference itself."""
    s = x / (2.0 + x)
    total = 0.0
    for n in range(25, 1, -2):
        total = total * (s * s) + 1.0 / n
    near = (x >= -1.0 / 3.0) & (x <= 0.5)
    return np.where(near, s * (x - 2.0 * (s * s) * total), x - np.log1p(x))


def _shaped(components, *inputs):
    """Components as one array: their places first, then the shape of the inputs."""
    arrays = np.broadcast_arrays(*components, *inputs)
    kind = np.result_type(*inputs)
    kind = kind if np.issubdtype(kind, np.floating) else np.float64
    return np.stack(arrays[: len(components)]).astype(kind, copy=False)
