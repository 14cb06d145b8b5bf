#!/usr/bin/env python3
"""Bodies of several regions that share walls: Kerf, TetGen, gmsh where it is, and CGAL, on the same facets.

usage: regions.py [all] [--kerf KERF] [--helper PROGRAM] [--cgal PROGRAM] [--only WORD] [--files FILE,...:BOUND]...
                  [--repetitions N] [--long SECONDS] [--limit SECONDS] [--json FILE]

All are given each facet once and what lies on its sides: Kerf and TetGen points in the regions, gmsh the surfaces that
bound them, CGAL's Polyhedral_complex_mesh_domain_3 a surface for each pair of regions, with the pair. Kerf, TetGen and
gmsh keep the facets; CGAL makes others. Bounds are of the volume (TetGen: -pYAQq1.4a), or edges (gmsh) and radii
(CGAL) that make about as many cells. Kerf, gmsh and CGAL make the cells better, as they do by default; TetGen's are as
it leaves them, and so are Kerf's once more (--no-improve).

Seconds are those of the processor, medians over repetitions that take turns; who needs more than --long of them is
called once. Kerf's are those of the whole command `kerf mesh` and of all processes that it starts, with the system's:
it reads, finds the regions, cuts, meshes, verifies and writes. With two workers they are about those with one, and the
wall clock tells what the second one is worth. The others' are those of the user on meshing alone, in memory (gmsh's by
its log). Cells by second and core are cells by these seconds.

What comes out is measured by one program (tests/bench/regions_bench.cpp): how many regions have cells; by how much the
volume inside of the cells of a region, of the worst, and that of all cells together differ from that inside of the
given facets; the least angle of the cells, and that below which a hundredth of them have their smallest dihedral angle.

Bodies: cement in bone (assets), a ball in a cube, two rings through each other in a box, fibres in a block, twenty
layers, fifty grains that are made of cubes; all but the first with ten times as many cells, too, by Kerf and TetGen, or
by all of them if it says `all`. --files: one file that has several regions, or several that touch, and the bound of the
volume of a cell, 0 for none, in place of these.
"""

import argparse
import dataclasses
import json
import os
import pathlib
import shutil
import sys
import tempfile

from measured import output_of, rate_text, ratio_text, run_gmsh, run_measured
from meshers import Call

ROOT = pathlib.Path(__file__).resolve().parents[2]
EDGE_OF_BOUND = 2.35  # of gmsh: cube of the edge length that makes as many cells as a bound of 1 in TetGen
RADIUS_OF_BOUND = 1.35  # of CGAL: the radius, by the cube root of the bound
PARTS = 8  # of Kerf, or one for each region if there are more
DELAUNAY = 1  # of gmsh's algorithms: the default
GMSH_SCRIPT = """General.NumThreads = 1;
Mesh.MaxNumThreads3D = 1;
Mesh.Algorithm3D = {algorithm};
Mesh.Optimize = 1;
Mesh.Binary = 1;
{size}
Merge "{surface}";
{volumes}
Mesh 3;
Save "{mesh}";
"""
GMSH_VOLUME = """Surface Loop({i}) = {{{surfaces}}};
Volume({i}) = {{{i}}};
Physical Volume("region_{i}") = {{{i}}};"""
COLUMNS = ("body", "regions", "mesher", "cells", "seconds", "wall", "cells/s", "ratio", "least", "1 %", "median",
           "error", "of all")
LAYOUT = "{:<18} {:>7} {:<15} {:>9} {:>8} {:>7} {:>9} {:>6} {:>6} {:>6} {:>6} {:>8} {:>8}"


@dataclasses.dataclass
class Case:
    label: str
    words: list  # of the helper: a body and its fineness, or files
    bound: float
    is_large: bool = False  # too long for gmsh and CGAL where `all` is not asked for


def assets(*names):
    return [ROOT / f"assets/{name}.stl" for name in names]


