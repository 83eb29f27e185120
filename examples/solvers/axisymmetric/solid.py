"""A total-Lagrangian solid of revolution, neo-Hookean, of bilinear elements in the meridian (R, Z) with scikit-fem.

    python3 examples/solvers/axisymmetric/solid.py

The integrals are per radian, with the weight R. The mass is lumped, and velocities are at half steps. b and the start come from the
field; all sides except the axis are at rest. `around=0` leaves out P_tt/R, and sets F_tt = 1: that study must fail.
"""

import sys

import manufactured as mf
import numpy as np
from skfem import Basis, BilinearForm, ElementQuad1, ElementVector, LinearForm, MeshQuad

# Half of the time window.
END = 0.0158
COURANT = 0.15


def at(quantity, x):
    """A quantity of the field at positions of scikit-fem, which has components first."""
    return np.moveaxis(quantity(np.moveaxis(x, 0, -1)), -1, 0)


def run(problem, around=1.0):
    field, n = problem.field, problem.cells
    radius, length, young, nu, rho0 = (field.parameters[it] for it in ("radius", "length", "young", "nu", "rho0"))
    mu, lam = young / (2 * (1 + nu)), young * nu / ((1 + nu) * (1 - 2 * nu))
    mesh = MeshQuad.init_tensor(np.linspace(0, radius, n + 1), np.linspace(0, length, n + 1))
    basis = Basis(mesh, ElementVector(ElementQuad1()), intorder=6)
    on_axis = mesh.facets_satisfying(lambda x: x[0] == 0, boundaries_only=True)
    walls = np.setdiff1d(mesh.boundary_facets(), on_axis)
    held = np.union1d(basis.get_dofs(walls).all(), basis.get_dofs(on_axis).all("u^1"))
    places = basis.default_parameters()["x"]

    def stress(h, hoop):
        """P = mu (F - F^-T) + lambda ln J F^-T in the meridian, and P_tt."""
        f = h + np.eye(2)[:, :, None, None]
        plane, stretch = f[0, 0] * f[1, 1] - f[0, 1] * f[1, 0], 1 + around * hoop
        cofactor = np.array([[f[1, 1], -f[1, 0]], [-f[0, 1], f[0, 0]]])
        pressure = lam * np.log(plane * stretch) - mu
        return mu * f + pressure * cofactor / plane, mu * stretch + pressure / stretch

    @LinearForm
    def force(v, w):
        hoop = around * w.hoop * v.value[0]
        inner = np.einsum("ij...,ij...", w.stress, v.grad)
        return rho0 * np.sum(w.b * v.value, axis=0) * w.x[0] - inner * w.x[0] - hoop

    @BilinearForm
    def mass(u, v, w):
        return rho0 * np.sum(u.value * v.value, axis=0) * w.x[0]

    lumped = np.asarray(mass.assemble(basis).sum(axis=1)).ravel()

    def acceleration(t, u):
        here = basis.interpolate(u)
        of_meridian, hoop = stress(here.grad, here.value[0] / places[0])
        b = at(field.at(t).body_force, places)
        a = force.assemble(basis, stress=of_meridian, hoop=hoop, b=b) / lumped
        a[held] = 0.0
        return a

    begin, speed = field.window[0], np.sqrt((lam + 2 * mu) / rho0)
    steps = int(np.ceil((END - begin) * speed / (COURANT * problem.h)))
    u, v = (np.empty(basis.N) for _ in range(2))
    start, dt = field.at(begin), (END - begin) / steps
    for to, quantity in ((u, start.displacement), (v, start.velocity)):
        for component, dofs in enumerate(basis.split_indices()):
            to[dofs] = at(quantity, basis.doflocs)[component, dofs]
    v += dt / 2 * acceleration(begin, u)
    for step in range(steps):
        u = u + dt * v
        v = v + dt * acceleration(begin + (step + 1) * dt, u)

    moved = np.stack([u[dofs] for dofs in basis.split_indices()], axis=1)
    return problem.results(moved, mesh.p.T, t=END, cells=[("quad", mesh.t.T)])


field, cells = mf.field("axisymmetric_rod"), [4, 8, 16]
right = mf.campaign(field, run, cells=cells, expected_order=2)
lacking = mf.campaign(field, lambda problem: run(problem, around=0.0), cells=cells, expected_order=2)
found = lacking.diagnose()
print(right, lacking, found, sep="\n\n")
if not right.passed or lacking.verdict != "fail" or found.named != "hoop_missing":
    sys.exit("expected a pass, and a failure without the hoop term, which a diagnosis names")
