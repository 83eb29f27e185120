"""Writes the files of VTK in `vtk_more/`: structured grids, pieces, blocks, series, and cells of higher degree.

Needs vtk, meshio and numpy. Meshes of the unit square and of the unit cube carry u = (0.1 X Y, -0.2 X, 0.3 Z) in points,
and `middle`, the X of the middle, in cells; see ../vtk_more.rs. `read_back.txt` lists the data that VTK reads from files
whose order it changes.
"""

import json
import pathlib
import re
import shutil

import meshio
import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

HERE = pathlib.Path(__file__).parent / "vtk_more"


def array(name, values):
    found = numpy_to_vtk(numpy.ascontiguousarray(values), deep=True)
    found.SetName(name)
    return found


def carry(grid, time=0.25):
    """Adds u, `middle` and the time to a grid."""
    X = numpy.array([grid.GetPoint(i) for i in range(grid.GetNumberOfPoints())]).reshape(-1, 3)
    u = numpy.column_stack([0.1 * X[:, 0] * X[:, 1], -0.2 * X[:, 0], 0.3 * X[:, 2]])
    grid.GetPointData().AddArray(array("u", u))
    bounds = [grid.GetCell(i).GetBounds() for i in range(grid.GetNumberOfCells())]
    grid.GetCellData().AddArray(array("middle", numpy.array([(it[0] + it[1]) / 2 for it in bounds])))
    if time is not None:
        found = vtk.vtkDoubleArray()
        found.SetName("TimeValue")
        found.InsertNextValue(time)
        grid.GetFieldData().AddArray(found)
    return grid


def image(extent, spacing=0.25):
    grid = vtk.vtkImageData()
    grid.SetExtent(*extent)
    grid.SetSpacing(spacing, spacing, spacing)
    return carry(grid)


def rectilinear(extent):
    grid = vtk.vtkRectilinearGrid()
    grid.SetExtent(*extent)
    for axis, name in enumerate("XYZ"):
        along = numpy.arange(extent[2 * axis], extent[2 * axis + 1] + 1) / 4
        getattr(grid, f"Set{name}Coordinates")(array(name, along * along))
    return carry(grid)


def structured(extent):
    grid = vtk.vtkStructuredGrid()
    grid.SetExtent(*extent)
    i, j, k = (numpy.arange(extent[2 * axis], extent[2 * axis + 1] + 1) / 4 for axis in range(3))
    k, j, i = numpy.meshgrid(k, j, i, indexing="ij")
    X = numpy.stack([i + 0.1 * i * j, j, k], axis=-1).reshape(-1, 3)
    points = vtk.vtkPoints()
    points.SetData(array("Points", X))
    grid.SetPoints(points)
    return carry(grid)


GRIDS = {
    "vti": (image, vtk.vtkXMLImageDataWriter),
    "vtr": (rectilinear, vtk.vtkXMLRectilinearGridWriter),
    "vts": (structured, vtk.vtkXMLStructuredGridWriter),
}


def write(writer, grid, name, mode=None):
    writer.SetInputData(grid)
    if mode is not None:
        writer.SetDataMode(["ascii", "binary", "appended"].index(mode))
    writer.SetFileName(str(HERE / name))
    writer.Write()


def pieces(end, make, writer):
    """Two pieces that share a row of points, and one that is empty, with the list of pieces that the ranks of VTK write."""
    extents = [[0, 2, 0, 4, 0, 0], [2, 4, 0, 4, 0, 0], [0, -1, 0, -1, 0, -1]]
    names = [f"pieces_{rank}.{end}" for rank in range(3)]
    for extent, name in zip(extents[:2], names):
        write(writer(), make(extent), name)
    empty = type(make(extents[0]))()
    empty.SetExtent(*extents[2])
    write(writer(), empty, names[2], "ascii")
    # VTK names arrays without a name by their addresses in memory.
    text = (HERE / names[2]).read_text()
    (HERE / names[2]).write_text(re.sub("Array 0x[0-9a-f]+", "along", text))
    kind = "P" + re.search('type="(\\w+)"', (HERE / names[0]).read_text(errors="replace"))[1]
    text = " ".join(str(it) for it in extents[0][:1] + [4] + extents[0][2:])
    listed = [
        f'<Piece Extent="{" ".join(map(str, extent))}" Source="{name}"/>' for extent, name in zip(extents, names)
    ]
    (HERE / f"pieces.p{end}").write_text(
        f'<?xml version="1.0"?>\n<VTKFile type="{kind}" version="0.1" byte_order="LittleEndian">\n'
        f'<{kind} WholeExtent="{text}" GhostLevel="0">\n' + "\n".join(listed) + f"\n</{kind}>\n</VTKFile>\n"
    )


