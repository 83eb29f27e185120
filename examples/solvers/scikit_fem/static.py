"""A field at rest: Newton's method, with the force applied in steps."""

import numpy as np
from solid import Solid


def solved(solid, force, steps=4):
    """The displacement that balances a force, which is applied in steps."""
    u = np.zeros(solid.basis.N)
    for step in range(1, steps + 1):
        u = solid.balance(force * step / steps, u)
    return u


def run(field, kind, n):
    """The solid, and its displacement."""
    held = [side for side, claim in field.boundary.items() if claim == "fixed"]
    solid = Solid(kind, n, field.parameters, held)
    now = field.at(0.0)
    force = solid.body_force(now.body_force)
    for side, claim in field.boundary.items():
        if claim == "traction":
            force += solid.surface_force(side, lambda X: now.traction(side, X))
    return solid, solved(solid, force)