# Bounds that fit the facets, which are as fine as it says, but for the bone.
CASES = [
    Case("cement in bone", assets("bone", "cement"), 5e-4),
    Case("ball in a cube", ["ball", 7], 1.5e-4),
    Case("linked rings", ["rings", 6], 3e-4),
    Case("fibres in a block", ["fibres", 4], 2e-4),
    Case("20 layers", ["layers", 2], 0.1),
    Case("50 grains", ["grains", 28], 0.1),
    Case("ball, 3 M", ["ball", 15], 1.5e-5, True),
    Case("linked rings, 3 M", ["rings", 13], 3e-5, True),
    Case("fibres, 4 M", ["fibres", 9], 1.8e-5, True),
    Case("20 layers, 2 M", ["layers", 4], 0.1, True),
    Case("50 grains, 4 M", ["grains", 60], 0.1, True),
]


class Mesher(Call):
    """Subclasses: fill(limit) makes self.result and returns seconds of the processor, of the clock, and memory."""

    def __init__(self, name, args, stem, ending):
        super().__init__(name)
        self.args, self.surface = args, stem.with_suffix(".smesh")
        self.result_file = stem.parent / f"{name.replace(' ', '_').replace(',', '')}{ending}"

    def call(self, measured, limit):
        figures = self.fill(limit)
        if measured:
            figures |= output_of(self.args.helper, "measure", self.surface, self.measured_file())
        return figures

    def measured_file(self):
        return self.result_file


class Kerf(Mesher):
    def __init__(self, name, options, args, stem, given, bound):
        super().__init__(name, args, stem, "")
        size = ["--max-volume", repr(bound)] if bound else []
        parts = max(PARTS, given["regions"])
        self.command = [args.kerf, "mesh", self.surface, "-o", self.result_file, "-n", parts, "--surface", "keep",
                        "-q", *options, *size]

    def fill(self, limit):
        shutil.rmtree(self.result_file, ignore_errors=True)
        done = run_measured(self.command, self.surface.with_suffix(".log"), limit)
        if done.exit_code != 0:
            raise RuntimeError(done.log.strip() or f"kerf ended with code {done.exit_code}")
        return {"seconds": done.processor_seconds, "wall_seconds": done.seconds, "peak_bytes": done.peak_bytes}

    def measured_file(self):
        merged = self.result_file.with_suffix(".msh")
        run_measured([self.args.kerf, "merge", self.result_file, "-o", merged, "-q"], merged.with_suffix(".log"),
                     self.args.limit)
        return merged


class TetGen(Mesher):
    def __init__(self, args, stem, bound):
        super().__init__("TetGen", args, stem, ".mesh")
        self.bound = bound

    def fill(self, limit):
        return output_of(self.args.helper, "tetgen", self.surface, repr(self.bound), self.result_file, limit=limit)


class Cgal(Mesher):
    def __init__(self, args, stem, bound):
        super().__init__("CGAL", args, stem, ".mesh")
        self.size = RADIUS_OF_BOUND * bound ** (1 / 3)

    def fill(self, limit):
        return output_of(self.args.cgal, self.surface, repr(self.size), self.result_file, limit=limit)


class Gmsh(Mesher):
    def __init__(self, args, stem, given, bound):
        super().__init__("gmsh", args, stem, ".msh")
        self.script = stem.with_suffix(".geo")
        size = (EDGE_OF_BOUND * bound) ** (1 / 3)
        self.script.write_text(GMSH_SCRIPT.format(
            algorithm=DELAUNAY, surface=stem.with_suffix(".msh"), mesh=self.result_file,
            size=f"Mesh.MeshSizeExtendFromBoundary = 0;\nMesh.MeshSizeMax = {size!r};" if bound else "",
            volumes="\n".join(GMSH_VOLUME.format(i=i + 1, surfaces=surfaces)
                              for i, surfaces in enumerate(given["surfaces"]))))

    def fill(self, limit):
        done, made, improved = run_gmsh(self.script, self.script.with_suffix(".log"), limit)
        return {"seconds": made + improved, "peak_bytes": done.peak_bytes}