def structured_grids():
    flat, solid, across = [0, 4, 0, 4, 0, 0], [0, 2, 0, 1, 0, 2], [0, 3, 0, 0, 0, 2]
    for end, (make, writer) in GRIDS.items():
        write(writer(), make(flat), f"flat.{end}", "ascii")
        write(writer(), make(solid), f"solid.{end}", "appended")
        write(writer(), make(across), f"across.{end}", "binary")
        for name, extent in [("flat", flat), ("solid", solid)]:
            for mode in ["ascii", "binary"]:
                legacy = vtk.vtkDataSetWriter()
                legacy.SetFileType(1 if mode == "ascii" else 2)
                write(legacy, make(extent), f"{end}_{name}_{mode}.vtk")
        pieces(end, make, writer)
    # Steps of a third in six digits, as the legacy writer prints them.
    write(vtk.vtkDataSetWriter(), image([0, 3, 0, 3, 0, 0], 1 / 3), "thirds.vtk")
    # Axes that are turned by a quarter and moved.
    turned = vtk.vtkImageData()
    turned.SetExtent(-2, 2, 1, 5, 0, 0)
    turned.SetSpacing(0.25, 0.25, 1)
    turned.SetOrigin(1.25, 0.5, 0)
    turned.SetDirectionMatrix(0, -1, 0, 1, 0, 0, 0, 0, 1)
    write(vtk.vtkXMLImageDataWriter(), carry(turned), "turned.vti")
    # The last column of cells belongs to another rank.
    ghosts = image([0, 5, 0, 4, 0, 0])
    cells = numpy.array([i % 5 == 4 for i in range(20)], dtype=numpy.uint8)
    points = numpy.array([i % 6 == 5 for i in range(30)], dtype=numpy.uint8)
    ghosts.GetCellData().AddArray(array("vtkGhostType", cells))
    ghosts.GetPointData().AddArray(array("vtkGhostType", points))
    write(vtk.vtkXMLImageDataWriter(), ghosts, "ghosts.vti")
    write(vtk.vtkDataSetWriter(), ghosts, "ghosts.vtk")


def compressed():
    for mode in ["binary", "appended"]:
        writer = vtk.vtkXMLImageDataWriter()
        writer.SetCompressorTypeToLZ4()
        writer.SetBlockSize(256)
        write(writer, image([0, 4, 0, 4, 0, 0]), f"lz4_{mode}.vti", mode)


def named_components():
    """Symmetric tensors with names of their components, in an order of no convention."""
    for end, writer in [("vti", vtk.vtkXMLImageDataWriter()), ("vtk", vtk.vtkDataSetWriter())]:
        grid = image([0, 2, 0, 2, 0, 0])
        X = numpy.array([grid.GetPoint(i) for i in range(9)])
        stress = array("Cauchy Stress", numpy.column_stack([X[:, 1], 3 + X[:, 0], 5 + X[:, 1], X[:, 0], 0 * X[:, 0], 7 + X[:, 0]]))
        for at, name in enumerate(["XY", "YY", "ZZ", "XZ", "YZ", "XX"]):
            stress.SetComponentName(at, name)
        grid.GetPointData().AddArray(stress)
        write(writer, grid, f"names.{end}")


def matrices():
    """Matrices in cells as meshio writes them, without their number of components; and tensors of the legacy format."""
    points = numpy.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0], [2, 1, 0]])
    cells = [("quad", numpy.array([[0, 1, 2, 3], [1, 4, 5, 2]]))]
    F = numpy.arange(18.0).reshape(2, 3, 3)
    u = numpy.column_stack([0.1 * points[:, 0] * points[:, 1], -0.2 * points[:, 0], 0 * points[:, 0]])
    mesh = meshio.Mesh(points, cells, point_data={"u": u}, cell_data={"F": [F]})
    mesh.write(HERE / "meshio_matrix_zlib.vtu", compression="zlib")
    mesh.write(HERE / "meshio_matrix_ascii.vtu", binary=False)
    for mode in [1, 2]:
        grid = image([0, 1, 0, 1, 0, 0])
        values = numpy.arange(36.0).reshape(4, 9)
        grid.GetPointData().SetTensors(array("F", values))
        writer = vtk.vtkDataSetWriter()
        writer.SetFileType(mode)
        write(writer, grid, f"tensors_{mode}.vtk")


def unstructured(extent, dtype=numpy.float64):
    """An image as a list of points and cells."""
    found = vtk.vtkAppendFilter()
    found.AddInputData(image(extent))
    found.Update()
    return found.GetOutput()


