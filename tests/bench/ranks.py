#!/usr/bin/env python3
"""What each rank of a run does: seconds of its processor, memory, bytes and messages.

Ranks share the processors of this machine, so that seconds of the wall clock say little here; those of the processor,
of each rank with its threads, say who works and who waits. The surface is the bearing cap, each facet divided into 4,
16 and 64, and the run is `kerf mesh --dry-run`: reading, checking, cutting, matching. Memory: private, and shared pages
by the number of ranks that have them (PSS), at the peak of each rank. Bytes and messages are those of Open MPI's
monitoring, with what its collectives send.
"""

import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import threading
import time

from divided_surface import write_divided
from speed_up import ASSETS

MEGABYTE = 1e6


def memory_of(process):
    """Private bytes, and those with its share of pages that others have, too; none once it has ended."""
    try:
        text = pathlib.Path(f"/proc/{process}/smaps_rollup").read_text()
    except OSError:
        return 0, 0
    found = {name: 1024 * int(size) for name, size in re.findall(r"^(\w+): +(\d+) kB$", text, re.MULTILINE)}
    return found.get("Private_Clean", 0) + found.get("Private_Dirty", 0), found.get("Pss", 0)


def be_rank(folder, command):
    """One rank: runs the command and notes what it took."""
    process = subprocess.Popen(command, stdin=subprocess.DEVNULL)
    peak, ended = [0, 0], threading.Event()

    def watch():
        while not ended.wait(0.02):
            for i, size in enumerate(memory_of(process.pid)):
                peak[i] = max(peak[i], size)

    watcher = threading.Thread(target=watch)
    watcher.start()
    _, status, usage = os.wait4(process.pid, 0)
    ended.set()
    watcher.join()
    rank = int(os.environ["OMPI_COMM_WORLD_RANK"])
    row = {"rank": rank, "cpu_seconds": usage.ru_utime + usage.ru_stime, "private": peak[0], "pss": peak[1]}
    (folder / f"rank.{rank}.json").write_text(json.dumps(row))
    return os.waitstatus_to_exitcode(status)


def sent_bytes(profile):
    """Bytes and messages that a rank has sent to others."""
    found = re.findall(r"^[IE]\t\d+\t\d+\t(\d+) bytes\t(\d+) msgs", profile, re.MULTILINE)
    return sum(int(size) for size, _ in found), sum(int(count) for _, count in found)


def measure(kerf, surface, parts, ranks, limit):
    """A row for each rank, and the seconds of the whole."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        monitoring = {"enable": 2, "enable_output": 3, "filename": folder / "sent"}
        options = [word for key, value in monitoring.items() for word in ("--mca", f"pml_monitoring_{key}", f"{value}")]
        command = ["mpirun", "--oversubscribe", "--bind-to", "none", "-n", f"{ranks}", *options,
                   sys.executable, __file__, "--rank", name, str(kerf), "mesh", str(surface), "-n", f"{parts}",
                   "--dry-run", "-q"]
        start = time.perf_counter()
        subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, check=True, timeout=limit)
        seconds = time.perf_counter() - start
        rows = [json.loads((folder / f"rank.{rank}.json").read_text()) for rank in range(ranks)]
        for row in rows:
            profile = folder / f"sent.{row['rank']}.prof"
            row["sent"], row["messages"] = sent_bytes(profile.read_text()) if profile.exists() else (0, 0)
        return {"ranks": ranks, "seconds": seconds, "of_ranks": rows}


def summary(run, alone):
    busiest = max(row["cpu_seconds"] for row in run["of_ranks"])
    return {
        "busiest": busiest,
        "of_one": busiest / max(row["cpu_seconds"] for row in alone["of_ranks"]),
        "all": sum(row["cpu_seconds"] for row in run["of_ranks"]),
        "private": max(row["private"] for row in run["of_ranks"]),
        "together": sum(row["pss"] for row in run["of_ranks"]),
        "sent": max(row["sent"] for row in run["of_ranks"]),
        "messages": max(row["messages"] for row in run["of_ranks"]),
    }


def main():
    if sys.argv[1:2] == ["--rank"]:
        sys.exit(be_rank(pathlib.Path(sys.argv[2]), sys.argv[3:]))
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kerf", default="build/kerf", help="program to measure")
    parser.add_argument("--surface", type=pathlib.Path, default=ASSETS / "bearing_cap_52k.stl", help="binary STL")
    parser.add_argument("--levels", type=int, nargs="+", default=[1, 2, 3], help="each divides each facet into four")
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2, 4, 8])
    parser.add_argument("--parts", type=int, default=64)
    parser.add_argument("--limit", type=float, default=600, help="seconds of a run")
    parser.add_argument("--json", type=pathlib.Path, help="where the figures go, too")
    args = parser.parse_args()

    if os.geteuid() == 0:
        os.environ |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    results = []
    with tempfile.TemporaryDirectory() as name:
        for level in args.levels:
            surface = pathlib.Path(name) / f"level_{level}.stl"
            facets = write_divided(args.surface, level, surface)
            print(f"\n{facets:,} facets, {args.parts} parts; seconds of the processor, memory in MB\n"
                  f"{'ranks':>6} {'seconds':>8} {'busiest':>8} {'of one':>7} {'all':>8} {'private':>8} {'together':>9} "
                  f"{'sent, MB':>9} {'messages':>9}")
            runs = []
            for ranks in args.ranks:
                runs.append(measure(args.kerf, surface, args.parts, ranks, args.limit))
                row = summary(runs[-1], runs[0])
                print(f"{ranks:>6} {runs[-1]['seconds']:>8.2f} {row['busiest']:>8.2f} {row['of_one']:>7.2f} "
                      f"{row['all']:>8.2f} {row['private'] / MEGABYTE:>8.0f} {row['together'] / MEGABYTE:>9.0f} "
                      f"{row['sent'] / MEGABYTE:>9.2f} {row['messages']:>9}", flush=True)
            results.append({"facets": facets, "parts": args.parts, "runs": runs})
    if args.json:
        args.json.write_text(json.dumps({"surface": args.surface.name, "results": results}, indent=2) + "\n")


if __name__ == "__main__":
    main()
