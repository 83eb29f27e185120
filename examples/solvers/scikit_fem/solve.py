"""One run: a kind of problem and a degree, as in "static P1", cells, steps, the last time, and a file.

    mms emit FIELD --target numpy -o FOLDER
    PYTHONPATH=FOLDER python3 examples/solvers/scikit_fem/solve.py "static P1" CELLS STEPS END FILE
"""

import importlib
import sys

import dynamic
import static


def main(name, cells, steps, end, path):
    kind, degree = name.split(" P")
    degree, n = int(degree), int(cells)
    if kind == "static":
        solid, u = static.run(importlib.import_module("cantilever_2d"), degree, n)
    else:
        module = importlib.import_module("travelling_wave_2d")
        solid, u = dynamic.run(module, degree, n, int(steps), float(end))
    solid.write(u, path)


main(*sys.argv[1:])
