"""The material point method in Taichi, total Lagrangian with linear weights, on travelling_wave_2d.

    python3 examples/solvers/taichi/mpm.py

The grid covers the reference body, with 2 x 2 particles of neo-Hookean material in each cell.
Velocities are at half steps. b at the particles, the motion of the sides and the start come from the
field.
"""

import sys

import manufactured as mf
import numpy as np
import taichi as ti

# A quarter of the time window.
END = 0.0158
COURANT = 0.25

ti.init(arch=ti.cpu, default_fp=ti.f64, log_level=ti.ERROR)


@ti.data_oriented
class Body:
    """A square of n x n cells."""

    def __init__(self, n, h, parameters):
        young, nu = parameters["young"], parameters["nu"]
        self.n, self.h = n, h
        self.mu = young / (2.0 * (1.0 + nu))
        self.lam = young * nu / ((1.0 + nu) * (1.0 - 2.0 * nu))
        self.volume, self.rho0 = (self.h / 2.0) ** 2, parameters["rho0"]
        self.X, self.u, self.v = (ti.Vector.field(2, float, 4 * n * n) for _ in range(3))
        self.H = ti.Matrix.field(2, 2, float, 4 * n * n)
        self.mass = ti.field(float, (n + 1, n + 1))
        # Momentum, then velocity; force, then acceleration.
        self.velocity, self.acceleration = (
            ti.Vector.field(2, float, (n + 1, n + 1)) for _ in range(2)
        )

    @ti.func
    def corner(self, p, k):
        """The node, the weight and the weight gradient of the k-th corner of the particle's cell."""
        place = self.X[p] / self.h
        cell = ti.min(ti.floor(place, int), self.n - 1)
        side = ti.Vector([k % 2, k // 2])
        sign = 2.0 * side - 1.0
        part = 1.0 - side + sign * (place - cell)
        return cell + side, part[0] * part[1], ti.Vector([sign[0] * part[1], part[0] * sign[1]]) / self.h

    @ti.kernel
    def gather(self, b: ti.types.ndarray(dtype=ti.math.vec2, ndim=1)):
        """Sums masses, momenta and forces of the particles onto the nodes."""
        for node in ti.grouped(self.mass):
            self.mass[node] = 0.0
            self.velocity[node] = self.acceleration[node] = ti.Vector([0.0, 0.0])
        for p in self.X:
            m = self.rho0 * self.volume
            F = ti.Matrix.identity(float, 2) + self.H[p]
            transpose = F.inverse().transpose()
            P = self.mu * F + (self.lam * ti.log(F.determinant()) - self.mu) * transpose
            for k in ti.static(range(4)):
                node, weight, gradient = self.corner(p, k)
                self.mass[node] += m * weight
                self.velocity[node] += m * weight * self.v[p]
                self.acceleration[node] += m * weight * b[p] - self.volume * (P @ gradient)

    @ti.kernel
    def move(self, dt: float, sides: ti.types.ndarray(dtype=ti.math.vec2, ndim=2)):
        """Updates the nodes; nodes of the sides get prescribed velocities."""
        for node in ti.grouped(self.mass):
            before = self.velocity[node] / self.mass[node]
            self.velocity[node] = before + dt * self.acceleration[node] / self.mass[node]
            if ti.min(node[0], node[1]) == 0 or ti.max(node[0], node[1]) == self.n:
                self.velocity[node] = sides[node]
            self.acceleration[node] = (self.velocity[node] - before) / dt

    @ti.kernel
    def scatter(self, dt: float):
        """Updates the particles from the nodes."""
        for p in self.X:
            for k in ti.static(range(4)):
                node, weight, gradient = self.corner(p, k)
                self.v[p] += dt * weight * self.acceleration[node]
                self.u[p] += dt * weight * self.velocity[node]
                self.H[p] += dt * self.velocity[node].outer_product(gradient)


def run(problem):
    """u of the particles at the end."""
    field, particles = problem.field, problem.X
    body = Body(problem.cells, problem.h, field.parameters)
    ticks = np.arange(body.n + 1) * body.h
    nodes = np.stack(np.meshgrid(ticks, ticks, indexing="ij"), axis=-1)

    begin, speed = problem.window[0], np.sqrt((body.lam + 2.0 * body.mu) / body.rho0)
    steps = int(np.ceil((END - begin) * speed / (COURANT * body.h)))
    dt = (END - begin) / steps
    start = field.at(begin)
    body.X.from_numpy(particles)
    body.u.from_numpy(start.displacement(particles))
    body.v.from_numpy(field.velocity(particles, begin - dt / 2.0))
    body.H.from_numpy(start.displacement_gradient(particles))
    for step in range(steps):
        t = begin + step * dt
        body.gather(field.body_force(particles, t))
        body.move(dt, field.velocity(nodes, t + dt / 2.0))
        body.scatter(dt)
    return problem.results(body.u.to_numpy(), t=END)


verdict = mf.campaign("travelling_wave_2d", run, cells=[8, 16, 32, 64], expected_order=2)
print(verdict)
sys.exit(not verdict.passed)
