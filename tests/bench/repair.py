#!/usr/bin/env python3
"""Dirty surfaces: kerf repair and kerf wrap beside CGAL's repairs of polygon meshes, admesh, MeshFix, fTetWild, TetGen and gmsh, on the same files.

usage: repair.py [--kerf KERF] [--helper PROGRAM] [--cgal PROGRAM] [--only WORD] [--surface FILE]... [--folder FOLDER]
                 [--with NAME]... [--mesh] [--repetitions N] [--long SECONDS] [--limit SECONDS] [--json FILE]
                 [--markdown FILE]

Each is asked for what it does by default:

  kerf repair     the whole ladder ("full")
  kerf wrap       a surface around the facets, pulled back to them
  CGAL            repair_polygon_soup, orient_polygon_soup, stitch_borders, duplicate_non_manifold_vertices,
                  remove_degenerate_faces, remove_self_intersections (experimental), triangulate_hole of all holes, and
                  remove_self_intersections again
  admesh          all of its repairs (Debian package admesh)
  MeshFix         a program `MeshFix` or `meshfix` in the path: MeshFix INPUT RESULT
  fTetWild        a program `FloatTetwild_bin` in the path: the skin of its tetrahedra
  TetGen, gmsh    no repairs: whether they mesh the file as it is (-pQ; STL merged, surface loop, volume)

Those that are not there are left out. `passes` says whether kerf check finds nothing in the result that keeps it from
being meshed; TetGen and gmsh pass where they make tetrahedra. Distances are largest ones at corners, midpoints of edges
and centres of facets, in percent of the diagonal of the input: from the result to the input, and back, which for parts
of the input that end inside of the result is no error. `changed`: facets of the input, in percent, that are not in the
result with the same corners. Volumes are by the facets as they lie; of an open input that is no more than a hint.
Seconds are those of the processor of the whole command with what it reads and writes, CGAL's those on facets in memory,
medians of repetitions that take turns; who needs more than --long of them is called once.

--mesh: what Kerf has made and passes is meshed in 8 parts, and the angle is told below which a hundredth of the cells
have their smallest dihedral angle. --markdown: a table of Kerf's results, as the page of repairs has it: what was wrong
with the file, what is left, and who does not come to an end is said, too.

Files: shapes of the repository with damage (tests/bench/dirty_surfaces.py), or any files.
"""

import argparse
import json
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

from measured import failure_of, output_of, run_gmsh, run_measured

ROOT = pathlib.Path(__file__).resolve().parents[2]
GMSH_SCRIPT = """General.NumThreads = 1;
Merge "{surface}";
Surface Loop(1) = {{Surface{{:}}}};
Volume(1) = {{1}};
Mesh 3;
"""
MAKER = ROOT / "tests/bench/dirty_surfaces.py"  # a process of its own: children inherit the peak of memory
COLUMNS = ("file", "facets", "program", "passes", "seconds", "MB", "facets", "changed", "distance", "back", "volume")
LAYOUT = "{:<28} {:>8} {:<12} {:>6} {:>8} {:>6} {:>8} {:>8} {:>9} {:>9} {:>9}"


class Tool:
    """A program that makes a surface of a surface. Subclasses: command(surface, result)."""
    name, ending = "", ".obj"

    def __init__(self, args):
        self.args = args

    def is_there(self):
        return True

    def run(self, surface, scratch):
        """Seconds, bytes and the file, or raises."""
        result = scratch / f"result{self.ending}"
        result.unlink(missing_ok=True)
        done = run_measured(self.command(surface, result), scratch / "log", self.args.limit)
        if not result.exists():
            lines = done.log.strip().splitlines()
            raise RuntimeError(lines[-1] if lines else f"ended with code {done.exit_code}")
        return done.processor_seconds, done.peak_bytes, result


class Kerf(Tool):
    def __init__(self, args, command):
        super().__init__(args)
        self.name, self.word = f"kerf {command}", command

    def is_there(self):
        return f"\n  {self.word} " in subprocess.run([self.args.kerf, "--help"], capture_output=True, text=True).stdout

    def command(self, surface, result):
        return [self.args.kerf, self.word, surface, "-o", result, "-q"]


