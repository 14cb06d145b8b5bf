"""What the readers of HDF5 compare with: the surface that was meshed and the report of the run."""

import json
import pathlib
import re

import numpy as np


class Broken(Exception):
    pass


def require(holds, law):
    if not holds:
        raise Broken(law)


def same(found, wanted):
    return np.isclose(found, wanted, rtol=1e-9, atol=0)


def tet_volumes(points, corners):
    a, b, c, d = (points[corners[:, i]] for i in range(4))
    return np.einsum("ij,ij->i", b - a, np.cross(c - a, d - a)) / 6


def triangle_areas(points, corners):
    a, b, c = (points[corners[:, i]] for i in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2


class Expected:
    """Of the run NAME, the surface of which is NAME.stl, ASCII with a solid a patch."""

    def __init__(self, name):
        report = json.loads((pathlib.Path(name) / "report.json").read_text())
        self.tets = report["totals"]["tets"]
        self.vertices = report["totals"]["vertices"]
        self.parts = [(part["id"], part["tets"], part["vertices"]) for part in report["parts"]]
        self.areas = {}
        self.volume = 0.0
        text = pathlib.Path(name + ".stl").read_text(encoding="utf-8")
        for solid in re.split(r"^endsolid.*\n", text, flags=re.MULTILINE)[:-1]:
            patch = solid.split("\n", 1)[0].removeprefix("solid ")
            corners = re.findall(r"vertex\s+(\S+)\s+(\S+)\s+(\S+)", solid)
            points = np.array(corners, dtype=float)
            facets = np.arange(len(points)).reshape(-1, 3)
            self.areas[patch] = self.areas.get(patch, 0) + triangle_areas(points, facets).sum()
            a, b, c = (points[facets[:, i]] for i in range(3))
            self.volume += np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6

    def check_areas(self, areas, reader):
        require(areas.keys() == self.areas.keys(), f"{reader} finds the patches")
        for name, area in self.areas.items():
            require(same(areas[name], area), f"{reader} finds the area of {name}")


def areas_by_patch(points, triangles, patches, names):
    areas = np.bincount(patches, weights=triangle_areas(points, triangles), minlength=len(names))
    return {name: area for name, area in zip(names, areas) if area > 0}
