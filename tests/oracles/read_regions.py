"""Makes a body of three regions with Gmsh, and counts the cells of each region in what Kerf has written of it: with VTK,
meshio, Gmsh, h5py, DOLFINx, and by the words of OpenFOAM's checkMesh, TetGen, and the tools of MED and CGNS.

usage: python3 read_regions.py make FILE.msh
       python3 read_regions.py judge DIR

DIR is that of regions_test.sh. Prints the cells of each region; the exit code is 1 if a format has others.
"""

import collections
import contextlib
import io
import pathlib
import re
import sys

import gmsh
import h5py
import merged_formats
import meshio
import numpy as np
import vtk
from dolfinx.io import XDMFFile
from mpi4py import MPI
from vtk.util.numpy_support import vtk_to_numpy

VTK_TETRA, VTK_TRIANGLE = 10, 5
# In the order of the regions; an OpenFOAM word for each.
REGIONS = {"steel": "steel", "core (hot)": "core_hot", "air": "air"}
WALLS = ["contact", "shell"]


class Broken(Exception):
    pass


def require_same(found, wanted, what):
    if dict(found) != dict(wanted):
        raise Broken(f"{what} has {dict(found)}, not {dict(wanted)}")


def make(path):
    """Two cubes side by side, and a ball inside of the second one."""
    occ = gmsh.model.occ
    steel = occ.addBox(0, 0, 0, 1, 1, 1)
    others = [(3, occ.addBox(1, 0, 0, 1, 1, 1)), (3, occ.addSphere(1.5, 0.5, 0.5, 0.3))]
    occ.fragment([(3, steel)], others)
    occ.synchronize()

    def name(dimension, entities, words):
        gmsh.model.setPhysicalName(dimension, gmsh.model.addPhysicalGroup(dimension, entities), words)

    volumes = sorted((t for _, t in gmsh.model.getEntities(3)), key=lambda t: occ.getMass(3, t))
    core, (air, steel) = volumes[0], sorted(volumes[1:], key=lambda t: -occ.getCenterOfMass(3, t)[0])
    for words, volume in zip(REGIONS, (steel, core, air)):
        name(3, [volume], words)
    beside = {t: set(gmsh.model.getAdjacencies(2, t)[0]) for _, t in gmsh.model.getEntities(2)}
    name(2, [t for t, of in beside.items() if len(of) == 1], "outside")
    name(2, [t for t, of in beside.items() if of == {steel, air}], "contact")
    name(2, [t for t, of in beside.items() if of == {core, air}], "shell")
    gmsh.option.setNumber("Mesh.CharacteristicLengthMax", 0.25)
    gmsh.model.mesh.generate(3)
    gmsh.write(path)


def read(path):
    """meshio's mesh; it says that it has no names for SU2's markers."""
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        return meshio.read(path)


def by_number(numbers, names):
    """How many there are of each, by the names of the numbers from 1."""
    return {names[int(n) - 1]: int(count) for n, count in zip(*np.unique(numbers, return_counts=True))}


def data_of(mesh, array, kind):
    blocks = [data for cells, data in zip(mesh.cells, mesh.cell_data[array]) if cells.type == kind]
    return np.concatenate(blocks).ravel()


def counts_of_parts(run):
    """Cells and triangles of the part files by region and patch; those of a wall are there twice."""
    reader = vtk.vtkXMLPUnstructuredGridReader()
    reader.SetFileName(str(run / "mesh.pvtu"))
    reader.Update()
    grid = reader.GetOutput()
    kinds = vtk_to_numpy(grid.GetCellTypesArray())
    region = vtk_to_numpy(grid.GetCellData().GetArray("Region"))[kinds == VTK_TETRA]
    patch = vtk_to_numpy(grid.GetCellData().GetArray("Patch"))[kinds == VTK_TRIANGLE]
    names = bytes(vtk_to_numpy(grid.GetFieldData().GetArray("PatchNames"))).decode().split("\0")
    patches = by_number(patch[patch >= 0] + 1, names)
    for wall in WALLS:
        patches[wall] //= 2
    return by_number(region + 1, list(REGIONS)), patches, names


