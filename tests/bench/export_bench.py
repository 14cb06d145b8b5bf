#!/usr/bin/env python3
"""What writing costs: a run in each format, and what is written, merged and measured afterwards.

usage: export_bench.py --kerf KERF [--max-volume V] [--parts K] [--repetitions N] [--json FILE]

The bearing cap is meshed with the format vtu, which is the run's own stage of writing; then every format is exported
from it on one worker and on two, merged, and measured. All in one run of this script, in turns, medians of the
repetitions. The speed of the disk is that of a file of the same size written in one go, synced like the others are not:
so both numbers are given. Memory is the largest of each command's processes.
"""

import argparse
import json
import os
import pathlib
import shutil
import statistics
import sys
import tempfile
import time

ASSETS = pathlib.Path(__file__).resolve().parents[2] / "assets"
FORMATS = ("vtu", "msh", "openfoam", "mfem", "hdf5", "medit", "tetgen", "abaqus", "su2", "vtk", "unv",
           "med", "cgns", "feb", "vtp")
ENDINGS = ("vtu", "msh", "h5", "mesh", "node", "inp", "su2", "vtk", "unv", "med", "cgns", "feb", "vtp")


def timed(*command):
    """Seconds of wall clock and of processors, and the peak memory in MB, of a command that must succeed."""
    start = time.perf_counter()
    silent = [(os.POSIX_SPAWN_OPEN, fd, os.devnull, os.O_WRONLY, 0) for fd in (1, 2)]
    process = os.posix_spawn(command[0], [str(word) for word in command], os.environ, file_actions=silent)
    _, status, usage = os.wait4(process, 0)
    if status != 0:
        sys.exit(f"{' '.join(map(str, command))} has failed")
    return time.perf_counter() - start, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def size_of(path):
    """MB of a file, or of all below a folder."""
    files = [path] if path.is_file() else [file for file in path.rglob("*") if file.is_file()]
    return sum(file.stat().st_size for file in files) / 1e6


def disk_speed(folder, megabytes=400):
    """MB/s of a file written in one go: into the page cache, and with the disk waited for."""
    block, file = os.urandom(1 << 20), folder / "disk"
    start = time.perf_counter()
    with open(file, "wb", buffering=0) as out:
        for _ in range(megabytes):
            out.write(block)
        cached = time.perf_counter() - start
        os.fsync(out.fileno())
        synced = time.perf_counter() - start
    file.unlink()
    size = megabytes * (1 << 20) / 1e6
    return size / cached, size / synced


def row(name, megabytes, runs):
    wall, cpu, memory = (statistics.median(column) for column in zip(*runs))
    print(f"{name:24} {megabytes:9.1f} MB {wall:8.2f} s {megabytes / wall:8.0f} MB/s {cpu:8.2f} cpu s {memory:7.0f} MB")
    return {"name": name, "mb": megabytes, "seconds": wall, "cpu_seconds": cpu, "peak_mb": memory}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--kerf", default="build/kerf")
    parser.add_argument("--max-volume", default="0.042", help="0.042: 4 million tetrahedra")
    parser.add_argument("--parts", type=int, default=16)
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--json", type=pathlib.Path)
    args = parser.parse_args()
    kerf, rows = pathlib.Path(args.kerf).resolve(), []
    folder = pathlib.Path(tempfile.mkdtemp(prefix="kerf_export_bench_"))
    try:
        run = folder / "run"
        timed(kerf, "mesh", ASSETS / "bearing_cap_52k.stl", "-o", run, "-n", args.parts, "--max-volume", args.max_volume,
              "--workers", 2, "-q")
        totals = json.loads((run / "report.json").read_text())["totals"]
        print(f"{totals['tets']} tetrahedra in {args.parts} parts, two workers: mesh {totals['mesh_seconds']:.2f} s, of it "
              f"store {totals['store_seconds']:.2f} s; write {totals['write_seconds']:.2f} s; hash "
              f"{totals['hash_seconds']:.2f} s")
        cached, synced = disk_speed(folder)
        print(f"disk: {cached:.0f} MB/s into the cache, {synced:.0f} MB/s with a sync")

        def repeat(name, product, *command):
            runs = []
            for _ in range(args.repetitions):
                if product and product.exists():
                    shutil.rmtree(product) if product.is_dir() else product.unlink()
                runs.append(timed(kerf, *command))
            rows.append(row(name, size_of(product) if product else 0.0, runs))
            if product:
                shutil.rmtree(product) if product.is_dir() else product.unlink()

        for name in FORMATS:
            for workers in (1, 2):
                out = folder / "out"
                repeat(f"export {name}, {workers}", out, "export", run, "--format", name, "-o", out, "--workers", workers,
                       "-q")
        for ending in ENDINGS:
            repeat(f"merge .{ending}", folder / f"whole.{ending}", "merge", run, "-o", folder / f"whole.{ending}")
        repeat("quality", folder / "sheet.svg", "quality", run, "--picture", folder / "sheet.svg")
    finally:
        shutil.rmtree(folder)
    if args.json:
        args.json.write_text(json.dumps({"tets": totals["tets"], "totals": totals, "disk_mb_s": [cached, synced],
                                         "rows": rows}, indent=2) + "\n")


if __name__ == "__main__":
    main()
