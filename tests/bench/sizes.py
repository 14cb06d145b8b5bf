#!/usr/bin/env python3
"""How near the edges of a mesh are to the size that was asked for: Kerf, and gmsh where it is, on the same files.

usage: sizes.py [--kerf KERF] [--helper PROGRAM] [--surface FILE]... [--corpus FOLDER] [--only WORD]
                [--shares SHARE,SHARE,...] [--limit SECONDS] [--json FILE]

Every file is meshed with three sizes, shares of its diagonal, each half of the one before. Kerf is `kerf mesh --size`
with one part and two workers, once by default (a surface of good facets is kept) and once with --surface remesh, where
that is another mesh. gmsh has MeshSizeMin = MeshSizeMax = size and no others; it reads CAD files itself, and divides
other surfaces at edges of more than 30 degrees (ClassifySurfaces, CreateGeometry). Seconds are those of whole commands,
once, and end at the limit. "gmsh, as long" is
gmsh once more, with the size for which its edges are as long on average as those of Kerf, so that cells compare. What comes out is measured by one program (tests/bench/sizes_bench.cpp): the share of edges
with 0.7 to 1.4 of the size, and their mean over it, on the boundary and everywhere, cells, and the angle below which
a hundredth of the cells have their smallest dihedral angle. Growth is the number of cells over that with twice the
size: 8 for a body of any size, 4 where it is thin.
"""

import argparse
import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
CAD_ENDINGS = (".step", ".stp", ".iges", ".igs", ".brep")
SURFACE_ENDINGS = (".stl", ".obj", ".ply", ".off", ".mesh", ".smesh")
MERGE_SURFACE = """Merge "{file}";
ClassifySurfaces{{30 * Pi / 180, 1, 1, Pi}};
CreateGeometry;
Surface Loop(1) = Surface{{:}};
Volume(1) = {{1}};
"""
MERGE_CAD = """Geometry.OCCTargetUnit = "MM";
Merge "{file}";
"""
SIZES = """Mesh.MeshSizeMin = {size!r};
Mesh.MeshSizeMax = {size!r};
Mesh.Binary = 1;
"""
COLUMNS = ("file", "size", "program", "cells", "growth", "surface", "mean", "all", "mean", "least", "1 %",
           "seconds")
LAYOUT = "{:<26} {:>8} {:<14} {:>10} {:>6} {:>8} {:>6} {:>7} {:>6} {:>6} {:>6} {:>8}"


def output_of(*command):
    done = subprocess.run([str(word) for word in command], stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip() or f"{command[0]} ended with code {done.returncode}")
    return json.loads(done.stdout)


class Program:
    """One mesher on one file: what it is called, and its command for a size."""

    def __init__(self, name, command_of):
        self.name, self.command_of = name, command_of

    def row(self, args, size, result, asked=None):
        """Meshes with a size and measures against it, or against what the user has asked for."""
        result.unlink(missing_ok=True)
        start = time.perf_counter()
        try:
            done = subprocess.run([str(word) for word in self.command_of(size, result)], stdin=subprocess.DEVNULL,
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=args.limit)
        except subprocess.TimeoutExpired:
            return {"program": self.name, "failure": f"more than {args.limit:g} s"}
        seconds = time.perf_counter() - start
        if done.returncode != 0 or not result.exists():
            return {"program": self.name, "failure": f"ended with code {done.returncode}"}
        try:
            figures = output_of(args.helper, "measure", result, repr(asked or size))
        except RuntimeError as error:
            return {"program": self.name, "failure": str(error)}
        return {"program": self.name, "seconds": seconds, **figures}


def is_same_mesh(row, other):
    return "cells" in row and all(row[name] == other.get(name) for name in ("cells", "volume", "all"))


def with_edges_as_long(args, program, size, row, aim, result):
    """Returns the row of a program whose edges are as long as the aim says, both over the size, by two steps."""
    asked = size
    for _ in range(2):
        if "failure" in row:
            break
        asked *= aim / row["all"]["mean"]
        row = program.row(args, asked, result, size)
    return {**row, "program": f"{program.name}, as long"}


def programs_on(args, path, surface, folder):
    is_cad = surface is None

    def kerf(*options):
        return lambda size, result: [args.kerf, "mesh", path, "-o", result, "-n", "1", "-j", "2", "--size",
                                     repr(size), "-q", *options]

    def gmsh(size, result):
        script = folder / "sizes.geo"
        script.write_text((MERGE_CAD if is_cad else MERGE_SURFACE).format(file=path.resolve() if is_cad else surface) +
                          SIZES.format(size=size))
        return ["gmsh", "-nopopup", script, "-3", "-format", "msh41", "-o", result]

    programs = [Program("kerf", kerf())]
    if not is_cad:
        programs.append(Program("kerf remesh", kerf("--surface", "remesh")))
    if shutil.which("gmsh"):
        programs.append(Program("gmsh", gmsh))
    return programs


