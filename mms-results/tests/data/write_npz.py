"""Writes archives of NumPy with several times, and with members that are no arrays of points.

Needs numpy. The files contain the data of ../series.rs: X on a grid, u = t (0.1 X Y, -0.2 X) at the times t.
"""

import io
import pathlib
import zipfile

import numpy

HERE = pathlib.Path(__file__).parent
TIMES = numpy.array([0.25, 0.5, 1.0])
X = numpy.array([[i / 2, j / 2] for j in range(3) for i in range(3)])
U = TIMES[:, None, None] * numpy.column_stack([0.1 * X[:, 0] * X[:, 1], -0.2 * X[:, 0]])
F = numpy.eye(2) + TIMES[:, None, None, None] * numpy.array([[[0.1 * y, 0.1 * x], [-0.2, 0.0]] for x, y in X])

numpy.savez(HERE / "times.npz", X=X, u=U, F=F, times=TIMES, cells=numpy.arange(16).reshape(4, 4))
numpy.savez_compressed(HERE / "times_everywhere.npz", t=TIMES[:, None], X=numpy.stack([X] * 3), u=U, E=2.1e11)
odd = dict(
    X=X,
    u=U[0].astype("f2"),
    time=numpy.float32(0.25),
    note=numpy.array("a run"),
    words=numpy.array(["one", "two"]),
    objects=numpy.array([None, dict(a=1)], dtype=object),
    structured=numpy.zeros(9, dtype=[("x", "f8"), ("name", "U3")]),
    complex=U[0] * 1j,
    long=X.astype("longdouble"),
    truth=X[:, 0] > 0,
    date=numpy.datetime64("2020-01-01"),
    number=3,
)
numpy.savez(HERE / "odd.npz", **odd)
with zipfile.ZipFile(HERE / "odd.npz", "a") as archive:
    archive.writestr("readme.txt", "no array")
