"""Bilinear finite elements in NumPy: total Lagrangian, lumped mass, central differences, loads on three sides.

    python3 solid.py CELLS STEPS END FILE

The field, which `mms emit --target numpy` writes, gives b, the tractions and the start; the law is the solver's own.
"""

import sys

import numpy as np
import sheared_block_2d

LAMBDA, MU, DENSITY = 1e6 * 0.3 / (1.3 * 0.4), 1e6 / 2.6, 1000.0
GAUSS = 0.5 + np.array([-1, 1]) / np.sqrt(12)


def stress(F):
    """P of neo-Hookean material, for an array of F."""
    J = np.linalg.det(F)[:, None, None]
    inverse = np.linalg.inv(F).transpose(0, 2, 1)
    return MU * (F - inverse) + LAMBDA * np.log(J) * inverse


def solve(field, cells, steps, end):
    """X and u of the nodes at the end."""
    h, dt, row = 1 / cells, end / steps, cells + 1
    j, i = np.divmod(np.arange(row * row), row)
    X = np.stack([i * h, j * h])
    corner = (np.arange(cells)[:, None] * row + np.arange(cells)).ravel()
    nodes = corner[:, None] + np.array([0, 1, row, row + 1])
    # Weights and their gradients at the Gauss points, and the places of these points.
    points = [(r, s) for r in GAUSS for s in GAUSS]
    weights = [np.array([(1 - r) * (1 - s), r * (1 - s), (1 - r) * s, r * s]) for r, s in points]
    slopes = [
        np.array([[s - 1, r - 1], [1 - s, -r], [-s, 1 - r], [s, r]]) / h for r, s in points
    ]
    places = [X[:, corner] + h * np.array(point)[:, None] for point in points]
    mass = np.zeros(row * row)
    np.add.at(mass, nodes, np.full(nodes.shape, DENSITY * h * h / 4))
    # A side: its nodes from end to end, and its unit normal.
    sides = [
        (np.arange(row) * row, (-1.0, 0.0)),
        (np.arange(row) * row + cells, (1.0, 0.0)),
        (np.arange(row) + cells * row, (0.0, 1.0)),
    ]
    start = field.at_time(0.0)
    u = np.stack(start.displacement(*X), axis=1)
    v = np.stack(start.velocity(*X), axis=1)
    for step in range(steps):
        now = field.at_time(step * dt)
        force = np.zeros_like(u)
        for w, g, place in zip(weights, slopes, places):
            P = stress(np.eye(2) + np.einsum("eni,nk->eik", u[nodes], g))
            b = np.stack(now.body_force(*place), axis=1)
            outer = DENSITY * w[None, :, None] * b[:, None, :]
            np.add.at(force, nodes, (outer - np.einsum("eik,nk->eni", P, g)) * h * h / 4)
        for side, normal in sides:
            for s in GAUSS:
                place = (1 - s) * X[:, side[:-1]] + s * X[:, side[1:]]
                load = np.stack(now.traction(*place, *normal), axis=1) * h / 2
                np.add.at(force, side[:-1], (1 - s) * load)
                np.add.at(force, side[1:], s * load)
        # The first kick is half a step; the base stays at rest.
        v += (dt / 2 if step == 0 else dt) * force / mass[:, None]
        v[:row] = 0
        u += dt * v
    return X.T, u


if __name__ == "__main__":
    cells, steps, end, path = int(sys.argv[1]), int(sys.argv[2]), float(sys.argv[3]), sys.argv[4]
    X, u = solve(sheared_block_2d.prepare(), cells, steps, end)
    np.savez(path, X=X, u=u)
