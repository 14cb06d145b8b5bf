"""kerf.Run: folders of runs, read a part at a time, verified, exported."""

import json
import os
import shutil
import subprocess

import numpy as np
import pytest

import kerf
from conftest import CUBE_POINTS, CUBE_TRIANGLES
from region_boxes import two_boxes

FORMATS = ["vtu", "msh", "openfoam", "mfem", "hdf5", "medit", "tetgen", "abaqus", "su2", "vtk", "unv", "med", "cgns",
           "feb", "vtp"]


def kerf_program(*arguments):
    return subprocess.run([os.environ["KERF_PROGRAM"], *map(str, arguments)], check=True, capture_output=True).stdout


def files_below(folder):
    return {path.relative_to(folder): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}


def volume(points, tetrahedra):
    a, b, c, d = (points[tetrahedra[:, i]] for i in range(4))
    return np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a).sum() / 6


@pytest.fixture(scope="module")
def boxes():
    return two_boxes()


@pytest.fixture(scope="module")
def run(boxes, tmp_path_factory):
    return kerf.mesh(boxes, parts=5, size=0.35, output=tmp_path_factory.mktemp("run") / "out")


@pytest.fixture
def copy(run, tmp_path):
    """The run, to be damaged."""
    return shutil.copytree(run.folder, tmp_path / "copy")


@pytest.fixture
def cube_file(tmp_path):
    rows = [f"OFF\n{len(CUBE_POINTS)} {len(CUBE_TRIANGLES)} 0"]
    rows += [" ".join(map(str, row)) for row in CUBE_POINTS] + [f"3 {a} {b} {c}" for a, b, c in CUBE_TRIANGLES]
    (tmp_path / "cube.off").write_text("\n".join(rows) + "\n")
    return tmp_path / "cube.off"


def test_parts_are_the_mesh(run):
    mesh = run.mesh()
    assert len(run) == len(run.parts) == 5
    assert run.points_count == len(mesh.points) and run.tetrahedra_count == len(mesh.tetrahedra)
    assert run.patch_names == mesh.patch_names and run.region_names == ["steel", "copper"]
    parts = list(run.parts)
    assert np.array_equal(np.concatenate([p.global_ids[p.tetrahedra] for p in parts]), mesh.tetrahedra)
    assert np.array_equal(np.concatenate([p.region for p in parts]), mesh.region)
    assert np.array_equal(np.repeat([p.number for p in parts], [len(p.tetrahedra) for p in parts]), mesh.part)
    assert [len(p.tetrahedra) for p in parts] == list(run.parts.tetrahedra_counts)
    for part in parts:
        assert np.array_equal(part.points, mesh.points[part.global_ids])
        assert not part.points.flags.writeable and part.points.dtype == np.float64
        assert part.triangles.max() + 1 == part.boundary_points
        corners = np.sort(part.tetrahedra[part.tetrahedron], axis=1)
        assert all(set(t) < set(c) for t, c in zip(part.triangles, corners))
        assert np.array_equal(part.patch < 0, part.facet < 0)
    assert np.isclose(sum(volume(p.points, p.tetrahedra) for p in parts), 2)


def test_a_notebook_shows_counts(run):
    assert f"<td>tetrahedra</td><td style='text-align:right'>{run.tetrahedra_count:,}</td>" in run._repr_html_()


def test_neighbours_have_the_same_triangles_turned(run):
    faces = set()
    for part in run.parts:
        is_shared = part.neighbour >= 0
        for triangle, neighbour in zip(part.global_ids[part.triangles[is_shared]], part.neighbour[is_shared]):
            faces.add((part.number, neighbour, *np.roll(triangle, -triangle.argmin())))
    assert faces and all((n, p, a, c, b) in faces for p, n, a, b, c in faces)


def test_shared_points_are_the_same_in_all_parts(run):
    groups, holders = {}, {}
    for part in run.parts:
        for i in part.global_ids:
            holders.setdefault(i, []).append(part.number)
        for group in part.shared:
            ids = groups.setdefault(tuple(group.parts), part.global_ids[group.points])
            assert np.array_equal(ids, part.global_ids[group.points])
            assert np.all(part.owner[group.points] == group.parts[0]) and part.number in group.parts
    told = {i: list(parts) for parts, ids in groups.items() for i in ids}
    assert told == {i: parts for i, parts in holders.items() if len(parts) > 1}


def test_a_part_is_read_when_it_is_asked_for(copy):
    run = kerf.open(copy)
    (copy / "parts" / f"part_{run.parts.numbers[1]:04}.vtu").unlink()
    others = run.parts[2:]
    assert len(others) == 3 and list(others.numbers) == list(run.parts.numbers[2:])
    assert others[-1].number == run.parts[4].number == run.parts.numbered(run.parts.numbers[4]).number
    with pytest.raises(kerf.FileError, match="part_"):
        run.parts[1]
    with pytest.raises(IndexError, match="there are 5"):
        run.parts[5]
    with pytest.raises(KeyError, match="no part 1"):
        run.parts.numbered(1)


