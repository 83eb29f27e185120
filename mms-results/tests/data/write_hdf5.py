"""Writes the files in `hdf5/`: one small mesh in the formats over HDF5 and netCDF, and in XDMF.

Needs h5py, hdf5plugin, hdf5storage, meshio[all], netCDF4, numpy and vtk. The files contain the data of ../hdf5.rs and
../xdmf.rs: X on a grid of 3 x 3 points, u = (1 + t) (0.1 X Y, -0.2 X) at the times t, and for each cell the mean of X over
its points.

h5py, hdf5storage, meshio, netCDF4 and VTK write their own files. MOOSE, dolfin and dolfinx are not packages of
Python: this script writes their files with netCDF4 and h5py, in the layout of their sources and of other files.
"""

import os
import pathlib
import sys

import h5py
import hdf5plugin
import hdf5storage
import meshio
import netCDF4
import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk
from vtk.util.vtkAlgorithm import VTKPythonAlgorithmBase

HERE = pathlib.Path(__file__).parent / "hdf5"
SIDE = 3
X = numpy.array([[i / 2, j / 2] for j in range(SIDE) for i in range(SIDE)])
U = numpy.column_stack([0.1 * X[:, 0] * X[:, 1], -0.2 * X[:, 0]])
QUADS = numpy.array([[i + SIDE * j, i + 1 + SIDE * j, i + 1 + SIDE * (j + 1), i + SIDE * (j + 1)]
                     for j in range(2) for i in range(2)])
TRIANGLES = numpy.array([t for a, b, c, d in QUADS for t in [[a, b, c], [a, c, d]]])
MIDDLE = X[QUADS, 0].mean(axis=1)
TIMES = [0.0, 0.5, 2.0]
X3 = numpy.column_stack([X, 0 * X[:, 0]])
U3 = numpy.column_stack([U, 0 * X[:, 0]])


def at(time):
    return (1 + time) * U


def with_h5py():
    for version in ["earliest", "latest"]:
        with h5py.File(HERE / f"h5py_{version}.h5", "w", libver=version) as f:
            f["X"] = X
            f["u"] = U
            f["time"] = 0.25
            f["name"] = "words"
            f.create_dataset("v", shape=(0, 2**40), dtype="f8")
            f["names"] = numpy.array(["one", "two"], dtype=object)
            f["record"] = numpy.array([(1, 2.0)], dtype=[("a", "i4"), ("b", "f8")])
            g = f.create_group("stored")
            f["link"] = h5py.SoftLink("/stored/compact")
            f["nowhere"] = h5py.SoftLink("/no/such/thing")
            f["elsewhere"] = h5py.ExternalLink("other.h5", "/u")
            g["itself"] = g
            for name in ["f4", "f8", ">f4", ">f8"]:
                g.create_dataset("as_" + name.replace(">", "big_"), data=U.astype(name))
            # Integers: multiples of X that are whole.
            for name in ["i1", "i2", "i4", "i8", "u1", "u2", "u4", "u8", ">i2", ">u4", ">i8"]:
                g.create_dataset("whole_" + name.replace(">", "big_"), data=(2 * X).astype(name))
            g["truth"] = X > 0.5
            g.create_dataset("chunks", data=U, chunks=(4, 1))
            g.create_dataset("one_chunk", data=U, chunks=(9, 2))
            g.create_dataset("gzip", data=U, chunks=(4, 2), compression="gzip")
            g.create_dataset("filters", data=U, chunks=(4, 2), compression="gzip", shuffle=True, fletcher32=True)
            g.create_dataset("lzf", data=numpy.repeat(U, 10, axis=0)[::10], chunks=(9, 2), compression="lzf", shuffle=True)
            g.create_dataset("grows", data=U, chunks=(2, 2), maxshape=(None, 2))
            g.create_dataset("grows_gzip", data=U, chunks=(2, 2), maxshape=(None, 2), compression="gzip")
            g.create_dataset("grows_both", data=U, chunks=(2, 1), maxshape=(None, None))
            d = g.create_dataset("filled", shape=(9, 2), dtype="f8", chunks=(3, 2), fillvalue=-7.5)
            d[3:6] = U[3:6]
            g.create_dataset("never", shape=(9, 2), dtype="f8", fillvalue=1.5)
            # Low level: the numbers in the header, and chunks that are there from the beginning.
            plist = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
            plist.set_layout(h5py.h5d.COMPACT)
            space = h5py.h5s.create_simple(U.shape)
            made = h5py.h5d.create(g.id, b"compact", h5py.h5t.IEEE_F64LE, space, plist)
            made.write(h5py.h5s.ALL, h5py.h5s.ALL, U.copy())
            plist = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
            plist.set_chunk((4, 2))
            plist.set_alloc_time(h5py.h5d.ALLOC_TIME_EARLY)
            made = h5py.h5d.create(g.id, b"early", h5py.h5t.IEEE_F64LE, space, plist)
            made.write(h5py.h5s.ALL, h5py.h5s.ALL, U.copy())
            # An array with so many chunks that their index has more than one level, and a group with so many members.
            many = numpy.arange(400, dtype="f4")
            f.create_dataset("many", data=many, chunks=(2,), maxshape=(None,))
            g = f.create_group("members")
            for i in range(60):
                g[f"m{i:02}"] = numpy.float32(i)
            for i in range(12):
                g.attrs[f"a{i}"] = i
    with h5py.File(HERE / "times.h5", "w") as f:
        f["X"] = X
        f["u"] = numpy.array([at(t) for t in TIMES])
        f["t"] = TIMES
        f["J"] = numpy.array([1 + t * X[:, 0] for t in TIMES])
        f["F"] = numpy.zeros((9, 2, 2)) + numpy.eye(2)
    with h5py.File(HERE / "one_time.h5", "w") as f:
        f["X"] = X
        f["u"] = at(0.5)[None]
        f["time"] = [0.5]
    with h5py.File(HERE / "zstd.h5", "w") as f:
        f["X"] = X
        f.create_dataset("u", data=U, chunks=(9, 2), **hdf5plugin.Zstd())
        f.create_dataset("other", data=U, chunks=(9, 2), **hdf5plugin.Zstd())
    with h5py.File(HERE / "groups.h5", "w") as f:
        f["run/mesh/X"] = X
        f["run/fields/u"] = U
        f["T"] = 300 + X[:, 0]