def print_row(name, share, row):
    size = f"{100 * share:g} %"
    if "failure" in row:
        print(f"{name:<26} {size:>8} {row['program']:<14} {row['failure']}")
        return
    surface, everywhere = row["surface"], row["all"]
    print(LAYOUT.format(
        name, size, row["program"], f"{row['cells']:,}", f"{row['growth']:.1f}" if row.get("growth") else "",
        f"{100 * surface['share']:.0f} %", f"{surface['mean']:.2f}", f"{100 * everywhere['share']:.0f} %",
        f"{everywhere['mean']:.2f}", f"{row['dihedral_0']:.1f}", f"{row['dihedral_1']:.1f}", f"{row['seconds']:.1f}"))


def compare(args, path):
    with tempfile.TemporaryDirectory(prefix="kerf_sizes_bench_") as scratch:
        folder = pathlib.Path(scratch)
        surface = None if path.suffix in CAD_ENDINGS else folder / "surface.stl"
        try:
            given = output_of(args.helper, "prepare", path, surface or "-")
        except RuntimeError as error:
            print(f"{path.name}: {error}")
            return None
        programs = programs_on(args, path, surface, folder)
        rows, before = [], {}
        for share in args.shares:
            size = share * given["diagonal"]
            for program in programs:
                row = program.row(args, size, folder / "mesh.msh")
                if program.name == "kerf":
                    of_kerf = row
                if program.name == "kerf remesh" and is_same_mesh(row, rows[-1]):
                    continue  # it is remeshed by default
                if "cells" in row and before.get(program.name):
                    row["growth"] = row["cells"] / before[program.name]
                before[program.name] = row.get("cells")
                if "volume" in row:
                    row["volume_error"] = abs(row["volume"] / given["volume"] - 1)
                print_row(path.name, share, row)
                rows.append({"share": share, **row})
                if program.name == "gmsh" and "cells" in of_kerf:
                    row = with_edges_as_long(args, program, size, row, of_kerf["all"]["mean"], folder / "mesh.msh")
                    print_row(path.name, share, row)
                    rows.append({"share": share, **row})
            sys.stdout.flush()
    return {"file": path.name, **given, "rows": rows}


def mean(values):
    return sum(values) / len(values) if values else math.nan


def print_sums(comparisons):
    print()
    for name in dict.fromkeys(row["program"] for c in comparisons for row in c["rows"]):
        rows = [row for c in comparisons for row in c["rows"] if row["program"] == name]
        done = [row for row in rows if "failure" not in row]
        growth = [row["growth"] for row in done if row.get("growth")]
        print(f"{name}: {len(rows)} meshes, {len(rows) - len(done)} failed; means: "
              f"{100 * mean([row['surface']['share'] for row in done]):.0f} % of the edges of the surface and "
              f"{100 * mean([row['all']['share'] for row in done]):.0f} % of all within 0.7 to 1.4 of the size, "
              f"mean edges {mean([row['surface']['mean'] for row in done]):.2f} and "
              f"{mean([row['all']['mean'] for row in done]):.2f} of it; a hundredth of the cells below "
              f"{mean([row['dihedral_1'] for row in done]):.1f} degrees, {mean(growth):.1f} times the cells for half "
              f"the size, {sum(row['seconds'] for row in done):.0f} s")


def paths_of(args):
    paths = list(args.surface or [])
    if args.corpus:
        endings = CAD_ENDINGS + SURFACE_ENDINGS
        paths += sorted(path for path in args.corpus.iterdir() if path.suffix in endings)
    paths = paths or sorted((ROOT / "assets").glob("*.stl"))
    return [path for path in paths if not args.only or args.only in path.name]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kerf", default=ROOT / "build/kerf", help="program to measure")
    parser.add_argument("--helper", default=ROOT / "build/sizes_bench")
    parser.add_argument("--surface", type=pathlib.Path, action="append",
                        help="a file, CAD or not, instead of the assets")
    parser.add_argument("--corpus", type=pathlib.Path, help="all files of this folder instead of the assets")
    parser.add_argument("--only", help="files whose names contain this")
    parser.add_argument("--shares", type=lambda text: [float(word) for word in text.split(",")],
                        default=[0.04, 0.02, 0.01], help="sizes, as shares of the diagonal, largest first")
    parser.add_argument("--limit", type=float, default=120, help="seconds for one command")
    parser.add_argument("--json", type=pathlib.Path, help="file for the results")
    args = parser.parse_args()

    load = os.getloadavg()[0]
    print(f"surface, all: edges with 0.7 to 1.4 of the size; means over it; angles in degrees; one run each; "
          f"{os.cpu_count()} cores, load {load:.1f} at the start")
    print(LAYOUT.format(*COLUMNS))
    comparisons = [c for c in (compare(args, path) for path in paths_of(args)) if c]
    print_sums(comparisons)
    if args.json:
        args.json.write_text(json.dumps({"cores": os.cpu_count(), "load_at_start": load, "shares": args.shares,
                                         "files": comparisons}, indent=2) + "\n")


if __name__ == "__main__":
    main()
