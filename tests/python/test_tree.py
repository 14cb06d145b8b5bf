"""kerf.decompose(): the cuts of the command line, as arrays."""

import gc
import json
import os
import subprocess

import numpy as np
import pytest

import kerf


def asset(name):
    return os.path.join(os.environ["KERF_ASSETS"], name)


def two_regions(cube):
    """The unit cube and another on top of it, which share a wall."""
    points, triangles = cube
    top = points[4:] + [0, 0, 1]
    upper = np.array([[4, 5, 9], [4, 9, 8], [5, 6, 10], [5, 10, 9], [6, 7, 11], [6, 11, 10], [7, 4, 8], [7, 8, 11],
                      [8, 9, 10], [8, 10, 11]])
    sides = [[0, 1 if min(t) >= 4 else -1] for t in triangles] + [[1, -1]] * len(upper)
    return kerf.Surface(np.vstack([points, top]), np.vstack([triangles, upper]), sides=sides, regions=["low", "high"])


def prism(sides=30, height=30.0):
    """Facets from bottom to top: without a contour of edges across it."""
    angle = 2 * np.pi * np.arange(sides) / sides
    ring = np.column_stack([np.cos(angle), np.sin(angle), 0 * angle])
    here = np.arange(sides)
    next_ = (here + 1) % sides
    fan = np.column_stack([0 * here, next_, here])[1:-1]
    return np.vstack([ring, ring + [0, 0, height]]), np.vstack([
        np.column_stack([here, next_, next_ + sides]), np.column_stack([here, next_ + sides, here + sides]), fan,
        fan[:, ::-1] + sides])


@pytest.fixture(scope="module")
def bone():
    return kerf.decompose(asset("bone.stl"), parts=8)


@pytest.fixture(params=["bone", "prism", "cube", "regions"])
def tree(request, cube, bone):
    return {"bone": lambda: bone,
            "prism": lambda: kerf.decompose(kerf.Surface(*prism()), parts=5, surface="split"),
            "cube": lambda: kerf.decompose(kerf.Surface(*cube), parts=3, size=0.3),
            "regions": lambda: kerf.decompose(two_regions(cube), parts=5, size=0.4)}[request.param]()


def corners(surface):
    return surface.points[surface.triangles]


def volume(surface):
    a, b, c = np.moveaxis(corners(surface), 1, 0)
    return np.einsum("ij,ij->", np.cross(a, b), c) / 6


def area(points, triangles):
    a, b, c = np.moveaxis(points[triangles], 1, 0)
    return np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2


def turned(triangles):
    """Rows with their smallest number first, as seen from behind."""
    triangles = triangles[:, ::-1]
    first = np.argmin(triangles, axis=1)
    return np.take_along_axis(triangles, (first[:, None] + np.arange(3)) % 3, axis=1)


def test_parts_are_closed_and_fill_the_whole(tree):
    assert np.isclose(sum(volume(part.surface) for part in tree.parts), tree.root.volume)
    for part in tree.parts:
        assert np.isclose(volume(part.surface), part.volume)
        edges = part.surface.global_ids[part.surface.triangles[:, [0, 1, 1, 2, 2, 0]]].reshape(-1, 2)
        assert sorted(map(tuple, edges)) == sorted(map(tuple, edges[:, ::-1]))


def test_interfaces_have_two_sides(tree):
    surfaces = {part.id: part.surface for part in tree.parts}
    for id, surface in surfaces.items():
        for neighbour in set(surface.neighbours) - {-1}:
            beyond = surfaces[neighbour]
            own = surface.global_ids[surface.triangles[surface.neighbours == neighbour]]
            other = beyond.global_ids[beyond.triangles[beyond.neighbours == id]]
            assert set(map(tuple, turned(turned(own)))) == set(map(tuple, turned(other)))
        assert np.all((surface.patches < 0) == surface.is_interface)
    points = {}
    for surface in surfaces.values():
        for number, point in zip(surface.global_ids, surface.points):
            assert points.setdefault(number, tuple(point)) == tuple(point)


def test_nodes_are_a_tree_in_depth_first_order(tree):
    def below(node):
        return [node] + [each for child in node.children for each in below(child)]

    assert tree.nodes == below(tree.root) == list(tree) and len(tree) == len(tree.nodes)
    assert [part.node for part in tree.parts] == [node for node in tree if node.is_part]
    for node in tree:
        assert node.id == 1 and node.parent is None or node in node.parent.children
        assert node.is_part != bool(node.children)
        assert np.isclose(node.volume, sum(child.volume for child in node.children) if node.children else node.volume)
        assert node.was_cut == (node.plane is not None) == (node.interface is not None) == bool(node.contour)


