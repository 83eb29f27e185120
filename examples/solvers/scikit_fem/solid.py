"""A total-Lagrangian solid of neo-Hookean material in plane strain, discretised with scikit-fem.

The field that verifies it provides the parameters, and functions for b and for tractions.
"""

import numpy as np
from skfem import (
    Basis, BilinearForm, ElementQuad1, ElementQuad2, ElementTriP1, ElementTriP2, ElementVector, FacetBasis,
    LinearForm, MeshQuad, MeshTri, condense, solve,
)

# For each kind of element: its mesh, its functions, its degree, and the name of its cells in meshio.
ELEMENTS = {
    "P1": (MeshTri, ElementTriP1, 1, "triangle"),
    "P2": (MeshTri, ElementTriP2, 2, "triangle6"),
    "Q1": (MeshQuad, ElementQuad1, 1, "quad"),
    "Q2": (MeshQuad, ElementQuad2, 2, "quad9"),
}


def at(quantity, x):
    """A quantity of the field at positions of scikit-fem, which has components first."""
    return np.moveaxis(quantity(np.moveaxis(x, 0, -1)), -1, 0)


def _inverse(f):
    """The inverse of F at every point, and J."""
    j = f[0, 0] * f[1, 1] - f[0, 1] * f[1, 0]
    return np.array([[f[1, 1], -f[0, 1]], [-f[1, 0], f[0, 0]]]) / j, j


def _deformation(h):
    """F = I + H."""
    return h + np.eye(2)[:, :, None, None]


def square(kind, n, length, shift):
    """A mesh of n x n squares, or of twice as many triangles. Its inner nodes are shifted at random, by as much of the
    edge of a square at most as `shift` says.
    """
    mesh, ticks = ELEMENTS[kind][0], np.linspace(0.0, length, n + 1)
    regular = mesh.init_tensor(ticks, ticks)
    x = regular.p.copy()
    inner = np.all((x > 0.0) & (x < length), axis=0)
    x[:, inner] += shift * length / n * np.random.default_rng(n).uniform(-1.0, 1.0, (2, inner.sum()))
    return mesh(x, regular.t)


class Solid:
    """A square of elements of a kind; the motion of the sides `held` is prescribed."""

    def __init__(self, kind, n, parameters, held, shift=0.0):
        length, young, nu = (parameters[it] for it in ("length", "young", "nu"))
        mesh = square(kind, n, length, shift)
        _, functions, degree, self.cell = ELEMENTS[kind]
        element = ElementVector(functions())
        # High enough that the error of quadrature is negligible.
        self.order = 2 * degree + 4
        self.basis = Basis(mesh, element, intorder=self.order)
        places = {"x_min": (0, 0.0), "x_max": (0, length), "y_min": (1, 0.0), "y_max": (1, length)}
        self.sides = {
            name: mesh.facets_satisfying(lambda x: x[axis] == place) for name, (axis, place) in places.items()
        }
        self.held = self.basis.get_dofs(np.concatenate([self.sides[it] for it in held])).all()
        self.mu = young / (2.0 * (1.0 + nu))
        self.lam = young * nu / ((1.0 + nu) * (1.0 - 2.0 * nu))
        self.rho0 = parameters["rho0"]

    def stress(self, h):
        """P = mu (F - F^-T) + lambda ln J F^-T."""
        f = _deformation(h)
        g, j = _inverse(f)
        return self.mu * f + (self.lam * np.log(j) - self.mu) * g.transpose(1, 0, 2, 3)

    def internal_force(self, u):
        """The integral of P : grad v."""
        form = LinearForm(lambda v, w: np.einsum("ij...,ij...", w.stress, v.grad))
        return form.assemble(self.basis, stress=self.stress(self.basis.interpolate(u).grad))

    def tangent(self, u):
        """The derivative of the internal force."""
        g, j = _inverse(_deformation(self.basis.interpolate(u).grad))
        twist = self.mu - self.lam * np.log(j)

        def form(du, v, w):
            gd = np.einsum("ij...,jk...->ik...", w.g, du.grad)
            gv = np.einsum("ij...,jk...->ik...", w.g, v.grad)
            stretch = np.einsum("ij...,ij...", du.grad, v.grad)
            turn = np.einsum("ij...,ji...", gd, gv)
            return self.mu * stretch + w.twist * turn + self.lam * np.trace(gd) * np.trace(gv)

        return BilinearForm(form).assemble(self.basis, g=g, twist=twist)

    def body_force(self, b):
        """The integral of rho0 b . v, with a function b(X)."""
        form = LinearForm(lambda v, w: self.rho0 * np.sum(w.b * v.value, axis=0))
        return form.assemble(self.basis, b=at(b, self.basis.default_parameters()["x"]))

    def surface_force(self, side, traction):
        """The integral of T . v over a side, with a function T(X)."""
        mesh, element = self.basis.mesh, self.basis.elem
        faces = FacetBasis(mesh, element, facets=self.sides[side], intorder=self.order)
        form = LinearForm(lambda v, w: np.sum(w.t * v.value, axis=0))
        return form.assemble(faces, t=at(traction, faces.default_parameters()["x"]))

    def balance(self, force, u):
        """The displacement that balances a force, by Newton's method from u."""
        for _ in range(20):
            residual = force - self.internal_force(u)
            correction = solve(*condense(self.tangent(u), residual, D=self.held))
            u = u + correction
            if np.linalg.norm(correction) <= 1e-11 * np.linalg.norm(u):
                return u
        raise ArithmeticError("Newton's method does not converge")

    def mass(self):
        """The integral of rho0 du . v."""
        form = BilinearForm(lambda du, v, w: self.rho0 * np.sum(du.value * v.value, axis=0))
        return form.assemble(self.basis)

    def interpolated(self, function):
        """The values of a function of X at the nodes."""
        values = at(function, self.basis.doflocs)
        u = np.empty(self.basis.N)
        for component, dofs in enumerate(self.basis.split_indices()):
            u[dofs] = values[component, dofs]
        return u

    def nodes(self, u):
        """The positions, the cells and the vectors of the nodes, a row for each."""
        (u1, part), (u2, _) = self.basis.split(u)
        return part.doflocs.T, [(self.cell, part.element_dofs.T)], np.stack([u1, u2], axis=1)
