"""A field at rest: Newton's method, and a force that is put on in steps."""

import numpy as np
from solid import Solid


def solved(solid, force, steps=4):
    """The displacement that balances a force, which is put on in steps."""
    u = np.zeros(solid.basis.N)
    for step in range(1, steps + 1):
        u = solid.balance(force * step / steps, u)
    return u


def run(module, kind, n):
    """The solid, and its displacement."""
    parameters = module.Parameters()
    now = module.prepare(parameters).at_time(0.0)
    solid = Solid(kind, n, parameters, is_held=lambda x: x[0] == 0.0)
    force = solid.body_force(lambda x: now.body_force(*x))
    force += solid.surface_force(lambda x, normal: now.traction(*x, *normal))
    return solid, solved(solid, force)
