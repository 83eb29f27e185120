"""Verifies the three solvers with all sources, and without one term of them. Prints the orders, and exits 1 unless they are as
expected with all terms, and lost without the term.
"""

import sys
from functools import partial

import heated
import loaded
import manufactured as mf
import mixed

wrong = 0


def study(solver, name, field, run, cells, order, *, passes):
    """Prints the order of each quantity."""
    global wrong
    verdict = mf.campaign(field, run, cells=cells, expected_order=order)
    wrong += verdict.verdict != ("pass" if passes else "fail")
    for quantity in verdict.quantities:
        norm = next(it for it in quantity.norms if it.norm == "l2")
        orders = f"{norm.expected_order:8.0f} {norm.observed_order:8.2f}"
        print(f"{solver:7} {name:24} {quantity.name:13} {orders}  {quantity.verdict}")


print(f"{'solver':7} {'study':24} {'quantity':13} expected observed  verdict")

cells, order = [6, 12, 24], {"u": 3, "p": 2}
study("mixed", "right", mixed.FIELD, mixed.run, cells, order, passes=True)
lacking = partial(mixed.run, has_source=False)
study("mixed", "without volume_residual", mixed.FIELD, lacking, cells, order, passes=False)

study("heated", "right", heated.FIELD, heated.run, cells, 2, passes=True)
# Sources are linear in these parameters: with the value 0 they lack exactly one term.
for name in ("expansion", "conductivity"):
    lacking = partial(heated.run, sources=heated.FIELD.set(**{name: 0}))
    study("heated", f"without {name}", heated.FIELD, lacking, cells, 2, passes=False)

for load in (0.25, 0.5, 1):
    study("loaded", f"right@load={load}", loaded.FIELD.set(load=load), loaded.run, [3, 6, 12], 3, passes=True)
lacking = partial(loaded.run, sources=loaded.FIELD.set(lame=0))
study("loaded", "without lame", loaded.FIELD, lacking, [3, 6, 12], 3, passes=False)

if wrong:
    sys.exit(f"{wrong} studies have another verdict than they should have")
