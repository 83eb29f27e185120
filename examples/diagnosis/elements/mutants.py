"""Measures whether the ladder of `mms diagnose` finds the stage of a solver in which an operator was changed.

    python3 examples/diagnosis/elements/mutants.py MMS [EVERY] >> docs/diagnosis.md

Each mutant is solver.py with one operator, operand, sign, order of axes or statement changed, by rule and not by choice; the changed
function determines its stage. MMS, the command, gets the input that a user would give it: a table of F and P; forces at nodes at an
exact state, with all terms and without one; then results of two meshes. A mutant counts if it runs and its error exceeds three times
the error of the right solver. With EVERY, every EVERY-th mutant is tried. Exits 1 if fewer than 80 % of the stages are right.
"""

import ast
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import types

import numpy as np

import solver
from draw import LARGE, load, wilson

FIELD = "sheared_block_2d"
LAW = '''
def law(young, nu, h):
    """P of H for the neo-Hookean solid of the field."""
    lam, mu = young * nu / ((1 + nu) * (1 - 2 * nu)), young / (2 * (1 + nu))
    f = h + np.eye(2)[:, :, None]
    j = f[0, 0] * f[1, 1] - f[0, 1] * f[1, 0]
    cofactor = np.array([[f[1, 1], -f[1, 0]], [-f[0, 1], f[0, 0]]])
    return mu * (f - cofactor / j) + lam * np.log(j) * cofactor / j
'''
# The stage of each function.
STAGES = {
    "law": "law",
    "gradient": "kinematics",
    "internal": "kinematics",
    "external": "force",
    "masses": "mass",
    "tractions": "boundary",
    "held_nodes": "boundary",
    "start": "start",
    "until": "time",
    "write": "output",
}
# The stage at fault, by the term without which the balance is right, and by the named change of results if the balance is right.
OF_TERM = {"stress": "kinematics", "body_force": "force", "traction": "boundary"}
OF_CHANGE = {
    "start": "start",
    "boundary condition": "boundary",
    "prescribed motion": "boundary",
    "output": "output",
}
SWAPPED = {ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult}
MESHES = (8, 16)
COURANT = 0.5
TIME = 0.3  # of the window


def changes(node):
    """The changes of a node: a name for each, and the new node."""
    match node:
        case ast.BinOp(left, op, right) if type(op) in SWAPPED:
            yield "operator", ast.BinOp(left, SWAPPED[type(op)](), right)
            yield "second operand left out", left
            if not isinstance(op, (ast.Sub, ast.Div)):
                yield "first operand left out", right
        case ast.UnaryOp(ast.USub(), operand):
            yield "sign", operand
        case ast.AugAssign(target, op, value):
            yield "sign", ast.AugAssign(target, SWAPPED[type(op)](), value)
            yield "statement left out", ast.Pass()
        case ast.Constant(str(text)) if "->" in text:
            inputs, output = text.split("->")
            yield "axes", ast.Constant(f"{inputs}->{output[1] + output[0] + output[2:]}")
        case ast.Constant(0 | 1) if type(node.value) is int:
            yield "component", ast.Constant(1 - node.value)


def mutants(source):
    """The stage of each mutant, its change and line, and its source."""
    places = [
        (function.name, at, change)
        for function in ast.walk(ast.parse(source))
        if isinstance(function, ast.FunctionDef) and function.name in STAGES
        for at, node in enumerate(ast.walk(function))
        for change in range(len(list(changes(node))))
    ]
    for name, at, change in places:
        tree = ast.parse(source)
        function = next(it for it in ast.walk(tree) if isinstance(it, ast.FunctionDef) and it.name == name)
        old = list(ast.walk(function))[at]
        what, new = list(changes(old))[change]
        line = source.split("\n")[old.lineno - 1].strip()
        ast.copy_location(new, old)
        for parent in ast.walk(function):
            for key, value in ast.iter_fields(parent):
                if value is old:
                    setattr(parent, key, new)
                elif isinstance(value, list):
                    setattr(parent, key, [new if it is old else it for it in value])
        yield STAGES[name], f"{what}: `{line}`", ast.unparse(ast.fix_missing_locations(tree))


