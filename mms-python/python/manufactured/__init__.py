"""Manufactured solutions for solid mechanics, over NumPy arrays.

>>> import numpy as np
>>> import manufactured as mf
>>> bar = mf.field("bar_1d", amplitude=0.1)
>>> X = np.array([0.25, 0.5])
>>> bar.displacement(X, t=0.0).shape
(2,)
"""

from ._native import (
    AtPoints,
    Field,
    FieldError,
    Material,
    MmsError,
    Now,
    __version__,
    field,
    gallery,
    load,
    loads,
)

__all__ = [
    "AtPoints",
    "Field",
    "FieldError",
    "Material",
    "MmsError",
    "Now",
    "__version__",
    "field",
    "gallery",
    "load",
    "loads",
]