def without_points():
    """Pieces one of which has no points: with arrays, without arrays, and with an array of other components."""
    grid = vtk.vtkXMLUnstructuredGridWriter()
    write(grid, unstructured([0, 4, 0, 4, 0, 0]), "some_0.vtu")
    empty = vtk.vtkUnstructuredGrid()
    write(vtk.vtkXMLUnstructuredGridWriter(), empty, "some_1.vtu", "ascii")
    empty = vtk.vtkUnstructuredGrid()
    odd = array("u", numpy.zeros((0, 2)))
    empty.GetPointData().AddArray(odd)
    write(vtk.vtkXMLUnstructuredGridWriter(), empty, "some_2.vtu")
    listed = "\n".join(f'<Piece Source="some_{rank}.vtu"/>' for rank in [1, 0, 2])
    (HERE / "some.pvtu").write_text(
        f'<VTKFile type="PUnstructuredGrid" version="1.0">\n<PUnstructuredGrid>\n{listed}\n</PUnstructuredGrid>\n</VTKFile>\n'
    )
    # Several pieces in one file.
    text = (HERE / "some_1.vtu").read_text()
    piece = text[text.index("<Piece") : text.index("</Piece>") + len("</Piece>")]
    mesh = unstructured([0, 4, 0, 4, 0, 0])
    write(vtk.vtkXMLUnstructuredGridWriter(), mesh, "in_one.vtu", "ascii")
    text = (HERE / "in_one.vtu").read_text()
    (HERE / "in_one.vtu").write_text(text.replace("<Piece", piece + "\n<Piece", 1))


def blocks():
    """Blocks within blocks: two halves of a square of different arrays, one that is empty, and an edge with u alone."""
    left, right = unstructured([0, 2, 0, 4, 0, 0]), unstructured([2, 4, 0, 4, 0, 0])
    right.GetPointData().AddArray(array("more", numpy.zeros(right.GetNumberOfPoints())))
    edge = unstructured([0, 0, 0, 4, 0, 0])
    edge.GetCellData().RemoveArray("middle")
    all = vtk.vtkMultiBlockDataSet()
    inner = vtk.vtkMultiBlockDataSet()
    for at, block in enumerate([left, right, None]):
        inner.SetBlock(at, block)
    all.SetBlock(0, edge)
    all.SetBlock(1, inner)
    write(vtk.vtkXMLMultiBlockDataWriter(), all, "blocks.vtm")
    parts = vtk.vtkPartitionedDataSetCollection()
    parts.SetPartition(0, 0, left)
    parts.SetPartition(1, 0, right)
    write(vtk.vtkXMLPartitionedDataSetCollectionWriter(), parts, "parts.vtpc")
    part = vtk.vtkPartitionedDataSet()
    part.SetPartition(0, left)
    part.SetPartition(1, right)
    write(vtk.vtkXMLPartitionedDataSetWriter(), part, "part.vtpd")


def times():
    """Lists of times: a series of ParaView, and a collection of blocks and of parts."""
    files = [{"name": "flat.vti", "time": 0.5}, {"name": "vti_flat_ascii.vtk", "time": 0.1}]
    series = {"file-series-version": "1.0", "files": files}
    (HERE / "flat.vti.series").write_text(json.dumps(series, indent=2))
    sets = [("0.5", 0, "blocks.vtm"), ("0.25", 0, "pieces_0.vti"), ("0.25", 1, "pieces_1.vti"), ("0.125", 0, "some.pvtu")]
    listed = "\n".join(f'<DataSet timestep="{time}" part="{part}" file="{name}"/>' for time, part, name in sets)
    (HERE / "times.pvd").write_text(
        f'<VTKFile type="Collection" version="0.1">\n<Collection>\n{listed}\n</Collection>\n</VTKFile>\n'
    )


def odd_arrays():
    """Arrays that belong to no quantity, before and after others: bits, words, colours, numbers of points."""
    for mode in [1, 2]:
        grid = image([0, 2, 0, 2, 0, 0])
        bits = vtk.vtkBitArray()
        bits.SetName("bits")
        for at in range(9):
            bits.InsertNextValue(at % 2)
        words = vtk.vtkStringArray()
        words.SetName("words")
        for at in range(9):
            words.InsertNextValue("a word" * at)
        data = grid.GetPointData()
        data.AddArray(bits)
        data.AddArray(words)
        data.AddArray(array("last", numpy.arange(9.0)))
        data.SetScalars(array("colours", numpy.arange(27, dtype=numpy.uint8).reshape(9, 3)))
        data.SetGlobalIds(array("ids", numpy.arange(9, dtype=numpy.int64)))
        writer = vtk.vtkDataSetWriter()
        writer.SetFileType(mode)
        write(writer, grid, f"odd_{mode}.vtk")
    write(vtk.vtkXMLImageDataWriter(), grid, "odd.vti")


def instance(kind, points):
    """A cell of this kind and number of points."""
    cell = vtk.vtkGenericCell.InstantiateCell(kind)
    cell.GetPointIds().SetNumberOfIds(points)
    cell.GetPoints().SetNumberOfPoints(points)
    if hasattr(cell, "SetUniformOrderFromNumPoints"):
        cell.SetUniformOrderFromNumPoints(points)
    cell.Initialize()
    return cell


