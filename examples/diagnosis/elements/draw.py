"""Measures how often `mms diagnose` names the mistakes of an independent solver.

    python3 examples/diagnosis/elements/draw.py MMS SEED WRONG RIGHT >> docs/diagnosis.md

MMS is the command; it gets WRONG cases with a mistake and RIGHT without. Fields, mistakes with their sizes, elements, meshes, times and
time steps are drawn from the seed. A case counts if it does not stop and its error exceeds three times the error of the right run.
Exits 1 if a name is wrong, or if `diagnose` accuses a right run that `mms judge` passes.
"""

import importlib
import json
import os
import subprocess
import sys
import tempfile

import numpy as np

from solver import Mesh, Solver, broadcast, write

FIELDS = [
    "travelling_wave_2d",
    "axis_aligned_2d",
    "plane_strain_mooney_rivlin",
    "quiet_boundary_2d",
    "starting_square_2d",
    "plane_strain_saint_venant_kirchhoff",
    "nearly_incompressible_2d",
    "sheared_block_2d",
]
# The sizes of each mistake; for a mistake on a face, a tuple of the claims of possible faces.
MISTAKES = {
    "force_sign": [None],
    "inertia_missing": [None],
    "force_factor": [0.0, 0.5, 1.1, 2.0, -1.0],
    "force_late": [0.5, 1.0, 2.0, -1.0],
    "force_at_present": [None],
    "constant_force": [0.05, 0.3],
    "stress_transposed": [None],
    "stress_second_piola": [None],
    "stress_kirchhoff": [None],
    "stress_cauchy": [None],
    "stress_volume": [None],
    "stress_small_strain": [None],
    "moduli_factor": [0.5, 0.9, 1.05, 1.3, 1.54],
    "density_factor": [0.5, 0.9, 1.05, 1.3, 1.54],
    "start_at_rest": [None],
    "start_undeformed": [None],
    "free_face": ("fixed", "prescribed", "roller"),
    "held_face": ("free", "traction"),
    "traction_missing": ("traction",),
    "traction_sign": ("traction",),
}
# Other names that count as right: names of sizes, and names with the same formula for b per mass inside a body.
SAME = {
    "force_factor": {"force_missing", "force_half", "force_twice", "force_reversed"},
    "force_late": {"force_early"},
    "moduli_factor": {"density_factor"},
    "density_factor": {"moduli_factor"},
    "force_sign": {"moduli_factor", "density_factor"},
    "traction_missing": {"traction_factor"},
    "traction_sign": {"traction_factor"},
}
MESHES = [(8, 16), (12, 24), (16,)]
LARGE = 3.0  # times the error of the right run


class Case:
    """A drawn case without its mistake."""

    def __init__(self, command, random):
        self.name = FIELDS[random.integers(len(FIELDS))]
        self.field, self.faces = load(command, self.name)
        self.element = ["p1", "q1"][random.integers(2)]
        self.irregular = bool(random.integers(2))
        self.cells = MESHES[random.integers(len(MESHES))]
        start, end = (float(it) for it in self.field.time_window())
        self.end = start + random.uniform(0.08, 0.4) * (end - start)
        self.courant = random.uniform(0.3, 0.8)
        self.meshes = [Mesh(self.field, self.element, n, self.irregular, random) for n in self.cells]

    def solved(self, mistake, size):
        """u on each mesh; None if a run stops."""
        solvers = [Solver(self.field, self.faces, mesh, mistake, size) for mesh in self.meshes]
        runs = [solver.until(self.end, self.courant) for solver in solvers]
        return None if any(u is None for u in runs) else runs

    def error(self, u):
        mesh = self.meshes[-1]
        exact = broadcast(self.field.at_time(self.end).displacement(*mesh.x), mesh.x[0])
        return np.sqrt(np.mean((u[-1] - exact) ** 2))

    def diagnosed(self, command, u):
        """The command's diagnosis of the results."""
        with tempfile.TemporaryDirectory() as folder:
            paths = [os.path.join(folder, f"{n}.csv") for n in self.cells]
            for path, mesh, values in zip(paths, self.meshes, u):
                write(path, mesh, self.end, values)
            sizes = ",".join(repr(float(mesh.spacing[0])) for mesh in self.meshes)
            words = [command, "diagnose", self.name, *paths, "--h", sizes, "--json"]
            return json.loads(subprocess.run(words, capture_output=True, text=True).stdout)

    def told(self):
        irregular = ", irregular" if self.irregular else ""
        return f"`{self.name}` ({self.element.upper()}{irregular}, {' and '.join(map(str, self.cells))} cells)"