def with_matlab():
    path = HERE / "matlab.mat"
    path.unlink(missing_ok=True)
    hdf5storage.savemat(str(path), {"X": X, "u": U, "t": 0.25, "J": 1 + X[:, :1], "name": "words"}, format="7.3")
    # In the layout of MATLAB itself: all axes in reverse, a class beside each array, and 512 bytes before the file.
    path = HERE / "matlab_single.mat"
    with h5py.File(path, "w", userblock_size=512) as f:
        for name, value, kind in [("X", X, "double"), ("u", U.astype("f4"), "single"), ("t", [[0.25]], "double"),
                                  ("row", numpy.arange(9.0)[None], "double"),
                                  ("F", numpy.arange(36.0).reshape(9, 2, 2), "double"),
                                  ("word", numpy.array([[119, 111]], "u2"), "char")]:
            f[name] = numpy.asarray(value).T
            f[name].attrs["MATLAB_class"] = numpy.bytes_(kind)
        f["none"] = numpy.zeros(2, "u8")
        f["none"].attrs["MATLAB_class"] = numpy.bytes_("double")
        f["none"].attrs["MATLAB_empty"] = numpy.uint8(1)
        f["#refs#/a"] = numpy.zeros((2, 2))
    with open(path, "r+b") as f:
        f.write(b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(116) + bytes(8) + b"\x00\x02IM")


