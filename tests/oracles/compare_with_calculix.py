"""Has CalculiX compute the case of solve_test.sh on the elements of a solution, and compares.

usage: python3 compare_with_calculix.py SOLUTION ORDER

Displacements of nodes, stresses of elements (the mean over the points of integration) and the reaction must agree; the
solution has the nodes on edges of order 2, in the order in which both programs have them. CalculiX prints seven digits.
Writes into the current folder; the exit code is 1 if something differs.
"""

import json
import pathlib
import re
import subprocess
import sys

import meshio
import numpy as np

PRESSURE, TRACTION = 2.5, np.array([1.0, 2.0, -3.0])
FIXED, PRESSED, PULLED = 0, 3, 1  # patches
# Of degree 4 on a triangle: weights of the corners, and of the point.
RULE = [(w, np.roll([1 - 2 * x, x, x], i)) for x, w in ((0.445948490915964886, 0.223381589678011466),
                                                       (0.0915762135097707435, 0.109951743655321868)) for i in range(3)]


class Solution:
    """The parts of a solution joined by their global numbers."""

    def __init__(self, folder, order=1):
        tetra, triangle = ("tetra", "triangle") if order == 1 else ("tetra10", "triangle6")
        parts = [meshio.read(file) for file in sorted((folder / "parts").glob("*.vtu"))]
        count = 1 + max(int(part.point_data["GlobalVertexId"].max()) for part in parts)
        self.points, self.displacement = np.zeros((count, 3)), np.zeros((count, 3))
        tets, stress, triangles, patch = [], [], [], []
        for part in parts:
            ids = part.point_data["GlobalVertexId"].ravel()
            self.points[ids] = part.points
            self.displacement[ids] = part.point_data["Displacement"]
            tets.append(ids[part.cells_dict[tetra]])
            stress.append(part.cell_data_dict["Stress"][tetra])
            triangles.append(ids[part.cells_dict[triangle]])
            patch.append(part.cell_data_dict["Patch"][triangle].ravel())
        self.tets, self.stress = np.concatenate(tets), np.concatenate(stress)
        self.triangles, self.patch = np.concatenate(triangles), np.concatenate(patch)


def shapes_of(place):
    """Values and slopes along the weights of the corners, of a triangle with six nodes."""
    a, b, c = place
    values = np.array([a * (2 * a - 1), b * (2 * b - 1), c * (2 * c - 1), 4 * a * b, 4 * b * c, 4 * a * c])
    slopes = np.array([[4 * a - 1, 0, 0], [0, 4 * b - 1, 0], [0, 0, 4 * c - 1], [4 * b, 4 * a, 0], [0, 4 * c, 4 * b],
                       [4 * c, 0, 4 * a]])
    return values, slopes


def shares_of_triangle(points):
    """For each point of the rule shapes of the nodes and the area vector, times its weight."""
    if len(points) == 3:
        return [(np.full(3, 1 / 3), np.cross(points[1] - points[0], points[2] - points[0]) / 2)]
    shares = []
    for weight, place in RULE:
        values, slopes = shapes_of(place)
        along = points.T @ slopes
        shares.append((values, weight * np.cross(along[:, 1] - along[:, 0], along[:, 2] - along[:, 0]) / 2))
    return shares


def nodal_forces(solution):
    """What pressure and traction put on the nodes."""
    forces = np.zeros_like(solution.points)
    for patch, of_normal in ((PRESSED, True), (PULLED, False)):
        for nodes in solution.triangles[solution.patch == patch]:
            for shapes, area in shares_of_triangle(solution.points[nodes]):
                forces[nodes] += np.outer(shapes, -PRESSURE * area if of_normal else TRACTION * np.linalg.norm(area))
    return forces


def number(x):
    """CalculiX reads no more than 20 characters of one."""
    return f"{x:.12e}"


def write_deck(points, elements, held, forces):
    kind = "C3D4" if elements.shape[1] == 4 else "C3D10"
    lines = ["*NODE, NSET=NALL"]
    lines += [f"{i + 1}, {number(x)}, {number(y)}, {number(z)}" for i, (x, y, z) in enumerate(points)]
    lines += [f"*ELEMENT, TYPE={kind}, ELSET=EALL"]
    lines += [", ".join(str(n) for n in [i + 1, *(nodes + 1)]) for i, nodes in enumerate(elements)]
    lines += ["*MATERIAL, NAME=STEEL", "*ELASTIC", "210000., 0.3", "*SOLID SECTION, ELSET=EALL, MATERIAL=STEEL"]
    lines += ["*BOUNDARY", *(f"{n + 1}, 1, 3" for n in held), "*STEP", "*STATIC", "*CLOAD"]
    lines += [f"{n + 1}, {c + 1}, {number(forces[n, c])}" for n in np.flatnonzero(forces.any(axis=1)) for c in range(3)]
    lines += ["*NODE PRINT, NSET=NALL", "U", "*EL PRINT, ELSET=EALL", "S", "*END STEP", ""]
    pathlib.Path("job.inp").write_text("\n".join(lines))


def rows_of(text, title, width):
    """The table below a headline as numbers."""
    lines = text[text.index(title):].splitlines()[1:]
    rows = []
    for line in lines:
        words = line.split()
        if len(words) == width:
            rows.append([float(word.replace("D", "E")) for word in words])
        elif rows and words:
            break
    return np.array(rows)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    folder, order = pathlib.Path(sys.argv[1]), int(sys.argv[2])
    solution = Solution(folder, order)
    points, elements = solution.points, solution.tets
    held = set(solution.triangles[solution.patch == FIXED].flat)
    forces = nodal_forces(solution)
    write_deck(points, elements, sorted(held), forces)
    done = subprocess.run(["ccx", "job"], capture_output=True, text=True, timeout=240)
    if done.returncode != 0 or "Job finished" not in done.stdout or re.search(r"\*ERROR", done.stdout):
        print(done.stdout[-4000:])
        sys.exit("CalculiX complains")

    data = pathlib.Path("job.dat").read_text()
    moved = rows_of(data, "displacements", 4)[:, 1:]
    stresses = rows_of(data, "stresses", 8)
    stress = np.zeros_like(solution.stress, dtype=float)
    points_each = len(stresses) // len(elements)
    np.add.at(stress, stresses[:, 0].astype(int) - 1, stresses[:, [2, 3, 4, 5, 7, 6]] / points_each)  # xx yy zz xy xz yz

    report = json.loads((folder / "report.json").read_text())["solve"]["cases"][0]
    far = np.abs(moved - solution.displacement).max() / np.abs(moved).max()
    off = np.abs(stress - solution.stress).max() / np.abs(stress).max()
    reaction = np.array(report["reactions"][0]["reaction"])
    unbalanced = np.linalg.norm(reaction + forces.sum(axis=0)) / np.linalg.norm(forces.sum(axis=0))
    print(f"order {order}: {len(points)} nodes; displacements differ by {far:.1e}, stresses by {off:.1e} of the largest; "
          f"reaction by {unbalanced:.1e}")
    assert far < 1e-6 and off < 1e-4 and unbalanced < 1e-9


if __name__ == "__main__":
    main()
