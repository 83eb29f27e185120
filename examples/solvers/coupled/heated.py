"""A thermoelastic square in motion, with bilinear functions of u and theta, by the implicit midpoint rule.
"""

import manufactured as mf
import numpy as np
from skfem import BilinearForm, ElementQuad1, ElementVector, LinearForm, MeshQuad
from skfem.helpers import ddot, det, dot, grad, inv, mul, trace, transpose
from square import Square, deformation

# During the runs, heat crosses half of the square.
FIELD = mf.field("heated_square_2d", capacity=1, conductivity=2000)
# A quarter of a period of the wave.
END = 0.0079
COURANT = 0.5


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


def run(problem, sources=None):
    """The square; `sources` is a field whose b and source of heat replace the right ones."""
    field, names = problem.field, ("young", "nu", "rho0", "expansion", "conductivity", "capacity", "length")
    young, nu, rho0, expansion, conductivity, heat, length = (field.parameters[it] for it in names)
    sources = sources or field
    element = ElementVector(ElementQuad1()) * ElementQuad1()
    rollers = {f"{side}_{end}": [f"u^{axis}^1"] for side, axis in (("x", 1), ("y", 2)) for end in ("min", "max")}
    square = Square(MeshQuad, length, problem.cells, element, 4, rollers)
    basis = square.basis
    mu, lame = young / (2 * (1 + nu)), young * nu / ((1 + nu) * (1 - 2 * nu))
    law = {"mu": mu, "lame": lame, "thermal": (3 * lame + 2 * mu) * expansion, "conductivity": conductivity}
    inertia = mass.assemble(basis, rho0=rho0)
    storage = capacity.assemble(basis, rho0=rho0, capacity=heat)

    first, nodes = problem.window[0], basis.mesh.p.T
    start = field.at(first)
    of_u, of_theta = basis.split_indices()
    x, v = basis.zeros(), basis.zeros()
    x[of_u], v[of_u] = start.displacement(nodes).ravel(), start.velocity(nodes).ravel()
    x[of_theta] = start.theta(nodes)

    speed = np.sqrt((lame + 2 * mu) / rho0)
    steps = int(np.ceil((END - first) * speed / (COURANT * problem.h)))
    dt = (END - first) / steps
    for step in range(steps):
        now = sources.at(first + (step + 0.5) * dt)
        given = {"b": square.at_points(now.body_force), "heat": square.at_points(now.heat_source), "rho0": rho0}

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
    return square.results(problem, u, part, t=END, theta=theta)