def with_netcdf():
    for kind in ["NETCDF3_CLASSIC", "NETCDF3_64BIT_OFFSET", "NETCDF3_64BIT_DATA", "NETCDF4", "NETCDF4_CLASSIC"]:
        with netCDF4.Dataset(HERE / f"{kind.lower()}.nc", "w", format=kind) as f:
            for name, length in [("time", None), ("point", 9), ("axis", 2), ("letters", 8)]:
                f.createDimension(name, length)
            f.createVariable("time", "f8", ("time",))[:] = TIMES
            f.createVariable("X", "f8", ("point", "axis"))[:] = X
            single = f.createVariable("v", "f4", ("point", "axis"))
            single[:] = U
            single.units = "m/s"
            f.createVariable("kind", "i2", ("point",))[:] = range(9)
            f.createVariable("words", "S1", ("axis", "letters"))[:] = netCDF4.stringtochar(numpy.array(["a", "bc"], "S8"))
            u = f.createVariable("u", "f8", ("time", "point", "axis"))
            short = f.createVariable("odd", "i2", ("time",))
            for i, t in enumerate(TIMES):
                u[i] = at(t)
                short[i] = i
            f.title = "a run"


# Elements of Exodus, each with its nodes at the places in the manual, in units of half an edge.
CORNERS = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
HEX27 = CORNERS + [(1, 0, 0), (2, 1, 0), (1, 2, 0), (0, 1, 0), (0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1),
                   (1, 0, 2), (2, 1, 2), (1, 2, 2), (0, 1, 2),
                   (1, 1, 1), (1, 1, 0), (1, 1, 2), (0, 1, 1), (2, 1, 1), (1, 0, 1), (1, 2, 1)]
