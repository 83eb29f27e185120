"""Elements of Taylor and Hood: an incompressible neo-Hookean block at rest, with quadratic functions of u and linear ones of p.

    mms emit incompressible_2d.toml --target numpy -o FOLDER
    PYTHONPATH=FOLDER python3 mixed.py right CELLS FILE

`without volume_residual` in place of `right` leaves out the source of the constraint.
"""

import sys

import numpy as np
from skfem import BilinearForm, ElementTriP1, ElementTriP2, ElementVector, LinearForm, MeshTri
from skfem.helpers import ddot, det, dot, grad
from square import Square, deformation, prepared


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


def main(study, cells, path):
    parameters, field, _ = prepared("incompressible_2d", "right")
    now = field.at_time(0.0)
    element = ElementVector(ElementTriP2()) * ElementTriP1()
    square = Square(MeshTri, parameters.length, int(cells), element, 6, [(0, 0.0, ["u^1^1", "u^2^1"])])
    b = now.body_force_density(*square.x)
    source = 0.0 if study == "without volume_residual" else now.volume_residual(*square.x)
    force = square.surface_force(now.traction)

    def equations(x):
        u, p = square.basis.interpolate(x)
        given = {"u": u, "p": p, "mu": parameters.mu}
        internal = residual.assemble(square.basis, b=b, source=source, **given)
        return tangent.assemble(square.basis, **given), internal + force

    (u, nodes), (p, _) = square.basis.split(square.solved(equations, square.basis.zeros()))
    square.write(path, u, nodes, p=p)


main(*sys.argv[1:])
