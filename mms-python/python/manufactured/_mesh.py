"""Meshes of meshio and PyVista as levels."""

from __future__ import annotations

import os
from typing import Any

import numpy as np

from ._native import Level

#: The numbers that VTK gives to the cells of meshio.
_CELLS = {
    "vertex": 1,
    "line": 3,
    "triangle": 5,
    "quad": 9,
    "tetra": 10,
    "hexahedron": 12,
    "wedge": 13,
    "pyramid": 14,
    "line3": 21,
    "triangle6": 22,
    "quad8": 23,
    "tetra10": 24,
    "hexahedron20": 25,
    "quad9": 28,
    "hexahedron27": 29,
}


def level_of(results: Any) -> Level | str | os.PathLike[str]:
    """Results as the extension module takes them."""
    if isinstance(results, (Level, str, os.PathLike)):
        return results
    if hasattr(results, "points") and hasattr(results, "point_data"):
        return _level(results)
    raise TypeError(
        f"expected a level, a path, or a mesh of meshio or PyVista, found {type(results).__name__}"
    )


def _level(mesh: Any) -> Level:
    if hasattr(mesh, "cells_dict") and hasattr(mesh, "celltypes"):
        # PyVista: by the numbers of VTK.
        cells = [(int(kind), np.asarray(each)) for kind, each in mesh.cells_dict.items()]
        fields = getattr(mesh, "field_data", {})
    else:
        unknown = [block.type for block in mesh.cells if block.type not in _CELLS]
        if unknown:
            raise ValueError(f"cells of the type {unknown[0]} are not read; expected {', '.join(_CELLS)}")
        cells = [(_CELLS[block.type], np.asarray(block.data)) for block in mesh.cells]
        fields = getattr(mesh, "field_data", {})
    time = next((fields[name] for name in ("TimeValue", "time", "TIME") if name in fields), None)
    t = None if time is None else float(np.asarray(time).ravel()[0])
    arrays = {name: np.asarray(array) for name, array in mesh.point_data.items()}
    return Level(None, np.asarray(mesh.points), t=t, cells=cells, **arrays)