def test_the_files_are_those_of_the_command_line(cube_file, tmp_path):
    """Also with options of the surface, and of formats."""
    run = kerf.mesh(cube_file, parts=3, size=0.3, weld=1e-9, radius_edge=1.6, format="vtu,su2", output=tmp_path / "a")
    kerf_program("mesh", cube_file, "-o", tmp_path / "b", "-n", 3, "--size", 0.3, "--weld", 1e-9, "--radius-edge", 1.6,
                 "--format", "vtu,su2", "-q")
    files = files_below(tmp_path / "a")
    report, other = (json.loads((tmp_path / folder / "report.json").read_text()) for folder in "ab")
    assert report["mesh_hash"] == other["mesh_hash"] and run.report == report
    assert files.keys() == files_below(tmp_path / "b").keys()
    assert all(files[name] == bytes for name, bytes in files_below(tmp_path / "b").items() if name.suffix != ".json")
    assert run.verify().compared_with_surface
    in_memory = kerf.mesh(kerf.Surface(CUBE_POINTS, CUBE_TRIANGLES), parts=3, size=0.3, radius_edge=1.6)
    assert np.array_equal(run.mesh().tetrahedra, in_memory.tetrahedra)


def test_a_sound_run_is_verified(run, boxes):
    found = run.verify(boxes)
    assert found and found.passed and found.compared_with_surface and "Every law holds." in found.text
    assert (found.parts, found.tetrahedra, found.points) == (5, run.tetrahedra_count, run.points_count)
    assert found.differences == [] and set(found.broken.values()) == {0}
    alone = run.verify()
    assert alone.passed and not alone.compared_with_surface and alone.not_compared
    assert run.verify(without_input=True).not_compared == ""
    assert not run.verify(kerf.Surface(CUBE_POINTS, CUBE_TRIANGLES)).compared_with_surface


def test_damage_is_found(copy):
    """A point inside of a part has moved by a rounding error."""
    part = kerf.open(copy).parts[2]
    path = copy / "parts" / f"part_{part.number:04}.vtu"
    bytes, x = path.read_bytes(), part.points[-1, 0]
    assert bytes.count(x.tobytes()) == 1
    path.write_bytes(bytes.replace(x.tobytes(), np.nextafter(x, 9).tobytes()))
    found = kerf.open(copy).verify(without_input=True)
    assert not found and any(path.name in difference for difference in found.differences)
    assert "NOT valid" in str(found)
    path.write_bytes(bytes[:-40])
    found = kerf.open(copy).verify()
    assert not found and any(path.name in difference for difference in found.differences)


def test_all_formats_are_those_of_the_command_line(run, tmp_path):
    files = run.export(FORMATS, tmp_path / "a")
    kerf_program("export", run.folder, "--format", ",".join(FORMATS), "-o", tmp_path / "b", "-q")
    assert files_below(tmp_path / "a") == files_below(tmp_path / "b")
    assert sorted(files) == sorted(str(path) for path in (tmp_path / "a").rglob("*")
                                   if path.is_file() and path.name != "kerf_export.json")
    options = dict(into=2, patch_type={"bottom": "wall"}, msh_ascii=True, fields=["shape", "aspect"])
    run.export(["vtu", "msh", "openfoam"], tmp_path / "c", **options)
    kerf_program("export", run.folder, "--format", "vtu,msh,openfoam", "-o", tmp_path / "d", "--into", 2, "--msh-ascii",
                 "--patch-type", "bottom=wall", "--fields", "shape,aspect", "-q")
    assert files_below(tmp_path / "c") == files_below(tmp_path / "d")


def test_cells_of_order_2_are_those_of_the_command_line(run, tmp_path):
    run.export(["msh", "mfem"], tmp_path / "a", order=2)
    kerf_program("export", run.folder, "--format", "msh,mfem", "-o", tmp_path / "b", "--order", 2, "-q")
    assert files_below(tmp_path / "a") == files_below(tmp_path / "b")
    run.merge(tmp_path / "c.inp", order=2)
    kerf_program("merge", run.folder, "-o", tmp_path / "d.inp", "--order", 2, "-q")
    assert (tmp_path / "c.inp").read_bytes() == (tmp_path / "d.inp").read_bytes()
    assert b"C3D10" in (tmp_path / "c.inp").read_bytes()
    with pytest.raises(kerf.UsageError, match="su2 has no cells of order 2"):
        run.merge(tmp_path / "a.su2", order=2)


def test_an_export_becomes_part_of_the_run(copy):
    run = kerf.open(copy)
    assert os.path.dirname(run.export("su2")[0]) == os.path.join(run.folder, "export/su2")
    assert any(file["path"].startswith("export/su2") for file in run.report["files"])
    assert run.verify(without_input=True).passed


