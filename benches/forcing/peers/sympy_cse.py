"""Writes b of the bench's fields as C, as is usual with SymPy: differentiates the whole
displacement, eliminates common subexpressions, prints. Powers are expanded to products, which are faster
than the powers that SymPy prints. Usage: sympy_cse.py FOLDER."""

import pathlib
import sys

import sympy as sp
from sympy.codegen.rewriting import create_expand_pow_optimization

X, Y, Z, t = sp.symbols("X Y Z t", real=True)
POWERS = create_expand_pow_optimization(8)


def cofactors(F):
    d = F.shape[0]
    if d == 1:
        return sp.eye(1)
    if d == 2:
        return sp.Matrix([[F[1, 1], -F[1, 0]], [-F[0, 1], F[0, 0]]])
    rows = [F.row(i) for i in range(3)]
    return sp.Matrix([rows[(i + 1) % 3].cross(rows[(i + 2) % 3]) for i in range(3)])


def body_force(u, axes, lam, mu, rho0):
    """b = a - Div P / rho0 of the compressible neo-Hookean solid of the slides."""
    d = len(axes)
    F = sp.eye(d) + sp.Matrix(d, d, lambda i, j: sp.diff(u[i], axes[j]))
    # Not with `F.inv()` and `F.det()`, which test expressions for zero and do not end in useful time.
    J = cofactors(F)[0, :].dot(F[0, :])
    inverse = cofactors(F).T / J
    P = lam * sp.log(J) * inverse.T + mu * (F - inverse.T)
    div = [sum(sp.diff(P[i, j], axes[j]) for j in range(d)) for i in range(d)]
    return [sp.diff(u[i], t, 2) - div[i] / rho0 for i in range(d)]


def fields():
    L, E, rho0, amplitude = sp.symbols("length young rho0 amplitude", positive=True)
    A = amplitude * sp.cos(sp.sqrt(E / rho0) * sp.pi * t)
    bar = body_force([X * (2 * L - X) / L**2 * A], [X], 0, E / 2, rho0)
    yield "a", bar, [X], [L, E, rho0, amplitude]

    lam, mu, c, a = sp.symbols("lambda_ mu c amplitude", positive=True)
    phases = [0, 2 * sp.pi / 3, 4 * sp.pi / 3]
    waves = [a * sp.sin(2 * sp.pi * x) * sp.sin(c * sp.pi * t + p) for x, p in zip((X, Y, Z), phases)]
    yield "b", body_force(waves, [X, Y, Z], lam, mu, rho0), [X, Y, Z], [lam, mu, rho0, c, a]

    R = sp.sqrt(X**2 + Y**2)
    angle = sp.sin(sp.pi * t) * (1 - 32 * (R - 1) ** 2 + 256 * (R - 1) ** 4)
    s, k = sp.sin(angle), sp.cos(angle)
    vortex = [X * k - Y * s - X, X * s + Y * k - Y]
    yield "c", body_force(vortex, [X, Y], lam, mu, rho0), [X, Y], [lam, mu, rho0]


def function(b, axes, parameters):
    """A C function of one point."""
    temporaries, results = sp.cse(b, optimizations=[])
    arguments = ", ".join(f"double {name}" for name in [*axes, t, *parameters])
    lines = [f"static inline void body_force({arguments}, double *out) {{"]
    for name, value in temporaries:
        lines.append(f"    double {name} = {sp.ccode(POWERS(value))};")
    for index, value in enumerate(results):
        lines.append(f"    out[{index}] = {sp.ccode(POWERS(value))};")
    return "\n".join([*lines, "}"])


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[1])
    for name, b, axes, parameters in fields():
        columns = ", ".join(f"x[{i}][i]" for i in range(len(axes)))
        values = "".join(f", p[{i}]" for i in range(len(parameters)))
        call = f"body_force({columns}, t{values}, b)"
        text = function(b, axes, parameters)
        text += f"\n#define DIMENSION {len(axes)}\n#define PARAMETERS {len(parameters)}\n#define CALL {call}\n"
        (folder / f"{name}.h").write_text(text)