def test_cuts_are_what_they_say(tree):
    for node in (node for node in tree if node.was_cut):
        loops = [np.linalg.norm(loop - np.roll(loop, 1, axis=0), axis=1).sum() for loop in node.contour]
        assert np.isclose(sum(loops), node.contour_length)
        points, triangles = node.interface
        distances = (np.vstack(node.contour) - node.plane.point) @ node.plane.normal
        assert np.isclose(np.abs(distances).max(), node.max_deviation)
        assert node.tries[-1].refusal == "none" or node.strategy == "soft"
        assert np.isclose(np.linalg.norm(node.plane.normal), 1)
        if node.method == "straight":
            assert node.stages == {} and np.isclose(node.max_deviation, 0)
            continue
        a, b, c = np.moveaxis(points[triangles], 1, 0)
        assert np.cross(b - a, c - a).sum(axis=0) @ node.plane.normal > 0
        assert np.isclose(area(points, triangles), node.interface_area)
        ends = {frozenset(map(tuple, edge)) for edge in node.stages["smoothed"]}
        of_loops = [edge for loop in node.contour for edge in zip(loop, np.roll(loop, 1, axis=0))]
        assert ends == {frozenset(map(tuple, edge)) for edge in of_loops}
        assert set(map(tuple, np.vstack(node.contour))) <= set(map(tuple, points))


def test_moments_are_those_of_the_points(bone):
    surface = kerf.read(asset("bone.stl"))
    arms = surface.points - surface.points.mean(axis=0)
    assert np.allclose(bone.root.centroid, surface.points.mean(axis=0))
    assert np.allclose(bone.root.inertia, np.sum(arms**2) * np.eye(3) - arms.T @ arms)
    axes = bone.root.principal_axes
    assert np.allclose(axes.T @ bone.root.inertia @ axes, np.diag(bone.root.principal_moments), atol=1e-2 * len(arms))
    assert np.isclose(bone.root.volume, surface.volume) and np.isclose(bone.root.area, surface.area)


def read_stl(path):
    with open(path, "rb") as file:
        facets = np.frombuffer(file.read()[84:], np.dtype([("numbers", "<f4", (4, 3)), ("attribute", "<u2")]))
    return facets["numbers"][:, 1:]


def write_off(path, points, triangles):
    rows = [" ".join(map(repr, map(float, point))) for point in points] + [f"3 {a} {b} {c}" for a, b, c in triangles]
    path.write_text("\n".join(["OFF", f"{len(points)} {len(triangles)} 0", *rows]) + "\n")
    return path


@pytest.mark.parametrize("is_straight", [False, True])
def test_cuts_are_those_of_the_command(is_straight, tmp_path):
    file = write_off(tmp_path / "prism.off", *prism()) if is_straight else asset("bone.stl")
    options = {"surface": "split", "size": 3} if is_straight else {}
    given = [f"--{key}={value}" for key, value in options.items()]
    command = [os.environ["KERF_PROGRAM"], "decompose", file, "-n", "8", "-o", tmp_path / "out", "--stl", *given]
    told = subprocess.run(command, check=True, capture_output=True, text=True)
    report = json.loads((tmp_path / "out/report.json").read_text())
    tree = kerf.decompose(file, parts=8, **options)
    assert is_straight == any(node.method == "straight" for node in tree)
    assert tree.to_text() in told.stderr
    assert sorted(node.id for node in tree) == [node["id"] for node in report["tree"]]
    for told in report["tree"]:
        node = tree[told["id"]]
        assert (node.points, node.triangles, node.volume) == (told["vertices"], told["faces"], told["volume"])
        if not node.was_cut:
            continue
        cut = told["cut"]
        assert cut["plane"] == {"point": list(node.plane.point), "normal": list(node.plane.normal)}
        assert (cut["method"], cut["rung"], cut["tries"]) == (node.method, node.strategy, len(node.tries))
        assert (cut["interface_area"], cut["interface_faces"]) == (node.interface_area, len(node.interface.triangles))
        assert (cut["min_interface_angle_deg"], cut["min_dihedral_deg"]) == (node.min_angle, node.min_dihedral)
    for part in tree.parts:
        assert np.array_equal(read_stl(tmp_path / f"out/parts/part_{part.id:04}.stl"),
                              corners(part.surface).astype(np.float32))


def test_attempts_say_why_a_cut_is_straight():
    root = kerf.decompose(kerf.Surface(*prism()), parts=2, surface="split").root
    assert root.strategy == root.method == "straight"
    assert {each.method for each in root.tries[:-1]} == {"min-cut"} and root.tries[-1].method == "straight"
    assert all(each.refusal != "none" for each in root.tries[:-1])


def test_a_part_is_a_surface(bone):
    part = bone.parts[0]
    surface = part.surface.to_surface()
    assert np.isclose(surface.volume, part.volume)
    neighbours = {int(each) for each in part.surface.neighbours} - {-1}
    assert surface.names == part.surface.names + [f"interface_{each}" for each in sorted(neighbours)]


def test_what_is_wrong_is_said(cube):
    with pytest.raises(kerf.UsageError, match="too few for 100 parts"):
        kerf.decompose(kerf.Surface(*cube), parts=100)
    with pytest.raises(kerf.UsageError, match="weld"):
        kerf.decompose(kerf.Surface(*cube), parts=2, weld=1)
    with pytest.raises(kerf.Cancelled):
        kerf.decompose(kerf.Surface(*cube), parts=2, progress=lambda *_: False)
    with pytest.raises(kerf.FileError):
        kerf.decompose("nowhere.stl")


def test_arrays_outlive_the_tree(cube):
    tree = kerf.decompose(kerf.Surface(*cube), parts=2)
    points, loops = tree.parts[0].surface.points, tree.root.contour
    before = points.copy(), [loop.copy() for loop in loops]
    del tree
    gc.collect()
    assert np.array_equal(points, before[0]) and all(map(np.array_equal, loops, before[1]))
    assert not points.flags.writeable
