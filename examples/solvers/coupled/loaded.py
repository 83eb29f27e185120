"""A neo-Hookean block in equilibrium, with quadratic functions, under a share of its load.

    mms emit loaded_2d.toml --target numpy --set load=0.5 -o FOLDER
    PYTHONPATH=FOLDER python3 loaded.py right CELLS FILE

`without lame` in place of `right` leaves out the term of b that the first Lame parameter gives.
"""

import sys

import numpy as np
from skfem import BilinearForm, ElementTriP2, ElementVector, LinearForm, MeshTri
from skfem.helpers import ddot, det, dot, grad, inv, mul, trace, transpose
from square import Square, deformation, prepared


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


def main(study, cells, path):
    parameters, field, lacking = prepared("loaded_2d", study)
    square = Square(MeshTri, parameters.length, int(cells), ElementVector(ElementTriP2()), 6, [(0, 0.0, ["u^1", "u^2"])])
    b = lacking.at_time(0.0).body_force_density(*square.x)
    force = square.surface_force(field.at_time(0.0).traction)

    def equations(u):
        given = {"u": square.basis.interpolate(u), "mu": parameters.mu, "lame": parameters.lame}
        internal = residual.assemble(square.basis, b=b, **given)
        return tangent.assemble(square.basis, **given), internal + force

    square.write(path, square.solved(equations, square.basis.zeros()), square.basis)


main(*sys.argv[1:])
