"""Writes the files of Gmsh beside this script, with gmsh and with meshio.

Needs gmsh and meshio. The files contain the data of ../gmsh.rs: elements of each type at the places of the reference cell
of VTK, one beside the other along X, with nodes in the order of gmsh, and u = t (0.1 X Y, -0.2 X, 0.05 Z) at all nodes. A
square of two triangles with its boundary, u at the nodes of elements, and J = 1 + X at the middles of the triangles alone.
And the grid of write.py by meshio, which with NumPy 2 writes numbers in text as `np.float64(0.5)`.
"""

import pathlib

import gmsh
import meshio
import numpy

HERE = pathlib.Path(__file__).parent
# Orders 3 to 5.
HIGHER = {1: [26, 27, 28], 2: [21, 23, 25, 36, 37, 38], 3: [29, 30, 31, 92, 93, 94]}
# By dimension: the type numbers of Gmsh. Quadrilaterals, hexahedra and so on extend from -1 to 1.
TYPES = {1: [1, 8], 2: [2, 3, 9, 10, 16], 3: [4, 5, 6, 7, 11, 12, 13, 17, 18, 19]}
FROM_MINUS_1 = {1: (0,), 8: (0,), 3: (0, 1), 10: (0, 1), 16: (0, 1), 5: (0, 1, 2), 12: (0, 1, 2), 17: (0, 1, 2),
                6: (2,), 13: (2,), 18: (2,), 7: (0, 1), 19: (0, 1)}
for at, kinds in enumerate([[26, 27, 28], [36, 37, 38], [92, 93, 94]], 1):
    FROM_MINUS_1.update({it: tuple(range(at)) for it in kinds})


def model(name, types=TYPES):
    """The elements, with numbers of nodes that have gaps."""
    gmsh.clear()
    gmsh.model.add(name)
    node, element, count = 11, 101, 0
    for dimension, kinds in types.items():
        gmsh.model.addDiscreteEntity(dimension, dimension)
        for kind in kinds:
            _, axes, _, nodes, local, corners = gmsh.model.mesh.getElementProperties(kind)
            places = numpy.zeros((nodes, 3))
            places[:, :axes] = numpy.reshape(local, (nodes, axes))
            for axis in FROM_MINUS_1.get(kind, ()):
                places[:, axis] = (places[:, axis] + 1) / 2
            # In Gmsh a pyramid's apex is above the middle of its base, in VTK above the first corner.
            if kind in (7, 19):
                places[:, :2] -= places[:, 2:] / 2
            places[:, 0] += 2 * count
            tags = range(node, node + nodes)
            gmsh.model.mesh.addNodes(dimension, dimension, tags, places.ravel())
            gmsh.model.mesh.addElementsByType(dimension, kind, [element], tags)
            node, element, count = node + nodes + 2, element + 1, count + 1
    # In version 2.2, Gmsh renumbers nodes that are in no group.
    for dimension in TYPES:
        gmsh.model.addPhysicalGroup(dimension, [dimension], name=f"part {dimension}")


def nodes():
    tags, places, _ = gmsh.model.mesh.getNodes()
    return tags, places.reshape(-1, 3)


def views(name):
    tags, x = nodes()
    u, words = gmsh.view.add("u"), gmsh.view.add("corners")
    for step, time in enumerate([0.25, 0.5]):
        values = time * numpy.column_stack([0.1 * x[:, 0] * x[:, 1], -0.2 * x[:, 0], 0.05 * x[:, 2]])
        gmsh.view.addHomogeneousModelData(u, step, name, "NodeData", tags, values.ravel(), time, 3)
    gmsh.view.addModelData(words, 0, name, "ElementNodeData", [101], [[1.0, 2.0]], 0.25, 1)
    return u, words


