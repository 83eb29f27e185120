"""A field in motion: a consistent mass, and the Runge-Kutta method of fourth order, so that the elements
dominate the error. The sides move with the accelerations of the field; b and the start come from the
field.
"""

import math

import numpy as np
from scipy.sparse.linalg import splu
from solid import ELEMENTS, Solid

# The largest wave speed times time step, over the distance of nodes.
COURANT = 0.15


def moved(solid, field, begin, end, steps):
    """The displacement, the velocity and the acceleration after `steps` steps from the state of the field at the start."""
    mass = solid.mass().tocsc()
    held, free = solid.held, solid.basis.complement_dofs(solid.held)
    factors = splu(mass[free][:, free])

    def acceleration(t, u):
        now = field.at(t)
        a = np.zeros_like(u)
        a[held] = solid.interpolated(now.acceleration)[held]
        force = solid.body_force(now.body_force) - solid.internal_force(u)
        a[free] = factors.solve((force - mass @ a)[free])
        return a

    start = field.at(begin)
    u = solid.interpolated(start.displacement)
    v = solid.interpolated(start.velocity)
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


def run(field, kind, n, end, shift=0.0):
    """The solid, and its motion from the first time of the field to the end."""
    solid = Solid(kind, n, field.parameters, field.faces, shift)
    begin, speed = field.window[0], math.sqrt((solid.lam + 2 * solid.mu) / solid.rho0)
    distance = field.parameters["length"] / (n * ELEMENTS[kind][2])
    steps = math.ceil((end - begin) * speed / (COURANT * distance))
    return solid, moved(solid, field, begin, end, steps)
