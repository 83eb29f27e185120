"""Writes the files of MATLAB beside this script, with SciPy and, for the other byte order, with a few lines here.

Needs scipy. The files contain the data of ../mat.rs: X on a grid, u = (0.1 X Y, -0.2 X), and a structure, a cell, words,
complex and sparse numbers, which are no arrays of points.
"""

import io
import pathlib
import struct

import numpy
import scipy.io
import scipy.sparse

HERE = pathlib.Path(__file__).parent
X = numpy.array([[i / 2, j / 2] for j in range(3) for i in range(3)])
U = numpy.column_stack([0.1 * X[:, 0] * X[:, 1], -0.2 * X[:, 0]])
F = numpy.array([[[1 + 0.1 * y, 0.1 * x], [-0.2, 1.0]] for x, y in X])
PLAIN = dict(X=X, u=U, time=0.25)
ALL = dict(
    PLAIN,
    F=F,
    p=X[:, 0],
    single=U.astype("f4"),
    whole=numpy.arange(9, dtype="i2").reshape(9, 1),
    words="not numbers",
    cell=numpy.array(["a", 2.0], dtype=object),
    s=dict(v=2 * U, name="x", deep=dict(w=1.0)),
    complex=U * 1j,
    sparse=scipy.sparse.csc_array(U),
    empty=numpy.zeros((0, 3)),
)


def element(kind, data):
    return struct.pack(">II", kind, len(data)) + data + bytes(-len(data) % 8)


def big_endian(arrays):
    """Variables with the most significant byte first, as SPARC computers wrote them."""
    text = b"MATLAB 5.0 MAT-file, big-endian".ljust(116) + bytes(8) + struct.pack(">H", 0x0100) + b"MI"
    for name, array in arrays.items():
        array = numpy.atleast_2d(array)
        numbers = numpy.asarray(array, ">f8").tobytes(order="F")
        head = element(6, struct.pack(">II", 6, 0)) + element(5, struct.pack(">2i", *array.shape))
        text += element(14, head + element(1, name.encode()) + element(9, numbers))
    return text


def big_endian_4(arrays):
    text = b""
    for name, array in arrays.items():
        array = numpy.atleast_2d(array)
        text += struct.pack(">5i", 1000, *array.shape, 0, len(name) + 1) + name.encode() + b"\0"
        text += numpy.asarray(array, ">f8").tobytes(order="F")
    return text


scipy.io.savemat(HERE / "scipy.mat", ALL)
scipy.io.savemat(HERE / "scipy_packed.mat", ALL, do_compression=True)
scipy.io.savemat(HERE / "scipy_4.mat", dict(PLAIN, words="not numbers"), format="4")
for name, text in [("big.mat", big_endian(PLAIN)), ("big_4.mat", big_endian_4(PLAIN))]:
    read = scipy.io.loadmat(io.BytesIO(text))
    assert all((read[name] == value).all() for name, value in PLAIN.items())
    (HERE / name).write_bytes(text)
