"""Makes a bar of two cubes, rubber and steel, and its case; then has CalculiX compute it from Kerf's Abaqus file with a
material for each set of elements, and compares with kerf solve.

usage: python3 compare_bimaterial.py make|judge

`make` writes rubber.stl, steel.stl and case.toml into the current folder, `judge` reads bar.inp, stress.vtu and stress/
from there. One end is held, the other one moved along the bar, and the materials contract sideways by different shares,
so that stresses jump at the wall. CalculiX prints seven digits. The exit code is 1 if something differs.
"""

import json
import pathlib
import re
import subprocess
import sys

import meshio
import numpy as np
from compare_with_calculix import rows_of

MATERIALS = {"rubber": (10, 0.45), "steel": (1000, 0.25)}
LENGTH, MOVED = 2, 0.1


def write_cube(name, low):
    """From x = low to low + 1; diagonals are those of the cube beside it."""
    lines = [f"solid {name}"]
    for axis in range(3):
        for at in (0, 1):
            square = np.zeros((4, 3))
            square[:, axis] = at
            square[:, (axis + 1) % 3] = [0, 1, 1, 0]
            square[:, (axis + 2) % 3] = [0, 0, 1, 1]
            for corners in ([0, 1, 2], [0, 2, 3]):
                lines += ["facet normal 0 0 0", "outer loop"]
                lines += ["vertex {} {} {}".format(*(square[c] + [low, 0, 0])) for c in (corners if at else corners[::-1])]
                lines += ["endloop", "endfacet"]
    pathlib.Path(f"{name}.stl").write_text("\n".join([*lines, f"endsolid {name}", ""]))


def make():
    for low, name in enumerate(MATERIALS):
        write_cube(name, low)
    materials = [f"[material.{n}]\nyoung = {young}\npoisson = {poisson}\n" for n, (young, poisson) in MATERIALS.items()]
    pathlib.Path("case.toml").write_text("\n".join(materials) + f"""
[[support]]
name = "held"
plane = [1, 0, 0, 0]
fixed = true

[[support]]
name = "moved"
plane = [1, 0, 0, {LENGTH}]
x = {MOVED}
y = 0
z = 0

[solver]
rtol = 1e-11
""")


def write_deck(points):
    lines = ["*INCLUDE, INPUT=bar.inp"]
    for name, (young, poisson) in MATERIALS.items():
        lines += [f"*MATERIAL, NAME=OF_{name}", "*ELASTIC", f"{young}., {poisson}"]
        lines += [f"*SOLID SECTION, ELSET={name}, MATERIAL=OF_{name}"]
    lines += ["*STEP", "*STATIC", "*BOUNDARY"]
    lines += [f"{n + 1}, 1, 3, 0." for n in np.flatnonzero(points[:, 0] == 0)]
    for n in np.flatnonzero(points[:, 0] == LENGTH):
        lines += [f"{n + 1}, 1, 1, {MOVED}", f"{n + 1}, 2, 3, 0."]
    lines += ["*NODE PRINT, NSET=NALL", "U, RF", "*EL PRINT, ELSET=EALL", "S", "*END STEP", ""]
    pathlib.Path("job.inp").write_text("\n".join(lines))


def elements_of(path):
    """Nodes, from 0, of the elements by their numbers."""
    blocks = re.findall(r"^\*ELEMENT,.*\n([^*]*)", path.read_text(), re.MULTILINE)
    table = np.array([row.split(",") for block in blocks for row in block.split()], dtype=int)
    table = table[np.argsort(table[:, 0])]
    assert np.array_equal(table[:, 0], np.arange(1, len(table) + 1)), "elements are numbered from 1"
    return table[:, 1:] - 1


def judge():
    solved = meshio.read("stress.vtu")
    tets = solved.cells_dict["tetra"]
    assert np.array_equal(elements_of(pathlib.Path("bar.inp")), tets), "the files have the same elements"
    write_deck(solved.points)
    done = subprocess.run(["ccx", "job"], capture_output=True, text=True, timeout=240)
    if done.returncode != 0 or "Job finished" not in done.stdout or re.search(r"\*ERROR", done.stdout):
        print(done.stdout[-4000:])
        sys.exit("CalculiX complains")

    data = pathlib.Path("job.dat").read_text()
    moved, force = (rows_of(data, title, 4)[:, 1:] for title in ("displacements", "forces"))
    stress = rows_of(data, "stresses", 8)[:, [2, 3, 4, 5, 7, 6]]  # xx yy zz xy xz yz
    of_kerf = solved.cell_data_dict["Stress"]["tetra"]
    region = solved.cell_data_dict["Region"]["tetra"].ravel()
    far = np.abs(moved - solved.point_data["Displacement"]).max() / MOVED
    off = [np.abs(stress - of_kerf)[region == r].max() / np.abs(stress[region == r]).max() for r in range(len(MATERIALS))]
    report = json.loads(pathlib.Path("stress/report.json").read_text())["solve"]["cases"][0]
    pull = force[solved.points[:, 0] == LENGTH].sum(axis=0)
    # The end that is moved is steel, the other one rubber.
    found = [[np.array(each["reaction"]) for each in of["reactions"]] for of in report["regions"]]
    unlike = np.linalg.norm(found[1][1] - pull) / np.linalg.norm(pull)
    print(f"{len(tets)} elements; displacements differ by {far:.1e} of the largest, stresses by {off[0]:.1e} in rubber and "
          f"{off[1]:.1e} in steel; the reaction of steel by {unlike:.1e}")
    assert far < 1e-6 and max(off) < 1e-4 and unlike < 1e-5
    assert not found[0][1].any() and not found[1][0].any(), "no end has cells of the other material"


if __name__ == "__main__":
    {"make": make, "judge": judge}[sys.argv[1]]()
