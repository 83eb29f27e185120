"""The shared parts of the three solvers: a square of triangles or quadrilaterals, and Newton's method."""

import numpy as np
from skfem import Basis, FacetBasis, LinearForm, condense, solve
from skfem.helpers import dot


def deformation(h):
    """F = I + H."""
    return np.eye(2)[:, :, None, None] + h


class Square:
    """A mesh of n x n squares, or of twice as many triangles, with the functions of an element, the displacement first. `held`
    has the names of the degrees of freedom that are 0 on sides. Quadrature is exact up to an order.
    """

    def __init__(self, mesh, length, n, element, order, held):
        ticks = np.linspace(0.0, length, n + 1)
        mesh = mesh.init_tensor(ticks, ticks)
        self.order = order
        self.basis = Basis(mesh, element, intorder=order)
        places = {"x_min": (0, 0.0), "x_max": (0, length), "y_min": (1, 0.0), "y_max": (1, length)}
        self.sides = {
            name: mesh.facets_satisfying(lambda x: x[axis] == place) for name, (axis, place) in places.items()
        }
        dofs = [self.basis.get_dofs(self.sides[side]).all(names) for side, names in held.items()]
        self.held = np.concatenate(dofs)

    def at_points(self, quantity, basis=None):
        """A function of X at the points of quadrature; scikit-fem has components first."""
        x = np.moveaxis((basis or self.basis).default_parameters()["x"], 0, -1)
        values = quantity(x)
        return values if values.shape != x.shape else np.moveaxis(values, -1, 0)

    def surface_force(self, field, t=None):
        """The integral of T . v over the sides with tractions."""
        form = LinearForm(lambda v, *others: dot(others[-1].t, v))
        force = 0.0
        for side, claim in field.boundary.items():
            if claim == "traction":
                faces = FacetBasis(self.basis.mesh, self.basis.elem, facets=self.sides[side], intorder=self.order)
                force += form.assemble(faces, t=self.at_points(lambda X: field.traction(side, X, t), faces))
        return force

    def solved(self, equations, x):
        """Solves for a residual of 0 by Newton's method from x; `equations` returns the tangent and the residual."""
        for _ in range(20):
            tangent, residual = equations(x)
            correction = solve(*condense(tangent, residual, D=self.held))
            x = x + correction
            pairs = zip(self.basis.split(correction), self.basis.split(x))
            if all(np.linalg.norm(c) <= 1e-10 * np.linalg.norm(whole) for (c, _), (whole, _) in pairs):
                return x
        raise ArithmeticError("Newton's method does not converge")

    def results(self, problem, u, nodes, t=None, **linear):
        """The displacement at nodes with their cells, and quantities that are linear in each cell, at the same nodes."""
        (u1, part), (u2, _) = nodes.split(u)
        cells, corners = part.element_dofs, self.basis.mesh.t
        at_nodes = {}
        for name, values in linear.items():
            at_nodes[name] = np.empty_like(u1)
            at_nodes[name][cells[:len(corners)]] = values[corners]
            if len(cells) == 6:
                at_nodes[name][cells[3:]] = (values[corners] + values[corners[[1, 2, 0]]]) / 2
        kind = {3: "triangle", 4: "quad", 6: "triangle6"}[len(cells)]
        both = np.stack([u1, u2], axis=1)
        return problem.results(both, part.doflocs.T, t=t, cells=[(kind, cells.T)], **at_nodes)
