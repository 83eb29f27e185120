"""Writes the files of CalculiX beside this script, with its solver ccx, which must be on the PATH.

The files contain the data of ../frd.rs: elements of each type at the places of the reference cell, one beside the other
along X, with u = t (0.1 X Y, -0.2 X, 0.05 Z) at all nodes. This script writes the file in the short form itself, record by
record as in the manual, since ccx writes only the long form.
"""

import pathlib
import re
import subprocess
import tempfile

HERE = pathlib.Path(__file__).parent
HEXAHEDRON = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
TETRAHEDRON = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
WEDGE = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1)]
# The corners, and the pairs of corners between which the other nodes of ccx lie.
SOLIDS = {
    "C3D8": (HEXAHEDRON, []),
    "C3D20": (HEXAHEDRON, "01 12 23 30 45 56 67 74 04 15 26 37".split()),
    "C3D4": (TETRAHEDRON, []),
    "C3D10": (TETRAHEDRON, "01 12 20 03 13 23".split()),
    "C3D6": (WEDGE, []),
    "C3D15": (WEDGE, "01 12 20 34 45 53 03 14 25".split()),
}
SQUARE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
FLAT = {
    "CPS3": (SQUARE[:2] + SQUARE[3:], []),
    "CPS6": (SQUARE[:2] + SQUARE[3:], "01 12 20".split()),
    "CPS4": (SQUARE, []),
    "CPS8": (SQUARE, "01 12 23 30".split()),
}


def deck(kinds, step, first=11):
    nodes, elements = [], ""
    for at, (kind, (corners, middles)) in enumerate(kinds.items()):
        places = [*corners, *(tuple((a + b) / 2 for a, b in zip(*(corners[int(it)] for it in pair))) for pair in middles)]
        numbers = [first + len(nodes) + it for it in range(len(places))]
        nodes += [(x + 2 * at, y, z) for x, y, z in places]
        row = [at + 1, *numbers]
        lines = [", ".join(map(str, row[it : it + 15])) for it in range(0, len(row), 15)]
        elements += f"*ELEMENT, TYPE={kind}, ELSET=E{at}\n" + ",\n".join(lines) + "\n"
    text = "*NODE, NSET=ALL\n" + "".join(f"{first + at}, {x}, {y}, {z}\n" for at, (x, y, z) in enumerate(nodes))
    text += elements + f"*NSET, NSET=SOME\n{first}, {first + 1}\n"
    text += "*MATERIAL, NAME=M\n*ELASTIC\n1000, 0.3\n*DENSITY\n1\n"
    text += "".join(f"*SOLID SECTION, ELSET=E{at}, MATERIAL=M\n1\n" for at in range(len(kinds)))
    u = [(at, axis, value) for at, (x, y, z) in enumerate(nodes, first)
         for axis, value in enumerate([0.1 * x * y, -0.2 * x, 0.05 * z], 1)]
    return text + step.replace("BOUNDARY", "*BOUNDARY\n" + "".join(f"{at}, {i}, {i}, {v:.15g}\n" for at, i, v in u))


def run(name, text):
    with tempfile.TemporaryDirectory() as folder:
        pathlib.Path(folder, "run.inp").write_text(text)
        subprocess.run(["ccx", "run"], cwd=folder, check=True, capture_output=True)
        found = pathlib.Path(folder, "run.frd").read_bytes()
    # The time and place of the run do not matter.
    found = re.sub(rb"(?m)^    1U(DATE|TIME|HOST|DIR|DBN|USER|COMPILETIME).*\n", b"", found)
    (HERE / name).write_bytes(found)


STATIC = "*STEP, NLGEOM\n*STATIC, DIRECT\n0.5, 1\nBOUNDARY\n*NODE {0}\nU\n*EL {0}\nS\n*END STEP\n"
run("calculix.frd", deck(SOLIDS, STATIC.format("FILE")))
run("calculix_binary.frd", deck(SOLIDS, STATIC.format("OUTPUT")))
FLAT_STEP = "*STEP\n*STATIC\nBOUNDARY\n*NODE FILE, OUTPUT=2D\nU\n*END STEP\n"
run("calculix_plane.frd", deck(FLAT, FLAT_STEP))
ONE = {"C3D4": SOLIDS["C3D4"]}
run("calculix_some.frd", deck(ONE, "*STEP\n*STATIC\nBOUNDARY\n*NODE FILE, NSET=SOME\nU\n*EL FILE\nS\n*END STEP\n"))
run("calculix_modes.frd", deck(ONE, "*STEP\n*FREQUENCY\n1\n*NODE FILE\nU\n*END STEP\n"))
DYNAMIC = "*STEP\n*DYNAMIC, DIRECT\n0.125, 0.25\nBOUNDARY\n*NODE FILE\nU, V\n*END STEP\n"
run("calculix_moving.frd", deck(ONE, DYNAMIC))


def short(name):
    """The tetrahedron in the short form, with an exponent of three digits and numbers that touch."""
    lines = ["    1C", "    1UPGM               by hand", "    2C" + 18 * " " + f"{4:12}" + 37 * " " + "0"]
    lines += [f" -1{at:5}" + "".join(f"{x:12.5E}" for x in place) for at, place in enumerate(TETRAHEDRON, 1)]
    lines += [" -3", "    3C" + 18 * " " + f"{1:12}" + 37 * " " + "0", f" -1{1:5}{3:5}{0:5}{0:5}"]
    lines += [" -2" + "".join(f"{it:5}" for it in [1, 2, 3, 4]), " -3"]
    lines += ["  100CL  101" + f"{0.25:12.5E}{4:12}" + 20 * " " + " 1" + f"{1:5}" + 10 * " " + " 0"]
    lines += [" -4  DISP        4    1", *(f" -5  D{it}          1    2    {it}    0" for it in (1, 2, 3))]
    lines += [" -5  ALL         1    2    0    0    1ALL"]
    lines += [f" -1{at:5}{-0.1 * at:12.5E}-2.00000E-01 1.00000-103" for at in [3, 1, 4, 2]]
    (HERE / name).write_text("\n".join([*lines, " -3", " 9999", ""]))


short("calculix_short.frd")
