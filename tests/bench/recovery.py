#!/usr/bin/env python3
"""What fills the parts of many surfaces, and how the facets that no Delaunay triangulation has are recovered.

usage: recovery.py [--corpus FOLDER]... [--sizes LIST] [--surfaces LIST] [--parts LIST] [--only WORD] [--workers W]
                   [--limit SECONDS] [--causes N] [--surfaces-to FOLDER] [--kerf KERF] [--helper PROGRAM] [--json FILE]

Each surface file is meshed by `kerf mesh` with every number of parts, every --surface and every size, one run after the
other. Without --corpus these are the assets, without a size and with three; else all files in the folders and in what
lies in them, without a size. A file that cannot be meshed as it is (exit code 3) is left out, and so is what has too
few facets for so many parts (2). A run that takes longer than the limit is ended; its parts that were done count.

A line a run: parts by what has filled them, those that failed or were not done, facets that were missing, recovered by
flips alone and split for a while, vertices added by recovery, and why TetGen had to fill parts. At the end a table:
files and parts that TetGen has filled at least in part, and the share of the workers' seconds that these parts took.

--causes: of so many parts of a run that TetGen has filled, the smallest first, then of those with facets that were
split, what is around the facets that a Delaunay triangulation without a core lacks, and around those that are lost, by
the helper (tests/bench/recovery_causes.cpp lists the causes). --surfaces-to: OBJ files of these parts for kerf view,
with the lost facets as a patch.
"""

import argparse
import collections
import itertools
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
SURFACES = {".stl", ".obj", ".ply", ".off", ".mesh", ".smesh", ".poly", ".msh", ".vtu", ".3mf", ".step", ".stp", ".igs",
            ".iges", ".brep"}
SIZES_OF_ASSETS = "none,6%,3%,1.5%"
USAGE, INPUT = 2, 3  # exit codes
EXPLAINED = ("missing", "lost")  # facets, by the helper
RECOVERY = ("missing", "by_flips", "split", "added_vertices")
RUN_COLUMNS = ("file", "surface", "-n", "size", "facets", "tets", "seconds", *RECOVERY, "ways")
RUN_LAYOUT = "{:<34} {:<7} {:>5} {:>5} {:>9} {:>10} {:>7} {:>8} {:>8} {:>7} {:>14}  {}"
SUM_COLUMNS = ("surface", "-n", "size", "files", "with TetGen", "parts", "by TetGen", "failed", "not done",
               "seconds", "TetGen's", *RECOVERY)
SUM_LAYOUT = "{:<8} {:>5} {:>5} {:>6} {:>12} {:>6} {:>10} {:>7} {:>9} {:>9} {:>9} {:>9} {:>9} {:>7} {:>14}"


def ended(process, limit):
    """Whether the run ends by itself within the limit; its workers go with it."""
    try:
        process.wait(timeout=limit)
        return True
    except subprocess.TimeoutExpired:
        process.terminate()
    try:
        process.wait(timeout=10)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
    return False


def objects_in(events):
    """Those of all whole lines of a file of --events."""
    lines = events.read_text().split("\n")[:-1] if events.exists() else []
    return [json.loads(line) for line in lines]


def part_of(event, facets):
    way = "failed" if event["state"] == "failed" else event.get("way") or event["mesher"]
    recovery = event.get("recovery", {})
    return {"id": event["id"], "facets": facets.get(event["id"], 0), "tets": event["tets"],
            "attempts": event["attempts"], "seconds": event["part_seconds"], "way": way,
            "by_tetgen": "tetgen" in way.lower(), "reason": event.get("message") or event.get("reason", ""),
            "recovery": {count: recovery.get(count, 0) for count in RECOVERY}}


def output_of(*command, limit):
    return json.loads(subprocess.run([str(word) for word in command], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                     text=True, timeout=limit, check=True).stdout)


def explain(args, name, folder, parts):
    """The causes, for those parts whose surfaces were written."""
    hard = [part for part in parts if part["by_tetgen"] or part["recovery"]["split"]]
    for part in sorted(hard, key=lambda part: (not part["by_tetgen"], part["facets"]))[:args.causes]:
        surface = folder / f"part_{part['id']:04}.surface.vtu"
        if not surface.exists():
            continue
        words = [args.helper, surface]
        if args.surfaces_to:
            words.append(args.surfaces_to / f"{name}_part_{part['id']:04}.obj")
        try:
            part["causes"] = output_of(*words, limit=args.limit)
        except (subprocess.TimeoutExpired, subprocess.CalledProcessError):
            continue


def causes_of(parts, kind):
    """Facets by cause, as shares of all of the kind that the helper has looked at."""
    counts = collections.Counter()
    for part in parts:
        counts.update(part["causes"][kind]["causes"] if "causes" in part else {})
    return {cause: count / counts.total() for cause, count in counts.most_common()}


def run(args, path, surface, parts, size):
    with tempfile.TemporaryDirectory(prefix="kerf_recovery_bench_") as folder:
        scratch = pathlib.Path(folder)
        words = [args.kerf, "mesh", path, "-o", scratch / "out", "-n", parts, "--surface", surface, "--workers",
                 args.workers, "--events", scratch / "events", "-q"]
        words += [] if size == "none" else ["--size", size]
        start = time.perf_counter()
        with open(scratch / "errors", "w") as errors:
            process = subprocess.Popen([str(word) for word in words], stdin=subprocess.DEVNULL,
                                       stdout=subprocess.DEVNULL, stderr=errors)
            in_time = ended(process, args.limit)
        seconds = time.perf_counter() - start
        message = (scratch / "errors").read_text().strip()
        told = objects_in(scratch / "events")
        begun = next((event["parts"] for event in told if event["event"] == "parts"), [])
        facets = {part["id"]: part["facets"] for part in begun}
        done = [part_of(event, facets) for event in told if event["event"] == "part"]
        explain(args, f"{path.stem}_{surface}_{parts}_{size}".replace("%", ""), scratch / "out/parts", done)
    return {"file": f"{path.parent.name}/{path.name}", "surface": surface, "wanted_parts": parts, "size": size,
            "code": process.returncode if in_time else None, "message": message, "seconds": seconds,
            "not_done": len(begun) - len(done), "parts": done}


