#!/usr/bin/env python3
"""Kerf on several processes against TetGen's own program on the whole surface.

Both fill the same surface under the same bounds. The time of Kerf is that of the complete command: reading,
decomposing, meshing, verifying and writing the run folder. TetGen reads the surface as .smesh with the same
vertices and writes nothing (switches N, E, F). Repetitions take turns, so that a busy moment of the machine hits
both; the medians are compared.
"""

import argparse
import json
import os
import pathlib
import re
import statistics
import struct
import subprocess
import sys
import tempfile
import time

ASSETS = pathlib.Path(__file__).resolve().parents[2] / "assets"


def read_binary_stl(path):
    """Vertices, welded where their coordinates are equal, and facets."""
    data = path.read_bytes()
    (count,) = struct.unpack_from("<I", data, 80)
    number_of, facets = {}, []
    for i in range(count):
        corners = struct.unpack_from("<9f", data, 84 + 50 * i + 12)
        facets.append([number_of.setdefault(corners[c : c + 3], len(number_of)) for c in (0, 3, 6)])
    return list(number_of), facets


def write_smesh(path, vertices, facets):
    with open(path, "w") as out:
        out.write(f"{len(vertices)} 3 0 0\n")
        out.writelines(f"{i} {x!r} {y!r} {z!r}\n" for i, (x, y, z) in enumerate(vertices))
        out.write(f"{len(facets)} 0\n")
        out.writelines(f"3 {a} {b} {c}\n" for a, b, c in facets)
        out.write("0\n0\n")


def timed(command):
    """Seconds of wall clock and standard output of a command that must succeed."""
    start = time.perf_counter()
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    seconds = time.perf_counter() - start
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)} ended with code {done.returncode}:\n{done.stdout}{done.stderr}")
    return seconds, done.stdout


class TetGen:
    def __init__(self, smesh, max_volume=None):
        bound = f"a{max_volume:g}" if max_volume else ""
        self.switches = f"-pYq1.4{bound}NEF"
        self.command = ["tetgen", self.switches, str(smesh)]
        self.name = f"tetgen {self.switches}"

    def run(self):
        seconds, text = timed(self.command)
        counts = dict(re.findall(r"(Input points|Input facets|Mesh tetrahedra): *(\d+)", text))
        return {"seconds": seconds, "tets": int(counts["Mesh tetrahedra"]), "input": int(counts["Input points"])}


class Kerf:
    def __init__(self, program, command, surface, folder, options):
        self.folder = folder
        self.command = [program, command, str(surface), "-o", str(folder), "-q", *options]
        self.name = " ".join(["kerf", command, *options])

    def run(self):
        seconds, _ = timed(self.command)
        report = json.loads((self.folder / "report.json").read_text())
        return {
            "seconds": seconds,
            "tets": sum(part["tets"] for part in report["parts"]),
            "input": report["input"]["vertices"],
            "decompose_seconds": report["totals"]["decompose_seconds"],
        }


def measure(contestants, repetitions):
    """Runs all in turns; for each the medians of its figures, and its seconds one by one."""
    runs = [[] for _ in contestants]
    for repetition in range(repetitions):
        for contestant, results in zip(contestants, runs):
            print(f"{repetition + 1}/{repetitions} {contestant.name}", file=sys.stderr)
            results.append(contestant.run())
    if len({result["input"] for results in runs for result in results}) != 1:
        sys.exit("The programs did not read the same number of vertices.")
    return [
        {
            "command": contestant.name,
            **{key: statistics.median(result[key] for result in results) for key in results[0]},
            "all_seconds": [result["seconds"] for result in results],
        }
        for contestant, results in zip(contestants, runs)
    ]


def print_row(*columns):
    print("{:<47} {:>8} {:>10} {:>9} {:>9}".format(*columns))


def print_table(pairs):
    print_row("program", "seconds", "tets", "tets/s", "speed-up")
    for tetgen, kerf in pairs:
        for result in (tetgen, kerf):
            seconds, tets = result["seconds"], result["tets"]
            speed_up = f"{tetgen['seconds'] / seconds:.2f}"
            print_row(result["command"], f"{seconds:.2f}", f"{tets:,.0f}", f"{tets / seconds:,.0f}", speed_up)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kerf", default="build/kerf", help="program to measure")
    parser.add_argument("--surface", type=pathlib.Path, default=ASSETS / "bearing_cap_52k.stl", help="binary STL")
    parser.add_argument("--max-volume", type=float, nargs="+", default=[0.5, 0.05], help="bounds, coarse to fine")
    parser.add_argument("--parts", type=int, default=16)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--json", type=pathlib.Path, help="file for the results")
    args = parser.parse_args()

    vertices, facets = read_binary_stl(args.surface)
    load = os.getloadavg()[0]
    with tempfile.TemporaryDirectory() as scratch:
        smesh = pathlib.Path(scratch) / "surface.smesh"
        write_smesh(smesh, vertices, facets)

        def kerf(command, *options):
            return Kerf(args.kerf, command, args.surface, pathlib.Path(scratch) / "run", list(options))

        contestants = [TetGen(smesh), kerf("decompose", "-n", "8")]
        for volume in args.max_volume:
            # TetGen keeps the facets, too.
            options = ["-n", f"{args.parts}", "--workers", f"{args.workers}", "--max-volume", f"{volume:g}",
                       "--surface", "split"]
            contestants += [TetGen(smesh, volume), kerf("mesh", *options)]
        whole, decomposition, *results = measure(contestants, args.repetitions)

    share = decomposition["decompose_seconds"] / whole["seconds"]
    pairs = list(zip(results[::2], results[1::2]))
    print(
        f"\n{args.surface.name}: {len(vertices):,} vertices, {len(facets):,} facets; medians of {args.repetitions};"
        f" {os.cpu_count()} cores, load {load:.1f} at the start"
    )
    print_table(pairs)
    print(
        f"decomposition into 8 parts: {decomposition['decompose_seconds']:.2f} s,"
        f" {100 * share:.1f} % of {whole['command']} ({whole['seconds']:.2f} s, {whole['tets']:,.0f} tets)"
    )
    if args.json:
        figures = {
            "surface": args.surface.name,
            "cores": os.cpu_count(),
            "load_at_start": load,
            "repetitions": args.repetitions,
            "decomposition_share": share,
            "whole": whole,
            "decomposition": decomposition,
            "pairs": [
                {"tetgen": tetgen, "kerf": kerf, "speed_up": tetgen["seconds"] / kerf["seconds"]}
                for tetgen, kerf in pairs
            ],
        }
        args.json.write_text(json.dumps(figures, indent=2) + "\n")


if __name__ == "__main__":
    main()
