"""The assertion of an order, and the marker of slow levels."""

import pytest

pytest_plugins = ["pytester"]

SUITE = """
import numpy as np
import pytest
import manufactured as mf

TIME = 0.013
RUNS = []

def solve(order):
    def solve(field, n):
        RUNS.append(n)
        X = (np.arange(2 * n) + 0.5) / (2 * n)
        return mf.Level(1 / n, X, field.u(X, TIME) * (1 + 3 / n**order), t=TIME)
    return solve

@pytest.mark.slow_levels(64)
def test_right(assert_order):
    assert_order("bar_1d", solve(2), cells=[8, 16, 32], order=2)
    print("RUNS", RUNS)

def test_wrong(assert_order):
    assert_order("bar_1d", solve(1), cells=[8, 16, 32], order=2)
"""


def test_the_assertion(pytester):
    pytester.makepyfile(SUITE)
    found = pytester.runpytest_subprocess("-s", "--strict-markers", "-p", "no:cacheprovider")
    found.assert_outcomes(passed=1, failed=1)
    found.stdout.fnmatch_lines(["*RUNS [[]8, 16, 32]*", "*fail: observed order 1.*", "*the error acts as *"])


def test_slow_levels_are_run_where_they_are_asked_for(pytester):
    pytester.makepyfile(SUITE)
    options = ["-s", "--slow-levels", "-k", "right", "-p", "no:cacheprovider"]
    found = pytester.runpytest_subprocess(*options)
    found.stdout.fnmatch_lines(["*RUNS [[]8, 16, 32, 64]*"])
