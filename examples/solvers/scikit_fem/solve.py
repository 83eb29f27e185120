"""One run: a kind of problem and of elements, as in "static P1", cells, steps, the last time, and a file.

    mms emit FIELD --target numpy -o FOLDER
    PYTHONPATH=FOLDER python3 examples/solvers/scikit_fem/solve.py "static P1" CELLS STEPS END FILE
"""

import importlib
import sys

import dynamic
import static


def main(name, cells, steps, end, path):
    problem, kind = name.split()
    n = int(cells)
    if problem == "static":
        solid, u = static.run(importlib.import_module("cantilever_2d"), kind, n)
    else:
        module = importlib.import_module("travelling_wave_2d")
        solid, (u, _, _) = dynamic.run(module, kind, n, int(steps), float(end))
    solid.write(u, path)


main(*sys.argv[1:])
