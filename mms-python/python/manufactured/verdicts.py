"""Verdicts on the results of a solver."""

from __future__ import annotations

import html
import json
import os
import warnings
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar, Union

import numpy as np

from . import _native
from ._document import Document
from ._mesh import level_of
from ._native import Field, Level
from ._progress import Progress, followed
from .documents import Diagnose, Judge

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

#: Results of one mesh: arrays, the path of files, or a mesh of meshio or PyVista.
Results = Union[Level, str, "os.PathLike[str]", Any]

S = TypeVar("S", bound="Shown")


@dataclass(frozen=True, kw_only=True)
class Shown(Document):
    """A document with the forms in which it is shown."""

    @classmethod
    def _of(cls: type[S], views: Mapping[str, str | None]) -> S:
        made = cls.from_dict(json.loads(views["json"] or "{}"))
        object.__setattr__(made, "_views", views)
        return made

    def _view(self, name: str) -> str:
        return self.__dict__["_views"][name] or ""

    def __str__(self) -> str:
        return self._view("text")

    def to_json(self) -> str:
        """The document in JSON."""
        return self._view("json")

    def to_markdown(self) -> str:
        """The tables in Markdown."""
        return self._view("markdown")

    def to_latex(self) -> str:
        """The tables in LaTeX, for the package booktabs."""
        return self._view("latex")

    def to_csv(self) -> str:
        """The numbers with all their digits."""
        return self._view("csv")

    def _repr_html_(self) -> str:
        return f"{self._view('svg')}<pre>{html.escape(str(self))}</pre>"


class Judged(Shown):
    """An observed order and the verdict on it."""

    _kind: ClassVar[str]
    field: Any
    verdict: Any
    observed_order: Any

    def __repr__(self) -> str:
        order = "" if self.observed_order is None else f", order {self.observed_order:.2f}"
        return f"<{self._kind} of {self.field}: {self.verdict}{order}>"

    @property
    def passed(self) -> bool:
        """Whether the order is the expected one, or the results are exact to round-off."""
        return self.verdict in ("pass", "exact to round-off")

    def to_svg(self) -> str:
        """A picture of the errors against h or dt, with the orders in the legend."""
        return self._view("svg")


@dataclass(frozen=True, kw_only=True, repr=False)
class Judgement(Judged, Judge):
    """The verdict on results: `judge` returns one."""

    _kind = "judgement"

    __str__ = Shown.__str__

    def plot(self, ax: Any = None) -> Any:
        """Draws the deciding norm of each quantity against h with Matplotlib, and returns the axes."""
        if ax is None:
            import matplotlib.pyplot as plt  # type: ignore[import-not-found, unused-ignore]

            ax = plt.subplots()[1]
        for quantity in self.quantities:
            norm = next(it for it in quantity.norms if it.norm == quantity.norm)
            levels = [it for it in norm.levels or [] if it.error is not None]
            order = "" if norm.observed_order is None else f", order {norm.observed_order:.2f}"
            lengths = [it.length for it in levels]
            ax.loglog(lengths, [it.error for it in levels], "o-", label=f"{quantity.name} {norm.norm}{order}")
        ax.set_xlabel("dt" if self.refinement == "time" else "h")
        ax.set_ylabel("error")
        ax.legend()
        return ax


@dataclass(frozen=True, kw_only=True, repr=False)
class Diagnosis(Shown, Diagnose):
    """The mistake that an error acts as: `diagnose` and `judge_law` return one."""

    __str__ = Shown.__str__

    def __repr__(self) -> str:
        named = f" {self.named}" if self.named else ""
        return f"<diagnosis of {self.field}: {self.finding}{named}>"

    @property
    def named(self) -> str | None:
        """The name of the mistake, such as "force_reversed"; None where none is named."""
        return self.ranked[0].hypothesis if self.finding == "named" else None

    @property
    def is_right(self) -> bool:
        """Whether nothing is wrong beyond what a method makes."""
        return self.finding == "nothing"


def opened(field: Field | str) -> Field:
    """A field, or the field of the gallery with this name."""
    return _native.field(field) if isinstance(field, str) else field


def _levels(results: Iterable[Results]) -> list[Level | str | os.PathLike[str]]:
    if isinstance(results, (str, os.PathLike, Level)):
        results = [results]
    levels = [level_of(it) for it in results]
    if not levels:
        raise _native.MmsError("no results: expected a level, a path or a mesh of each mesh, from coarse to fine")
    return levels


