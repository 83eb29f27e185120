errors, magnitudes = [0.0] * len(SETS), [0.0] * len(SETS)
worst, worst_name, failures = 0.0, "nothing", 0


def flat(value):
    """The numbers of nested tuples."""
    if isinstance(value, (tuple, list)):
        return [number for item in value for number in flat(item)]
    return [value]


def compare(which, expected, found):
    assert len(expected) == len(found)
    for value, wanted in zip(found, expected):
        error = abs(value - wanted)
        errors[which] = max(errors[which], error if math.isfinite(error) else math.inf)
        magnitudes[which] = max(magnitudes[which], abs(wanted))


def settle(name, accepted):
    """Ends the comparison of a function."""
    global worst, worst_name, failures
    for which in range(len(SETS)):
        error = errors[which] / max(magnitudes[which], LEAST) / EPS
        if error > accepted:
            print(f"{name}: {error:.3g} eps, accepted {accepted}")
            failures += 1
        if error > worst:
            worst, worst_name = error, name
        errors[which] = magnitudes[which] = 0.0


def rows(text):
    """Lines of hexadecimal numbers."""
    return [[float.fromhex(word) for word in line.split()] for line in text.splitlines()]