def square(name):
    gmsh.clear()
    gmsh.model.add(name)
    gmsh.model.addDiscreteEntity(1, 1)
    gmsh.model.addDiscreteEntity(2, 2)
    places = numpy.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 7]])
    gmsh.model.mesh.addNodes(2, 2, [9, 4, 5, 6, 2], places.ravel())
    gmsh.model.mesh.addElementsByType(1, 1, [1, 2, 3, 4], [9, 4, 4, 5, 5, 6, 6, 9])
    gmsh.model.mesh.addElementsByType(2, 2, [7, 5], [9, 4, 5, 9, 5, 6])
    u, J, s = gmsh.view.add("u"), gmsh.view.add("J"), gmsh.view.add("sigma")
    values = numpy.column_stack([0.1 * places[:, 0] * places[:, 1], -0.2 * places[:, 0], 0 * places[:, 0]])
    gmsh.view.addHomogeneousModelData(u, 0, name, "NodeData", [5, 6, 4, 9], values[[2, 3, 1, 0]].ravel(), 0, 3)
    gmsh.view.addHomogeneousModelData(J, 0, name, "ElementData", [7, 5], [1 + 2 / 3, 1 + 1 / 3], 0, 1)
    stress = [[10.0 * at + it for it in range(9)] for at in range(4)]
    gmsh.view.addHomogeneousModelData(s, 0, name, "NodeData", [9, 4, 5, 6], numpy.ravel(stress), 0, 9)
    return u, J, s


def parametric():
    """The unit square with nodes that have parameters, and with sides that are periodic."""
    gmsh.clear()
    gmsh.model.add("parametric")
    gmsh.model.occ.addRectangle(0, 0, 0, 1, 1)
    gmsh.model.occ.synchronize()
    for curve in [1, 2, 3, 4]:
        gmsh.model.mesh.setTransfiniteCurve(curve, 3)
    gmsh.model.mesh.setTransfiniteSurface(1)
    gmsh.model.mesh.setPeriodic(1, [2], [4], [1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1])
    gmsh.model.mesh.generate(2)
    tags, x = nodes()
    u = gmsh.view.add("u")
    values = numpy.column_stack([0.1 * x[:, 0] * x[:, 1], -0.2 * x[:, 0], 0 * x[:, 0]])
    gmsh.view.addHomogeneousModelData(u, 0, "parametric", "NodeData", tags, values.ravel(), 0.5, 3)
    gmsh.option.setNumber("Mesh.SaveParametric", 1)
    gmsh.option.setNumber("PostProcessing.SaveMesh", 0)
    gmsh.option.setNumber("Mesh.MshFileVersion", 4.1)
    for binary, form in enumerate(["text", "binary"]):
        gmsh.option.setNumber("Mesh.Binary", binary)
        path = str(HERE / f"gmsh_parametric_41_{form}.msh")
        gmsh.write(path)
        gmsh.view.write(u, path, True)


def with_gmsh():
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.option.setNumber("Mesh.SaveAll", 1)
    for version, binary in [(2.2, 0), (2.2, 1), (4.0, 0), (4.1, 0), (4.1, 1)]:
        for make, name in [(model, "gmsh"), (square, "gmsh_square")]:
            found = make(name)
            if make is model:
                found = views(name)
            gmsh.option.setNumber("Mesh.MshFileVersion", version)
            gmsh.option.setNumber("Mesh.Binary", binary)
            path = HERE / f"{name}_{str(version).replace('.', '')}_{'binary' if binary else 'text'}.msh"
            gmsh.write(str(path))
            # The mesh is written again with the first view only.
            for at, view in enumerate(found):
                gmsh.option.setNumber("PostProcessing.SaveMesh", int(at == 0))
                gmsh.view.write(view, str(path), True)
    model("higher", HIGHER)
    gmsh.option.setNumber("Mesh.Binary", 1)
    gmsh.write(str(HERE / "gmsh_higher_41_binary.msh"))
    parametric()
    gmsh.finalize()


def with_meshio():
    reference = numpy.array([[i / 2, j / 2, 0.0] for j in range(3) for i in range(3)])
    u = numpy.column_stack([0.1 * reference[:, 0] * reference[:, 1], -0.2 * reference[:, 0], 0 * reference[:, 0]])
    quads = numpy.array([[i + 3 * j, i + 1 + 3 * j, i + 4 + 3 * j, i + 3 + 3 * j] for j in range(2) for i in range(2)])
    mesh = meshio.Mesh(reference, [("quad", quads)], point_data={"u": u},
                       cell_data={"middle": [reference[quads, 0].mean(axis=1)]})
    for version, name in [("2.2", "22"), ("4.0", "40"), ("4.1", "41")]:
        for binary in [False, True]:
            path = HERE / f"meshio_{name}_{'binary' if binary else 'text'}.msh"
            meshio.gmsh.write(path, mesh, version, binary=binary)


with_gmsh()
with_meshio()