@pytest.mark.parametrize("name", ["a.msh", "a.vtu", "a.inp", "a.su2"])
def test_merged_files_are_those_of_the_command_line(run, tmp_path, name):
    (tmp_path / "b").mkdir()
    run.merge(tmp_path / name)
    kerf_program("merge", run.folder, "-o", tmp_path / "b" / name, "-q")
    assert (tmp_path / name).read_bytes() == (tmp_path / "b" / name).read_bytes()


def test_quality_is_that_of_the_command_line(run):
    quality = run.quality()
    assert quality.json == json.loads(kerf_program("quality", run.folder, "--json"))
    assert quality.text == kerf_program("quality", run.folder, "-v").decode()
    angle = quality.measures["min_dihedral_deg"]
    assert quality.cells == run.tetrahedra_count == angle.counts.sum()
    assert angle.min <= angle.p1 <= angle.median <= angle.max
    assert [region.name for region in quality.regions] == run.region_names
    assert sum(region.cells for region in quality.regions) == quality.cells


def test_what_is_no_run_is_refused(copy, tmp_path):
    with pytest.raises(kerf.FileError, match="not a finished run"):
        kerf.open(tmp_path / "nowhere")
    with pytest.raises(kerf.FileError, match="not a finished run"):
        kerf.open(tmp_path)
    (copy / "report.json").write_text("{}")
    with pytest.raises(kerf.VerificationError, match="not as Kerf has written it"):
        kerf.open(copy)


def test_wrong_requests_are_refused(run, boxes, tmp_path):
    for output in ("a.msh", "a.vtu"):
        with pytest.raises(kerf.UsageError, match="file of one mesh"):
            kerf.mesh(boxes, output=tmp_path / output)
    with pytest.raises(kerf.UsageError):
        run.export("dwg", tmp_path / "a")
    with pytest.raises(kerf.UsageError, match="--into"):
        run.export("su2", into=2)
    with pytest.raises(kerf.UsageError, match="ending"):
        run.merge(tmp_path / "a.dwg")
    (tmp_path / "of_a_user").mkdir()
    (tmp_path / "of_a_user" / "thesis.txt").write_text("years")
    with pytest.raises(kerf.FileError, match="thesis"):
        kerf.mesh(boxes, output=tmp_path / "of_a_user")


def test_a_run_that_was_ended_goes_on(boxes, run, tmp_path):
    seen = []

    def end_after_two(stage, done, total):
        seen.append((stage, done))
        return not (stage == "volume" and done == 2)

    options = dict(parts=5, size=0.35, workers=1, output=tmp_path / "out")
    with pytest.raises(kerf.Cancelled):
        kerf.mesh(boxes, progress=end_after_two, **options)
    with pytest.raises(kerf.FileError):
        kerf.open(tmp_path / "out")
    second = kerf.mesh(boxes, **options)
    assert sum(part.get("resumed", False) for part in second.report["parts"]) == 2
    assert second.report["mesh_hash"] == run.report["mesh_hash"]


def test_parts_that_fail_are_told(cube, tmp_path):
    """No process meshes a part in a thousandth of a second; later, with more time, the same folder has them."""
    surface = kerf.Surface(*cube)
    options = dict(parts=2, size=0.3, mesher="tetgen")
    with pytest.raises(kerf.MeshingError, match="Part 2") as caught:
        kerf.mesh(surface, timeout=0.001, output=tmp_path / "out", **options)
    assert [part.number for part in caught.value.failed_parts] == [2, 3]
    for part in caught.value.failed_parts:
        assert "0.001 s" in part.message and part.reproducer.startswith(str(tmp_path / "out"))
        assert all(0 < x < 1 for x in part.place)
    with pytest.raises(kerf.FileError, match="no tetrahedra"):
        kerf.open(tmp_path / "out")
    with pytest.raises(kerf.MeshingError) as caught:
        kerf.mesh(surface, timeout=0.001, **options)
    assert [part.reproducer for part in caught.value.failed_parts] == [None, None]
    assert kerf.mesh(surface, timeout=100, output=tmp_path / "out", **options).verify(surface).passed


def test_nothing_stays_in_the_temporary_folder(run, tmp_path, monkeypatch):
    (tmp_path / "tmp").mkdir()
    monkeypatch.setenv("TMPDIR", str(tmp_path / "tmp"))
    kerf.mesh(two_boxes(), parts=2, output=tmp_path / "out").verify()
    run.merge(tmp_path / "a.msh")
    run.export("su2", tmp_path / "su2")
    assert os.listdir(tmp_path / "tmp") == []
    assert sorted(os.listdir(tmp_path)) == ["a.msh", "out", "su2", "tmp"]
