worst, failures = 0.0, 0


def rows(text):
    """Lines of hexadecimal numbers."""
    return [[float.fromhex(word) for word in line.split()] for line in text.splitlines()]


def flat(value):
    """The numbers of nested lists."""
    if isinstance(value, (tuple, list)):
        return [number for item in value for number in flat(item)]
    return [value]


def check(name, accepted, expected, found):
    """Compares what a function gives with a set of parameters."""
    global worst, failures
    expected, found = flat(expected), flat(found)
    assert len(expected) == len(found), name
    errors = [abs(value - wanted) for value, wanted in zip(found, expected)]
    error = max(error if math.isfinite(error) else math.inf for error in errors)
    error = error / max(LEAST, *map(abs, expected)) / EPS
    worst = max(worst, error)
    if error > accepted:
        print(f"{name}: {error:.3g} eps, accepted {accepted}")
        failures += 1