TET10 = [(0, 0, 0), (2, 0, 0), (0, 2, 0), (0, 0, 2), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1)]
FLAT = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (1, 0, 0), (2, 1, 0), (1, 2, 0), (0, 1, 0), (1, 1, 0)]
TRI6 = [(0, 0, 0), (2, 0, 0), (0, 2, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
WEDGE = [(0, 0, 0), (2, 0, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (0, 2, 2)]
PYRAMID = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2)]
BAR = [(0, 0, 0), (2, 0, 0), (1, 0, 0)]
ELEMENTS = [("HEX8", HEX27[:8]), ("HEX20", HEX27[:20]), ("HEX27", HEX27), ("TETRA4", TET10[:4]), ("TETRA10", TET10),
            ("QUAD4", FLAT[:4]), ("QUAD8", FLAT[:8]), ("QUAD9", FLAT), ("TRI3", TRI6[:3]), ("TRI6", TRI6),
            ("WEDGE", WEDGE), ("PYRAMID", PYRAMID), ("BAR2", BAR[:2]), ("EDGE3", BAR), ("SHELL4", FLAT[:4])]


def exodus(name, kind, points, blocks, times, nodal, elemental=(), is_old=False):
    """Writes a file as libraries of Exodus do, including the one of MOOSE. `nodal` and `elemental` return values at a time."""
    with netCDF4.Dataset(HERE / name, "w", format=kind) as f:
        f.api_version = f.version = numpy.float32(5.22)
        f.floating_point_word_size = numpy.int32(8)
        f.file_size = numpy.int32(1)
        f.title = "a run"
        dims = dict(len_name=33, num_dim=points.shape[1], num_nodes=len(points), num_elem=sum(len(b) for _, b in blocks),
                    num_el_blk=len(blocks), time_step=None)
        if nodal:
            dims["num_nod_var"] = len(nodal)
        if elemental:
            dims["num_elem_var"] = len(elemental)
        for key, length in dims.items():
            f.createDimension(key, length)
        f.createVariable("time_whole", "f8", ("time_step",))[:] = times
        f.createVariable("eb_prop1", "i4", ("num_el_blk",))[:] = range(1, len(blocks) + 1)
        if is_old:
            f.createVariable("coord", "f8", ("num_dim", "num_nodes"))[:] = points.T
        else:
            for axis in range(points.shape[1]):
                f.createVariable("coord" + "xyz"[axis], "f8", ("num_nodes",))[:] = points[:, axis]
        for at_block, (element, cells) in enumerate(blocks, 1):
            f.createDimension(f"num_el_in_blk{at_block}", len(cells))
            f.createDimension(f"num_nod_per_el{at_block}", len(cells[0]))
            v = f.createVariable(f"connect{at_block}", "i4", (f"num_el_in_blk{at_block}", f"num_nod_per_el{at_block}"))
            v.elem_type = element
            v[:] = numpy.array(cells) + 1
        def names(key, dim, all_names):
            v = f.createVariable(key, "S1", (dim, "len_name"))
            for at_name, text in enumerate(all_names):
                v[at_name] = netCDF4.stringtochar(numpy.array([text], "S33"))[0]
        if nodal:
            names("name_nod_var", "num_nod_var", [n for n, _ in nodal])
        if nodal and is_old:
            v = f.createVariable("vals_nod_var", "f8", ("time_step", "num_nod_var", "num_nodes"))
            for i, t in enumerate(times):
                v[i] = [value(t) for _, value in nodal]
        for at_name, (_, value) in enumerate(nodal, 1) if not is_old else []:
            v = f.createVariable(f"vals_nod_var{at_name}", "f8", ("time_step", "num_nodes"))
            for i, t in enumerate(times):
                v[i] = value(t)
        if elemental:
            names("name_elem_var", "num_elem_var", [n for n, _ in elemental])
            for at_name, (_, value) in enumerate(elemental, 1):
                start = 0
                for at_block, (_, cells) in enumerate(blocks, 1):
                    v = f.createVariable(f"vals_elem_var{at_name}eb{at_block}", "f8", ("time_step", f"num_el_in_blk{at_block}"))
                    for i, t in enumerate(times):
                        v[i] = value(t)[start:start + len(cells)]
                    start += len(cells)


def with_exodus():
    nodal = [("disp_x", lambda t: at(t)[:, 0]), ("disp_y", lambda t: at(t)[:, 1]), ("temp", lambda t: 0 * X[:, 0] + t)]
    middle = [("middle", lambda t: MIDDLE), ("time_of", lambda t: 0 * MIDDLE + t)]
    blocks = [("QUAD4", QUADS[:1]), ("QUAD4", QUADS[1:])]
    for kind in ["NETCDF3_64BIT_OFFSET", "NETCDF4"]:
        exodus(f"moose_{kind.lower()}.e", kind, X, blocks, TIMES, nodal, middle)
    exodus("old.exo", "NETCDF3_CLASSIC", X, blocks, TIMES, nodal[:2], is_old=True)
    points, all_blocks = [], []
    for name, nodes in ELEMENTS:
        all_blocks.append((name, [list(range(len(points), len(points) + len(nodes)))]))
        points += nodes
    exodus("elements.e", "NETCDF3_64BIT_OFFSET", numpy.array(points) / 2.0, all_blocks, [], [])
    read = vtk.vtkExodusIIReader()
    read.SetFileName(str(HERE / "elements.e"))
    read.UpdateInformation()
    read.Update()
    # The places of VTK's nodes for each element, and its type.
    lines = []
    blocks_read = read.GetOutput().GetBlock(0)
    for i in range(blocks_read.GetNumberOfBlocks()):
        grid = blocks_read.GetBlock(i)
        cell = grid.GetCell(0)
        places = [grid.GetPoint(cell.GetPointId(k)) for k in range(cell.GetNumberOfPoints())]
        lines.append(" ".join([str(cell.GetCellType())] + [f"{x:g}" for p in places for x in p]))
    (HERE / "elements.txt").write_text("\n".join(lines) + "\n")
    meshio.Mesh(X3, [("quad", QUADS)], point_data={"u_x": U[:, 0], "u_y": U[:, 1]}).write(HERE / "meshio.e")


def array(name, values):
    found = numpy_to_vtk(numpy.ascontiguousarray(values), deep=True)
    found.SetName(name)
    return found


def filled(grid, time, points=X3):
    places = vtk.vtkPoints()
    places.SetData(array("Points", points))
    grid.SetPoints(places)
    grid.GetPointData().AddArray(array("u", (1 + time) * U3))
    grid.GetCellData().AddArray(array("middle", MIDDLE))
    cells = vtk.vtkCellArray()
    for quad in QUADS:
        cells.InsertNextCell(4, quad)
    return cells


def unstructured(time, points=X3):
    grid = vtk.vtkUnstructuredGrid()
    grid.SetCells(vtk.VTK_QUAD, filled(grid, time, points))
    return grid


def surface(time):
    grid = vtk.vtkPolyData()
    grid.SetPolys(filled(grid, time))
    return grid


class Source(VTKPythonAlgorithmBase):
    """A filter that outputs a grid at several times."""

    def __init__(self, make, kind):
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType=kind)
        self.make = make

    def RequestInformation(self, request, inputs, outputs):
        info = outputs.GetInformationObject(0)
        for i, t in enumerate(TIMES):
            info.Append(vtk.vtkStreamingDemandDrivenPipeline.TIME_STEPS(), t)
        info.Set(vtk.vtkStreamingDemandDrivenPipeline.TIME_RANGE(), [TIMES[0], TIMES[-1]], 2)
        return 1

    def RequestData(self, request, inputs, outputs):
        info = outputs.GetInformationObject(0)
        key = vtk.vtkStreamingDemandDrivenPipeline.UPDATE_TIME_STEP()
        time = info.Get(key) if info.Has(key) else TIMES[0]
        out = info.Get(vtk.vtkDataObject.DATA_OBJECT())
        out.ShallowCopy(self.make(time))
        out.GetInformation().Set(vtk.vtkDataObject.DATA_TIME_STEP(), time)
        return 1


