"""Explicit finite elements in NumPy for any emitted field on a rectangle, with mistakes typed by hand.

Nothing is shared with the solver or the hypotheses of this project but the values of the field: P of H, b, tractions and the exact
motion come from the module that `mms emit --target numpy` writes. Elements are P1 or Q1, on regular or irregular meshes.
"""

import numpy as np

GAUSS = 0.5 / 3**0.5
# The vertices of Q1 and P1 on their reference cells, and their quadratures: points with weights.
QUADRATURES = {
    "q1": [((x, y), 1.0) for x in (-2 * GAUSS, 2 * GAUSS) for y in (-2 * GAUSS, 2 * GAUSS)],
    "p1": [((1 / 6, 1 / 6), 1 / 6), ((2 / 3, 1 / 6), 1 / 6), ((1 / 6, 2 / 3), 1 / 6)],
}


def shape_functions(element, r, s):
    """Values and gradients of the shape functions on the reference cell."""
    if element == "p1":
        return np.array([1 - r - s, r, s]), np.array([[-1.0, 1.0, 0.0], [-1.0, 0.0, 1.0]])
    x, y = np.array([-1, 1, 1, -1]), np.array([-1, -1, 1, 1])
    return (1 + r * x) * (1 + s * y) / 4, np.array([x * (1 + s * y), y * (1 + r * x)]) / 4


def broadcast(values, like):
    return np.array([np.broadcast_to(value, like.shape) for value in values], float)


class Mesh:
    """A rectangle of `cells` along its first edge, its inner nodes moved at random if it is irregular."""

    def __init__(self, field, element, cells, irregular, random):
        self.lower, self.upper = (np.array(it, float) for it in (field.lower(), field.upper()))
        edges = self.upper - self.lower
        counts = [cells, max(2, round(cells * edges[1] / edges[0]))]
        i, j = (it.ravel() for it in np.meshgrid(*(np.arange(n + 1) for n in counts), indexing="ij"))
        self.spacing = edges / counts
        self.x = self.lower[:, None] + np.array([i, j]) * self.spacing[:, None]
        if irregular:
            inner = np.array([(i > 0) & (i < counts[0]), (j > 0) & (j < counts[1])])
            self.x += inner * random.uniform(-0.25, 0.25, self.x.shape) * self.spacing[:, None]
        a, b = (it.ravel() for it in np.meshgrid(*(np.arange(n) for n in counts), indexing="ij"))
        node = lambda a, b: a * (counts[1] + 1) + b
        quads = np.array([node(a, b), node(a + 1, b), node(a + 1, b + 1), node(a, b + 1)])
        triangles = np.concatenate([quads[[0, 1, 2]], quads[[0, 2, 3]]], axis=1)
        self.cells = triangles if element == "p1" else quads
        self.points = []  # values of shape functions, gradients, volumes, X
        for (r, s), weight in QUADRATURES[element]:
            values, slopes = shape_functions(element, r, s)
            jacobian = np.einsum("ak,ikc->aic", slopes, self.x[:, self.cells])
            volume = jacobian[0, 0] * jacobian[1, 1] - jacobian[0, 1] * jacobian[1, 0]
            inverse = np.array([[jacobian[1, 1], -jacobian[0, 1]], [-jacobian[1, 0], jacobian[0, 0]]]) / volume
            gradients = np.einsum("iac,ak->ikc", inverse, slopes)
            place = np.einsum("k,ikc->ic", values, self.x[:, self.cells])
            self.points.append((values, gradients, weight * volume, place))

    def face(self, name):
        """The nodes of a face, in their order along it."""
        axis, bound = "xy".index(name[0]), self.lower if name.endswith("min") else self.upper
        nodes = np.where(np.abs(self.x[axis] - bound[axis]) < 1e-9 * self.spacing[axis])[0]
        return nodes[np.argsort(self.x[1 - axis, nodes])]

    def assembled(self, values):
        """Sums at the nodes of values at the vertices of cells."""
        return np.bincount(self.cells.ravel(), values.ravel(), self.x.shape[1])


