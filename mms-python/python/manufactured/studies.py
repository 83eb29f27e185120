"""Studies: of the solver of this project, and of one that is a Python function."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Union

from . import _native, documents
from ._mesh import level_of
from ._native import Field, Level
from ._progress import Progress, followed
from .verdicts import Diagnosis, Judged, Judgement, Results, Shown, diagnose, judge, opened

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

#: Cells along the longest edge of the body, or along each of its axes.
Cells = Union[int, str, Sequence[int]]

#: The options of `mms study` that say where files go and how results are printed.
_NO_OPTIONS = ("format", "full", "help", "json", "output", "set", "study", "verbose")


@dataclass(frozen=True, kw_only=True, repr=False)
class Study(Judged, documents.Study):
    """The observed order of a method of this project's own solver: `study` returns one."""

    _kind = "study"

    __str__ = Shown.__str__

    def plot(self, ax: Any = None) -> Any:
        """Draws the norms of the error against h, or against dt, with Matplotlib, and returns the axes."""
        if ax is None:
            import matplotlib.pyplot as plt  # type: ignore[import-not-found, unused-ignore]

            ax = plt.subplots()[1]
        length = "time_step" if self.refinement == "time" else "cell_size"
        for norm in ("l1", "l2", "linf"):
            levels = [it for it in self.levels if getattr(it, norm) is not None]
            ax.loglog([getattr(it, length) for it in levels], [getattr(it, norm) for it in levels], "o-", label=norm)
        ax.set_xlabel("dt" if self.refinement == "time" else "h")
        ax.set_ylabel("error")
        ax.legend()
        return ax


def _division(cells: Cells) -> str:
    return "x".join(map(str, cells)) if isinstance(cells, Sequence) and not isinstance(cells, str) else str(cells)


def _grids(cells: Iterable[Cells]) -> list[Cells]:
    """The cells of each mesh."""
    if isinstance(cells, str) or not isinstance(cells, Iterable):
        raise TypeError(f"`cells`: expected a list with the cells of each mesh, such as [8, 16, 32], found {cells!r}")
    return list(cells)


def _options(options: Mapping[str, Any]) -> list[str]:
    words = []
    for name, value in options.items():
        if name in _NO_OPTIONS:
            raise TypeError(f"study() takes no `{name}`: it writes no file, and its result has every form")
        option = "--" + name.replace("_", "-")
        if value is True:
            words.append(option)
        elif value is not None and value is not False:
            many = isinstance(value, Iterable) and not isinstance(value, str)
            words.append(f"{option}={','.join(map(str, value)) if many else value}")
    return words


def study(
    field: Field | str,
    *,
    cells: Iterable[Cells] = (),
    progress: Progress = None,
    **options: Any,
) -> Study:
    """Runs a method of this project's own solver on levels of refinement: errors, orders, verdict. No file is written.

    `study("bar_1d", shape="cpgimp", cells=[8, 16, 32])`. Options are as in `mms study`, with an underscore for a hyphen;
    True means an option without a value. A study has one method.

    `progress` is a function that takes each line about how far runs are; True prints them to stderr, and None does where
    somebody watches: on a terminal and in a notebook.

    Raises MmsError where an option makes no sense, or no level can be started. An interrupt ends the runs.
    """
    grids = [_division(it) for it in _grids(cells)]
    with followed(progress) as told:
        return Study._of(_native.study(opened(field), _options({"cells": grids or None, **options}), told))