def _orders(given: float | Mapping[str, float] | None) -> list[tuple[str | None, float]]:
    if given is None:
        return []
    if isinstance(given, Mapping):
        return [(name, float(order)) for name, order in given.items()]
    return [(None, float(given))]


def judge(
    field: Field | str,
    results: Iterable[Results],
    *,
    quantities: Sequence[str] = (),
    times: Sequence[float] = (),
    expected_order: float | Mapping[str, float] | None = None,
    tolerance: float | None = None,
    start: str | None = None,
    over: str | None = None,
    part: bool = False,
    all_components: bool = False,
    progress: Progress = None,
) -> Judgement:
    """Judges results of any solver, one of each mesh, from coarse to fine: their orders, and a verdict.

    No process is started, and no file is written. `results` are levels, paths as `mms judge` takes them, or meshes of meshio or
    PyVista. `expected_order` is a number, or numbers by names of norms, quantities or QUANTITY:NORM. `over` is "points" or
    "cells". The other options have their meaning in `mms judge`; for `progress`, see `study`.

    Raises MmsError where results are none of the field. An interrupt ends the work.
    """
    with followed(progress) as told:
        views = _native.judge(
            opened(field),
            _levels(results),
            list(quantities),
            [float(it) for it in times],
            _orders(expected_order),
            tolerance,
            start,
            over,
            part,
            all_components,
            told,
        )
    judgement = Judgement._of(views)
    for warning in judgement.warnings or []:
        warnings.warn(warning, stacklevel=2)
    return judgement


def diagnose(
    field: Field | str,
    results: Iterable[Results] | ArrayLike,
    *,
    h: float | None = None,
    t: float | None = None,
    quantities: Sequence[str] = (),
    times: Sequence[float] = (),
    time_step: float | Sequence[float] = (),
    expected_order: float | Mapping[str, float] | None = None,
    without: Sequence[str] = (),
    residual_sign: float = 1.0,
    nodal: bool = False,
    progress: Progress = None,
    **arrays: ArrayLike,
) -> Diagnosis:
    """Names the mistake of a solver by the error that it makes, as `mms diagnose` does.

    `diagnose(field, X, a=a, t=t)` looks at accelerations, or at residuals `r`, at an exact state. `diagnose(field, results)`
    looks at results as `judge` takes them. `time_step` is the solver's, or one for each mesh. For `progress`, see `study`.

    Raises MmsError where there is nothing to look at. An interrupt ends the work.
    """
    named: dict[str, Any] = arrays
    if not named and isinstance(results, np.ndarray):
        raise TypeError("points alone: give what the solver computed there, such as `a=` for accelerations or `r=` for residuals")
    given = [Level(h, results, t=t, **named)] if named else _levels(results)  # type: ignore[arg-type]
    steps = [float(time_step)] if isinstance(time_step, (int, float)) else [float(it) for it in time_step]
    with followed(progress) as told:
        views, notes = _native.diagnose(
            opened(field),
            given,
            None,
            list(quantities),
            [float(it) for it in times],
            steps,
            _orders(expected_order),
            list(without),
            residual_sign,
            nodal,
            told,
        )
    for note in notes:
        warnings.warn(note, stacklevel=2)
    return Diagnosis._of(views)


def judge_law(
    field: Field | str,
    F: ArrayLike,
    P: ArrayLike | None = None,
    *,
    S: ArrayLike | None = None,
    sigma: ArrayLike | None = None,
    tau: ArrayLike | None = None,
    X: ArrayLike | None = None,
) -> Diagnosis:
    """Compares a law of your own with the law of the field, to round-off: is it the same material, and if not, what differs?

    F is (n, D, D), and so is the one stress that is given: P, S, sigma or tau. X is needed where the material depends on it.

    Raises MmsError where no stress is given, or two are.
    """
    of, shape = opened(field), np.shape(F)
    dimension = of.dimension
    if shape[-2:] not in ((dimension, dimension), (3, 3)) and (dimension > 1 or len(shape) != 1):
        raise _native.MmsError(f"`F` has the shape {shape}: expected (..., {dimension}, {dimension})")
    stresses = {"P": P, "S": S, "sigma": sigma, "tau": tau}
    given: dict[str, Any] = {name: it for name, it in stresses.items() if it is not None}
    level = Level(None, X, F=F, **given)
    views, _ = _native.diagnose(of, [level], "stress", [], [], [], [], [], 1.0, False, None)
    return Diagnosis._of(views)
