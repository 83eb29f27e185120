"""travelling_wave_2d of the gallery: order 2 in L2 with P1 elements and 3 with P2.

    mms emit travelling_wave_2d --target numpy -o FOLDER
    PYTHONPATH=FOLDER python3 examples/solvers/scikit_fem/dynamic.py

A consistent mass, and the method of Runge and Kutta of fourth order, so that the error is that of the
elements. The sides move with the accelerations of the field; b and the start are the field's.
"""

import sys

import numpy as np
import travelling_wave_2d
from scipy.sparse.linalg import splu
from solid import Solid, verdict


def moved(solid, field, begin, end, steps):
    """The displacement at the end of so many steps, from the field's own state at the beginning."""
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
    return u


def main():
    parameters = travelling_wave_2d.Parameters()
    field = travelling_wave_2d.prepare(parameters)
    begin, last = field.time_window()
    # A quarter of a period: a wave crosses more than half of the block.
    end = begin + (last - begin) / 4.0
    passed = True
    for degree, levels in [(1, (8, 16, 32)), (2, (4, 8, 16))]:
        errors = []
        for n in levels:
            solid = Solid(degree, n, parameters, is_held=lambda x: np.full(x[0].shape, True))
            u = moved(solid, field, begin, end, steps=3 * degree * n)
            now = field.at_time(end)
            errors.append(solid.error(u, lambda x: now.displacement(*x)))
        passed &= verdict(f"dynamic, P{degree}", levels, errors, degree + 1)
    sys.exit(not passed)


main()
