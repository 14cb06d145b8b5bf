"""Reads merged meshes with programs of others: a function for each format, all with the same answer. VTK reads .vtk and
.cgns, Gmsh .unv, meshio .med. cgnscheck and libmed's tools have to find nothing wrong. FEBio was not at hand: Python's
reader of XML is asked for what its specification says.
"""

import contextlib
import dataclasses
import io
import subprocess
import xml.etree.ElementTree

import gmsh
import h5py
import meshio
import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

ENDINGS = ("vtk", "unv", "med", "cgns", "feb")
# VTK's places of the nodes of Gmsh's cells, and of MED's, which are seen from the other side.
FROM_GMSH = [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]
FROM_MED = [0, 2, 1, 3, 6, 5, 4, 7, 9, 8]


class Unfit(Exception):
    pass


@dataclasses.dataclass
class Mesh:
    """Cells by the coordinates of their nodes, in VTK's order, and the names of what they are of."""

    nodes: int
    tets: np.ndarray  # of cells, their nodes, coordinates
    triangles: np.ndarray
    regions: np.ndarray  # a name for each tetrahedron; "volume" or "body_1" ... where there are no regions
    patches: np.ndarray  # a name for each triangle

    def volume(self):
        """By a rule that is exact for cells of order 2, none of which may be inverted."""
        return float((determinants(self.tets) @ RULE[1]).sum())

    def areas(self):
        """Of the corners, by patch, in the order in which patches come."""
        a, b, c = (self.triangles[:, i] for i in range(3))
        area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
        return {name: float(area[self.patches == name].sum()) for name in dict.fromkeys(self.patches)}

    def cells_by_region(self):
        return dict(zip(*np.unique(self.regions, return_counts=True)))

    def triangles_by_patch(self):
        return dict(zip(*np.unique(self.patches, return_counts=True)))


def collapsed_rule(points):
    """Gauss's rule on the cube, collapsed to the tetrahedron: exact to the degree 2 * points - 3."""
    x, w = np.polynomial.legendre.leggauss(points)
    x, w = (x + 1) / 2, w / 2
    a, b, c = (grid.ravel() for grid in np.meshgrid(x, x, x))
    weights = np.multiply.outer(np.multiply.outer(w, w), w).transpose(1, 0, 2).ravel()
    return np.stack([a * (1 - b) * (1 - c), b * (1 - c), c], axis=1), weights * (1 - b) * (1 - c) ** 2


RULE = collapsed_rule(4)
EDGES = ((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3))


def determinants(tets):
    """Those of the Jacobians at the points of the rule; all must be positive."""
    barycentric = np.column_stack([1 - RULE[0].sum(axis=1), RULE[0]])
    of_corner = np.vstack([-np.ones(3), np.eye(3)])  # gradients of barycentric coordinates
    if tets.shape[1] == 4:
        gradients = np.broadcast_to(of_corner, (len(barycentric), 4, 3))
    else:
        corners = (4 * barycentric - 1)[:, :, None] * of_corner
        edges = [4 * (barycentric[:, [i]] * of_corner[j] + barycentric[:, [j]] * of_corner[i]) for i, j in EDGES]
        gradients = np.concatenate([corners, np.stack(edges, axis=1)], axis=1)
    found = np.linalg.det(np.einsum("tnx,pny->tpxy", tets, gradients))
    if found.min() <= 0:
        raise Unfit("an inverted cell")
    return found


def tool(*command):
    """The output of a program, which must end well."""
    done = subprocess.run([str(word) for word in command], capture_output=True, encoding="utf-8", timeout=60)
    if done.returncode != 0:
        raise Unfit(f"{command} ends with {done.returncode}: {done.stdout}{done.stderr}")
    return done.stdout


def cells_of_grid(grid, kinds):
    """Nodes of the cells of some of VTK's types, and where those are among the cells."""
    nodes = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    offsets = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
    chosen = np.isin(vtk_to_numpy(grid.GetCellTypesArray()), kinds)
    size = np.unique(np.diff(offsets)[chosen])
    points = vtk_to_numpy(grid.GetPoints().GetData())
    return points[nodes[offsets[:-1][chosen][:, None] + np.arange(size[0])]], chosen


TETS, TRIANGLES = (vtk.VTK_TETRA, vtk.VTK_QUADRATIC_TETRA), (vtk.VTK_TRIANGLE, vtk.VTK_QUADRATIC_TRIANGLE)


def read_vtk(path):
    reader = vtk.vtkUnstructuredGridReader()
    reader.SetFileName(path)
    reader.ReadAllFieldsOn()
    reader.Update()
    grid = reader.GetOutput()
    tets, are_tets = cells_of_grid(grid, TETS)
    triangles, are_triangles = cells_of_grid(grid, TRIANGLES)

    def names(array, cells):
        if grid.GetCellData().GetArray(array) is None:
            return np.full(cells.sum(), "volume")
        called = bytes(vtk_to_numpy(grid.GetFieldData().GetArray(array + "Names"))).decode().split("\0")[:-1]
        return np.array(called)[vtk_to_numpy(grid.GetCellData().GetArray(array))[cells]]

    return Mesh(grid.GetNumberOfPoints(), tets, triangles, names("Region", are_tets), names("Patch", are_triangles))