def with_vtkhdf():
    for name, make in [("grid", unstructured), ("surface", surface)]:
        write = vtk.vtkHDFWriter()
        write.SetChunkSize(8)
        write.SetFileName(str(HERE / f"vtk_{name}.vtkhdf"))
        grid = make(0.0)
        grid.GetFieldData().AddArray(array("TimeValue", numpy.array([0.0])))
        write.SetInputData(grid)
        write.Write()
        write = vtk.vtkHDFWriter()
        source = Source(make, f"vtk{'UnstructuredGrid' if name == 'grid' else 'PolyData'}")
        write.SetInputConnection(source.GetOutputPort())
        write.SetWriteAllTimeSteps(True)
        write.SetChunkSize(8)
        write.SetCompressionLevel(4)
        write.SetFileName(str(HERE / f"vtk_{name}_times.vtkhdf"))
        write.Write()
    # Two pieces, and a mesh that is written for each step, which the format allows.
    with h5py.File(HERE / "pieces.vtkhdf", "w") as f:
        g = f.create_group("VTKHDF")
        g.attrs["Version"] = numpy.array([2, 0])
        g.attrs.create("Type", b"UnstructuredGrid", dtype=h5py.string_dtype("ascii", 16))
        halves = [(X3[:6], QUADS[:2], U3[:6]), (X3[3:], QUADS[2:] - 3, U3[3:])]
        steps = [(p, c, (1 + t) * u) for t in TIMES for p, c, u in halves]
        g["NumberOfPoints"] = [len(p) for p, _, _ in steps]
        g["NumberOfCells"] = [len(c) for _, c, _ in steps]
        g["NumberOfConnectivityIds"] = [c.size for _, c, _ in steps]
        g["Points"] = numpy.concatenate([p for p, _, _ in steps])
        g["Connectivity"] = numpy.concatenate([c.ravel() for _, c, _ in steps])
        g["Offsets"] = numpy.concatenate([numpy.arange(len(c) + 1) * 4 for _, c, _ in steps])
        g["Types"] = numpy.full(12, 9, "u1")
        g["PointData/u"] = numpy.concatenate([u for _, _, u in steps])
        g["CellData/middle"] = numpy.concatenate([MIDDLE] * 3)
        s = g.create_group("Steps")
        s.attrs["NSteps"] = 3
        s["Values"] = TIMES
        s["PartOffsets"] = [0, 2, 4]
        s["NumberOfParts"] = [2, 2, 2]
        s["PointOffsets"] = [0, 12, 24]
        s["CellOffsets"] = [[0], [4], [8]]
        s["ConnectivityIdOffsets"] = [[0], [16], [32]]
        s["PointDataOffsets/u"] = [0, 12, 24]
        s["CellDataOffsets/middle"] = [0, 4, 8]
    with h5py.File(HERE / "image.vtkhdf", "w") as f:
        g = f.create_group("VTKHDF")
        g.attrs["Version"] = numpy.array([1, 0])
        g.attrs.create("Type", b"ImageData", dtype=h5py.string_dtype("ascii", 9))
        g.attrs["WholeExtent"] = [0, 2, 0, 2, 0, 0]
        g.attrs["Origin"] = [0.0, 0.0, 0.0]
        g.attrs["Spacing"] = [0.5, 0.5, 1.0]
        g.attrs["Direction"] = numpy.eye(3).ravel()
        g["PointData/u"] = U3.reshape(1, 3, 3, 3)
        g["CellData/middle"] = MIDDLE.reshape(1, 2, 2)


