"""The tangent of a body about a state, by finite elements of scikit-fem, and its least eigenvalue.

Only F comes from mms: the laws are typed here, and their tangents are complex steps.
"""

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import LinearOperator, eigsh, splu
from skfem import (
    Basis,
    BilinearForm,
    ElementHex2,
    ElementQuad2,
    ElementVector,
    MeshHex,
    MeshQuad,
    MeshQuad2,
)

STEP = 1e-30


def neo_hookean(young, nu):
    """P = mu (F - F^-T) + lambda ln J F^-T; the last two axes of F are its indices."""
    lam, mu = young * nu / ((1 + nu) * (1 - 2 * nu)), young / (2 * (1 + nu))

    def stress(f):
        inverse = np.linalg.inv(f).swapaxes(-1, -2)
        return mu * f + (lam * np.log(np.linalg.det(f)) - mu)[..., None, None] * inverse

    return stress


def saint_venant_kirchhoff(young, nu):
    """P = F (lambda tr(E) I + 2 mu E), 2 E = F^T F - I."""
    lam, mu = young * nu / ((1 + nu) * (1 - 2 * nu)), young / (2 * (1 + nu))

    def stress(f):
        strain = (f.swapaxes(-1, -2) @ f - np.eye(f.shape[-1])) / 2
        trace = np.trace(strain, axis1=-2, axis2=-1)[..., None, None]
        return f @ (lam * trace * np.eye(f.shape[-1]) + 2 * mu * strain)

    return stress


def tangent(stress, f):
    """dP_iJ/dF_kL by complex steps: axes i, J, k, L first, the axes of the points last."""
    size, points = f.shape[-1], f.shape[:-2]
    slopes = np.empty((size,) * 4 + points)
    for k in range(size):
        for l in range(size):
            step = np.zeros((size, size), complex)
            step[k, l] = 1j * STEP
            slopes[:, :, k, l] = np.moveaxis(stress(f + step).imag / STEP, (-2, -1), (0, 1))
    return slopes


class Body:
    """A box, or a sector of a ring, of quadratic elements. `held` maps faces to the held components: `all` or `normal`."""

    def __init__(self, lower, upper, cells, held, polar=False):
        ticks = [np.linspace(a, b, n + 1) for a, b, n in zip(lower, upper, cells)]
        self.size = len(ticks)
        if self.size == 3:
            mesh, element = MeshHex.init_tensor(*ticks), ElementHex2()
        else:
            mesh, element = MeshQuad.init_tensor(*ticks), ElementQuad2()
            if polar:
                mesh = MeshQuad2.from_mesh(mesh)
                radius, angle = mesh.doflocs
                mesh = MeshQuad2(radius * np.array([np.cos(angle), np.sin(angle)]), mesh.t)
        self.basis = Basis(mesh, ElementVector(element), intorder=5)
        fixed = set()
        for (axis, end), how in held.items():
            side = [lower, upper][end][axis]
            at = self.basis.get_dofs(lambda x: np.abs(x[axis] - side) < 1e-9)
            names = [f"u^{axis + 1}"] if how == "normal" else None
            fixed |= set(at.all(names).tolist())
        self.free = np.setdiff1d(np.arange(self.basis.N), sorted(fixed))

    def pencil(self, stress, density, gradient):
        """K and M of the free degrees of freedom; `gradient(*X)` is du_i/dX_J."""
        places = self.basis.default_parameters()["x"]
        h = np.array(gradient(*places)) + np.zeros((self.size, self.size) + places[0].shape)
        f = np.moveaxis(h, (0, 1), (-2, -1)) + np.eye(self.size)
        moduli = tangent(stress, f)
        stiff = BilinearForm(
            lambda u, v, w: np.einsum("ijkl...,kl...,ij...", moduli, u.grad, v.grad)
        )
        mass = BilinearForm(lambda u, v, w: density * np.einsum("i...,i...", u, v))
        part = lambda form: form.assemble(self.basis)[self.free][:, self.free].tocsc()
        return part(stiff), part(mass)

    def rigid(self, position):
        """The rigid motions of the deformed body, with x = `position(*X)`; none if something is held."""
        if len(self.free) < self.basis.N:
            return np.zeros((len(self.free), 0))
        x = np.array(position(*self.basis.doflocs))
        columns, axis_of = [], np.empty(self.basis.N, int)
        for axis, dofs in enumerate(self.basis.split_indices()):
            axis_of[dofs] = axis
        for a in range(self.size):
            columns.append((axis_of == a).astype(float))
            for b in range(a):
                columns.append(np.where(axis_of == a, x[b], 0.0) - np.where(axis_of == b, x[a], 0.0))
        return np.array(columns).T


def least(stiffness, mass, apart):
    """The least eigenvalue of K v = w^2 M v on all v that are M-orthogonal to the columns of `apart`."""
    order, kept = mass.shape[0], apart.shape[1]
    # If no eigenvalue is below the shift, the nearest one is the least.
    shift = abs(stiffness).max() / abs(mass).max() * 1e-3
    while negative(stiffness + shift * mass) > 0:
        shift *= 4.0
    border = sparse.csc_matrix(mass @ apart)
    corner = sparse.csc_matrix((kept, kept))
    whole = sparse.bmat([[stiffness + shift * mass, border], [border.T, corner]], "csc")
    factors = splu(whole)

    def inverse(v):
        return factors.solve(np.concatenate([v, np.zeros(kept)]))[:order]

    return eigsh(
        stiffness,
        1,
        mass,
        sigma=-shift,
        v0=inverse(np.sin(np.arange(1.0, order + 1.0))),
        OPinv=LinearOperator((order, order), inverse),
        return_eigenvectors=False,
    )[0]


def negative(matrix):
    """The number of negative eigenvalues of a symmetric matrix, by the signs of its factors (Sylvester 1852)."""
    factors = splu(
        matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True}
    )
    return int(np.sum(factors.U.diagonal() < 0))
