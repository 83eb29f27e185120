worst, failures = 0.0, 0


def vectors():
    """The test vectors: tables by name, first the defaults, then the tables of each set of parameters."""
    text = pathlib.Path(__file__).with_name(f"{FIELD}_vectors.txt").read_text(encoding="utf-8")
    lines = (line for line in text.splitlines() if not line.startswith("#"))
    sets = [{}]
    for line in lines:
        name, count, *_ = line.split()
        if name == "set":
            sets.append({})
        rows = [next(lines).split() for _ in range(int(count))]
        sets[-1][name] = [[float(word) for word in row] for row in rows]
    assert len(sets) == 1 + COUNT, "the test vectors are not whole: emit them anew"
    return sets


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


FIRST, *SETS = vectors()