def print_row(case, given, row, reference):
    if "failure" in row:
        print(f"{case.label:<18} {given['regions']:>7} {row['mesher']:<15} {row['failure'][:150]}")
        return
    rate = row["tets_per_second"]
    print(LAYOUT.format(
        case.label, f"{row['regions']}/{given['regions']}", row["mesher"], f"{row['tets']:,}", f"{row['seconds']:.2f}",
        f"{row['wall_seconds']:.2f}" if "wall_seconds" in row else "", rate_text(rate),
        ratio_text(rate, reference), f"{row['dihedral_0']:.1f}", f"{row['dihedral_1']:.1f}",
        f"{row['dihedral_50']:.1f}", f"{row['region_error']:.1e}", f"{row['volume_error']:.1e}"))


def meshers_on(args, case, stem, given):
    meshers = [Kerf(name, options, args, stem, given, case.bound)
               for name, options in (("kerf", ["-j", "1"]), ("kerf, 2 workers", ["-j", "2"]),
                                     ("kerf, as it is", ["-j", "1", "--no-improve"]))]
    meshers.append(TetGen(args, stem, case.bound))
    if case.is_large and args.which != "all":
        return meshers
    if shutil.which("gmsh"):
        meshers.append(Gmsh(args, stem, given, case.bound))
    if case.bound and args.cgal.exists():
        meshers.append(Cgal(args, stem, case.bound))
    return meshers


def compare(args, case):
    with tempfile.TemporaryDirectory(prefix="kerf_regions_bench_") as scratch:
        stem = pathlib.Path(scratch) / "surface"
        given = output_of(args.helper, "prepare", stem, *case.words)
        meshers = meshers_on(args, case, stem, given)
        for _ in range(args.repetitions):
            for mesher in meshers:
                mesher.run(args)
    rows = [mesher.result() for mesher in meshers]
    reference = next((row.get("tets_per_second") for row in rows if row["mesher"] == "TetGen"), None)
    for row in rows:
        print_row(case, given, row, reference)
    sys.stdout.flush()
    return {"body": case.label, "facets": given["facets"], "regions": given["regions"], "bound": case.bound,
            "rows": rows}


def case_of_files(text):
    files, _, bound = text.rpartition(":")
    paths = [pathlib.Path(name) for name in files.split(",")]
    return Case(paths[0].stem[:18], paths, float(bound))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("which", nargs="?", choices=("quick", "all"), default="quick")
    parser.add_argument("--kerf", default=ROOT / "build/kerf", help="program to measure")
    parser.add_argument("--helper", default=ROOT / "build/regions_bench")
    parser.add_argument("--cgal", type=pathlib.Path, default=ROOT / "build/regions_cgal_bench")
    parser.add_argument("--only", help="bodies whose names contain this")
    parser.add_argument("--files", type=case_of_files, action="append", help="FILE,...:BOUND, in place of the bodies")
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--long", type=float, default=12, help="seconds of a call that is not repeated")
    parser.add_argument("--limit", type=float, default=600, help="seconds for one call")
    parser.add_argument("--json", type=pathlib.Path, help="file for the results")
    args = parser.parse_args()

    load = os.getloadavg()[0]
    print(f"seconds of the processor, medians of {args.repetitions}; ratio: rate by TetGen's; angles in degrees; error:"
          f" of the volume of the worst region, and of all; {os.cpu_count()} cores, load {load:.1f} at the start")
    print(LAYOUT.format(*COLUMNS))
    cases = [case for case in args.files or CASES if not args.only or args.only in case.label]
    comparisons = [compare(args, case) for case in cases]
    if args.json:
        figures = {"cores": os.cpu_count(), "load_at_start": load, "repetitions": args.repetitions,
                   "bodies": comparisons}
        args.json.write_text(json.dumps(figures, indent=2) + "\n")


if __name__ == "__main__":
    main()