def judge_gmsh(paths, regions, patches):
    """Together; cells that parts have of others are in no physical group."""
    found = {2: collections.Counter(), 3: collections.Counter()}
    for path in paths:
        gmsh.open(str(path))
        for dimension, tag in gmsh.model.getPhysicalGroups():
            for entity in gmsh.model.getEntitiesForPhysicalGroup(dimension, tag):
                number = sum(len(tags) for tags in gmsh.model.mesh.getElements(dimension, entity)[1])
                if number > 0:
                    found[dimension][gmsh.model.getPhysicalName(dimension, tag)] += number
        gmsh.clear()
    require_same(found[3], regions, f"{paths[0]} as Gmsh reads it")
    require_same(found[2], patches, f"{paths[0]} as Gmsh reads it")


def judge_meshio(folder, regions, patches, names):
    groups = list(patches)
    for file, array, first_region in (("whole.mesh", "medit:ref", 0), ("whole.msh", "gmsh:physical", len(names)),
                                      ("whole22.msh", "gmsh:physical", len(names))):
        mesh = read(folder / file)
        require_same(by_number(data_of(mesh, array, "tetra") - first_region, list(REGIONS)), regions, file)
        require_same(by_number(data_of(mesh, array, "triangle"), names), patches, file)
    for file in ("whole.node", "whole.1.node"):
        found = data_of(read(folder / file), "tetgen:ref", "tetra")
        require_same(by_number(found, list(REGIONS)), regions, file)
    sets = {name: sum(len(block) for block in blocks) for name, blocks in read(folder / "whole.inp").cell_sets.items()}
    require_same({name: sets[word] for name, word in REGIONS.items()}, regions, "whole.inp")
    faces = {patch: sum(sets.get(f"{patch}_S{face}", 0) for face in range(1, 5)) for patch in groups}
    require_same(faces, patches, "the surfaces of whole.inp")
    triangles = sum(len(cells.data) for cells in read(folder / "whole.su2").cells if cells.type == "triangle")
    require_same({"outside": triangles}, {"outside": patches["outside"]}, "whole.su2")


def judge_others(folder, regions, patches):
    for ending in merged_formats.ENDINGS:
        path = folder / f"whole.{ending}"
        mesh = merged_formats.read(path)
        words = {name: name if ending == "vtk" else word for name, word in REGIONS.items()}
        require_same(mesh.cells_by_region(), {words[name]: count for name, count in regions.items()}, path)
        require_same(mesh.triangles_by_patch(), patches, path)


def judge_dolfinx(path, regions):
    with XDMFFile(MPI.COMM_SELF, str(path), "r") as file:
        tags = file.read_meshtags(file.read_mesh(name="mesh"), name="mesh")
    require_same(by_number(tags.values, list(REGIONS)), regions, f"{path} as DOLFINx reads it")


def judge(folder):
    regions, patches, names = counts_of_parts(folder / "run")
    names = [name for name in names if name]
    print(regions, patches)
    whole = read(folder / "whole.vtu")
    require_same(by_number(data_of(whole, "Region", "tetra") + 1, list(REGIONS)), regions, "whole.vtu")
    require_same(by_number(data_of(whole, "Patch", "triangle") + 1, names), patches, "whole.vtu")
    for pattern in ("whole.msh", "whole22.msh", "parts/mesh_*.msh"):
        judge_gmsh(sorted(folder.glob(pattern)), regions, patches)
    judge_meshio(folder, regions, patches, names)
    judge_others(folder, regions, patches)
    with h5py.File(folder / "whole.h5") as file:
        called = [name.decode() for name in file["viz/region_names"]]
        require_same(by_number(file["viz/region"][:], called), regions, "whole.h5")
    judge_dolfinx(folder / "hdf5" / "mesh.xdmf", regions)
    for case in ("foam", "serial"):
        log = (folder / f"{case}.log").read_text()
        zones = {name: int(re.search(rf"^ *{word} +(\d+) ", log, re.MULTILINE)[1]) for name, word in REGIONS.items()}
        require_same(zones, regions, f"the case {case}")
        if "Mesh OK." not in log or "boundary patches: 1\n" not in log:
            raise Broken(f"checkMesh of the case {case}:\n{log}")


def main():
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    try:
        if sys.argv[1] == "make":
            make(sys.argv[2])
        else:
            judge(pathlib.Path(sys.argv[2]))
    except (Broken, merged_formats.Unfit) as broken:
        print(broken, file=sys.stderr)
        sys.exit(1)
    finally:
        gmsh.finalize()


main()
