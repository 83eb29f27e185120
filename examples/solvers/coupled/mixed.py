"""Taylor-Hood elements: an incompressible neo-Hookean block at rest, with quadratic functions of u and linear functions of p.
"""

import manufactured as mf
import numpy as np
from skfem import BilinearForm, ElementTriP1, ElementTriP2, ElementVector, LinearForm, MeshTri
from skfem.helpers import ddot, det, dot, grad
from square import Square, deformation

FIELD = mf.load("incompressible_2d.toml")


def cofactor(f):
    """J F^-T, linear in F."""
    return np.array([[f[1, 1], -f[1, 0]], [-f[0, 1], f[0, 0]]])


@LinearForm
def residual(v, q, w):
    f, p = deformation(grad(w.u)), w.p
    stress = w.mu * f - p * cofactor(f)
    return dot(w.b, v) - ddot(stress, grad(v)) + (det(f) - 1.0 - w.source) * q


@BilinearForm
def tangent(du, dp, v, q, w):
    f, df = deformation(grad(w.u)), grad(du)
    dstress = w.mu * df - w.p * cofactor(df) - dp * cofactor(f)
    return ddot(dstress, grad(v)) - ddot(cofactor(f), df) * q


def run(problem, has_source=True):
    """The block; without its source the constraint is J = 1."""
    field, mu = problem.field, problem.field.parameters["mu"]
    element = ElementVector(ElementTriP2()) * ElementTriP1()
    square = Square(MeshTri, problem.upper[0], problem.cells, element, 6, {"x_min": ["u^1^1", "u^2^1"]})
    b = square.at_points(field.body_force_density)
    source = square.at_points(field.volume_residual) if has_source else 0.0
    force = square.surface_force(field)

    def equations(x):
        u, p = square.basis.interpolate(x)
        given = {"u": u, "p": p, "mu": mu}
        internal = residual.assemble(square.basis, b=b, source=source, **given)
        return tangent.assemble(square.basis, **given), internal + force

    (u, nodes), (p, _) = square.basis.split(square.solved(equations, square.basis.zeros()))
    return square.results(problem, u, nodes, p=p)
