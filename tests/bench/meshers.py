#!/usr/bin/env python3
"""Kerf's default mesher, TetGen, and those of gmsh where there is one, on the same surfaces under the same bounds of the volume.

usage: meshers.py [all] [--only WORD] [--mesher NAME] [--no-gmsh] [--repetitions N] [--long SECONDS] [--limit SECONDS] [--json FILE]
                  [--surface FILE]...

Each call is a process of its own on one thread. Seconds are those that the processor spends for the user on meshing
alone, from the surface in memory to tetrahedra in memory, medians over repetitions that take turns; who needs more than
--long seconds is called once. Memory is the largest resident set. Rates and ratios are tetrahedra by second, since none
makes exactly as many. What comes out is measured by one program (tests/bench/meshers_bench.cpp): smallest dihedral
angles, cells with one below 20 degrees in a million, and the share of the volume that is in cells above the bound.
Results of Kerf's meshers are verified, too; those of gmsh must fill the volume.

gmsh does not take a bound of the volume: it is asked for edges that make about as many tetrahedra as TetGen's with the
bound. Its seconds are those of its own log ("Done meshing 3D" and "Done optimizing mesh", processor); where that says 0,
the rate is unknown, a dash. HXT is one of its meshers, raw and with its optimisation; "gmsh" is the one that it takes
where nobody chooses, a Delaunay mesher with an optimisation of its own.

Without `all`: the bearing cap at 0.4 and 3.5 million tetrahedra, at 20 million for meshers other than TetGen and gmsh's,
and every asset without a bound. With it all of them at 20 million, the cap in 207 k facets (each of 52 k quartered) at
3.8 and 20 million, and every other asset with a bound for a million. With --surface these files instead, without a
bound.
"""

import argparse
import dataclasses
import json
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

from measured import failure_of, output_of, rate_of, rate_text, ratio_text, run_gmsh

ROOT = pathlib.Path(__file__).resolve().parents[2]
CAP = "bearing_cap_52k"
REFERENCE = "tetgen"
WANTED = -1  # the bound that makes so many tetrahedra of other assets:
TETS_WITH_BOUND = 1e6
EDGE_OF_BOUND = 2.35  # of gmsh: cube of the edge length that makes as many tetrahedra as a bound of 1 in TetGen
OF_GMSH = {  # names of its meshers: Mesh.Algorithm3D and Mesh.Optimize
    "HXT raw": (10, 0),
    "HXT optimised": (10, 1),
    "gmsh": (1, 1),
}
GMSH_SCRIPT = """General.NumThreads = 1;
Mesh.MaxNumThreads3D = 1;
Mesh.Algorithm3D = {algorithm};
Mesh.Optimize = {optimised};
Mesh.Binary = 1;
{size}
{merges}
{loops}
Volume(1) = {{{numbers}}};
Mesh 3;
"""
COLUMNS = ("case", "mesher", "tets", "seconds", "tets/s", "ratio", "MB", "least", "0.1 %", "1 %", "5 %", "median", "<20/M",
           "above", "core")
LABEL_WIDTH = 27
LAYOUT = f"{{:<{LABEL_WIDTH}}}" + " {:<13} {:>11} {:>8} {:>10} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>7} {:>7} {:>5}"


@dataclasses.dataclass
class Case:
    surface: pathlib.Path
    bound: float  # 0: none
    label: str
    quartered: bool = False
    is_large: bool = False  # too long for TetGen and gmsh where `all` is not asked for