def sums(parts):
    return {count: sum(part["recovery"][count] for part in parts) for count in RECOVERY}


def ways_text(row):
    ways = collections.Counter(part["way"] for part in row["parts"])
    if row["not_done"]:
        ways["not done"] = row["not_done"]
    texts = [f"{count} {way}" for way, count in sorted(ways.items())]
    if row["code"] is None:
        texts.append("ended by the limit")
    elif row["code"] != 0:
        texts.append(f"exit code {row['code']}")
    reasons = [part["reason"] for part in row["parts"] if part["by_tetgen"] or part["way"] == "failed"]
    return ", ".join(texts) + (f" ({reasons[0]})" if reasons else "")


def print_run(row):
    parts = row["parts"]
    print(RUN_LAYOUT.format(row["file"], row["surface"], row["wanted_parts"], row["size"],
                            f"{sum(part['facets'] for part in parts):,}", f"{sum(part['tets'] for part in parts):,}",
                            f"{row['seconds']:.1f}", *(f"{count:,}" for count in sums(parts).values()), ways_text(row)))
    sys.stdout.flush()


def print_sums(rows):
    """A line for each set of options, and one for all."""
    print()
    print(SUM_LAYOUT.format(*SUM_COLUMNS))
    groups = collections.defaultdict(list)
    for row in rows:
        groups[row["surface"], row["wanted_parts"], row["size"]].append(row)
    for key, group in [*groups.items(), (("all", "", ""), rows)]:
        parts = [part for row in group for part in row["parts"]]
        seconds = sum(part["seconds"] for part in parts)
        of_tetgen = sum(part["seconds"] for part in parts if part["by_tetgen"])
        files = len({row["file"] for row in group})
        with_tetgen = len({row["file"] for row in group if any(part["by_tetgen"] for part in row["parts"])})
        print(SUM_LAYOUT.format(*key, files, with_tetgen, len(parts), sum(part["by_tetgen"] for part in parts),
                                sum(part["way"] == "failed" for part in parts), sum(row["not_done"] for row in group),
                                f"{seconds:.1f}", f"{100 * of_tetgen / seconds:.0f} %" if seconds else "",
                                *(f"{count:,}" for count in sums(parts).values())))


def print_causes(rows):
    for kind in EXPLAINED:
        causes = causes_of([part for row in rows for part in row["parts"]], kind)
        if causes:
            print(f"{kind}: " + ", ".join(f"{100 * share:.0f} % {cause}" for cause, share in causes.items()))


def files_of(args):
    """The cheap ones first."""
    if not args.corpus:
        return sorted((ROOT / "assets").glob("*.stl"), key=lambda path: path.stat().st_size)
    found = {path for folder in args.corpus for path in folder.rglob("*") if path.suffix.lower() in SURFACES}
    return sorted(found, key=lambda path: (path.stat().st_size, path))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--corpus", type=pathlib.Path, action="append", help="folder with surfaces; repeatable")
    parser.add_argument("--sizes", help=f"none or values of --size; of assets {SIZES_OF_ASSETS}, else none")
    parser.add_argument("--surfaces", default="keep,split,auto", help="values of --surface")
    parser.add_argument("--parts", default="1,8,32")
    parser.add_argument("--only", default="", help="files whose names contain this")
    parser.add_argument("--workers", type=int, default=os.cpu_count())
    parser.add_argument("--limit", type=float, default=120, help="seconds for one run")
    parser.add_argument("--kerf", default=ROOT / "build/kerf", help="program to measure")
    parser.add_argument("--causes", type=int, default=0, help="so many parts of each run are explained")
    parser.add_argument("--surfaces-to", type=pathlib.Path, help="existing folder for the surfaces of these parts")
    parser.add_argument("--helper", default=ROOT / "build/recovery_causes")
    parser.add_argument("--json", type=pathlib.Path, help="file for the results, written after every run")
    args = parser.parse_args()

    paths = [path for path in files_of(args) if args.only in path.name]
    sizes = (args.sizes or ("none" if args.corpus else SIZES_OF_ASSETS)).split(",")
    load = os.getloadavg()[0]
    print(f"{len(paths)} files, {args.workers} workers, {args.limit:g} s for a run; {os.cpu_count()} cores, "
          f"load {load:.1f} at the start")
    print(RUN_LAYOUT.format(*RUN_COLUMNS))
    rows, refused = [], set()
    parts = map(int, args.parts.split(","))
    for count, surface, size, path in itertools.product(parts, args.surfaces.split(","), sizes, paths):
        if (path, surface) in refused:
            continue
        row = run(args, path, surface, count, size)
        if row["code"] == INPUT:
            refused.add((path, surface))
        if row["code"] in (USAGE, INPUT):
            continue
        print_run(row)
        rows.append(row)
        if args.json:
            args.json.write_text(json.dumps({"cores": os.cpu_count(), "load_at_start": load, "workers": args.workers,
                                             "limit": args.limit, "runs": rows}, indent=2) + "\n")
    print_sums(rows)
    print_causes(rows)


if __name__ == "__main__":
    main()
