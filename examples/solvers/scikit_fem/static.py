"""cantilever_2d.toml at rest: Newton's method, order 2 in L2 with P1 elements and 3 with P2.

    mms emit examples/solvers/scikit_fem/cantilever_2d.toml --target numpy -o FOLDER
    PYTHONPATH=FOLDER python3 examples/solvers/scikit_fem/static.py
"""

import sys

import cantilever_2d
import numpy as np
from solid import Solid, verdict


def solved(solid, force, steps=4):
    """The displacement that balances a force, which is put on in steps."""
    u = np.zeros(solid.basis.N)
    for step in range(1, steps + 1):
        u = solid.balance(force * step / steps, u)
    return u


def main():
    parameters = cantilever_2d.Parameters()
    now = cantilever_2d.prepare(parameters).at_time(0.0)
    passed = True
    for degree, levels in [(1, (8, 16, 32)), (2, (4, 8, 16))]:
        errors = []
        for n in levels:
            solid = Solid(degree, n, parameters, is_held=lambda x: x[0] == 0.0)
            force = solid.body_force(lambda x: now.body_force(*x))
            force += solid.surface_force(lambda x, normal: now.traction(*x, *normal))
            errors.append(solid.error(solved(solid, force), lambda x: now.displacement(*x)))
        passed &= verdict(f"static, P{degree}", levels, errors, degree + 1)
    sys.exit(not passed)


main()
