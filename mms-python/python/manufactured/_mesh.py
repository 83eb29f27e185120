"""Meshes of meshio and PyVista as levels."""

from __future__ import annotations

import os
from typing import Any

import numpy as np

from ._native import Level


def level_of(results: Any) -> Level | str | os.PathLike[str]:
    """Results as the extension module takes them."""
    if isinstance(results, (Level, str, os.PathLike)):
        return results
    if hasattr(results, "points") and hasattr(results, "point_data"):
        return _level(results)
    raise TypeError(
        "expected a level, as of `Level(h, X, u, t=t)` or `problem.results(u)`, a path, or a mesh of meshio or PyVista; found "
        + type(results).__name__
    )


def _level(mesh: Any) -> Level:
    if hasattr(mesh, "cells_dict") and hasattr(mesh, "celltypes"):
        # PyVista: by the numbers of VTK.
        cells = [(int(kind), np.asarray(each)) for kind, each in mesh.cells_dict.items()]
    else:
        cells = [(block.type, np.asarray(block.data)) for block in mesh.cells]
    fields = getattr(mesh, "field_data", {})
    time = next((fields[name] for name in ("TimeValue", "time", "TIME") if name in fields), None)
    t = None if time is None else float(np.asarray(time).ravel()[0])
    arrays = {name: np.asarray(array) for name, array in mesh.point_data.items()}
    return Level(None, np.asarray(mesh.points), t=t, cells=cells, **arrays)
