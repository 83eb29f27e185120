"""Compares the stability that `mms check` reports with finite elements of scikit-fem: the least eigenvalues of the tangent on
the same meshes, and whether a disturbance grows faster on finer meshes if and only if a surface impedance, or the coercivity of
a corner, is negative.

    MMS=target/release/mms python3 -B .ci/stability/compare.py
"""

import importlib.util
import json
import os
import pathlib
import subprocess
import tempfile

import numpy as np
from elements import Body, least, neo_hookean, saint_venant_kirchhoff

HERE = pathlib.Path(__file__).parent
FIELDS = HERE.parent.parent / "fields"
MMS = os.environ.get("MMS", "mms")
DENSITY = 1000.0
SOFT, FIRM = saint_venant_kirchhoff(1e6, 0.3), neo_hookean(1e6, 0.3)
LEFT, RIGHT, BOTTOM, TOP = (0, 0), (0, 1), (1, 0), (1, 1)


def square(n, held):
    return Body([0, 0], [1, 1], [n, n], held)


def on_rollers(n):
    return square(n, {side: "normal" for side in (LEFT, RIGHT, BOTTOM, TOP)})


def clamped_but_on_top(n):
    return square(n, {side: "all" for side in (LEFT, RIGHT, BOTTOM)})


def compressed(n):
    return square(n, {LEFT: "normal", RIGHT: "all", BOTTOM: "normal"})


def clamped_below(n):
    return square(n, {BOTTOM: "all"})


def sector(n):
    return Body([0.5, 0], [1, np.pi / 2], [n, n], {}, polar=True)


def column(n):
    return Body([-0.25, -0.25, 0], [0.25, 0.25, 1], [n, n, n], {(2, 0): "all"})


# A field with its settings, its material, its body, the elements along each axis, and the relative difference allowed between
# the eigenvalues: in a sector, the sides of elements are parabolas here, and arcs in mms.
EIGENVALUES = [
    (FIELDS / "sheared_block_2d.toml", None, FIRM, clamped_below, 4, 1e-5),
    (FIELDS / "axis_aligned_2d.toml", None, FIRM, on_rollers, 4, 1e-5),
    (HERE / "bent_block.toml", "amplitude=0.04", SOFT, clamped_but_on_top, 4, 1e-5),
    (HERE / "compressed_block.toml", "stretch=0.45", FIRM, compressed, 4, 1e-5),
    (FIELDS / "conformal_sector_2d.toml", "amplitude=0.02", FIRM, sector, 4, 3e-2),
    (FIELDS / "conformal_sector_2d.toml", "amplitude=0.1", FIRM, sector, 4, 3e-2),
    (FIELDS / "twisted_column.toml", None, FIRM, column, 2, 1e-5),
]

# A field with its settings, its material, its body, and whether a face or a corner lets short waves grow.
GROWTH = [
    (HERE / "compressed_block.toml", "stretch=0.75", FIRM, compressed, None),
    (HERE / "compressed_block.toml", "stretch=0.45", FIRM, compressed, "face"),
    (HERE / "bent_block.toml", "amplitude=0.02", SOFT, clamped_but_on_top, None),
    (HERE / "bent_block.toml", "amplitude=0.05", SOFT, clamped_but_on_top, "face"),
    (FIELDS / "conformal_sector_2d.toml", "amplitude=0.02", FIRM, sector, None),
    (FIELDS / "conformal_sector_2d.toml", "amplitude=0.05", FIRM, sector, "corner"),
    (FIELDS / "conformal_sector_2d.toml", "amplitude=0.1", FIRM, sector, "face"),
]
MESHES = [8, 16, 32]


def checked(path, setting):
    """The stability of a field as `mms check` reports it."""
    options = ["--set", setting] if setting else []
    run = subprocess.run([MMS, "check", path, "--json", *options], capture_output=True, check=True)
    return json.loads(run.stdout)["files"][0]["stability"]


def emitted(path, setting):
    """The field as NumPy code."""
    options = ["--set", setting] if setting else []
    with tempfile.TemporaryDirectory() as folder:
        quantities = ["--quantity", "displacement,displacement_gradient"]
        command = [MMS, "emit", path, "--target", "numpy", "-o", folder, *quantities, *options]
        subprocess.run(command, check=True, capture_output=True)
        spec = importlib.util.spec_from_file_location(path.stem, f"{folder}/{path.stem}.py")
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
    return module.prepare()


def eigenvalue(field, time, stress, body):
    """The least eigenvalue about the exact state."""
    now = field.at_time(time)
    stiffness, mass = body.pencil(stress, DENSITY, now.displacement_gradient)
    apart = body.rigid(lambda *x: np.array(x) + np.array(now.displacement(*x)))
    return least(stiffness, mass, apart)


def compare_eigenvalues():
    print(f"{'field':22} {'set':15} {'mms, 1/s^2':>12} {'scikit-fem':>12}")
    for path, setting, stress, body, n, most in EIGENVALUES:
        mode = checked(path, setting)["slowest_mode"]
        found, expected = mode["omega_squared"], eigenvalue(
            emitted(path, setting), mode["time"], stress, body(n)
        )
        print(f"{path.stem:22} {setting or '':15} {found:12.6g} {expected:12.6g}")
        assert mode["elements"] == [n] * len(mode["elements"])
        assert abs(found - expected) <= most * abs(expected), found / expected - 1


def compare_growth():
    elements = "  ".join(f"{n:>9} cells" for n in MESHES)
    print(f"\n{'field':22} {'set':15} impedance  coercivity  least w^2, {elements}")
    for path, setting, stress, body, grows in GROWTH:
        stability = checked(path, setting)
        worst = min(stability["faces"], key=lambda face: face["least_impedance"])
        impedance = worst["least_impedance"]
        corners = [corner["coercivity"] for corner in stability["corners"]]
        coercivity = min(corners, default=np.inf)
        field = emitted(path, setting)
        found = [eigenvalue(field, worst["time"], stress, body(n)) for n in MESHES]
        values = "  ".join(f"{value:15.6g}" for value in found)
        print(f"{path.stem:22} {setting:15} {impedance:9.4f} {coercivity:11.4f} {values}")
        *_, coarse, fine = found
        if grows is None:
            assert impedance > 0.0 and coercivity > 0.0
            assert abs(fine - coarse) <= 0.05 * abs(fine), "something grows with the mesh"
        else:
            assert (impedance < 0.0) == (grows == "face")
            assert coercivity < 0.0 or grows == "face"
            assert fine < 2.0 * coarse < 0.0, "nothing grows with the mesh"


compare_eigenvalues()
compare_growth()
