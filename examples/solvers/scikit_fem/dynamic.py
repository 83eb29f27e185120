"""A field in motion: a consistent mass, and the method of Runge and Kutta of fourth order, so that the
error is that of the elements. The sides move with the accelerations of the field; b and the start are
the field's.
"""

import numpy as np
from scipy.sparse.linalg import splu
from solid import Solid


def moved(solid, field, begin, end, steps):
    """The displacement, the velocity and the acceleration at the end of so many steps, from the field's own state at the
    beginning.
    """
    mass = solid.mass().tocsc()
    held, free = solid.held, solid.basis.complement_dofs(solid.held)
    factors = splu(mass[free][:, free])

    def acceleration(t, u):
        now = field.at_time(t)
        a = np.zeros_like(u)
        a[held] = solid.interpolated(lambda x: now.acceleration(*x))[held]
        force = solid.body_force(lambda x: now.body_force(*x)) - solid.internal_force(u)
        a[free] = factors.solve((force - mass @ a)[free])
        return a

    start = field.at_time(begin)
    u = solid.interpolated(lambda x: start.displacement(*x))
    v = solid.interpolated(lambda x: start.velocity(*x))
    dt = (end - begin) / steps
    for step in range(steps):
        t = begin + step * dt
        a1 = acceleration(t, u)
        a2 = acceleration(t + dt / 2, u + dt / 2 * v)
        a3 = acceleration(t + dt / 2, u + dt / 2 * v + dt**2 / 4 * a1)
        a4 = acceleration(t + dt, u + dt * v + dt**2 / 2 * a2)
        u = u + dt * v + dt**2 / 6 * (a1 + a2 + a3)
        v = v + dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
    return u, v, acceleration(end, u)


def run(module, kind, n, steps, end, shift=0.0):
    """The solid, and its motion after so many steps from the first time on."""
    parameters = module.Parameters()
    field = module.prepare(parameters)
    solid = Solid(kind, n, parameters, lambda x: np.full(x[0].shape, True), shift)
    return solid, moved(solid, field, field.time_window()[0], end, steps)
