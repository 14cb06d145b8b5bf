#!/usr/bin/env python3
"""Kerf's remesher against CGAL's isotropic remeshing and gmsh's, on the same files and sizes.

usage: remesh.py [--kerf KERF] [--helper PROGRAM] [--corpus FOLDER] [--size SHARE] [--repetitions N]
                 [--limit SECONDS] [--loose DEVIATION] [--only WORD] [--json FILE]

All read the same binary STL, are asked for edges of the same length everywhere, and write a surface; features are edges
of more than 30 degrees. Kerf is asked twice, for a deviation of 0.002 % and for one about as large as those that the
others turn out to have. CGAL's has these features protected, gmsh divides the surface there (ClassifySurfaces,
CreateGeometry) and meshes the pieces in parameters. Times are those of whole commands, in turns, medians; one that
fails or takes longer than the limit is not tried again. What comes out is measured by one program
(tests/bench/remesh_bench.cpp): angles, distances both ways at points at most 0.2 % of the diagonal apart, closedness,
facets that meet.

Files: those of the project, and those of others with needles, named below, that are in the folder good/ of the corpus,
which is where the tests look for it.
"""

import argparse
import json
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
WITH_NEEDLES = (
    "netgen_hinge.stl",
    "openfoam_shield.obj",
    "prusa_y-motor-holder.stl",
    "trimesh_featuretype.ply",
    "trimesh_plate_holes.stl",
    "openfoam_NACA0012.obj",
)
GMSH_SCRIPT = """Merge "{surface}";
ClassifySurfaces{{30 * Pi / 180, 1, 1, Pi}};
CreateGeometry;
Mesh.MeshSizeMin = {size};
Mesh.MeshSizeMax = {size};
"""
COLUMNS = ("file", "program", "facets", "least", "1 %", "median", "below 5", "to input", "from input", "closed",
           "meeting", "seconds", "ratio")
LAYOUT = "{:<26} {:<11} {:>8} {:>6} {:>6} {:>7} {:>8} {:>9} {:>10} {:>7} {:>8} {:>8} {:>6}"


def output_of(*command):
    done = subprocess.run([str(word) for word in command], stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))} ended with code {done.returncode}:\n{done.stderr}")
    return json.loads(done.stdout)


class Program:
    """One remesher on one file."""

    def __init__(self, name, command, result, limit):
        self.name, self.command, self.result, self.limit = name, [str(word) for word in command], result, limit
        self.seconds, self.failure = [], None

    def run(self):
        if self.failure:
            return
        self.result.unlink(missing_ok=True)
        start = time.perf_counter()
        try:
            done = subprocess.run(self.command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                  stderr=subprocess.PIPE, timeout=self.limit)
        except subprocess.TimeoutExpired:
            self.failure = f"more than {self.limit:g} s"
            return
        self.seconds.append(time.perf_counter() - start)
        if done.returncode != 0 or not self.result.exists():
            self.failure = f"ended with code {done.returncode}"

    def figures(self, helper, surface):
        if self.failure:
            return {"program": self.name, "failure": self.failure}
        return {"program": self.name, "seconds": statistics.median(self.seconds),
                **output_of(helper, "measure", surface, self.result)}


def remeshers(args, folder, surface, size):
    script = folder / "remesh.geo"
    script.write_text(GMSH_SCRIPT.format(surface=surface, size=repr(size)))
    loose, cgal, gmsh = folder / "loose.obj", folder / "cgal.off", folder / "gmsh.mesh"

    def kerf(name, result, *options):
        command = [args.kerf, "remesh", surface, "-o", result, "--size", repr(size), "-q", *options]
        return Program(name, command, result, args.limit)

    programs = [
        kerf("kerf", folder / "kerf.obj", "--deviation", "0.002%"),
        kerf("kerf, loose", loose, "--deviation", args.loose),
        Program("CGAL", [args.helper, "cgal", surface, cgal, repr(size)], cgal, args.limit),
    ]
    if shutil.which("gmsh"):
        command = ["gmsh", "-nopopup", script, "-2", "-format", "mesh", "-o", gmsh]
        programs.append(Program("gmsh", command, gmsh, args.limit))
    return programs


