"""Uses of the library that the type checkers look at: precision and shape of an array are known before it runs."""

from typing import assert_type

import numpy as np
import numpy.typing as npt

import manufactured as mf

Flat = np.ndarray[tuple[int], np.dtype[np.float32]]
Grid = np.ndarray[tuple[int, int, int], np.dtype[np.float64]]


def uses(flat: Flat, grid: Grid) -> None:
    """A vector has the shape of X, and everything its precision."""
    bar = mf.field("bar_1d", amplitude=0.1)
    assert_type(bar.u(flat, t=0.0), Flat)
    assert_type(bar.at(0.0).body_force(grid), Grid)
    assert_type(bar.jacobian(flat, 0.0), npt.NDArray[np.float32])
    assert_type(bar.P([0.25, 0.5], 0.0), npt.NDArray[np.float64])
    assert_type(mf.study(bar, cells=[8, (16,)]).levels[0].l2, float | None)


def solve(problem: mf.Problem) -> mf.Level:
    """A solver of a campaign."""
    assert_type(problem.X, npt.NDArray[np.float64])
    return problem.results(problem.field.u(problem.X, 0.0), t=0.0)


assert_type(mf.campaign("bar_1d", solve, cells=[8, 16, 32], expected_order=2), mf.Campaign)