class Problem:
    """The problem that a solver solves on one mesh: a level of a `campaign`."""

    def __init__(self, field: Field, cells: Cells, level: int, particles_per_cell: Cells) -> None:
        #: The field: `problem.field.b(X, t)` and every other quantity.
        self.field = field
        #: Cells along the longest edge of the body, or along each axis, as they were given.
        self.cells = cells
        #: The number of the level, from 1.
        self.level = level
        #: Particles in each direction of a cell.
        self.particles_per_cell = particles_per_cell

    @cached_property
    def _grid(self) -> tuple[float, NDArray[np.float64], NDArray[np.float64]]:
        return self.field.grid(_division(self.cells), _division(self.particles_per_cell))

    @property
    def h(self) -> float:
        """The longest edge of a cell."""
        return self._grid[0]

    @property
    def X(self) -> NDArray[np.float64]:
        """The reference positions of particles that fill the cells: (n, D)."""
        return self._grid[1]

    @property
    def V0(self) -> NDArray[np.float64]:
        """The reference volumes of these particles: (n,)."""
        return self._grid[2]

    @property
    def lower(self) -> list[float]:
        """The lower corner of the box around the body."""
        return self.field.bounds[0]

    @property
    def upper(self) -> list[float]:
        """The upper corner of the box around the body."""
        return self.field.bounds[1]

    @property
    def window(self) -> tuple[float, float] | None:
        """The first and the last time; None of a static field."""
        return self.field.window

    @property
    def boundary(self) -> dict[str, str]:
        """The claim of the field on each face: fixed, free, traction and their like. `traction` gives the numbers."""
        return self.field.boundary

    def b(self, X: Any, t: float | None = None) -> NDArray[Any]:
        """The body force per unit mass at reference positions: (..., D)."""
        return self.field.body_force(X, t)

    def traction(self, face: str, X: Any, t: float | None = None) -> NDArray[Any]:
        """The traction P N on the reference area of a face: (..., D)."""
        return self.field.traction(face, X, t)

    def results(
        self,
        u: Any,
        X: Any = None,
        *,
        t: float | None = None,
        cells: Sequence[tuple[int | str, Any]] | None = None,
        **quantities: Any,
    ) -> Level:
        """Results on this mesh: u at the points X, or at the particles of the problem, at t, or at the end of the window.

        `cells` are the cells as in a `Level`, such as `[("triangle", triangles)]`: norms are then taken over cells. Other quantities
        are named: `P=stress`.
        """
        at = self.window[1] if t is None and self.window else t
        return Level(self.h, self.X if X is None else X, u, t=at, cells=cells, **quantities)

    def __repr__(self) -> str:
        return f"<{self.field.name} on {_division(self.cells)} cells>"


@dataclass(frozen=True)
class Run:
    """A run of a solver in a `campaign`."""

    #: The problem that the solver got.
    problem: Problem
    #: The results that it returned.
    results: Results
    #: The wall time that it took, in s.
    seconds: float


@dataclass(frozen=True, kw_only=True, repr=False)
class Campaign(Judgement):
    """The verdict on the results of a solver that is a function, with its runs: `campaign` returns one."""

    __str__ = Shown.__str__

    @property
    def runs(self) -> list[Run]:
        """The runs, from coarse to fine."""
        runs: list[Run] = self.__dict__["_runs"]
        return runs

    def diagnose(self, **options: Any) -> Diagnosis:
        """Names the mistake of the solver by these results; the options are the same as of `diagnose`."""
        return diagnose(self.runs[0].problem.field, [run.results for run in self.runs], **options)


def campaign(
    field: Field | str,
    solver: Callable[[Problem], Results],
    *,
    cells: Iterable[Cells],
    particles_per_cell: Cells = 2,
    progress: Progress = None,
    **options: Any,
) -> Campaign:
    """Runs a solver that is a Python function on meshes, from coarse to fine, and judges its results.

    `solver(problem)` gets a `Problem`, with so many particles in each direction of a cell, and returns `problem.results(u)`, or
    results as `judge` takes them. Options are as in `judge`, for example `expected_order=2`; `progress` is as in `study`.

    Returns the judgement, whose `runs` have each problem, its results and the seconds that they took; `diagnose()` looks for the
    mistake behind them. Raises what the solver raises, with a note that names the mesh, and MmsError where its results are none
    of the field.
    """
    of, grids, runs = opened(field), _grids(cells), []
    with followed(progress) as told:
        for level, each in enumerate(grids, 1):
            if told:
                told(f"{_division(each)} cells: level {level} of {len(grids)}")
            problem, start = Problem(of, each, level, particles_per_cell), time.perf_counter()
            try:
                results = level_of(solver(problem))
            except Exception as error:
                if hasattr(error, "add_note"):
                    error.add_note(f"in level {level} of {len(grids)}: {problem!r}")
                raise
            runs.append(Run(problem, results, time.perf_counter() - start))
        judgement = judge(of, [run.results for run in runs], progress=told or False, **options)
    made = Campaign._of(judgement.__dict__["_views"])
    object.__setattr__(made, "_runs", runs)
    return made