class Cgal(Tool):
    name = "CGAL"

    def is_there(self):
        return pathlib.Path(self.args.cgal).exists()

    def run(self, surface, scratch):
        result = scratch / "result.obj"
        result.unlink(missing_ok=True)
        done = output_of(self.args.cgal, surface, result, limit=self.args.limit)
        return done["seconds"], done["peak_bytes"], result


class Admesh(Tool):
    name, ending = "admesh", ".stl"

    def is_there(self):
        return shutil.which("admesh") is not None

    def command(self, surface, result):
        return ["admesh", f"--write-binary-stl={result}", surface]


class MeshFix(Tool):
    name, ending = "MeshFix", ".off"

    def is_there(self):
        return self.program() is not None

    def program(self):
        return shutil.which("MeshFix") or shutil.which("meshfix")

    def command(self, surface, result):
        return [self.program(), surface, result]


class FTetWild(Tool):
    name, ending = "fTetWild", ".msh"

    def is_there(self):
        return shutil.which("FloatTetwild_bin") is not None

    def command(self, surface, result):
        return ["FloatTetwild_bin", "-i", surface, "-o", result, "--max-threads", "1"]


class Mesher(Tool):
    """Only whether it makes tetrahedra of the file as it is."""

    def run(self, surface, scratch):
        for old in scratch.glob("mesher*"):
            old.unlink()
        copy = scratch / "mesher.stl"
        shutil.copy(surface, copy)
        done = self.mesh(copy)
        return done.processor_seconds, done.peak_bytes, None


class TetGen(Mesher):
    name = "TetGen"

    def is_there(self):
        return shutil.which("tetgen") is not None

    def mesh(self, surface):
        done = run_measured(["tetgen", "-pQ", surface], surface.with_suffix(".log"), self.args.limit)
        if not any(surface.parent.glob("mesher*.ele")):
            raise RuntimeError("makes no tetrahedra")
        return done


class Gmsh(Mesher):
    name = "gmsh"

    def is_there(self):
        return shutil.which("gmsh") is not None

    def mesh(self, surface):
        script = surface.with_suffix(".geo")
        script.write_text(GMSH_SCRIPT.format(surface=surface))
        done, _, _ = run_gmsh(script, surface.with_suffix(".log"), self.args.limit)
        made = re.search(r"(\d+) tetrahedra created", done.log)
        if not made or int(made[1]) == 0:
            raise RuntimeError("makes no tetrahedra")
        return done


def tools_of(args):
    tools = [Kerf(args, "repair"), Kerf(args, "wrap"), Cgal(args), Admesh(args), MeshFix(args), FTetWild(args),
             TetGen(args), Gmsh(args)]
    return [tool for tool in tools if tool.is_there() and (not args.tools or tool.name in args.tools)]


def kept_of_check(args, surface):
    """The defects that kerf check counts."""
    done = subprocess.run([args.kerf, "check", surface, "--json"], capture_output=True, text=True, timeout=args.limit)
    warnings = ("needle", "short edge")
    try:
        counts = json.loads(done.stdout)["counts"]
    except (json.JSONDecodeError, KeyError):
        return {"defects": {(done.stderr.strip().splitlines() or ["cannot be read"])[-1][:100]: 1}}
    return {"defects": {kind: count for kind, count in counts.items() if kind not in warnings}}


def mesh_and_measure(args, surface, scratch):
    """The hundredth of smallest dihedral angles of the mesh in 8 parts; None where there is none."""
    run = scratch / "run"
    shutil.rmtree(run, ignore_errors=True)
    try:
        meshed = run_measured([args.kerf, "mesh", surface, "-o", run, "-n", "8", "-q"], scratch / "log", args.limit)
        if meshed.exit_code != 0:
            return {"angle_1": None, "mesh_failure": (meshed.log.strip().splitlines() or [""])[-1]}
        quality = output_of(args.kerf, "quality", run, "--json", limit=args.limit)
        return {"angle_1": quality["quality"]["all"]["min_dihedral_deg"]["p1"]}
    except subprocess.SubprocessError as error:
        return {"angle_1": None, "mesh_failure": failure_of(error, args.limit)}


