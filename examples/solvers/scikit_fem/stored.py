"""Writes the twenty right runs, on four meshes each, that are stored in `tests/command/data/scikit_fem`:

    python3 examples/solvers/scikit_fem/stored.py OUTPUT
"""

import os
import sys

import dynamic
import manufactured as mf
import meshio
import numpy as np
from solid import ELEMENTS

END = 0.012
# The fields: the first is deformed at the start, the second is not.
FIELDS = {"wave": "travelling_wave_2d", "start": "starting_square_2d"}
# The written quantities of the motion, by field and degree.
WRITTEN = {("wave", 1): "uv", ("wave", 2): "uv", ("start", 1): "uva", ("start", 2): "uv"}
# Four of the waves are written again, with accelerations.
WITH_ACCELERATION = ["Q1_regular", "P2_regular", "P1_irregular", "Q2_irregular"]


def in_space(vectors):
    """Vectors of two components in rows of three, in single precision."""
    return np.pad(vectors, ((0, 0), (0, 1))).astype(np.float32)


def write(path, solid, motion, quantities):
    names = {"u": "displacement", "v": "velocity", "a": "acceleration"}
    nodes = [solid.nodes(it) for it in motion]
    points, cells, _ = nodes[0]
    data = {names[q]: in_space(values) for q, (_, _, values) in zip(quantities, nodes)}
    meshio.Mesh(in_space(points), cells, point_data=data).write(path)


def main(folder):
    runs = [(p, kind, s, None) for p in FIELDS for kind in ELEMENTS for s in ("regular", "irregular")]
    runs += [("wave", *it.split("_"), "ua") for it in WITH_ACCELERATION]
    for problem, kind, mesh, quantities in runs:
        field, degree = mf.field(FIELDS[problem]), ELEMENTS[kind][2]
        quantities = quantities or WRITTEN[problem, degree]
        shift = 0.1 if mesh == "irregular" else 0.0
        for n in [2, 4, 8, 16] if degree == 2 else [4, 8, 16, 32]:
            solid, motion = dynamic.run(field, kind, n, END, shift)
            chosen = [motion["uva".index(q)] for q in quantities]
            name = f"{problem}_{kind}_{mesh}_{quantities}_{n:02}.vtu"
            write(os.path.join(folder, name), solid, chosen, quantities)


main(*sys.argv[1:])