def print_row(name, row, kerf_seconds):
    if "failure" in row:
        print(f"{name:<26} {row['program']:<11} {row['failure']}")
        return
    print(LAYOUT.format(
        name, row["program"], f"{row['facets']:,}", f"{row['smallest_angle']:.2f}", f"{row['angle_1_percent']:.1f}",
        f"{row['median_angle']:.1f}", f"{100 * row['share_below_5']:.2f} %", f"{row['to_input']:.1e}",
        f"{row['from_input']:.1e}", "yes" if row["closed"] else "no", f"{row['self_intersections']:,}",
        f"{row['seconds']:.2f}", f"{row['seconds'] / kerf_seconds:.2f}" if kerf_seconds else ""))


def compare(args, path):
    with tempfile.TemporaryDirectory(prefix="kerf_remesh_bench_") as scratch:
        folder = pathlib.Path(scratch)
        surface = folder / "surface.stl"
        given = output_of(args.helper, "prepare", path, surface)
        size = args.size * given["diagonal"]
        programs = remeshers(args, folder, surface, size)
        for _ in range(args.repetitions):
            for program in programs:
                program.run()
        results = [program.figures(args.helper, surface) for program in programs]
        before = {"program": "(input)", "seconds": 0.0, **output_of(args.helper, "measure", surface, surface)}
    for row in (before, *results):
        print_row(path.name, row, results[0].get("seconds"))
    sys.stdout.flush()
    return {"file": path.name, "size": size, "before": before, "results": results}


def print_sums(comparisons):
    """Over the files, for each program: how often it failed, and its time over kerf's where both did it."""
    print()
    for name in dict.fromkeys(row["program"] for c in comparisons for row in c["results"]):
        rows = [(row, c["results"][0]) for c in comparisons for row in c["results"] if row["program"] == name]
        done = [(row, kerf) for row, kerf in rows if "failure" not in row]
        invalid = sum(not row["closed"] or row["self_intersections"] > 0 for row, _ in done)
        needles = sum(row["angle_1_percent"] < 10 for row, _ in done)
        farthest = max((max(row["to_input"], row["from_input"]) for row, _ in done), default=0)
        ratios = [row["seconds"] / kerf["seconds"] for row, kerf in done if "failure" not in kerf]
        ratio = f"{statistics.median(ratios):.2f}" if ratios else "-"
        rate = f"{statistics.median(row['facets'] / row['seconds'] for row, _ in done) / 1e3:.0f}" if done else "-"
        print(f"{name}: {len(rows)} files, {len(rows) - len(done)} failed, {invalid} open or with facets that meet, "
              f"{needles} with more than 1 % of angles below 10 degrees, farthest {farthest:.1e} of the diagonal, "
              f"seconds over kerf's {ratio}, {rate} thousand facets a second (medians)")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kerf", default=ROOT / "build/kerf", help="program to measure")
    parser.add_argument("--helper", default=ROOT / "build/remesh_bench")
    parser.add_argument("--corpus", type=pathlib.Path, help="folder with surfaces of others",
                        default=os.environ.get("KERF_CORPUS") or ROOT.parent / "shared/data")
    parser.add_argument("--only", help="files whose names contain this")
    parser.add_argument("--size", type=float, default=0.02, help="of edges, as a share of the diagonal")
    parser.add_argument("--loose", default="0.2%", help="deviation about as large as those of the others")
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--limit", type=float, default=60, help="seconds for one command")
    parser.add_argument("--json", type=pathlib.Path, help="file for the results")
    args = parser.parse_args()

    paths = sorted((ROOT / "assets").glob("*.stl"))
    paths += [path for name in WITH_NEEDLES if (path := args.corpus / "good" / name).is_file()]
    load = os.getloadavg()[0]
    print(f"edges of {100 * args.size:g} % of the diagonal; angles in degrees, distances as shares of the diagonal, seconds:"
          f" medians of {args.repetitions}; {os.cpu_count()} cores, load {load:.1f} at the start")
    print(LAYOUT.format(*COLUMNS))
    comparisons = [compare(args, path) for path in paths if not args.only or args.only in path.name]
    print_sums(comparisons)
    if args.json:
        args.json.write_text(json.dumps({"size": args.size, "cores": os.cpu_count(), "load_at_start": load,
                                         "repetitions": args.repetitions, "files": comparisons}, indent=2) + "\n")


if __name__ == "__main__":
    main()
