"""Manufactured solutions for solid mechanics, over NumPy arrays.

>>> import numpy as np
>>> import manufactured as mf
>>> bar = mf.field("bar_1d", amplitude=0.1)
>>> X = np.array([0.25, 0.5])
>>> bar.displacement(X, t=0.0).shape
(2,)
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ._native import (
    AtPoints,
    Field,
    FieldError,
    Level,
    Material,
    MmsError,
    Now,
    __version__,
    field,
    gallery,
    load,
    loads,
)

if TYPE_CHECKING:
    from .studies import Campaign, Problem, Run, Study, campaign, study
    from .verdicts import Diagnosis, Judgement, diagnose, judge, judge_law

__all__ = [
    "AtPoints",
    "Campaign",
    "Diagnosis",
    "Field",
    "FieldError",
    "Judgement",
    "Level",
    "Material",
    "MmsError",
    "Now",
    "Problem",
    "Run",
    "Study",
    "__version__",
    "campaign",
    "diagnose",
    "field",
    "gallery",
    "judge",
    "judge_law",
    "load",
    "loads",
    "study",
]


def __getattr__(name: str) -> Any:
    """Studies and verdicts, which are imported at their first use: programs that only evaluate fields do not wait for them."""
    if name not in __all__:
        raise AttributeError(f"module `manufactured` has no `{name}`")
    from . import studies, verdicts

    return getattr(verdicts if hasattr(verdicts, name) else studies, name)


def __dir__() -> list[str]:
    return __all__