def load(command, name):
    """The emitted module of a field, and its claims about faces."""
    if name not in load.known:
        subprocess.run([command, "emit", name, "--target", "numpy", "-o", load.folder], check=True, capture_output=True)
        fields = json.loads(subprocess.run([command, "list", "--json"], capture_output=True, text=True).stdout)
        faces = next(it["boundary"] for it in fields["fields"] if it["name"] == name)
        module = importlib.import_module(name)
        load.known[name] = module.prepare(module.Parameters()), faces
    return load.known[name]


def drawn_mistake(case, random):
    """A mistake with its size, or None if the field has no such face."""
    names = list(MISTAKES)
    mistake = names[random.integers(len(names))]
    sizes = MISTAKES[mistake]
    if isinstance(sizes, tuple):
        sizes = [face for face, claim in case.faces.items() if claim in sizes]
    return (mistake, sizes[random.integers(len(sizes))]) if sizes else None


def outcome(answer, mistake):
    if answer["finding"] != "named":
        return answer["finding"]
    best = answer["ranked"][0]
    names = [best["hypothesis"], *best["equivalent_always"], *best["equivalent_here"]]
    right = {mistake} | SAME.get(mistake, set())
    return "right" if any(name.split(" ")[0] in right for name in names) else "wrong"


def wilson(count, every):
    """The count, with the 95 % interval of its share in percent."""
    z, share = 1.96, count / every
    middle, width = share + z * z / (2 * every), z * np.sqrt(share * (1 - share) / every + (z / (2 * every)) ** 2)
    low, high = (100 * (middle + sign * width) / (1 + z * z / every) for sign in (-1, 1))
    return f"{count} ({max(low, 0):.0f} to {high:.0f} %)"


def main():
    command, seed, wrong, right = sys.argv[1], *map(int, sys.argv[2:])
    command = os.path.abspath(command)
    random = np.random.default_rng(seed)
    kinds = ["right", "wrong", "unexplained", "nothing"]
    tally = {"mistake": dict.fromkeys(kinds, 0), "right": dict.fromkeys(kinds, 0)}
    missed, accused, coarse = [], 0, 0
    with tempfile.TemporaryDirectory() as folder:
        load.folder, load.known = folder, {}
        sys.path.insert(0, folder)
        while sum(tally["mistake"].values()) < wrong or sum(tally["right"].values()) < right:
            case = Case(command, random)
            exact = case.solved(None, None)
            if exact is None:
                continue
            if sum(tally["right"].values()) < right:
                answer = case.diagnosed(command, exact)
                found, order = outcome(answer, None), answer["order"]
                tally["right"][found] += 1
                if order and order["verdict"] != "pass":
                    coarse += 1
                elif found != "nothing":
                    missed.append((case.told(), "none", found))
                    accused += 1
            mistake = drawn_mistake(case, random)
            if mistake is None or sum(tally["mistake"].values()) == wrong:
                continue
            u = case.solved(*mistake)
            if u is None or case.error(u) <= LARGE * case.error(exact):
                continue
            answer = case.diagnosed(command, u)
            found = outcome(answer, mistake[0])
            tally["mistake"][found] += 1
            told = " ".join(str(it) for it in mistake if it is not None)
            print(found, case.told(), told, file=sys.stderr, flush=True)
            if found != "right":
                best = answer["ranked"][0]["hypothesis"]
                missed.append((case.told(), told, f"{found}: {best}" if found == "wrong" else found))
    print("\n## By an independent solver\n")
    print("The solver is explicit finite elements in NumPy (`examples/diagnosis/elements`), P1 and Q1, on regular and irregular meshes, with")
    print("mistakes typed by hand. It writes u at one time, on one mesh or two. Cases are drawn as above, after the last change of the hypotheses.\n")
    print(f"Seed {seed}.\n\n| set | cases | named right | named wrong | unexplained | nothing |\n|---|---|---|---|---|---|")
    for name, of in tally.items():
        every = sum(of.values())
        print(f"| {name} | {every} | {' | '.join(wilson(of[kind], every) for kind in kinds)} |")
    print(f"\n`mms judge` does not pass {coarse} of the right runs, whose meshes are too coarse to show the order; `diagnose` is never milder, and calls")
    print(f"these `unexplained`. Among the other right runs, `diagnose` accuses {accused}.")
    print("\nNot named rightly:\n\n| case | mistake | found |\n|---|---|---|")
    for row in missed:
        print(f"| {' | '.join(row)} |")
    return any(of["wrong"] for of in tally.values()) or accused > 0


if __name__ == "__main__":
    sys.exit(main())