class Outcome:
    """What one program has done with one file."""

    def __init__(self, tool):
        self.tool, self.seconds, self.figures, self.failure = tool, [], {}, None

    def again(self, surface, scratch, args):
        if self.failure or (self.seconds and self.seconds[0] > args.long):
            return
        try:
            seconds, peak_bytes, result = self.tool.run(surface, scratch)
            if not self.seconds:
                self.figures = {"peak_bytes": peak_bytes, "passes": True}
                if result is not None:
                    self.figures |= output_of(args.helper, surface, result, limit=args.limit)
            if not self.seconds and args.mesh and isinstance(self.tool, Kerf):
                self.figures |= kept_of_check(args, result) | mesh_and_measure(args, result, scratch)
            self.seconds.append(seconds)
        except (RuntimeError, subprocess.SubprocessError, json.JSONDecodeError) as error:
            self.failure = failure_of(error, args.limit) or "has failed"

    def row(self):
        if self.failure:
            return {"program": self.tool.name, "passes": False, "failure": self.failure}
        return {"program": self.tool.name, "seconds": statistics.median(self.seconds), **self.figures}


def print_row(label, facets, row):
    if "failure" in row:
        print(f"{label:<28} {facets:>8} {row['program']:<12} {'no':>6} {row['failure'][:90]}")
        return
    has_surface = "distance" in row
    percent = (lambda value: f"{100 * value / row['diagonal']:.2g} %") if has_surface else None
    print(LAYOUT.format(
        label, facets, row["program"], "yes" if row["passes"] else "no", f"{row['seconds']:.2f}",
        f"{row['peak_bytes'] / 1e6:.0f}", *(
            (row["facets"], f"{100 * row['changed'] / max(1, row['facets_before']):.2f} %", percent(row["distance"]),
             percent(row["distance_from_input"]), f"{row['volume']:.5g}") if has_surface else [""] * 5)))


def compare(args, label, surface):
    try:
        facets = output_of(args.helper, surface, surface, limit=args.limit)["facets_before"]
    except (subprocess.SubprocessError, json.JSONDecodeError) as error:
        facets = 0  # no surface at all
        print(f"{label:<28} {failure_of(error, args.limit)[:120]}")
    outcomes = [Outcome(tool) for tool in tools_of(args)]
    with tempfile.TemporaryDirectory(prefix="kerf_repair_bench_") as folder:
        scratch = pathlib.Path(folder)
        for _ in range(args.repetitions):
            for outcome in outcomes:
                outcome.again(surface, scratch, args)
    rows = [outcome.row() for outcome in outcomes]
    for row in rows:
        print_row(label, facets, row)
    sys.stdout.flush()
    return {"file": label, "facets": facets, "rows": rows, **(kept_of_check(args, surface) if args.mesh else {})}


MARKDOWN_HEAD = """| file | facets | defects | by | outcome | changed | volume | area | distance | s | MB | 1 % angle |
|---|---:|---|---|---|---:|---:|---:|---:|---:|---:|---:|
"""


def in_words(defects):
    return ", ".join(f"{count} {kind}" for kind, count in defects.items()) or "none"


def markdown_row(comparison, row):
    start = f"| {comparison['file']} | {comparison['facets']} | {in_words(comparison.get('defects', {}))} | "
    start += f"{row['program'].removeprefix('kerf ')} | "
    if "failure" in row:
        return start + f"refused: {row['failure'].splitlines()[-1][:120]} | | | | | | | |\n"
    outcome = "can be meshed" if row["passes"] else f"left: {in_words(row.get('defects', {}))}"
    angle = row.get("angle_1")
    return start + (f"{outcome} | {100 * row['changed'] / max(1, row['facets_before']):.1f} % | {row['volume']:.4g} | "
                    f"{row['area']:.4g} | {100 * row['distance'] / row['diagonal']:.2g} % | {row['seconds']:.1f} | "
                    f"{row['peak_bytes'] / 1e6:.0f} | {f'{angle:.1f}°' if angle is not None else ''} |\n")


