"""A neo-Hookean block in equilibrium, with quadratic functions, under a part of its load.
"""

import manufactured as mf
import numpy as np
from skfem import BilinearForm, ElementTriP2, ElementVector, LinearForm, MeshTri
from skfem.helpers import ddot, det, dot, grad, inv, mul, trace, transpose
from square import Square, deformation

FIELD = mf.load("loaded_2d.toml")


@LinearForm
def residual(v, w):
    f = deformation(grad(w.u))
    stress = w.mu * f + (w.lame * np.log(det(f)) - w.mu) * transpose(inv(f))
    return dot(w.b, v) - ddot(stress, grad(v))


@BilinearForm
def tangent(du, v, w):
    f = deformation(grad(w.u))
    df, dv = mul(inv(f), grad(du)), mul(inv(f), grad(v))
    twist = w.mu - w.lame * np.log(det(f))
    return w.mu * ddot(grad(du), grad(v)) + twist * ddot(df, transpose(dv)) + w.lame * trace(df) * trace(dv)


def run(problem, sources=None):
    """The block; `sources` is a field whose b replaces the right one."""
    field, (mu, lame) = problem.field, (problem.field.parameters[it] for it in ("mu", "lame"))
    square = Square(
        MeshTri, problem.upper[0], problem.cells, ElementVector(ElementTriP2()), 6, {"x_min": ["u^1", "u^2"]}
    )
    b = square.at_points((sources or field).body_force_density)
    force = square.surface_force(field)

    def equations(u):
        given = {"u": square.basis.interpolate(u), "mu": mu, "lame": lame}
        internal = residual.assemble(square.basis, b=b, **given)
        return tangent.assemble(square.basis, **given), internal + force

    return square.results(problem, square.solved(equations, square.basis.zeros()), square.basis)
