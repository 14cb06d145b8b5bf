#!/usr/bin/env python3
"""Kerf's module of Python beside those of gmsh, CGAL (pygalmesh) and Netgen, where they are, on the same surfaces.

usage: python_modules.py [--package FOLDER] [--only WORD] [--repetitions N] [--long SECONDS] [--limit SECONDS]
                         [--json FILE]

Each module is used by a short script of tests/bench/python/: a STL and an edge length go in, arrays
of points and tetrahedra come out. Lines are those of the script that are neither empty nor its docstring. Seconds are
those of the processor, of the whole process and all that it starts: with the interpreter, the import, and the surface,
which is read as text, because Netgen reads no other; medians of runs that take turns. Wall: of the clock, where Kerf
has two workers. Memory is that of the largest process. Kerf, as it does by default, keeps facets, which may be smaller
than the size: there are more cells then; the others make a new surface of the given one. Error: by how much the volume
differs from that of the surface.
"""

import argparse
import importlib.util
import json
import os
import pathlib
import sys
import tempfile

from measured import output_of, rate_text, ratio_text, run_measured
from meshers import Call

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPTS = pathlib.Path(__file__).resolve().parent / "python"
# In a process of its own: what this one needs would count as memory of those that it starts.
PREPARE, MEASURE = ((sys.executable, SCRIPTS / "measure.py", word) for word in ("prepare", "measure"))
MODULES = ("kerf", "gmsh", "pygalmesh", "netgen")
CASES = {"cube": 0.05, "bearing_cap_14k": 2.0, "knee_femoral": 2.0, "cylinder": None, "l_bracket": None}
EDGES_OF_DIAGONAL = 40  # where no size is given
LAYOUT = "{:<16} {:<10} {:>5} {:>9} {:>8} {:>7} {:>9} {:>6} {:>6} {:>6} {:>8} {:>8}"
COLUMNS = ("surface", "module", "lines", "cells", "seconds", "wall", "cells/s", "ratio", "least", "1 %", "error", "MB")


def lines_of(script):
    """Lines of code."""
    code = script.read_text().split('"""')[2]
    return sum(1 for line in code.splitlines() if line.strip())


class Module(Call):
    def __init__(self, name, surface, size, volume):
        super().__init__(name)
        self.script, self.surface, self.size, self.volume = SCRIPTS / f"with_{name}.py", surface, size, volume
        self.arrays = surface.with_name(f"{name}.npz")

    def call(self, measured, limit):
        command = [sys.executable, self.script, self.surface, repr(self.size), self.arrays]
        done = run_measured(command, self.arrays.with_suffix(".log"), limit)
        if done.exit_code != 0:
            raise RuntimeError(done.log.strip().splitlines()[-1] if done.log.strip() else f"code {done.exit_code}")
        figures = {"seconds": done.processor_seconds, "wall_seconds": done.seconds, "peak_bytes": done.peak_bytes}
        return figures | output_of(*MEASURE, self.arrays, self.volume) if measured else figures


def print_row(label, row, reference):
    if "failure" in row:
        print(f"{label:<16} {row['mesher']:<10} {row['failure'][:120]}")
        return
    rate = row["tets_per_second"]
    print(LAYOUT.format(label, row["mesher"], row["lines"], f"{row['tets']:,}", f"{row['seconds']:.2f}",
                        f"{row['wall_seconds']:.2f}", rate_text(rate), ratio_text(reference, rate, 1),
                        f"{row['least_dihedral']:.1f}", f"{row['dihedral_1']:.1f}", f"{row['volume_error']:.0e}",
                        f"{row['peak_bytes'] / 1e6:.0f}"))


def compare(args, label, size):
    with tempfile.TemporaryDirectory(prefix="kerf_python_bench_") as scratch:
        text = pathlib.Path(scratch) / f"{label}.stl"
        given = output_of(*PREPARE, ROOT / f"assets/{label}.stl", text)
        size = size or given["diagonal"] / EDGES_OF_DIAGONAL
        modules = [Module(name, text, size, given["volume"]) for name in MODULES if name == MODULES[0] or importlib.util.find_spec(name)]
        for _ in range(args.repetitions):
            for module in modules:
                module.run(args)
    rows = [module.result() | {"lines": lines_of(module.script)} for module in modules]
    reference = rows[0].get("tets_per_second")
    for row in rows:
        print_row(label, row, reference)
    sys.stdout.flush()
    return {"surface": label, "triangles": given["triangles"], "size": size, "rows": rows}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--package", default=ROOT / "build/python", help="folder of the module kerf")
    parser.add_argument("--only", help="surfaces whose names contain this")
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--long", type=float, default=12, help="seconds of a call that is not repeated")
    parser.add_argument("--limit", type=float, default=120, help="seconds for one call")
    parser.add_argument("--json", type=pathlib.Path, help="file for the results")
    args = parser.parse_args()
    os.environ["PYTHONPATH"] = str(args.package)

    load = os.getloadavg()[0]
    print(f"seconds of the processor, medians of {args.repetitions}; ratio: Kerf's rate by this one's; angles in "
          f"degrees; {os.cpu_count()} cores, load {load:.1f} at the start")
    print(LAYOUT.format(*COLUMNS))
    surfaces = [compare(args, label, size) for label, size in CASES.items() if not args.only or args.only in label]
    if args.json:
        figures = {"cores": os.cpu_count(), "load_at_start": load, "repetitions": args.repetitions,
                   "surfaces": surfaces}
        args.json.write_text(json.dumps(figures, indent=2) + "\n")


if __name__ == "__main__":
    main()
