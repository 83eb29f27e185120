"""A total-Lagrangian solid of revolution, neo-Hookean, of bilinear elements in the meridian (R, Z) with scikit-fem.

    mms emit axisymmetric_rod --target numpy -o FOLDER
    PYTHONPATH=FOLDER python3 examples/solvers/axisymmetric/solid.py CELLS STEPS END FILE ["without hoop"]

The integrals are per radian, with the weight R. The mass is lumped, and velocities are half a step off. Of the field it takes b, the
start, and that all sides but the axis are at rest. `without hoop` leaves out P_tt/R, and takes F_tt = 1.
"""

import sys

import numpy as np
from axisymmetric_rod import Parameters, prepare
from skfem import Basis, BilinearForm, ElementQuad1, ElementVector, LinearForm, MeshQuad


def main(cells, steps, end, path, name="right"):
    p, n, steps, end = Parameters(), int(cells), int(steps), float(end)
    around = 0.0 if name == "without hoop" else 1.0
    mu, lam = p.young / (2 * (1 + p.nu)), p.young * p.nu / ((1 + p.nu) * (1 - 2 * p.nu))
    mesh = MeshQuad.init_tensor(np.linspace(0, p.radius, n + 1), np.linspace(0, p.length, n + 1))
    basis = Basis(mesh, ElementVector(ElementQuad1()), intorder=6)
    on_axis = mesh.facets_satisfying(lambda x: x[0] < 1e-9 * p.radius, boundaries_only=True)
    walls = np.setdiff1d(mesh.boundary_facets(), on_axis)
    held = np.union1d(basis.get_dofs(walls).all(), basis.get_dofs(on_axis).all("u^1"))
    radius, places = basis.default_parameters()["x"][0], basis.default_parameters()["x"]
    field = prepare(p)

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
        return p.rho0 * np.sum(w.b * v.value, axis=0) * w.x[0] - inner * w.x[0] - hoop

    @BilinearForm
    def mass(u, v, w):
        return p.rho0 * np.sum(u.value * v.value, axis=0) * w.x[0]

    lumped = np.asarray(mass.assemble(basis).sum(axis=1)).ravel()

    def acceleration(t, u):
        here = basis.interpolate(u)
        of_meridian, hoop = stress(here.grad, here.value[0] / radius)
        b = np.array(field.at_time(t).body_force(*places))
        a = force.assemble(basis, stress=of_meridian, hoop=hoop, b=b) / lumped
        a[held] = 0.0
        return a

    begin = field.time_window()[0]
    u, v = (np.empty(basis.N) for _ in range(2))
    start, dt = field.at_time(begin), (end - begin) / steps
    for to, values in ((u, start.displacement), (v, start.velocity)):
        for component, dofs in enumerate(basis.split_indices()):
            to[dofs] = np.array(values(*basis.doflocs))[component, dofs]
    v += dt / 2 * acceleration(begin, u)
    for step in range(steps):
        u = u + dt * v
        v = v + dt * acceleration(begin + (step + 1) * dt, u)

    moved = np.array([u[dofs] for dofs in basis.split_indices()] + [np.zeros(mesh.nvertices)])
    corners = np.vstack([np.full(mesh.nelements, 4), mesh.t]).T
    with open(path, "w") as file:
        print("# vtk DataFile Version 3.0\nrod\nASCII\nDATASET UNSTRUCTURED_GRID", file=file)
        print(f"POINTS {mesh.nvertices} double", file=file)
        np.savetxt(file, np.vstack([mesh.p, np.zeros(mesh.nvertices)]).T, fmt="%.17g")
        print(f"CELLS {mesh.nelements} {corners.size}", file=file)
        np.savetxt(file, corners, fmt="%d")
        print(f"CELL_TYPES {mesh.nelements}", file=file)
        np.savetxt(file, np.full(mesh.nelements, 9), fmt="%d")
        print(f"POINT_DATA {mesh.nvertices}\nVECTORS displacement double", file=file)
        np.savetxt(file, moved.T, fmt="%.17g")


main(*sys.argv[1:])
