"""Writes the files beside this script: one small mesh in all formats of meshio, VTK and NumPy.

Needs meshio, vtk and numpy. The files contain the data of ../files.rs: X on a grid, u = (0.1 X Y, -0.2 X), and for each
cell the mean of X over its points.
"""

import pathlib

import meshio
import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk

HERE = pathlib.Path(__file__).parent
SIDE = 3
REFERENCE = numpy.array([[i / 2, j / 2, 0.0] for j in range(SIDE) for i in range(SIDE)])
DISPLACEMENT = numpy.column_stack(
    [0.1 * REFERENCE[:, 0] * REFERENCE[:, 1], -0.2 * REFERENCE[:, 0], 0.0 * REFERENCE[:, 0]]
)
QUADS = numpy.array([[i + SIDE * j, i + 1 + SIDE * j, i + 1 + SIDE * (j + 1), i + SIDE * (j + 1)]
                     for j in range(2) for i in range(2)])
MIDDLE = REFERENCE[QUADS, 0].mean(axis=1)


def with_meshio():
    mesh = meshio.Mesh(REFERENCE, [("quad", QUADS)], point_data={"u": DISPLACEMENT}, cell_data={"middle": [MIDDLE]})
    mesh.write(HERE / "meshio_ascii.vtu", binary=False)
    mesh.write(HERE / "meshio_raw_base64.vtu", compression=None)
    mesh.write(HERE / "meshio_zlib.vtu", compression="zlib")
    mesh.write(HERE / "meshio_lzma.vtu", compression="lzma")
    for version in ["4.2", "5.1"]:
        for mode in ["ascii", "binary"]:
            name = HERE / f"meshio_{mode}_{version.replace('.', '')}.vtk"
            meshio.vtk.write(name, mesh, fmt_version=version, binary=mode == "binary")


def array(name, values):
    found = numpy_to_vtk(values, deep=True)
    found.SetName(name)
    return found


def data(grid, dtype=numpy.float64):
    points = vtk.vtkPoints()
    points.SetData(array("Points", REFERENCE.astype(dtype)))
    grid.SetPoints(points)
    cells = vtk.vtkCellArray()
    for quad in QUADS:
        cells.InsertNextCell(4, quad)
    grid.GetPointData().AddArray(array("u", DISPLACEMENT.astype(dtype)))
    grid.GetCellData().AddArray(array("middle", MIDDLE.astype(dtype)))
    words = vtk.vtkStringArray()
    words.SetName("words")
    for _ in REFERENCE:
        words.InsertNextValue("a < b")
    grid.GetPointData().AddArray(words)
    time = vtk.vtkDoubleArray()
    time.SetName("TimeValue")
    time.InsertNextValue(0.25)
    grid.GetFieldData().AddArray(time)
    return cells


def unstructured(dtype=numpy.float64):
    grid = vtk.vtkUnstructuredGrid()
    grid.SetCells(vtk.VTK_QUAD, data(grid, dtype))
    return grid


def surface():
    grid = vtk.vtkPolyData()
    grid.SetPolys(data(grid))
    return grid


def with_vtk():
    modes = {"ascii": 0, "binary": 1, "appended": 2}
    for mode, number in modes.items():
        for compressor in ["none", "zlib"]:
            for order in ["little", "big"]:
                if mode == "ascii" and (compressor, order) != ("none", "little"):
                    continue
                writer = vtk.vtkXMLUnstructuredGridWriter()
                writer.SetInputData(unstructured())
                writer.SetDataMode(number)
                writer.SetCompressorTypeToNone() if compressor == "none" else writer.SetCompressorTypeToZLib()
                writer.SetByteOrder(1 if order == "little" else 0)
                if order == "little":
                    writer.SetHeaderTypeToUInt64()
                else:
                    writer.SetHeaderTypeToUInt32()
                writer.SetEncodeAppendedData(compressor == "zlib" and order == "big")
                # More than one block.
                writer.SetBlockSize(64)
                writer.SetFileName(str(HERE / f"vtk_{mode}_{compressor}_{order}.vtu"))
                writer.Write()
    writer = vtk.vtkXMLUnstructuredGridWriter()
    writer.SetInputData(unstructured(numpy.float32))
    writer.SetDataModeToAppended()
    writer.EncodeAppendedDataOff()
    writer.SetCompressorTypeToNone()
    writer.SetFileName(str(HERE / "vtk_single.vtu"))
    writer.Write()
    writer = vtk.vtkXMLPolyDataWriter()
    writer.SetInputData(surface())
    writer.SetFileName(str(HERE / "vtk.vtp"))
    writer.Write()
    for make, name in [(unstructured, "grid"), (surface, "surface")]:
        for mode in ["ascii", "binary"]:
            writer = vtk.vtkDataSetWriter()
            writer.SetInputData(make())
            writer.SetFileTypeToASCII() if mode == "ascii" else writer.SetFileTypeToBinary()
            writer.SetFileName(str(HERE / f"vtk_{name}_{mode}.vtk"))
            writer.Write()
    pieces = vtk.vtkXMLPUnstructuredGridWriter()
    pieces.SetInputData(unstructured())
    pieces.SetFileName(str(HERE / "pieces.pvtu"))
    pieces.SetNumberOfPieces(1)
    pieces.Write()


def corners():
    """Writes the places of the nodes of each type of cell in VTK."""
    lines = []
    for kind in [3, 5, 8, 9, 10, 11, 12, 13, 14, 21, 22, 23, 24, 25, 28, 29, 26, 30, 31, 32, 33]:
        cell = vtk.vtkGenericCell.InstantiateCell(kind)
        places = cell.GetParametricCoords()
        numbers = [f"{places[i]:g}" for i in range(3 * cell.GetNumberOfPoints())]
        lines.append(" ".join([str(kind), *numbers]))
    (HERE / "nodes.txt").write_text("\n".join(lines) + "\n")


def with_numpy():
    arrays = dict(X=REFERENCE[:, :2], u=DISPLACEMENT[:, :2], time=0.25)
    numpy.savez(HERE / "numpy.npz", **arrays)
    numpy.savez_compressed(HERE / "numpy_compressed.npz", **arrays)
    other = {name: numpy.asfortranarray(value).astype(">f4") for name, value in arrays.items()}
    numpy.savez(HERE / "numpy_fortran_big_single.npz", **other)
    numpy.save(HERE / "numpy.npy", numpy.hstack([REFERENCE[:, :2], DISPLACEMENT[:, :2]]))
    table = numpy.hstack([REFERENCE[:, :2], DISPLACEMENT[:, :2]])
    numpy.savetxt(HERE / "numpy.csv", table, delimiter=",", header="X,Y,ux,uy")
    numpy.savetxt(HERE / "numpy_six.tsv", table, fmt="%.6f", delimiter="\t", header="X\tY\tux\tuy", comments="")
    numpy.savetxt(HERE / "numpy_spaces.txt", table, fmt="%.6e", header="X Y ux uy")


with_meshio()
with_vtk()
with_numpy()
corners()
