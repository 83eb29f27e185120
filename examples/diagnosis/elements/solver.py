"""Explicit finite elements in NumPy for any emitted field on a rectangle, with mistakes typed by hand.

The solver shares only the values of the field with this project: P of H, b, tractions and the exact
motion come from the module that `mms emit --target numpy` writes. Elements are P1 or Q1, on regular or irregular meshes.
"""

import numpy as np

GAUSS = 0.5 / 3**0.5
# The quadratures of Q1 and P1 on their reference cells: points with weights.
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
        """Sums values at the vertices of cells into the nodes."""
        return np.bincount(self.cells.ravel(), values.ravel(), self.x.shape[1])


def wrong_stress(mistake, size, law, x, h):
    """P of H, with a mistake."""
    if mistake == "stress_small_strain":
        return law(x, h * 1e-6) / 1e-6
    p = law(x, h)
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


class Solver:
    """The balance of momentum on a mesh. `law` computes P from X and H, `without` names the terms to leave out."""

    def __init__(self, field, faces, mesh, mistake=None, size=None, law=None, without=()):
        self.field, self.faces, self.mesh = field, dict(faces), mesh
        self.mistake, self.size, self.without = mistake, size, without
        self.law = law or self.law_of_field
        self.step = 0.0
        if mistake in ("held_face", "free_face"):
            self.faces[size] = "prescribed" if mistake == "held_face" else "free"
        self.held = self.held_nodes()
        self.density, self.mass = self.masses()

    def law_of_field(self, x, h):
        components = self.field.material_first_piola_kirchhoff(*x, *h.reshape(4, -1))
        return np.array(np.broadcast_arrays(*np.ravel(np.array(components, object)))).reshape(2, 2, -1)

    def held_nodes(self):
        """A mask of the nodal components that follow the field."""
        held = np.zeros(self.mesh.x.shape, bool)
        for face, claim in self.faces.items():
            if claim in ("fixed", "prescribed"):
                held[:, self.mesh.face(face)] = True
            elif claim == "roller":
                held["xy".index(face[0]), self.mesh.face(face)] = True
        return held

    def masses(self):
        """The density at each quadrature point, and the nodal masses."""
        mesh, factor = self.mesh, self.size if self.mistake == "density_factor" else 1.0
        density = [broadcast([self.field.density(*x)], x[0])[0] * factor for _, _, _, x in mesh.points]
        parts = zip(mesh.points, density)
        return density, sum(mesh.assembled(values[:, None] * (rho * volume)) for (values, _, volume, _), rho in parts)

    def gradient(self, u, gradients):
        """H in each cell."""
        return np.einsum("ikc,jkc->ijc", u[:, self.mesh.cells], gradients)

    def internal(self, force, p, gradients, volume):
        """Adds the internal forces."""
        for i in (0, 1):
            force[i] -= self.mesh.assembled(volume * np.einsum("jc,jkc->kc", p[i], gradients))

    def external(self, force, b, values, rho, volume):
        """Adds the body forces."""
        for i in (0, 1):
            force[i] += self.mesh.assembled(values[:, None] * (volume * rho * b[i]))

    def tractions(self, force, now, face):
        """Adds the loads of a face, by two points along each edge."""
        sign = -1.0 if self.mistake == "traction_sign" and face == self.size else 1.0
        normal = [0.0, 0.0]
        normal["xy".index(face[0])] = -1.0 if face.endswith("min") else 1.0
        nodes, place = self.mesh.face(face), self.mesh.x
        a, b = nodes[:-1], nodes[1:]
        length = np.hypot(*(place[:, b] - place[:, a]))
        for part in (0.5 - GAUSS, 0.5 + GAUSS):
            x = place[:, a] * (1 - part) + place[:, b] * part
            t = broadcast(now.traction(*x, *(n + 0 * x[0] for n in normal)), x[0])
            for i in (0, 1):
                np.add.at(force[i], a, sign * t[i] * length / 2 * (1 - part))
                np.add.at(force[i], b, sign * t[i] * length / 2 * part)

    def forces(self, time, u):
        """All forces at nodes."""
        force = np.zeros(self.mesh.x.shape)
        for (values, gradients, volume, x), rho in zip(self.mesh.points, self.density):
            if "stress" not in self.without:
                h = self.gradient(u, gradients)
                self.internal(force, wrong_stress(self.mistake, self.size, self.law, x, h), gradients, volume)
            if "body_force" not in self.without:
                moved = np.einsum("k,ikc->ic", values, u[:, self.mesh.cells])
                b = wrong_force(self.mistake, self.size, self.field, time, self.step, x, moved)
                self.external(force, b, values, rho, volume)
        loaded = [face for face, claim in self.faces.items() if claim == "traction" and "traction" not in self.without]
        for face in loaded:
            if (self.mistake, self.size) != ("traction_missing", face):
                self.tractions(force, self.field.at_time(time), face)
        return force

    def acceleration(self, time, u):
        """The accelerations of nodes; held components follow the field."""
        exact = broadcast(self.field.at_time(time).acceleration(*self.mesh.x), self.mesh.x[0])
        return np.where(self.held, exact, self.forces(time, u) / self.mass)

    def start(self, time):
        """u and v at the start."""
        now = self.field.at_time(time)
        u, v = (broadcast(it(*self.mesh.x), self.mesh.x[0]) for it in (now.displacement, now.velocity))
        return u * (self.mistake != "start_undeformed"), v * (self.mistake != "start_at_rest")

    def until(self, end, courant):
        """u at the end by the central-difference method; None if it is not finite."""
        first = float(self.field.time_window()[0])
        speed = max(np.max(self.field.wave_speed(*x)) for _, _, _, x in self.mesh.points)
        steps = int(np.ceil((end - first) * speed / (courant * self.mesh.spacing.min() / 2)))
        self.step = step = (end - first) / steps
        u, v = self.start(first)
        a = self.acceleration(first, u)
        for k in range(1, steps + 1):
            v = v + step / 2 * a
            u = u + step * v
            a = self.acceleration(first + k * step, u)
            v = v + step / 2 * a
            if not np.isfinite(u).all():
                return None
        return u


def write(path, mesh, time, u):
    """Writes u at the nodes at a time."""
    rows = np.column_stack([np.full(mesh.x.shape[1], time), *mesh.x, *u])
    np.savetxt(path, rows, delimiter=",", header="time,X,Y,ux,uy", comments="", fmt="%.17g")
