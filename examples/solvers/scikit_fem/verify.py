"""Verifies the solid at rest, under tractions, and in motion, each with P1 and P2. Exits 1 unless each has its order."""

import sys

import dynamic
import manufactured as mf
import static

CANTILEVER = mf.load("cantilever_2d.toml")
WAVE = mf.field("travelling_wave_2d")
# A quarter of a period: a wave crosses more than half of the block.
END = 0.0158


def at_rest(kind):
    def solve(problem):
        solid, u = static.run(problem.field, kind, problem.cells)
        points, cells, u = solid.nodes(u)
        return problem.results(u, points, cells=cells)

    return solve


def in_motion(kind):
    def solve(problem):
        solid, (u, _, _) = dynamic.run(problem.field, kind, problem.cells, END)
        points, cells, u = solid.nodes(u)
        return problem.results(u, points, t=END, cells=cells)

    return solve


STUDIES = [
    ("static P1", CANTILEVER, at_rest("P1"), [8, 16, 32], 2),
    ("static P2", CANTILEVER, at_rest("P2"), [4, 8, 16], 3),
    ("dynamic P1", WAVE, in_motion("P1"), [8, 16, 32], 2),
    ("dynamic P2", WAVE, in_motion("P2"), [6, 12, 24], 3),
]

failed = False
for name, field, solver, cells, order in STUDIES:
    verdict = mf.campaign(field, solver, cells=cells, expected_order=order)
    print(f"== {name}\n{verdict}\n")
    failed |= not verdict.passed
sys.exit(failed)
