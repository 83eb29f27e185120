"""A thermoelastic square in motion, with bilinear functions of u and theta, by the implicit midpoint rule.

    mms emit heated_square_2d --target numpy -o FOLDER
    PYTHONPATH=FOLDER python3 heated.py right CELLS STEPS END FILE

`without expansion` in place of `right` leaves out the term of b that the thermal stress gives, and `without conductivity` the
divergence of the heat flux in the source of heat.
"""

import sys

import numpy as np
from skfem import BilinearForm, ElementQuad1, ElementVector, LinearForm, MeshQuad
from skfem.helpers import ddot, det, dot, grad, inv, mul, trace, transpose
from square import Square, deformation, prepared


@LinearForm
def residual(v, q, w):
    f, slope = deformation(grad(w.u)), grad(w.theta)
    g, log = inv(f), np.log(det(f))
    stress = w.mu * f + (w.lame * log - w.mu - w.thermal * w.theta) * transpose(g)
    flux = -w.conductivity * det(f) * mul(g, mul(transpose(g), slope))
    return w.rho0 * dot(w.b, v) - ddot(stress, grad(v)) + w.heat * q + dot(flux, grad(q))


@BilinearForm
def tangent(du, dtheta, v, q, w):
    f, slope = deformation(grad(w.u)), grad(w.theta)
    g = inv(f)
    df, dv = mul(g, grad(du)), mul(g, grad(v))
    twist = w.mu - w.lame * np.log(det(f)) + w.thermal * w.theta
    along = (w.lame * trace(df) - w.thermal * dtheta) * trace(dv)
    dstress = w.mu * ddot(grad(du), grad(v)) + twist * ddot(df, transpose(dv)) + along
    straight = mul(g, mul(transpose(g), slope))
    turned = mul(df, straight) + mul(g, mul(transpose(g), mul(transpose(df), slope) - grad(dtheta)))
    dflux = w.conductivity * det(f) * (turned - trace(df) * straight)
    return dstress - dot(dflux, grad(q))


@BilinearForm
def mass(du, dtheta, v, q, w):
    return w.rho0 * dot(du, v)


@BilinearForm
def capacity(du, dtheta, v, q, w):
    return w.rho0 * w.capacity * dtheta * q


def main(study, cells, steps, end, path):
    p, field, lacking = prepared("heated_square_2d", study)
    element = ElementVector(ElementQuad1()) * ElementQuad1()
    rollers = [(axis, at, [f"u^{axis + 1}^1"]) for axis in (0, 1) for at in (0.0, p.length)]
    square = Square(MeshQuad, p.length, int(cells), element, 4, rollers)
    basis = square.basis
    mu, lame = p.young / (2 * (1 + p.nu)), p.young * p.nu / ((1 + p.nu) * (1 - 2 * p.nu))
    law = {"mu": mu, "lame": lame, "thermal": (3 * lame + 2 * mu) * p.expansion, "conductivity": p.conductivity}
    inertia = mass.assemble(basis, rho0=p.rho0)
    storage = capacity.assemble(basis, rho0=p.rho0, capacity=p.capacity)

    first, end = field.time_window()[0], float(end)
    start = field.at_time(first)
    nodes = basis.mesh.p
    of_u, of_theta = basis.split_indices()
    x, v = basis.zeros(), basis.zeros()
    x[of_u], v[of_u] = start.displacement(*nodes).T.ravel(), start.velocity(*nodes).T.ravel()
    x[of_theta] = start.theta(*nodes)

    dt = (end - first) / int(steps)
    for step in range(int(steps)):
        now = lacking.at_time(first + (step + 0.5) * dt)
        given = {"b": now.body_force(*square.x), "heat": now.heat_source(*square.x), "rho0": p.rho0}

        def equations(middle):
            u, theta = basis.interpolate(middle)
            gone = middle - x
            rates = inertia @ (4 / dt**2 * gone - 2 / dt * v) + storage @ (2 / dt * gone)
            stiffness = tangent.assemble(basis, u=u, theta=theta, **law)
            forces = residual.assemble(basis, u=u, theta=theta, **given, **law)
            return stiffness + 4 / dt**2 * inertia + 2 / dt * storage, forces - rates

        middle = square.solved(equations, x)
        x, v = 2 * middle - x, 4 / dt * (middle - x) - v

    (u, part), (theta, _) = basis.split(x)
    square.write(path, u, part, theta=theta)


main(*sys.argv[1:])
