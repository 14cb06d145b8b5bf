"""Reads MSH files of a run with Gmsh itself, merged ones with meshio, too, and compares what they find with the report
and with the surface that was meshed.

usage: python3 read_msh.py SURFACE.stl RUN PARTS MERGED...

SURFACE.stl is ASCII. Prints counts, volume and the number of ghost cells as JSON; the exit code is 1 if a law does not
hold.
"""

import collections
import json
import pathlib
import re
import subprocess
import sys

import gmsh
import meshio
import numpy as np

TRIANGLE, TETRA = 2, 4


class Broken(Exception):
    pass


def require(holds, law):
    if not holds:
        raise Broken(law)


def areas(points, corners):
    a, b, c = (points[corners[:, i]] for i in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2


def volumes(points, corners):
    a, b, c, d = (points[corners[:, i]] for i in range(4))
    return np.einsum("ij,ij->i", b - a, np.cross(c - a, d - a)) / 6


def area_by_name_of_surface(path):
    """Of the solids of an ASCII STL; Gmsh's names have no quotes."""
    found = collections.defaultdict(float)
    for solid in re.split(r"^solid ", path.read_text(), flags=re.MULTILINE)[1:]:
        corners = np.array(re.findall(r"vertex\s+(\S+)\s+(\S+)\s+(\S+)", solid), dtype=float)
        name = solid.splitlines()[0].strip().replace('"', "'")
        found[name] += float(areas(corners, np.arange(len(corners)).reshape(-1, 3)).sum())
    return found


def is_near(a, b):
    return np.isclose(a, b, rtol=1e-9, atol=0)


def require_same_areas(found, wanted, path):
    require(found.keys() == wanted.keys(), f"{path} has the patches of the surface")
    for name, area in wanted.items():
        require(is_near(found[name], area), f"{path} has the area of '{name}'")


class GmshFile:
    """A file as Gmsh reads it; a complaint of Gmsh is a broken law."""

    def __init__(self, path):
        self.path = path
        gmsh.clear()
        gmsh.logger.start()
        gmsh.open(str(path))
        complaints = [text for text in gmsh.logger.get() if not text.startswith(("Info", "Progress"))]
        gmsh.logger.stop()
        require(not complaints, f"Gmsh reads {path} without {complaints[:1]}")
        tags, points, _ = gmsh.model.mesh.getNodes()
        require(len(tags) > 0, f"{path} has nodes")
        require(len(np.unique(tags)) == len(tags), f"nodes of {path} have different tags")
        self.tags = tags.astype(np.int64)
        self.points = np.zeros((int(tags.max()) + 1, 3))
        self.points[self.tags] = points.reshape(-1, 3)
        self.tets, self.triangles, self.ghosts = [], [], []
        for dimension, tag in gmsh.model.getEntities():
            self.read_entity(dimension, tag)

    def read_entity(self, dimension, tag):
        types, elements, nodes = gmsh.model.mesh.getElements(dimension, tag)
        if len(types) == 0:
            return
        wanted = {2: TRIANGLE, 3: TETRA}[dimension]
        require(list(types) == [wanted], f"surface or volume {tag} of {self.path} has its own type of elements")
        block = {
            "entity": tag,
            "tags": elements[0].astype(np.int64),
            "corners": nodes[0].astype(np.int64).reshape(-1, dimension + 1),
            "names": [
                gmsh.model.getPhysicalName(dimension, group)
                for group in gmsh.model.getPhysicalGroupsForEntity(dimension, tag)
            ],
            "partitions": list(gmsh.model.getPartitions(dimension, tag)),
            "whole": gmsh.model.getParent(dimension, tag),
        }
        if gmsh.model.getType(dimension, tag) == "Ghost volume":
            ghosts, partitions = gmsh.model.mesh.getGhostElements(dimension, tag)
            require(np.array_equal(np.sort(ghosts), np.sort(block["tags"])), f"ghosts of {self.path} are cells")
            block["of"] = dict(zip((int(g) for g in ghosts), (int(p) for p in partitions)))
            self.ghosts.append(block)
        else:
            (self.triangles if dimension == 2 else self.tets).append(block)

    def tet_tags(self):
        return np.concatenate([block["tags"] for block in self.tets])

    def tet_corners(self):
        return np.concatenate([block["corners"] for block in self.tets])

    def element_tags(self):
        return np.concatenate([block["tags"] for block in self.tets + self.triangles])

    def volume(self):
        total = 0.0
        for block in self.tets:
            is_body = len(block["names"]) == 1 and (block["names"][0] == "volume" or block["names"][0][:5] == "body_")
            require(is_body, f"cells of {self.path} are in the group of a body")
            each = volumes(self.points, block["corners"])
            require(np.all(each > 0), f"tetrahedra of {self.path} have positive volume")
            total += float(each.sum())
        return total

    def area_by_name(self):
        found = collections.defaultdict(float)
        for block in self.triangles:
            require(len(block["names"]) == 1, f"surfaces of {self.path} are in one group each")
            found[block["names"][0]] += float(areas(self.points, block["corners"]).sum())
        return found


def is_dense(tags, count):
    return np.array_equal(np.sort(tags), np.arange(1, count + 1))


def check_ghosts(files):
    """Ghosts are the cells of other parts that share a vertex: found here from the parts' own cells alone."""
    tags = np.concatenate([file.tet_tags() for file in files])
    corners = np.concatenate([file.tet_corners() for file in files])
    partition = np.concatenate([np.full(len(file.tet_tags()), i + 1) for i, file in enumerate(files)])
    order = np.argsort(tags)
    tags, corners, partition = tags[order], corners[order], partition[order]
    total = 0
    for i, file in enumerate(files):
        is_near_part = np.isin(corners, np.unique(file.tet_corners())).any(axis=1) & (partition != i + 1)
        wanted = dict(zip(tags[is_near_part].tolist(), partition[is_near_part].tolist()))
        found = {}
        for block in file.ghosts:
            require(block["partitions"] == [i + 1], f"ghosts of {file.path} are seen from its part")
            found.update(block["of"])
            order = np.searchsorted(tags, block["tags"])
            require(np.array_equal(corners[order], block["corners"]), f"ghosts of {file.path} are cells of other parts")
        require(found == wanted, f"{file.path} has the cells of other parts that share a vertex")
        total += len(found)
    return total


def check_parts(folder, report, surface_areas):
    count = len(report["parts"])
    names = ["mesh.msh"] if count == 1 else [f"mesh_{i + 1}.msh" for i in range(count)]
    found = sorted(path.name for path in folder.glob("*.msh"))
    require(found == sorted(names), f"{folder} has a file for each part")
    files = [GmshFile(folder / name) for name in names]
    for i, (file, part) in enumerate(zip(files, report["parts"])):
        require(len(file.tet_tags()) == part["tets"], f"{file.path} has the tetrahedra of part {part['id']}")
        for block in file.tets + file.triangles:
            require(block["partitions"] == [i + 1], f"elements of {file.path} are of partition {i + 1}")
            require(block["whole"][1] >= 1, f"entities of {file.path} are parts of a whole")
    tags = np.concatenate([file.element_tags() for file in files])
    require(is_dense(tags, len(tags)), f"elements of {folder} have dense tags")
    nodes = np.unique(np.concatenate([file.tags for file in files]))
    require(is_dense(nodes, report["totals"]["vertices"]), f"nodes of {folder} have dense tags")
    volume = sum(file.volume() for file in files)
    require(is_near(volume, report["input"]["volume"]), f"{folder} has the volume of the input")
    found = collections.defaultdict(float)
    for file in files:
        for name, area in file.area_by_name().items():
            found[name] += area
    require_same_areas(found, surface_areas, folder)
    return {"elements": len(tags), "volume": volume, "ghosts": check_ghosts(files)}


def check_merged(path, report, elements, surface_areas):
    file = GmshFile(path)
    totals = report["totals"]
    require(is_dense(file.tags, totals["vertices"]), f"{path} has the vertices of the report")
    require(is_dense(file.element_tags(), elements), f"{path} has the elements of the parts")
    bodies = len({name for block in file.tets for name in block["names"]})
    sizes = [0] * len(report["parts"])
    for block in file.tets:
        sizes[(block["entity"] - 1) // bodies] += len(block["tags"])
    require(sizes == [part["tets"] for part in report["parts"]], f"volumes of {path} are the parts")
    require(is_near(file.volume(), report["input"]["volume"]), f"{path} has the volume of the input")
    require_same_areas(file.area_by_name(), surface_areas, path)
    judgement = subprocess.run(["gmsh", "-check", path], capture_output=True, text=True, timeout=60)
    complaints = re.findall(r"^(?:Error|Warning).*", judgement.stdout + judgement.stderr, flags=re.MULTILINE)
    require(judgement.returncode == 0 and not complaints, f"gmsh -check {path} has no {complaints[:1]}")


def check_as_meshio_reads_it(path, report, surface_areas):
    mesh = meshio.read(path)
    tets = mesh.cells_dict["tetra"]
    require(len(mesh.points) == report["totals"]["vertices"], f"meshio finds the vertices of {path}")
    require(len(tets) == report["totals"]["tets"], f"meshio finds the tetrahedra of {path}")
    each = volumes(mesh.points, tets)
    require(np.all(each > 0), f"meshio finds positive volumes in {path}")
    require(is_near(each.sum(), report["input"]["volume"]), f"meshio finds the volume of {path}")
    name_of = {int(tag): name for name, (tag, dimension) in mesh.field_data.items() if dimension == 2}
    groups = mesh.cell_data_dict["gmsh:physical"]["triangle"]
    each = areas(mesh.points, mesh.cells_dict["triangle"])
    found = {name_of[int(group)]: float(each[groups == group].sum()) for group in np.unique(groups)}
    require_same_areas(found, surface_areas, f"{path} as meshio reads it")
    bodies = sorted(int(tag) for tag, dimension in mesh.field_data.values() if dimension == 3)
    groups = mesh.cell_data_dict["gmsh:physical"]["tetra"]
    require(np.unique(groups).tolist() == bodies, f"meshio finds a group for each body in {path}")


def check_run(surface, run, parts, *merged):
    report = json.loads((run / "report.json").read_text())
    surface_areas = area_by_name_of_surface(surface)
    found = check_parts(parts, report, surface_areas)
    for path in merged:
        check_merged(path, report, found["elements"], surface_areas)
        check_as_meshio_reads_it(path, report, surface_areas)
    return found


def main():
    if len(sys.argv) < 5:
        sys.exit(__doc__)
    gmsh.initialize(readConfigFiles=False)
    gmsh.option.setNumber("General.Terminal", 0)
    try:
        print(json.dumps(check_run(*map(pathlib.Path, sys.argv[1:]))))
    except Broken as broken:
        print(json.dumps({"broken_law": str(broken)}))
        sys.exit(1)
    finally:
        gmsh.finalize()


if __name__ == "__main__":
    main()
