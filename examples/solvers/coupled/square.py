"""The parts that the three solvers share: a square of triangles, Newton's method, and the file of results."""

import importlib

import meshio
import numpy as np
from skfem import Basis, FacetBasis, LinearForm, condense, solve
from skfem.helpers import dot


def prepared(name, study):
    """The parameters of a field; the field; and the same with that parameter 0 which the study is without, if it is one of
    `without PARAMETER`. Sources are linear in it, so that those of the second lack its term and no other.
    """
    module = importlib.import_module(name)
    left_out = study.partition("@")[0].partition("without ")[2]
    parameters = module.Parameters()
    lacking = module.Parameters(**({left_out: 0.0} if left_out else {}))
    return parameters, module.prepare(parameters), module.prepare(lacking)


def deformation(h):
    """F = I + H."""
    return np.eye(2)[:, :, None, None] + h


class Square:
    """A square of n x n squares, or of twice as many triangles, with the functions of an element, the displacement first. `held`
    has the axis, the place on it and the names of the degrees of freedom that are 0 there. Quadrature is exact up to an order.
    """

    def __init__(self, mesh, length, n, element, order, held):
        ticks = np.linspace(0.0, length, n + 1)
        mesh = mesh.init_tensor(ticks, ticks)
        self.order = order
        self.basis = Basis(mesh, element, intorder=order)
        self.x = self.basis.default_parameters()["x"]
        sides = [mesh.facets_satisfying(lambda x: x[axis] == at, boundaries_only=True) for axis, at, _ in held]
        names = [it[2] for it in held]
        self.held = np.concatenate([self.basis.get_dofs(s).all(n) for s, n in zip(sides, names)])
        self.loaded = np.setdiff1d(mesh.boundary_facets(), np.concatenate(sides))

    def surface_force(self, traction):
        """The integral of T . v over the sides that are not held, of a function of x and N."""
        faces = FacetBasis(self.basis.mesh, self.basis.elem, facets=self.loaded, intorder=self.order)
        at = faces.default_parameters()
        form = LinearForm(lambda v, *others: dot(others[-1].t, v))
        return form.assemble(faces, t=traction(*at["x"], *at["n"]))

    def solved(self, equations, x):
        """Where the residual of equations is 0, by Newton's method from x; they give the tangent and the residual."""
        for _ in range(20):
            tangent, residual = equations(x)
            correction = solve(*condense(tangent, residual, D=self.held))
            x = x + correction
            pairs = zip(self.basis.split(correction), self.basis.split(x))
            if all(np.linalg.norm(c) <= 1e-10 * np.linalg.norm(whole) for (c, _), (whole, _) in pairs):
                return x
        raise ArithmeticError("Newton's method does not converge")

    def write(self, path, u, nodes, **linear):
        """Nodes and cells of a displacement, and what is linear in each cell, at the same nodes."""
        (u1, part), (u2, _) = nodes.split(u)
        cells, corners = part.element_dofs, self.basis.mesh.t
        data = {"displacement": np.array([u1, u2, 0.0 * u1]).T}
        for name, values in linear.items():
            data[name] = np.empty_like(u1)
            data[name][cells[:len(corners)]] = values[corners]
            if len(cells) == 6:
                data[name][cells[3:]] = (values[corners] + values[corners[[1, 2, 0]]]) / 2
        kind = {3: "triangle", 4: "quad", 6: "triangle6"}[len(cells)]
        points = np.pad(part.doflocs, ((0, 1), (0, 0)))
        meshio.Mesh(points.T, [(kind, cells.T)], point_data=data).write(path)
