"""Mesh, tags and names of patches in DOLFINx, on any number of processes: ../solvers.md"""

from dolfinx.io import XDMFFile
from mpi4py import MPI
from xml.etree import ElementTree

with XDMFFile(MPI.COMM_WORLD, "mesh/mesh.xdmf", "r") as file:
    mesh = file.read_mesh()
    mesh.topology.create_entities(2)
    patches = file.read_meshtags(mesh, "facets")  # numbers of patches, from 1
    bodies = file.read_meshtags(mesh, "mesh")     # of regions, or else bodies, from 1
# The names of the patches:
entries = ElementTree.parse("mesh/mesh.xdmf").findall("Domain/Information")
named = [(entry.get("Name").split(), entry.get("Value")) for entry in entries]  # "patch 4", "region 1"
number_of = {name: int(number) for (kind, number), name in named if kind == "patch"}
facets = patches.indices[patches.values == number_of["face_3"]]