def count(kind, n):
    """The number of points of a Lagrange cell of degree n."""
    triangle = (n + 1) * (n + 2) // 2
    return {68: n + 1, 69: triangle, 70: (n + 1) ** 2, 71: triangle * (n + 3) // 3, 72: (n + 1) ** 3, 73: triangle * (n + 1)}[kind]


def nodes(kind, points):
    places = instance(kind, points).GetParametricCoords()
    return numpy.array([places[i] for i in range(3 * points)]).reshape(-1, 3)


def of_higher_degree():
    """Nodes of cells in VTK as steps, and the values of their functions at a place: the type, the points, and numbers."""
    lines = []
    for n, kinds in [(1, range(68, 74)), (3, range(68, 74)), (4, [69, 70, 71, 73]), (5, [69, 71, 73]), (6, [69, 71])]:
        for kind in kinds:
            steps = numpy.rint(n * nodes(kind, count(kind, n))).astype(int)
            lines.append(" ".join(map(str, [kind, len(steps), *steps.ravel()])))
    (HERE / "steps.txt").write_text("\n".join(lines) + "\n")
    lines = []
    fixed = [3, 5, 8, 9, 10, 11, 12, 13, 21, 22, 23, 24, 25, 26, 28, 29, 30, 31, 32, 33]
    kinds = [(kind, vtk.vtkGenericCell.InstantiateCell(kind).GetNumberOfPoints()) for kind in fixed]
    for kind, points in kinds + [(kind, count(kind, n)) for n in [2, 3] for kind in range(68, 74)]:
        values = [0.0] * points
        instance(kind, points).InterpolateFunctions([0.3, 0.2, 0.1], values)
        lines.append(" ".join([str(kind), *(f"{it:.12g}" for it in values)]))
    (HERE / "functions.txt").write_text("\n".join(lines) + "\n")
    # One cell each of degrees 3 and 4 of each kind, with nodes at x = X + 0.1 Y^2.
    grid = vtk.vtkUnstructuredGrid()
    points = vtk.vtkPoints()
    points.SetDataTypeToDouble()
    grid.SetPoints(points)
    for kind in [69, 70]:
        for n in [3, 4]:
            own = nodes(kind, count(kind, n))
            first = points.GetNumberOfPoints()
            for x, y, z in own:
                points.InsertNextPoint(x + 0.1 * y * y + 2 * (n - 3), y + 2 * (kind - 69), z)
            grid.InsertNextCell(kind, len(own), list(range(first, first + len(own))))
    write(vtk.vtkXMLUnstructuredGridWriter(), carry(grid), "lagrange.vtu")
    write(vtk.vtkUnstructuredGridWriter(), grid, "lagrange.vtk")
    # A hexahedron of degree 3 in versions with different orders of nodes.
    grid = vtk.vtkUnstructuredGrid()
    points = vtk.vtkPoints()
    for place in nodes(72, 64):
        points.InsertNextPoint(place)
    grid.SetPoints(points)
    grid.InsertNextCell(72, 64, list(range(64)))
    write(vtk.vtkXMLUnstructuredGridWriter(), grid, "hexahedron_2.3.vtu", "ascii")
    new = (HERE / "hexahedron_2.3.vtu").read_text()
    for version in ["1.0", "2.0", "2.1"]:
        (HERE / f"hexahedron_{version}.vtu").write_text(new.replace('version="2.3"', f'version="{version}"'))
    write(vtk.vtkUnstructuredGridWriter(), grid, "hexahedron_5.1.vtk")
    new = (HERE / "hexahedron_5.1.vtk").read_text()
    cells = "CELLS 1 65\n64 " + " ".join(map(str, range(64))) + "\n"
    old = new[: new.index("CELLS")].replace("Version 5.1", "Version 4.2") + cells + new[new.index("CELL_TYPES") :]
    (HERE / "hexahedron_4.2.vtk").write_text(old)
    lines = []
    for path in sorted(HERE.glob("hexahedron_*")):
        reader = vtk.vtkXMLUnstructuredGridReader() if path.suffix == ".vtu" else vtk.vtkUnstructuredGridReader()
        reader.SetFileName(str(path))
        reader.Update()
        cell = reader.GetOutput().GetCell(0)
        own = [cell.GetPointId(i) for i in range(cell.GetNumberOfPoints())]
        lines.append(" ".join([path.name, *map(str, own)]))
    (HERE / "read_back.txt").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    shutil.rmtree(HERE, ignore_errors=True)
    HERE.mkdir()
    structured_grids()
    compressed()
    of_higher_degree()
    named_components()
    matrices()
    odd_arrays()
    without_points()
    blocks()
    times()
