"""Has CalculiX compute a body that is fixed at one end and pressed at the other one, and compares the reactions with
the load.

usage: python3 compute_with_calculix.py MESH.inp MESH.mesh

The ends are the patches that lie at the largest and at the smallest x. They are found, and the load is integrated, in
MESH.mesh, of order 1; CalculiX reads MESH.inp, of any order, in which patches are called as comments of MESH.mesh say.
Writes into the current folder. The exit code is 1 if CalculiX fails or forces do not balance.
"""

import pathlib
import re
import subprocess
import sys

import meshio
import numpy as np

PRESSURE = 2.5  # MPa


def end_patches(mesh):
    """Numbers and vector areas of the two patches: right end, left end."""
    triangles, patch = mesh.cells_dict["triangle"], mesh.cell_data_dict["medit:ref"]["triangle"] - 1
    x = mesh.points[:, 0]
    ends = []
    for bound in (x.max(), x.min()):
        at_end = np.all(np.abs(x[triangles] - bound) < 1e-6 * np.ptp(x), axis=1)
        numbers = np.unique(patch[at_end])
        assert len(numbers) == 1 and np.array_equal(at_end, patch == numbers[0]), "a patch is the end of the body"
        a, b, c = (mesh.points[triangles[at_end][:, i]] for i in range(3))
        ends.append((int(numbers[0]), np.cross(b - a, c - a).sum(axis=0) / 2))
    return ends


def names_of_patches(mesh_file):
    text = pathlib.Path(mesh_file).read_text()
    return re.findall(r"^# reference \d+ of triangles: (.*)$", text, re.MULTILINE)


def deck(mesh_file, fixed, loaded):
    return f"""*INCLUDE, INPUT={mesh_file}
*MATERIAL, NAME=STEEL
*ELASTIC
210000., 0.3
*SOLID SECTION, ELSET=EALL, MATERIAL=STEEL
*BOUNDARY
{fixed}, 1, 3
*STEP
*STATIC
*DSLOAD
{loaded}, P, {PRESSURE}
*NODE PRINT, NSET={fixed}, TOTALS=ONLY
RF
*NODE PRINT, NSET=NALL
U
*EL PRINT, ELSET=EALL, TOTALS=ONLY
EVOL
*END STEP
"""


def node_count(mesh_file):
    return pathlib.Path(mesh_file).read_text().split("*NODE, NSET=NALL\n")[1].split("*")[0].count("\n")


def number_of(word):
    return float(word.replace("D", "E"))


def numbers_after(text, headline):
    """The first line of numbers behind the line that has the headline in it."""
    lines = text[text.lower().index(headline):].splitlines()[1:]
    return np.array([number_of(word) for word in next(line for line in lines if line.strip()).split()])


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    mesh, names = meshio.read(sys.argv[2]), names_of_patches(sys.argv[2])
    (fixed, _), (loaded, vector_area) = end_patches(mesh)
    pathlib.Path("job.inp").write_text(deck(sys.argv[1], names[fixed], names[loaded]))
    done = subprocess.run(["ccx", "job"], capture_output=True, text=True, timeout=240)
    if done.returncode != 0 or "Job finished" not in done.stdout or re.search(r"\*(ERROR|WARNING)", done.stdout):
        print(done.stdout[-4000:])
        sys.exit("CalculiX complains")

    data = pathlib.Path("job.dat").read_text()
    reaction = numbers_after(data, "total force")
    load = -PRESSURE * vector_area  # against the normal
    print("load", load, "reaction", reaction)
    assert np.allclose(reaction, -load, rtol=0, atol=1e-5 * np.linalg.norm(load)), "the reactions balance the load"

    a, b, c, d = (mesh.points[mesh.cells_dict["tetra"][:, i]] for i in range(4))
    volume = np.einsum("ij,ij->i", b - a, np.cross(c - a, d - a)).sum() / 6
    assert np.isclose(numbers_after(data, "total volume")[0], volume, rtol=1e-6), "CalculiX finds the volume"

    rows = re.findall(r"^\s+(\d+)\s+(\S+E[+-]\d+)\s+(\S+E[+-]\d+)\s+(\S+E[+-]\d+)$", data, re.MULTILINE)
    assert len(rows) == node_count(sys.argv[1]), "every node has moved"
    moved = np.array([[number_of(word) for word in row[1:]] for row in rows])
    on_loaded = np.unique(mesh.cells_dict["triangle"][mesh.cell_data_dict["medit:ref"]["triangle"] - 1 == loaded])
    towards = moved[on_loaded] @ (load / np.linalg.norm(load))
    print("the loaded end moves", towards.min(), "to", towards.max())
    assert np.all(towards > 0), "the loaded end moves as it is pressed"


if __name__ == "__main__":
    main()
