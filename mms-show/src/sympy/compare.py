def exact(numbers):
    """Doubles as numbers of mpmath, digit by digit."""
    return [mpmath.mpf(number) for number in numbers]


def main():
    at = derived(len(NORMAL))
    derivations = [at(exact(point["X"]), mpmath.mpf(point["t"]), exact(NORMAL)) for point in POINTS]
    failed = False
    print(f"{'quantity':24}largest difference, relative to the quantity")
    for name in derivations[0]:
        pairs = [(ours, mpmath.mpmathify(theirs))
                 for point, derivation in zip(POINTS, derivations)
                 for ours, theirs in zip(point["values"][name], derivation[name], strict=True)]
        # If a quantity is 0 everywhere, there is no magnitude to be relative to.
        scale = max([abs(theirs) for _, theirs in pairs] + [mpmath.mpf("1e-30")])
        worst = max(abs(mpmath.mpf(ours) - theirs) for ours, theirs in pairs) / scale
        agrees = bool(worst <= TOLERANCE)
        failed = failed or not agrees
        print(f"{name:24}{mpmath.nstr(worst, 2):>10}{'' if agrees else '   DIFFERS'}")
    missing = set(POINTS[0]["values"]) ^ set(derivations[0])
    if missing:
        print("not compared:", ", ".join(sorted(missing)))
    print("differs" if failed or missing else f"agrees within {mpmath.nstr(TOLERANCE, 1)}")
    return 1 if failed or missing else 0


if __name__ == "__main__":
    sys.exit(main())