class Call:
    """One mesher in one case. Subclasses: call(measured) returns the figures of a call."""

    def __init__(self, name):
        self.name, self.figures, self.seconds, self.bytes, self.failure = name, {}, [], [], None

    def run(self, args):
        if self.failure or (self.seconds and self.seconds[0] > args.long):
            return
        try:
            done = self.call(measured=not self.seconds, limit=args.limit)
        except (RuntimeError, subprocess.SubprocessError) as error:
            self.failure = failure_of(error, args.limit)
            return
        self.seconds.append(done.pop("seconds"))
        self.bytes.append(done.pop("peak_bytes"))
        self.figures |= done

    def result(self):
        if self.failure:
            return {"mesher": self.name, "failure": self.failure}
        seconds = statistics.median(self.seconds)
        return {"mesher": self.name, "seconds": seconds, "all_seconds": self.seconds, "peak_bytes": min(self.bytes),
                "tets_per_second": rate_of(self.figures["tets"], seconds), **self.figures}


class OwnMesher(Call):
    def __init__(self, name, helper, surface, bound):
        super().__init__(name)
        self.command = [name, surface, repr(bound)]
        self.helper = helper

    def call(self, measured, limit):
        done = output_of(self.helper, "fill-and-measure" if measured else "fill", *self.command, limit=limit)
        if not done.pop("is_valid", True):
            raise RuntimeError("the mesh breaks the laws")
        return done


class Gmsh(Call):
    def __init__(self, name, helper, stem, given, bound):
        super().__init__(name)
        algorithm, optimised = OF_GMSH[name]
        self.helper, self.bound, self.volume = helper, bound, given["volume"]
        self.script, self.mesh = stem.with_suffix(".geo"), stem.with_suffix(".msh")
        numbers = range(1, given["shells"] + 1)
        size = (EDGE_OF_BOUND * bound) ** (1 / 3)
        self.text = GMSH_SCRIPT.format(
            algorithm=algorithm,
            optimised=optimised,
            size=f"Mesh.MeshSizeExtendFromBoundary = 0;\nMesh.MeshSizeMax = {size!r};" if bound else "",
            merges="\n".join(f'Merge "{stem}_{i - 1}.stl";' for i in numbers),
            loops="\n".join(f"Surface Loop({i}) = {{{i}}};" for i in numbers),
            numbers=", ".join(map(str, numbers)))

    def call(self, measured, limit):
        self.script.write_text(self.text + (f'Save "{self.mesh}";\n' if measured else ""))
        done, made, improved = run_gmsh(self.script, self.script.with_suffix(".log"), limit)
        figures = {"seconds": made + improved, "peak_bytes": done.peak_bytes}
        if not measured:
            return figures
        figures |= output_of(self.helper, "measure", self.mesh, self.bound)
        self.mesh.unlink()
        if abs(figures["volume"] - self.volume) > 1e-6 * self.volume:
            raise RuntimeError(f"the mesh has the volume {figures['volume']:g}, the surface {self.volume:g}")
        return figures


def print_row(case, row, reference):
    if "failure" in row:
        print(f"{case.label:<{LABEL_WIDTH}} {row['mesher']:<13} {row['failure']}")
        return
    rate = row["tets_per_second"]
    angles = [f"{row[f'dihedral_{percent}']:.1f}" for percent in ("0", "0.1", "1", "5", "50")]
    print(LAYOUT.format(
        case.label, row["mesher"], f"{row['tets']:,}", f"{row['seconds']:.2f}", rate_text(rate),
        ratio_text(rate, reference), f"{row['peak_bytes'] / 1e6:.0f}", *angles,
        f"{row['below_20_per_million']:.0f}", f"{100 * row['share_above']:.2f} %" if case.bound else "",
        f"{100 * row['core_tets'] / row['tets']:.0f} %" if row.get("core_tets") else "") +
        (f"  {row['way']}" if row.get("way") else ""))


def calls_of(args, case, stem, given):
    surface = stem.with_suffix(".stl")
    is_short = args.which == "all" or not case.is_large
    names = [args.mesher] if args.mesher == REFERENCE or not is_short else [args.mesher, REFERENCE]
    calls = [OwnMesher(name, args.helper, surface, case.bound) for name in names]
    if is_short and not args.no_gmsh and shutil.which("gmsh"):
        calls += [Gmsh(name, args.helper, stem, given, case.bound) for name in OF_GMSH]
    return calls