class Trial:
    """A solver, with its results on the field."""

    def __init__(self, command, folder, source):
        self.command, self.folder = command, folder
        self.field, self.faces = load(command, FIELD)
        self.module = types.ModuleType("mutant")
        exec(compile(source, "mutant", "exec"), self.module.__dict__)
        first, last = (float(it) for it in self.field.time_window())
        self.time = first + TIME * (last - first)
        random = np.random.default_rng(1)
        self.meshes = [solver.Mesh(self.field, "q1", cells, True, random) for cells in MESHES]
        self.spacings = [float(mesh.spacing[0]) for mesh in self.meshes]

    def solver(self, mesh, without=()):
        young, nu = 1e6, 0.3
        law = lambda x, h: self.module.law(young, nu, h)
        return self.module.Solver(self.field, self.faces, mesh, law=law, without=without)

    def exact(self, mesh, quantity):
        return solver.broadcast(getattr(self.field.at_time(self.time), quantity)(*mesh.x), mesh.x[0])

    def results(self):
        """The written file of the finest mesh, or None if a run stops; writes u of both meshes."""
        runs = []
        for mesh, spacing in zip(self.meshes, self.spacings):
            u = self.solver(mesh).until(self.time, COURANT)
            if u is None or u.shape != mesh.x.shape:
                return None
            self.module.write(self.path(spacing), mesh, self.time, u)
            runs.append(u)
        written = np.loadtxt(self.path(self.spacings[-1]), delimiter=",", skiprows=1)
        return written.T if np.isfinite(written).all() else None

    def error(self):
        """The error of the written u of the finest mesh."""
        written = self.results()
        if written is None:
            return None
        return np.sqrt(np.mean((written[3:5] - self.exact(self.meshes[-1], "displacement")) ** 2))

    def path(self, name):
        return os.path.join(self.folder, f"{name}.csv")

    def diagnosed(self, files, *options):
        words = [self.command, "diagnose", FIELD, *files, "--json", *options]
        run = subprocess.run(words, capture_output=True, text=True)
        if not run.stdout:
            sys.exit(run.stderr)
        return json.loads(run.stdout)

    def law_is_right(self):
        h = np.random.default_rng(2).uniform(-0.2, 0.2, (2, 2, 20))
        p, f = np.broadcast_to(self.module.law(1e6, 0.3, h), h.shape), h + np.eye(2)[:, :, None]
        if not np.isfinite(p).all():
            return False
        rows = np.concatenate([f.reshape(4, -1), p.reshape(4, -1)]).T
        np.savetxt(self.path("law"), rows, delimiter=",", header="F11,F12,F21,F22,P11,P12,P21,P22", comments="", fmt="%.17g")
        return self.diagnosed([self.path("law")], "--quantity", "stress")["finding"] == "nothing"

    def balance_is_right(self, without=()):
        """Whether the forces at nodes are right at the exact state."""
        files = []
        for mesh, spacing in zip(self.meshes, self.spacings):
            tried = self.solver(mesh, without)
            forces = tried.forces(self.time, self.exact(mesh, "displacement"))
            residual = tried.mass * self.exact(mesh, "acceleration") - forces
            if not np.isfinite(residual).all():
                return False
            rows = np.column_stack([np.full(mesh.x.shape[1], self.time), *mesh.x, *residual])
            files.append(self.path(f"exact_{spacing}"))
            np.savetxt(files[-1], rows, delimiter=",", header="time,X,Y,rx,ry", comments="", fmt="%.17g")
        options = [word for term in without for word in ("--without", term)]
        return self.diagnosed(files, "--residual", "nodal", *options)["finding"] == "nothing"

    def stage(self):
        """The stage that the answers point to."""
        if not self.law_is_right():
            return "law"
        if not self.balance_is_right():
            return next((stage for term, stage in OF_TERM.items() if self.balance_is_right([term])), "mass")
        # The largest error is in a corner, and falls with 1.57 from mesh to mesh.
        options = ["--h", ",".join(map(repr, self.spacings)), "--expected-order", "2,linf=1.5"]
        answer = self.diagnosed(map(self.path, self.spacings), *options)
        if answer["finding"] == "nothing":
            return "none"
        name = answer["ranked"][0]["hypothesis"] if answer["finding"] == "named" else None
        # The balance is right, and no other hypothesis explains the error.
        return OF_CHANGE.get(self.changes().get(name), "time")

    def changes(self):
        """The part of the solution that each hypothesis changes."""
        run = subprocess.run([self.command, "diagnose", FIELD, "--list", "--json"], capture_output=True, text=True)
        return {it["hypothesis"]: it["changes"] for it in json.loads(run.stdout)["hypotheses"]}


def main():
    command, every = os.path.abspath(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 1
    source = pathlib.Path(solver.__file__).read_text() + LAW
    found, missed, silent = {}, [], 0
    with tempfile.TemporaryDirectory() as folder, np.errstate(all="ignore"):
        load.folder, load.known = folder, {}
        sys.path.insert(0, folder)
        right = Trial(command, folder, source)
        least = LARGE * right.error()
        assert right.stage() == "none", right.stage()
        for stage, what, text in list(mutants(source))[::every]:
            try:
                mutant = Trial(command, folder, text)
                error = mutant.error()
            except (ArithmeticError, AttributeError, IndexError, OverflowError, TypeError, ValueError):
                error = None
            if error is None or not error > least:
                silent += 1
                continue
            said = mutant.stage()
            of = found.setdefault(stage, [0, 0])
            of[0] += said == stage
            of[1] += 1
            print(stage, said, what, file=sys.stderr, flush=True)
            if said != stage:
                missed.append((stage, said, what))
    print("\n## Operators of a solver\n")
    print("Each mutant is the independent solver with one operator, operand, sign, order of axes or statement changed by")
    print(f"rule (`examples/diagnosis/elements/mutants.py`), on `{FIELD}`, whose law is typed by hand. The changed function")
    print("determines the stage of the mutant. `mms diagnose` gets a table of stresses, then forces at nodes at an exact state, with")
    print("all terms and without one, then results of two meshes. The first of these tests that shows an error determines the stage at")
    print("fault; if the balance is wrong, the stage is the term without which it is right.")
    print(f"{silent} mutants are not counted: they stop, or their error is at most three times the error of the right solver.")
    print("\n| stage | mutants | stage right |\n|---|---|---|")
    for stage, (hits, count) in found.items():
        print(f"| {stage} | {count} | {hits} |")
    hits, count = (sum(of[k] for of in found.values()) for k in (0, 1))
    print(f"| all | {count} | {wilson(hits, count)} |")
    print("\n| stage | answer | change |\n|---|---|---|")
    for row in missed:
        print(f"| {' | '.join(row)} |")
    return hits < 0.8 * count


if __name__ == "__main__":
    sys.exit(main())
