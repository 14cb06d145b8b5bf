"""Meshes given to meshio, VTK and PyVista, and surfaces taken from them. Others judge: meshio and VTK themselves.

PyVista is not in Debian 12: a stand-in of its registry of accessors, after its documentation, takes its place.
"""

import gc
import importlib
import json
import os
import subprocess
import sys
import types

import numpy as np
import pytest

import kerf
from region_boxes import two_boxes

meshio = pytest.importorskip("meshio")
pytest.importorskip("vtkmodules")
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy  # noqa: E402
from vtkmodules.vtkCommonDataModel import VTK_TETRA, VTK_TRIANGLE, vtkPolyData  # noqa: E402
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkTriangleFilter  # noqa: E402
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkLineSource  # noqa: E402
from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter  # noqa: E402
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter  # noqa: E402


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    return kerf.mesh(two_boxes(), parts=4, size=0.4, output=tmp_path_factory.mktemp("run") / "out")


@pytest.fixture(scope="module")
def mesh(run):
    return run.mesh()


@pytest.fixture(scope="module")
def cube_mesh():
    """With as many points as corners: every patch needs one of them."""
    triangles = [[0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7], [0, 1, 5], [0, 5, 4], [1, 2, 6], [1, 6, 5], [2, 3, 7],
                 [2, 7, 6], [3, 0, 4], [3, 4, 7]]
    points = [[x, y, z] for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
    return kerf.mesh(kerf.Surface(points, triangles, np.repeat(range(6), 2), [f"side {i}" for i in range(6)]), parts=1)


def sizes(grid):
    """Volumes or areas of the cells, as VTK computes them."""
    measure = vtkCellSizeFilter()
    measure.SetInputData(grid)
    measure.Update()
    data = measure.GetOutput().GetCellData()
    return vtk_to_numpy(data.GetArray("Volume")), vtk_to_numpy(data.GetArray("Area"))


def volumes(points, cells):
    a, b, c, d = (points[cells[:, i]] for i in range(4))
    return np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6


def test_meshio_has_the_cells(mesh):
    other = mesh.to_meshio()
    tets = other.get_cells_type("tetra")
    assert (len(other.points), len(tets)) == (len(mesh.points), len(mesh.tetrahedra))
    assert len(other.get_cells_type("triangle")) == len(mesh.triangles)
    for region, number in (("steel", 0), ("copper", 1)):
        cells = tets[other.cell_sets_dict[region]["tetra"]]
        assert np.array_equal(cells, mesh.tetrahedra[mesh.region == number])
        assert np.isclose(volumes(other.points, cells).sum(), 1)
    assert sorted(other.get_cell_data("part", "tetra")) == sorted(mesh.part)
    for number, name in enumerate(mesh.patch_names):
        assert len(other.cell_sets_dict[name]["triangle"]) == np.count_nonzero(mesh.patch == number)


@pytest.mark.parametrize("which", ["mesh", "cube_mesh"])
def test_names_survive_a_file_of_gmsh(which, request, tmp_path):
    mesh = request.getfixturevalue(which)
    mesh.to_meshio().write(tmp_path / "a.msh", "gmsh")
    back = meshio.read(tmp_path / "a.msh")
    regions_from = len(mesh.patch_names) + 1  # as kerf merge numbers them
    for dimension, first, names, numbers in ((3, regions_from, mesh.region_names, mesh.region),
                                             (2, 1, mesh.patch_names, mesh.patch)):
        kind = "tetra" if dimension == 3 else "triangle"
        tags = back.get_cell_data("gmsh:physical", kind)
        for number, name in enumerate(names):
            assert list(back.field_data[name]) == [first + number, dimension]
            assert np.count_nonzero(tags == first + number) == np.count_nonzero(numbers == number)
    own = volumes(mesh.points, mesh.tetrahedra).sum()
    assert np.isclose(volumes(back.points, back.get_cells_type("tetra")).sum(), own)


def test_names_survive_a_file_of_vtk(mesh, tmp_path):
    mesh.to_meshio().write(tmp_path / "a.vtu")
    back = meshio.read(tmp_path / "a.vtu")
    names = mesh.region_names + mesh.patch_names
    sets = back.get_cell_data("-".join(names), "triangle")
    assert all(np.array_equal(sets == names.index(name), back.get_cell_data("patch", "triangle") == number)
               for number, name in enumerate(mesh.patch_names))
    assert np.count_nonzero(back.get_cell_data("region", "tetra")) == np.count_nonzero(mesh.region)


def test_a_surface_of_meshio(cube_mesh, tmp_path):
    other = cube_mesh.to_meshio()
    other.write(tmp_path / "a.msh", "gmsh")
    other.write(tmp_path / "a.vtu")
    for source in (other, meshio.read(tmp_path / "a.msh")):
        surface = kerf.Surface.from_meshio(source)
        assert surface.names == cube_mesh.patch_names and np.isclose(surface.volume, 1)
        assert np.array_equal(np.bincount(surface.patches), np.bincount(cube_mesh.patch))
    named = kerf.Surface.from_meshio(meshio.read(tmp_path / "a.vtu"), patches="patch")
    assert named.names == [f"patch_{i}" for i in range(6)]
    bare = meshio.Mesh(other.points, [("triangle", cube_mesh.triangles), ("vertex", [[0]])])
    assert kerf.Surface.from_meshio(bare).names == ["patch_0"]
    rows = [np.flatnonzero(cube_mesh.patch < 2), np.flatnonzero(cube_mesh.patch >= 2)]
    bare.cell_sets = {"floor and lid": [rows[0], None], "walls": [rows[1], None]}
    assert kerf.Surface.from_meshio(bare).names == ["floor and lid", "walls"]


@pytest.mark.parametrize("source", ["meshio", "gmsh", "msh", "vtu"])
def test_regions_and_patches_of_meshio_keep_their_names(mesh, tmp_path, source):
    other = mesh.to_meshio()
    if source == "gmsh":
        other.write(tmp_path / "a.msh", "gmsh")
        other = meshio.read(tmp_path / "a.msh")
    elif source != "meshio":
        mesh.save(tmp_path / f"a.{source}")
        other = meshio.read(tmp_path / f"a.{source}")
    surface = kerf.Surface.from_meshio(other)
    assert sorted(surface.names) == sorted(mesh.patch_names) and surface.regions == mesh.region_names
    assert len(surface.triangles) == len(mesh.triangles)
    for name in mesh.patch_names:
        assert np.count_nonzero(surface.patches == surface.names.index(name)) == np.count_nonzero(
            mesh.patch == mesh.patch_names.index(name))
    again = kerf.mesh(surface, parts=2)
    assert again.region_names == mesh.region_names
    assert all(np.isclose(again.volumes[again.region == region].sum(), 1) for region in (0, 1))


def test_triangles_that_do_not_bound_all_regions_make_one_body(cube_mesh, mesh):
    """As those of a file without walls."""
    other = mesh.to_meshio()
    rows = [i for i, block in enumerate(other.cells) if block.type == "tetra" or other.cell_data["patch"][i][0] != 1]
    cells = [(other.cells[i].type, other.cells[i].data) for i in rows]
    outer = meshio.Mesh(other.points, cells, field_data=other.field_data,
                        cell_data={"gmsh:physical": [other.cell_data["gmsh:physical"][i] for i in rows]})
    surface = kerf.Surface.from_meshio(outer)
    assert surface.regions == [] and np.isclose(surface.volume, 2)
    assert kerf.Surface.from_meshio(cube_mesh.to_meshio()).regions == []


def test_groups_have_the_numbers_of_kerf_merge(run, mesh, tmp_path):
    run.merge(tmp_path / "a.msh")
    merged, own = meshio.read(tmp_path / "a.msh"), mesh.to_meshio()
    assert {name: list(value) for name, value in own.field_data.items()} == {
        name: list(value) for name, value in merged.field_data.items()}
    for kind in ("tetra", "triangle"):
        counts = (np.unique(each.get_cell_data("gmsh:physical", kind), return_counts=True) for each in (own, merged))
        assert all(np.array_equal(a, b) for a, b in zip(*counts))


def test_what_is_no_surface_of_meshio_is_refused(mesh):
    with pytest.raises(ValueError, match="no triangles"):
        kerf.Surface.from_meshio(meshio.Mesh(mesh.points, [("tetra", mesh.tetrahedra)]))
    with pytest.raises(ValueError, match="quad"):
        kerf.Surface.from_meshio(meshio.Mesh(mesh.points, [("quad", [[0, 1, 2, 3]])]))
    with pytest.raises(ValueError, match="no cell data 'inlet'"):
        kerf.Surface.from_meshio(mesh.to_meshio(), patches="inlet")


def test_vtk_has_the_cells(mesh):
    grid = mesh.to_vtk()
    volume, area = sizes(grid)
    types = vtk_to_numpy(grid.GetCellTypesArray())
    assert np.count_nonzero(types == VTK_TETRA) == len(mesh.tetrahedra)
    assert np.count_nonzero(types == VTK_TRIANGLE) == len(mesh.triangles)
    assert np.isclose(volume.sum(), 2) and volume[types == VTK_TETRA].min() > 0 and np.isclose(area.sum(), 11)
    data = grid.GetCellData()
    region, patch = (vtk_to_numpy(data.GetArray(name)) for name in ("Region", "Patch"))
    assert np.array_equal(region[types == VTK_TETRA], mesh.region) and np.isclose(volume[region == 1].sum(), 1)
    assert np.array_equal(patch[types == VTK_TRIANGLE], mesh.patch)


def test_the_points_of_a_grid_are_shared(mesh):
    copy = kerf.mesh(two_boxes(), parts=4, size=0.4)
    grid = copy.to_vtk()
    assert np.shares_memory(vtk_to_numpy(grid.GetPoints().GetData()), copy.points)
    del copy
    gc.collect()
    np.full(10**6, np.nan)
    assert np.array_equal(vtk_to_numpy(grid.GetPoints().GetData()), mesh.points)
    assert np.isclose(sizes(grid)[0].sum(), 2)


def test_names_survive_vtk(mesh, tmp_path):
    """In the form in which files of Kerf have them, of which kerf.read() takes those of regions."""
    writer, reader = vtkXMLUnstructuredGridWriter(), vtkXMLUnstructuredGridReader()
    writer.SetInputData(mesh.to_vtk())
    for each in (writer, reader):
        each.SetFileName(str(tmp_path / "a.vtu"))
    writer.Write()
    reader.Update()
    names = vtk_to_numpy(reader.GetOutput().GetFieldData().GetArray("PatchNames"))
    assert names.tobytes().decode().split("\0")[:-1] == mesh.patch_names
    surface = kerf.read(tmp_path / "a.vtu")
    assert surface.regions == mesh.region_names and np.isclose(surface.volume, 2)


def polydata_of_cube(with_line=False):
    cube, triangles = vtkCubeSource(), vtkTriangleFilter()
    triangles.SetInputConnection(cube.GetOutputPort())
    triangles.Update()
    polydata = vtkPolyData()
    polydata.DeepCopy(triangles.GetOutput())
    if with_line:
        line, both = vtkLineSource(), vtkAppendPolyData()
        both.AddInputConnection(line.GetOutputPort())
        both.AddInputData(polydata)
        both.Update()
        polydata.DeepCopy(both.GetOutput())
    return polydata


def test_a_surface_of_polydata():
    for with_line in (False, True):
        polydata = polydata_of_cube(with_line)
        assert np.isclose(kerf.Surface.from_pyvista(polydata).volume, 1)
        kinds = numpy_to_vtk(np.array([9] * with_line + [3, 3, 5, 5, 3, 3, 3, 3, 3, 3, 3, 3]), deep=True)
        kinds.SetName("kind")
        polydata.GetCellData().AddArray(kinds)
        surface = kerf.Surface.from_pyvista(polydata, patches="kind")
        assert surface.names == ["patch_3", "patch_5"] and np.count_nonzero(surface.patches) == 2
    with pytest.raises(ValueError, match="no cell data 'inlet'"):
        kerf.Surface.from_pyvista(polydata, patches="inlet")
    with pytest.raises(ValueError, match="no polygons"):
        kerf.Surface.from_pyvista(vtkPolyData())
    cube = vtkCubeSource()
    cube.Update()
    with pytest.raises(ValueError, match="triangulate"):
        kerf.Surface.from_pyvista(cube.GetOutput())


def test_a_run_gives_the_same(run, mesh):
    assert run.to_vtk().GetNumberOfCells() == mesh.to_vtk().GetNumberOfCells()
    assert np.array_equal(run.to_meshio().get_cells_type("tetra"), mesh.to_meshio().get_cells_type("tetra"))


def test_without_pyvista_the_way_out_is_named(mesh, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyvista", None)
    with pytest.raises(ImportError, match="pip install pyvista"):
        mesh.to_pyvista()


@pytest.fixture
def pyvista(monkeypatch):
    """A stand-in: data sets of VTK, and accessors that are made when they are first asked for."""
    class PolyData(vtkPolyData):
        pass

    def register_dataset_accessor(name, target_cls, *, override=False):
        def register(accessor):
            assert override or not hasattr(target_cls, name)
            setattr(target_cls, name, property(accessor))
            return accessor
        return register

    module = types.ModuleType("pyvista")
    module.PolyData, module.register_dataset_accessor = PolyData, register_dataset_accessor
    module.wrap = lambda grid: ("wrapped", grid)
    monkeypatch.setitem(sys.modules, "pyvista", module)
    monkeypatch.delitem(sys.modules, "kerf.pyvista_accessor", raising=False)
    importlib.import_module("kerf.pyvista_accessor")
    yield module
    del sys.modules["kerf.pyvista_accessor"]


def test_the_accessor_meshes_and_checks(pyvista, tmp_path):
    polydata = pyvista.PolyData()
    polydata.ShallowCopy(polydata_of_cube())
    word, grid = polydata.kerf.mesh(size=0.5, parts=2)
    assert word == "wrapped" and np.isclose(sizes(grid)[0].sum(), 1)
    assert polydata.kerf.check() == []
    with pytest.raises(TypeError, match="output"):
        polydata.kerf.mesh(output=tmp_path / "out")
    polydata.GetPolys().ReplaceCellAtId(0, 3, [0, 1, 1])
    assert polydata.kerf.check()[0]["kind"] == "facet"


@pytest.mark.parametrize("ending", ["msh", "vtu", "mesh", "inp"])
def test_a_saved_mesh_is_that_of_the_run(run, mesh, tmp_path, ending):
    """Its parts are the regions, so that Gmsh's entities and the sets of parts may be others."""
    mesh.save(tmp_path / f"a.{ending}")
    run.merge(tmp_path / f"b.{ending}")
    own, other = (meshio.read(tmp_path / f"{name}.{ending}") for name in "ab")
    assert np.array_equal(*(np.unique(each.points, axis=0) for each in (own, other)))
    for kind, corners in (("tetra", 4), ("triangle", 3)):
        places = (np.sort(each.points[each.get_cells_type(kind)].view("f8,f8,f8").reshape(-1, corners), axis=1)
                  for each in (own, other))
        assert np.array_equal(*(np.unique(each, axis=0) for each in places))
    assert {name: list(value) for name, value in own.field_data.items()} == {
        name: list(value) for name, value in other.field_data.items()}
    names = [{name for name in each.cell_sets if not name.startswith("SUBDOMAIN_")} for each in (own, other)]
    assert names[0] == names[1]


def test_a_saved_mesh_has_the_quality_of_the_run(run, mesh, tmp_path):
    angles = run.quality().json["quality"]["all"]["min_dihedral_deg"]
    options = {"a.msh": {}, "b.msh": dict(msh_version="2.2", msh_ascii=True), "c.vtu": {}, "d.mesh": {}, "e.node": {}}
    for name, each in options.items():
        mesh.save(tmp_path / name, **each)
        told = subprocess.run([os.environ["KERF_PROGRAM"], "quality", tmp_path / name, "--json"], check=True,
                              capture_output=True).stdout
        assert json.loads(told)["quality"]["all"]["min_dihedral_deg"] == angles
    with pytest.raises(kerf.UsageError, match="There are .*msh"):
        mesh.save(tmp_path / "a.dwg")


CASE = """
[material.steel]
young = 210e3
poisson = 0.3
[material.copper]
young = 120e3
poisson = 0.34
[[support]]
patch = "bottom"
fixed = true
[[load]]
patch = "top"
pressure = 100
"""


def test_a_solution_has_its_values(run, mesh, tmp_path):
    try:
        kerf.programs.path("kerf-solve")
    except kerf.FileError:
        pytest.skip("kerf-solve needs PETSc")
    (tmp_path / "case.toml").write_text(CASE)
    subprocess.run([os.environ["KERF_PROGRAM"], "solve", run.folder, "--case", tmp_path / "case.toml", "-o",
                    tmp_path / "out", "--ranks", "1", "-q"], check=True, capture_output=True)
    solution = kerf.open(tmp_path / "out")
    assert "solution" in repr(solution) and "solve" in solution.report and solution.mesh_folder == run.folder
    other, grid = solution.to_meshio(), solution.to_vtk()
    moved = other.point_data["Displacement"]
    assert moved.shape == (len(mesh.points), 3) and moved[mesh.points[:, 2] == 2, 2].max() < 0
    assert np.array_equal(vtk_to_numpy(grid.GetPointData().GetArray("Displacement")), moved)
    stress = vtk_to_numpy(grid.GetCellData().GetArray("VonMises"))[:len(mesh.tetrahedra)]
    assert np.array_equal(np.sort(other.get_cell_data("VonMises", "tetra")), np.sort(stress))
    assert np.isnan(other.get_cell_data("VonMises", "triangle")).all()
    for part, number in zip(solution.parts, solution.parts.numbers):
        assert np.array_equal(part.point_data["Displacement"], moved[part.global_ids])
        assert np.array_equal(part.cell_data["VonMises"], stress[mesh.part == number])
    assert np.array_equal(solution.mesh().tetrahedra, mesh.tetrahedra) and solution.verify(without_input=True)
