

# More digits than any cancellation loses.
DIGITS = 100
field.PI = sp.pi.evalf(DIGITS)


def exact(numbers):
    """Floats as numbers of many digits, with which every step is a number."""
    return [sp.Float(sp.Rational(number), DIGITS) for number in numbers]


def numbers(value):
    """The components of a result."""
    components = list(value) if hasattr(value, "shape") else [value]
    return [float(sp.sympify(component).evalf(DIGITS)) for component in components]