def write_markdown(path, comparisons):
    path.write_text(MARKDOWN_HEAD + "".join(markdown_row(c, row) for c in comparisons for row in c["rows"]
                                            if row["program"].startswith("kerf")))


def print_summary(comparisons):
    print(f"\n{'program':<12} {'passes':>9} {'of':>4} {'median seconds':>15} {'median distance':>16}")
    names = list(dict.fromkeys(row["program"] for c in comparisons for row in c["rows"]))
    for name in names:
        rows = [row for c in comparisons for row in c["rows"] if row["program"] == name]
        passed = [row for row in rows if row["passes"]]
        seconds = [row["seconds"] for row in rows if "seconds" in row]
        far = [row["distance"] / row["diagonal"] for row in passed if "distance" in row]
        print(f"{name:<12} {len(passed):>9} {len(rows):>4} {statistics.median(seconds) if seconds else 0:>15.2f} "
              f"{f'{100 * statistics.median(far):.2g} %' if far else '':>16}")


def surfaces_of(args, scratch):
    if args.surface:
        return {path.stem: as_stl(args, path, scratch) for path in args.surface}
    if args.folder:
        paths = [path for path in sorted(args.folder.iterdir()) if path.suffix in (".stl", ".obj", ".off", ".ply")]
        return {path.stem: as_stl(args, path, scratch) for path in paths}
    made = subprocess.run([sys.executable, MAKER, ROOT / "assets", scratch], check=True, capture_output=True, text=True)
    return {path.stem.replace("_", " "): path for path in map(pathlib.Path, made.stdout.splitlines())}


def as_stl(args, path, scratch):
    """All programs are given the same STL; Kerf alone gets the file as it is, and so do all what is no surface."""
    only_kerf = args.tools and all(name.startswith("kerf") for name in args.tools)
    if path.suffix == ".stl" or only_kerf:
        return path
    result = scratch / f"{path.stem}.stl"
    done = subprocess.run([sys.executable, MAKER, path, result], capture_output=True)
    return result if done.returncode == 0 else path


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kerf", default=ROOT / "build/kerf", help="program to measure")
    parser.add_argument("--helper", default=ROOT / "build/repair_bench")
    parser.add_argument("--cgal", default=ROOT / "build/repair_cgal_bench")
    parser.add_argument("--only", default="", help="files whose names contain this")
    parser.add_argument("--surface", type=pathlib.Path, action="append", help="a file, in place of the shapes")
    parser.add_argument("--folder", type=pathlib.Path, help="all surfaces of a folder, in place of the shapes")
    parser.add_argument("--with", dest="tools", action="append", help="only this program: kerf repair, CGAL, ...")
    parser.add_argument("--mesh", action="store_true", help="mesh what Kerf has made")
    parser.add_argument("--markdown", type=pathlib.Path, help="file for a table of Kerf's results")
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--long", type=float, default=5, help="seconds of a call that is not repeated")
    parser.add_argument("--limit", type=float, default=120, help="seconds for one call")
    parser.add_argument("--json", type=pathlib.Path, help="file for the results")
    args = parser.parse_args()

    load = os.getloadavg()[0]
    print(f"seconds of the processor, medians of {args.repetitions}; distances in percent of the diagonal; "
          f"{os.cpu_count()} cores, load {load:.1f} at the start")
    print(LAYOUT.format(*COLUMNS))
    with tempfile.TemporaryDirectory(prefix="kerf_repair_bench_") as scratch:
        surfaces = surfaces_of(args, pathlib.Path(scratch))
        comparisons = [compare(args, label[:28], path) for label, path in surfaces.items() if args.only in label]
    print_summary(comparisons)
    if args.markdown:
        write_markdown(args.markdown, comparisons)
    if args.json:
        args.json.write_text(json.dumps({"cores": os.cpu_count(), "load_at_start": load, "files": comparisons},
                                        indent=2) + "\n")


if __name__ == "__main__":
    main()