DOCUMENT = '<?xml version="1.0"?>\n<!DOCTYPE Xdmf SYSTEM "Xdmf.dtd" []>\n'


def with_xdmf():
    mesh = meshio.Mesh(X3, [("quad", QUADS)], point_data={"u": U3}, cell_data={"middle": [MIDDLE]})
    mixed = meshio.Mesh(X, [("triangle", TRIANGLES[:2]), ("quad", QUADS[1:])], point_data={"u": U})
    os.chdir(HERE)
    for kind in ["XML", "Binary", "HDF"]:
        meshio.xdmf.write(f"meshio_{kind.lower()}.xdmf", mesh, data_format=kind)
    meshio.xdmf.write("meshio_mixed.xdmf", mixed, data_format="XML")
    with meshio.xdmf.TimeSeriesWriter("meshio_times.xdmf") as write:
        write.write_points_cells(X3, [("quad", QUADS)])
        for t in TIMES:
            write.write_data(t, point_data={"u": numpy.column_stack([at(t), X[:, 0] * 0])}, cell_data={"middle": [MIDDLE]})
    # The layout of dolfinx: a mesh, and a collection over time for each function, which points to it.
    with h5py.File("dolfinx.h5", "w") as f:
        f["Mesh/mesh/geometry"] = X
        f["Mesh/mesh/topology"] = TRIANGLES.astype("i8")
        for t in TIMES:
            f[f"Function/u/{t:g}".replace(".", "_")] = numpy.column_stack([at(t), 0 * X[:, 0]])
            f[f"Function/J/{t:g}".replace(".", "_")] = 1 + X[:, :1]
    def series(name, kind, size):
        head = f'    <Grid Name="{name}" GridType="Collection" CollectionType="Temporal">\n'
        grids = ""
        for t in TIMES:
            path = f"/Function/{name}/{t:g}".replace(".", "_")
            grids += (
                f'      <Grid Name="{name}" GridType="Uniform">\n'
                '        <xi:include xpointer="xpointer(/Xdmf/Domain/Grid[@GridType=\'Uniform\'][1]/*[self::Topology or '
                'self::Geometry])" />\n'
                f'        <Time Value="{t:g}" />\n'
                f'        <Attribute Name="{name}" AttributeType="{kind}" Center="Node">\n'
                f'          <DataItem Dimensions="9 {size}" Format="HDF">dolfinx.h5:{path}</DataItem>\n'
                '        </Attribute>\n      </Grid>\n'
            )
        return head + grids + "    </Grid>\n"
    pathlib.Path("dolfinx.xdmf").write_text(
        DOCUMENT + '<Xdmf Version="3.0" xmlns:xi="https://www.w3.org/2001/XInclude">\n  <Domain>\n'
        '    <Grid Name="mesh" GridType="Uniform">\n'
        '      <Topology TopologyType="Triangle" NumberOfElements="8" NodesPerElement="3">\n'
        '        <DataItem Dimensions="8 3" NumberType="Int" Format="HDF">dolfinx.h5:/Mesh/mesh/topology</DataItem>\n'
        '      </Topology>\n      <Geometry GeometryType="XY">\n'
        '        <DataItem Dimensions="9 2" Format="HDF">dolfinx.h5:/Mesh/mesh/geometry</DataItem>\n'
        '      </Geometry>\n    </Grid>\n' + series("u", "Vector", 3) + series("J", "Scalar", 1)
        + "  </Domain>\n</Xdmf>\n")
    # The layout of dolfin: the mesh is in the first grid of the collection.
    with h5py.File("dolfin.h5", "w") as f:
        f["Mesh/0/mesh/geometry"] = X
        f["Mesh/0/mesh/topology"] = TRIANGLES.astype("u4")
        for i, t in enumerate(TIMES):
            f[f"VisualisationVector/{i}"] = numpy.column_stack([at(t), 0 * X[:, 0]])
        g = f.create_group("u/u_0")
        g["mesh/geometry"] = X
        g["mesh/topology"] = TRIANGLES.astype("i8")
        # Degrees of freedom in an arbitrary order: all nodes of one component precede those in the next one.
        order = numpy.random.default_rng(1).permutation(18).reshape(9, 2)
        vector = numpy.zeros(18)
        vector[order] = U
        g["vector"] = vector[:, None]
        g["cell_dofs"] = order[TRIANGLES].transpose(0, 2, 1).reshape(-1, 1).astype("u4")
        g["x_cell_dofs"] = numpy.arange(0, 49, 6)[:, None].astype("u4")
        g["cells"] = numpy.arange(8)[:, None].astype("u4")
    grids = ""
    for i, t in enumerate(TIMES):
        own = (
            '        <Topology NumberOfElements="8" TopologyType="Triangle" NodesPerElement="3">\n'
            '          <DataItem Dimensions="8 3" NumberType="UInt" Format="HDF">dolfin.h5:/Mesh/0/mesh/topology</DataItem>\n'
            '        </Topology>\n        <Geometry GeometryType="XY">\n'
            '          <DataItem Dimensions="9 2" Format="HDF">dolfin.h5:/Mesh/0/mesh/geometry</DataItem>\n'
            '        </Geometry>\n'
        )
        pointer = (
            '        <xi:include xpointer="xpointer(//Grid[@Name=&quot;TimeSeries_u&quot;]/Grid[1]/*[self::Topology or '
            'self::Geometry])" />\n'
        )
        grids += (
            ('      <Grid Name="mesh" GridType="Uniform">\n' + own if i == 0 else "      <Grid>\n" + pointer)
            + f'        <Time Value="{t:g}" />\n        <Attribute Name="u" AttributeType="Vector" Center="Node">\n'
            f'          <DataItem Dimensions="9 3" Format="HDF">dolfin.h5:/VisualisationVector/{i}</DataItem>\n'
            '        </Attribute>\n      </Grid>\n'
        )
    start = '<Xdmf Version="3.0" xmlns:xi="http://www.w3.org/2001/XInclude">\n  <Domain>\n'
    pathlib.Path("dolfin.xdmf").write_text(
        '<?xml version="1.0"?>\n' + start + '    <Grid Name="TimeSeries_u" GridType="Collection" CollectionType="Temporal">\n'
        + grids + "    </Grid>\n  </Domain>\n</Xdmf>\n")
    item = '            <DataItem Dimensions="{}" NumberType="{}" Format="HDF">dolfin.h5:u/u_0/{}</DataItem>\n'
    pathlib.Path("dolfin_checkpoint.xdmf").write_text(
        '<?xml version="1.0"?>\n' + start + '    <Grid Name="u" GridType="Collection" CollectionType="Temporal">\n'
        '      <Grid Name="u_0" GridType="Uniform">\n'
        '        <Topology NumberOfElements="8" TopologyType="Triangle" NodesPerElement="3">\n'
        + item.format("8 3", "Int", "mesh/topology") + '        </Topology>\n        <Geometry GeometryType="XY">\n'
        + item.format("9 2", "Float", "mesh/geometry") + '        </Geometry>\n        <Time Value="0" />\n'
        '        <Attribute ItemType="FiniteElementFunction" ElementFamily="CG" ElementDegree="1" ElementCell="triangle" '
        'Name="u" Center="Other" AttributeType="Vector">\n'
        + item.format("48 1", "UInt", "cell_dofs") + item.format("18 1", "Float", "vector")
        + item.format("9 1", "UInt", "x_cell_dofs") + item.format("8 1", "UInt", "cells")
        + "        </Attribute>\n      </Grid>\n    </Grid>\n  </Domain>\n</Xdmf>\n")


HERE.mkdir(exist_ok=True)
for make in [with_h5py, with_matlab, with_netcdf, with_exodus, with_vtkhdf, with_xdmf]:
    if len(sys.argv) < 2 or make.__name__.endswith(sys.argv[1]):
        make()