def wrong_stress(mistake, size, field, x, h):
    """P of H, with a mistake."""
    law = lambda h: np.array(
        np.broadcast_arrays(*np.ravel(np.array(field.material_first_piola_kirchhoff(*x, *h.reshape(4, -1)), object)))
    ).reshape(2, 2, -1)
    if mistake == "stress_small_strain":
        return law(h * 1e-6) / 1e-6
    p = law(h)
    f = h + np.eye(2)[:, :, None]
    j = f[0, 0] * f[1, 1] - f[0, 1] * f[1, 0]
    inverse = np.array([[f[1, 1], -f[0, 1]], [-f[1, 0], f[0, 0]]]) / j
    match mistake:
        case "stress_transposed":
            return p.transpose(1, 0, 2)
        case "stress_second_piola":
            return np.einsum("ijp,jkp->ikp", inverse, p)
        case "stress_kirchhoff":
            return np.einsum("ijp,kjp->ikp", p, f)
        case "stress_cauchy":
            return np.einsum("ijp,kjp->ikp", p, f) / j
        case "stress_volume":
            return p / j
        case "moduli_factor":
            return p * size
    return p


def wrong_force(mistake, size, field, time, step, x, u):
    """b at X, with a mistake."""
    now = field.at_time(time - size * step if mistake == "force_late" else time)
    b = broadcast(now.body_force(*(x + u if mistake == "force_at_present" else x)), x[0])
    a = broadcast(now.acceleration(*x), x[0])
    match mistake:
        case "force_sign":
            return 2 * a - b
        case "inertia_missing":
            return b - a
        case "force_factor":
            return size * b
        case "constant_force":
            return b + np.array([[0.0], [size * np.abs(b).max()]])
    return b


def solve(field, faces, mesh, end, courant, mistake=None, size=None):
    """u at the nodes at the end by the central-difference method; None where that is not finite."""
    start = float(field.time_window()[0])
    faces = dict(faces)
    if mistake in ("held_face", "free_face"):
        faces[size] = "prescribed" if mistake == "held_face" else "free"
    held = np.zeros(mesh.x.shape, bool)
    for face, claim in faces.items():
        if claim in ("fixed", "prescribed"):
            held[:, mesh.face(face)] = True
        elif claim == "roller":
            held["xy".index(face[0]), mesh.face(face)] = True
    loaded = [face for face, claim in faces.items() if claim == "traction"]
    if mistake == "traction_missing":
        loaded.remove(size)
    factor = size if mistake == "density_factor" else 1.0
    density = [broadcast([field.density(*x)], x[0])[0] * factor for _, _, _, x in mesh.points]
    mass = sum(
        mesh.assembled(values[:, None] * (rho * volume)) for (values, _, volume, _), rho in zip(mesh.points, density)
    )
    speed = max(np.max(field.wave_speed(*x)) for _, _, _, x in mesh.points)
    steps = int(np.ceil((end - start) * speed / (courant * mesh.spacing.min() / 2)))
    step = (end - start) / steps
    first = field.at_time(start)
    u, v = (broadcast(it(*mesh.x), mesh.x[0]) for it in (first.displacement, first.velocity))
    u = 0 * u if mistake == "start_undeformed" else u
    v = 0 * v if mistake == "start_at_rest" else v

    def acceleration(time):
        force = np.zeros(mesh.x.shape)
        for (values, gradients, volume, x), rho in zip(mesh.points, density):
            h = np.einsum("ikc,jkc->ijc", u[:, mesh.cells], gradients)
            p = wrong_stress(mistake, size, field, x, h)
            b = wrong_force(mistake, size, field, time, step, x, np.einsum("k,ikc->ic", values, u[:, mesh.cells]))
            for i in (0, 1):
                inner = np.einsum("jc,jkc->kc", p[i], gradients)
                force[i] += mesh.assembled(volume * (values[:, None] * (rho * b[i]) - inner))
        now = field.at_time(time)
        for face in loaded:
            sign = -1.0 if mistake == "traction_sign" and face == size else 1.0
            normal = [0.0, 0.0]
            normal["xy".index(face[0])] = -1.0 if face.endswith("min") else 1.0
            nodes = mesh.face(face)
            a, b = nodes[:-1], nodes[1:]
            length = np.hypot(*(mesh.x[:, b] - mesh.x[:, a]))
            for part in (0.5 - GAUSS, 0.5 + GAUSS):
                x = mesh.x[:, a] * (1 - part) + mesh.x[:, b] * part
                t = broadcast(now.traction(*x, *(n + 0 * x[0] for n in normal)), x[0])
                for i in (0, 1):
                    np.add.at(force[i], a, sign * t[i] * length / 2 * (1 - part))
                    np.add.at(force[i], b, sign * t[i] * length / 2 * part)
        return np.where(held, broadcast(now.acceleration(*mesh.x), mesh.x[0]), force / mass)

    a = acceleration(start)
    for k in range(1, steps + 1):
        v = v + step / 2 * a
        u = u + step * v
        a = acceleration(start + k * step)
        v = v + step / 2 * a
        if not np.isfinite(u).all():
            return None
    return u