def compare(args, case):
    with tempfile.TemporaryDirectory(prefix="kerf_meshers_bench_") as scratch:
        stem = pathlib.Path(scratch) / "surface"
        given = output_of(args.helper, "prepare", case.surface, stem, *(["quartered"] if case.quartered else []))
        if case.bound == WANTED:
            case.bound = given["tets_times_bound"] / (TETS_WITH_BOUND - given["tets_without_bound"])
        calls = calls_of(args, case, stem, given)
        for _ in range(args.repetitions):
            for call in calls:
                call.run(args)
    rows = [call.result() for call in calls]
    reference = next((row.get("tets_per_second") for row in rows if row["mesher"] == REFERENCE), None)
    for row in rows:
        print_row(case, row, reference)
    sys.stdout.flush()
    return {"case": case.label, "facets": given["facets"], "bound": case.bound, "rows": rows}


def cases_of(args):
    if args.surface:
        return [Case(path, 0, f"{path.stem}, no bound") for path in args.surface]
    cap = ROOT / f"assets/{CAP}.stl"
    cases = [Case(cap, bound, f"{CAP} {size} M", is_large=size > 10) for bound, size in ((0.5, 0.4), (0.05, 3.5),
                                                                                        (0.0088, 20))]
    if args.which == "all":
        cases += [Case(cap, bound, f"bearing_cap_207k {size} M", quartered=True)
                  for bound, size in ((0.05, 3.8), (0.0088, 20))]
    for path in sorted((ROOT / "assets").glob("*.stl")):
        cases.append(Case(path, 0, f"{path.stem}, no bound"))
        if args.which == "all" and path != cap:
            cases.append(Case(path, WANTED, f"{path.stem} 1 M"))
    return [case for case in cases if not args.only or args.only in case.label]


def versions():
    """Of the programs, and of the library that Kerf's TetGen is; without what is not known here."""
    commands = {"TetGen": ["dpkg-query", "-W", "-f", "${source:Upstream-Version}", "libtet1.5"],
                "gmsh": ["gmsh", "--version"]}
    found = {"Kerf": re.search(r"project\(Kerf VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1]}
    for name, command in commands.items():
        if shutil.which(command[0]):
            done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True)
            found[name] = (done.stdout + done.stderr).split()[0]
    return found


def processor():
    """Its name, as the system has it."""
    name = re.search(r"^model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text(), re.MULTILINE)
    return re.sub(r"\((R|TM)\)| Processor", "", name[1]) if name else "a processor without a name"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("which", nargs="?", choices=("quick", "all"), default="quick")
    parser.add_argument("--surface", type=pathlib.Path, action="append", help="a file to measure instead of the assets")
    parser.add_argument("--helper", default=ROOT / "build/meshers_bench")
    parser.add_argument("--only", help="cases whose names contain this")
    parser.add_argument("--mesher", default="auto", help=f"this one beside {REFERENCE}")
    parser.add_argument("--no-gmsh", action="store_true")
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--long", type=float, default=12, help="seconds of a call that is not repeated")
    parser.add_argument("--limit", type=float, default=900, help="seconds for one call")
    parser.add_argument("--json", type=pathlib.Path, help="file for the results")
    args = parser.parse_args()

    load = os.getloadavg()[0]
    print(f"one thread each; seconds of the processor for meshing, medians of {args.repetitions}; ratio: rate by {REFERENCE}'s"
          f"; angles in degrees; {os.cpu_count()} cores, load {load:.1f} at the start")
    print(LAYOUT.format(*COLUMNS))
    comparisons = [compare(args, case) for case in cases_of(args)]
    if args.json:
        how = {"processor": processor(), "cores": os.cpu_count(), "load_at_start": load, "repetitions": args.repetitions,
               "long": args.long, "versions": versions()}
        args.json.write_text(json.dumps(how | {"cases": comparisons}, indent=2) + "\n")


if __name__ == "__main__":
    main()
