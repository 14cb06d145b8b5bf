"""What is refused names the way out, in the words of Python."""

import inspect
import pydoc

import numpy as np
import pytest

import kerf
from region_boxes import two_boxes


def refusal(call, kind=kerf.UsageError):
    with pytest.raises(kind) as raised:
        call()
    return str(raised.value)


@pytest.mark.parametrize("surface", ["arrays", "lists"])
def test_arrays_for_a_mesh_are_a_surface_first(cube, surface):
    points, triangles = cube if surface == "arrays" else (each.tolist() for each in cube)
    for call in (kerf.mesh, kerf.decompose):
        assert "kerf.mesh(kerf.Surface(points, triangles)" in refusal(lambda: call(points, triangles))


def test_sizes(cube):
    surface = kerf.Surface(*cube)
    points, lengths = cube[0], np.full(8, 0.2)
    for size in ((points, lengths), [0.1, 0.2], lengths):
        assert "SizeField.from_points(points, lengths)" in refusal(lambda: kerf.mesh(surface, size=size))
    for zero in (0, 0.0, np.float64(0)):
        assert "size is 0" in refusal(lambda: kerf.mesh(surface, size=zero))
    assert len(kerf.mesh(surface, size=None).tetrahedra) == len(kerf.mesh(surface).tetrahedra)


def test_a_function_of_sizes_may_return_one_column_or_one_number(cube):
    surface = kerf.Surface(*cube)
    of_rows = kerf.mesh(surface, size=lambda p: 0.2 + 0.1 * p[:, 0], parts=2)
    of_column = kerf.mesh(surface, size=lambda p: 0.2 + 0.1 * p[:, :1], parts=2)
    assert np.array_equal(of_rows.tetrahedra, of_column.tetrahedra)
    constant = kerf.mesh(surface, size=lambda p: 0.3, parts=2)
    assert np.array_equal(constant.points, kerf.mesh(surface, size=lambda p: np.full(len(p), 0.3), parts=2).points)

    def of_one_point(p):
        return 0.1 if p[0] < 0.5 else 0.2

    said = refusal(lambda: kerf.mesh(surface, size=of_one_point))
    assert "ambiguous" in said and ", 3)" in said


def test_sizes_at_points(cube):
    random = np.random.default_rng(1)
    points = random.random((500, 3))
    field = kerf.SizeField.from_points(points, 0.05 + 0.3 * points[:, 0], lattice=8)
    mesh = kerf.mesh(kerf.Surface(*cube), size=field, parts=2)
    centres = mesh.points[mesh.tetrahedra].mean(axis=1)
    left, right = (mesh.volumes[side].mean() for side in (centres[:, 0] < 0.3, centres[:, 0] > 0.7))
    assert left < 0.5 * right
    single = kerf.SizeField.from_points([[1, 2, 3]], [0.5])
    assert (single.sizes == 0.5).all() and single.points.min(axis=0)[0] < 1 < single.points.max(axis=0)[0]
    far = kerf.SizeField.from_points([[0, 0, 0], [1, 0, 0]], [0.1, 0.4], lattice=4)
    assert set(far.sizes) == {0.1, 0.4}
    assert "(n, 3) and (n,)" in refusal(lambda: kerf.SizeField.from_points(points, [0.1]))
    assert "not finite" in refusal(lambda: kerf.SizeField.from_points([[0, 0, np.nan]], [0.1]))
    assert "positive" in refusal(lambda: kerf.SizeField.from_points([[0, 0, 0]], [-1]), kerf.InputError)


@pytest.mark.parametrize("name, meant", [("n", "parts"), ("max_size", "size"), ("n_jobs", "workers"), ("maxh", "size"),
                                         ("seed", "Nothing is random")])
def test_names_of_other_meshers_are_known(cube, name, meant):
    assert meant in refusal(lambda: kerf.mesh(kerf.Surface(*cube), **{name: 3}))


def test_options_of_the_mesh_are_none_of_the_surface(cube, tmp_path):
    kerf.Surface(*cube).save(tmp_path / "a.stl")
    for call in (lambda: kerf.read(tmp_path / "a.stl", size=0.1), lambda: kerf.Surface(*cube, size=0.1),
                 lambda: kerf.check(*cube, size=0.1), lambda: kerf.wrap(*cube, size=0.1)):
        assert "size is no option of a surface: give it to kerf.mesh()" in refusal(call)


def test_triangles_counted_from_1_are_recognised(cube):
    points, triangles = cube
    assert "take 1 from all corners" in refusal(lambda: kerf.Surface(points, triangles + 1), kerf.InputError)
    assert "take 1" in str(kerf.check(points, triangles + 1))
    assert "take 1" not in refusal(lambda: kerf.Surface(points, triangles + 2), kerf.InputError)


def test_lists_of_shapes(cube):
    surface = kerf.Surface(*cube)
    meshes = [kerf.mesh(surface, size=0.5, size_in=shapes, parts=1)
              for shapes in (["sphere:0,0,0,0.5=0.1"], [("sphere:0,0,0,0.5", 0.1)], {"sphere:0,0,0,0.5": 0.1})]
    assert all(np.array_equal(mesh.tetrahedra, meshes[0].tetrahedra) for mesh in meshes)
    assert "a list of SHAPE=H, or a dict {SHAPE: H}" in refusal(lambda: kerf.mesh(surface, size_in=[["a", 3]]))


def test_a_grid_is_no_surface():
    pytest.importorskip("vtkmodules")
    grid = kerf.mesh(two_boxes(), parts=1).to_vtk()
    assert "extract_surface()" in refusal(lambda: kerf.Surface.from_pyvista(grid))


@pytest.mark.parametrize("kind", [kerf.Surface, kerf.Mesh, kerf.Check, kerf.SizeField, kerf.Tree, kerf.Run,
                                  kerf.DistributedMesh])
def test_help_has_signatures_of_python(kind):
    text = pydoc.plain(pydoc.render_doc(kind))
    assert "__init__(self: kerf._kerf" not in text
    assert "self" in inspect.signature(kind.__init__).parameters


def test_words_of_the_command_line_are_those_of_python(cube, tmp_path):
    points, triangles = cube
    surface = kerf.Surface(points, triangles)
    assert "Use parts=" in refusal(lambda: kerf.mesh(surface, parts=1000))
    run = kerf.mesh(surface, parts=1, output=tmp_path / "run")
    mesh = run.mesh()
    for save in (mesh.save, run.merge):
        said = refusal(lambda: save(tmp_path / "a.foo"))
        assert said.startswith("The path is ") and "ending is that of no format" in said and "--" not in said
        assert f"give {tmp_path / 'a'}.h5" in refusal(lambda: save(tmp_path / "a.xdmf"))
        save(tmp_path / "a.h5")
        assert (tmp_path / "a.xdmf").exists()
    said = refusal(lambda: kerf.Surface(points, triangles[1:]), kerf.InputError)
    assert 'repair="stitch,holes"' in said and "--" not in said
    # Commands for a shell stay commands.
    assert "kerf mesh -o" in refusal(lambda: kerf.open(tmp_path), kerf.FileError)


def test_help_says_what_a_mesh_depends_on():
    assert "give parts=N for the same mesh elsewhere" in inspect.getdoc(kerf.mesh)
