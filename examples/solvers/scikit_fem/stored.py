"""Writes twenty right runs on four meshes each, as `tests/command/data/scikit_fem` holds them:

    for field in travelling_wave_2d starting_square_2d; do mms emit $field --target numpy -o FOLDER; done
    PYTHONPATH=FOLDER python3 examples/solvers/scikit_fem/stored.py OUTPUT
"""

import importlib
import os
import sys

import dynamic
import meshio
import numpy as np
from solid import ELEMENTS

END = 0.012
# The largest product of wave speed and time step over the distance of nodes.
COURANT = 0.15
NAMES = {5: "triangle", 9: "quad", 22: "triangle6", 28: "quad9"}
# The fields: one that is deformed at the start, and one that is not.
FIELDS = {"wave": "travelling_wave_2d", "start": "starting_square_2d"}
# What is written of the motion, by the field and the degree.
WRITTEN = {("wave", 1): "uv", ("wave", 2): "uv", ("start", 1): "uva", ("start", 2): "uv"}
# Four of the waves once more, with accelerations.
WITH_ACCELERATION = ["Q1_regular", "P2_regular", "P1_irregular", "Q2_irregular"]


def in_space(vectors):
    """Vectors of two components in rows of three, in single precision."""
    return np.pad(vectors.T, ((0, 0), (0, 1))).astype(np.float32)


def write(path, solid, motion, quantities):
    part = solid.basis.split_bases()[0]
    values = np.array([[q[dofs] for dofs in solid.basis.split_indices()] for q in motion])
    names = [{"u": "displacement", "v": "velocity", "a": "acceleration"}[q] for q in quantities]
    data = {name: in_space(it) for name, it in zip(names, values)}
    cells = [(NAMES[solid.number], part.element_dofs.T)]
    meshio.Mesh(in_space(part.doflocs), cells, point_data=data).write(path)


def main(folder):
    runs = [(p, kind, s, None) for p in FIELDS for kind in ELEMENTS for s in ("regular", "irregular")]
    runs += [("wave", *it.split("_"), "ua") for it in WITH_ACCELERATION]
    for problem, kind, mesh, quantities in runs:
        module = importlib.import_module(FIELDS[problem])
        degree = ELEMENTS[kind][2]
        quantities = quantities or WRITTEN[problem, degree]
        shift = 0.1 if mesh == "irregular" else 0.0
        for n in [2, 4, 8, 16] if degree == 2 else [4, 8, 16, 32]:
            p = module.Parameters()
            speed = np.sqrt(p.young * (1 - p.nu) / ((1 + p.nu) * (1 - 2 * p.nu)) / p.rho0)
            steps = int(np.ceil(END * speed * n * degree / (COURANT * p.length)))
            solid, motion = dynamic.run(module, kind, n, steps, END, shift)
            chosen = [motion["uva".index(q)] for q in quantities]
            name = f"{problem}_{kind}_{mesh}_{quantities}_{n:02}.vtu"
            write(os.path.join(folder, name), solid, chosen, quantities)


main(*sys.argv[1:])