def read_unv(path):
    gmsh.clear()
    gmsh.open(path)
    tags, points, _ = gmsh.model.mesh.getNodes()
    place = np.full(int(tags.max()) + 1, -1)
    place[tags] = np.arange(len(tags))
    points = points.reshape(-1, 3)
    cells, names = {2: [], 3: []}, {2: [], 3: []}
    for dimension, group in gmsh.model.getPhysicalGroups():
        for entity in gmsh.model.getEntitiesForPhysicalGroup(dimension, group):
            kinds, elements, nodes = gmsh.model.mesh.getElements(dimension, entity)
            for numbers, of_kind in zip(elements, nodes):
                cells[dimension].append(points[place[of_kind.reshape(len(numbers), -1)]])
                names[dimension] += [gmsh.model.getPhysicalName(dimension, group)] * len(numbers)
    tets, triangles = np.concatenate(cells[3]), np.concatenate(cells[2])
    return Mesh(len(tags), tets[:, FROM_GMSH[: tets.shape[1]]], triangles, np.array(names[3]), np.array(names[2]))


def read_med(path):
    if "conforme" not in tool("medconforme", path):
        raise Unfit(f"medconforme does not like {path}")
    mesh = meshio.read(path)
    kinds, groups, tags = {"tetra": 4, "tetra10": 10, "triangle": 3, "triangle6": 6}, mesh.cell_tags, {}
    cells, counts = {}, tool("mdump", "--structure", path, "NODALE", "FULL_INTERLACE", 0)
    for block, of_block in zip(mesh.cells, mesh.cell_data["cell_tags"]):
        med_kind = ("MED_TETRA" if block.type.startswith("tetra") else "MED_TRIA") + str(kinds[block.type])
        if f"mailles de type {med_kind} : {len(block.data)} " not in counts:
            raise Unfit(f"libmed finds other cells in {path}:\n{counts}")
        dimension = 3 if block.type.startswith("tetra") else 2
        cells[dimension] = mesh.points[block.data]
        tags[dimension] = np.array([groups[tag][0] for tag in of_block])
    tets = cells[3][:, np.argsort(FROM_MED)] if cells[3].shape[1] == 10 else cells[3][:, FROM_MED[:4]]
    return Mesh(len(mesh.points), tets, cells[2], tags[3], tags[2])


def read_cgns(path):
    checked = tool("cgnscheck", path)
    if "ERROR" in checked or "checking complete" not in checked:
        raise Unfit(f"cgnscheck: {checked}")
    reader = vtk.vtkCGNSReader()
    reader.SetFileName(path)
    reader.UpdateInformation()
    reader.EnableAllBases()
    reader.SetLoadBndPatch(1)
    reader.Update()
    zone = reader.GetOutput().GetBlock(0).GetBlock(0)
    inside, patches = zone.GetBlock(0), zone.GetBlock(1)
    triangles, names = [], []
    for i in range(patches.GetNumberOfBlocks()):
        triangles.append(cells_of_grid(patches.GetBlock(i), TRIANGLES)[0])
        names += [patches.GetMetaData(i).Get(vtk.vtkCompositeDataSet.NAME())] * len(triangles[-1])
    tets, _ = cells_of_grid(inside, TETS)
    with h5py.File(path) as file:  # VTK does not tell sections of a zone apart
        sections = [node for node in file["Base/Zone"].values() if node.attrs.get("label") == b"Elements_t"]
        sections = [node for node in sections if node[" data"][0] in (10, 11)]  # TETRA_4, TETRA_10
        ranges = {tuple(node["ElementRange/ data"]): node.attrs["name"].decode() for node in sections}
        regions = np.concatenate([np.full(last - first + 1, ranges[first, last]) for first, last in sorted(ranges)])
    return Mesh(inside.GetNumberOfPoints(), tets, np.concatenate(triangles), regions, np.array(names))


def read_feb(path):
    root = xml.etree.ElementTree.parse(path).getroot()
    mesh, domains = root.find("Mesh"), root.find("MeshDomains")
    if root.get("version") != "4.0" or [child.tag for child in root] != ["Module", "Material", "Mesh", "MeshDomains"]:
        raise Unfit(f"{path} is no input of FEBio 4.0")
    materials = {material.get("name") for material in root.find("Material")}
    parts = {elements.get("name") for elements in mesh.findall("Elements")}
    if {domain.get("name") for domain in domains} != parts or {domain.get("mat") for domain in domains} - materials:
        raise Unfit(f"a part of {path} has no domain or no material")
    points = np.array([[float(x) for x in node.text.split(",")] for node in mesh.find("Nodes")])

    def cells(groups):
        rows = [[int(n) - 1 for n in cell.text.split(",")] for group in groups for cell in group]
        return points[np.array(rows)], np.array([group.get("name") for group in groups for _ in group])

    tets, regions = cells(mesh.findall("Elements"))
    triangles, patches = cells(mesh.findall("Surface"))
    return Mesh(len(points), tets, triangles, regions, patches)


def read(path):
    """Reads a file by its ending. Gmsh must be initialised. Throws Unfit."""
    gmsh.option.setNumber("General.Terminal", 0)
    with contextlib.redirect_stdout(io.StringIO()):
        return globals()["read_" + str(path).rsplit(".", 1)[1]](str(path))
