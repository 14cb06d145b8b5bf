#!/usr/bin/env python3
"""Kerf on 1, 2, 4, ... processes against TetGen's own program on the whole surface.

Every size is meshed with four parts for each process. Where the machine has the cores, the time is that of the complete
command (reading, cutting, meshing, verifying, writing). Beyond, it is projected, and labelled so, from the same run on
one core and on two, by the model of cluster_model.py: one host with a core and a worker for each rank. TetGen reads the
surface as .smesh and writes nothing. Efficiency is the speed-up over TetGen by the number of processes.

The cube study compares two estimates of the method with what is measured: the share of interface nodes,
3 n^(-1/3) (N^(1/3) - 1), and the gain over linear speed-up of the mesher alone, N (log n / log(n/N) - 1), for n nodes
in N parts.
"""

import argparse
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

from cluster_model import Machine, costs_of_runs, replay
from speed_up import ASSETS, TetGen, read_binary_stl, timed, write_smesh

PARTS_PER_PROCESS = 4
MACHINE = Machine()


def run_kerf(args, command, folder, surface, parts, workers, max_volume):
    """Seconds of the command, and its report."""
    # TetGen keeps the facets, too.
    options = ["-n", f"{parts}", "--workers", f"{workers}", "--max-volume", f"{max_volume:g}", "--surface", "split"]
    line = [args.kerf, command, str(surface), "-o", str(folder), "-q", *options]
    print(" ".join(line[1:2] + options), file=sys.stderr)
    seconds, _ = timed(line)
    return seconds, json.loads((folder / "report.json").read_text())


def measure_size(args, scratch, smesh, max_volume):
    whole = TetGen(smesh, max_volume)
    print(whole.name, file=sys.stderr)
    tetgen = whole.run()
    rows = []
    for processes in args.processes:
        folder, parts = scratch / "run", PARTS_PER_PROCESS * processes
        is_measured = processes <= args.cores
        workers = processes if is_measured else 2
        seconds, report = run_kerf(args, "mesh", folder, args.surface, parts, workers, max_volume)
        row = {"processes": processes, "parts": len(report["parts"]), "tets": report["totals"]["tets"]}
        row |= {"measured": is_measured, "peak_rss_bytes": report["totals"]["peak_rss_bytes"]}
        if not is_measured:
            _, alone = run_kerf(args, "mesh", folder, args.surface, parts, 1, max_volume)
            costs = costs_of_runs(alone, report)
            row["terms"] = replay(costs, MACHINE, alone["input"]["faces"], row["tets"], processes, PARTS_PER_PROCESS)
            row["measured_on_two_cores"] = seconds
            seconds = sum(row["terms"].values())
        row |= {"seconds": seconds, "speed_up": tetgen["seconds"] / seconds}
        row["efficiency"] = row["speed_up"] / processes
        rows.append(row)
    return {"max_volume": max_volume, "tetgen": tetgen | {"command": whole.name}, "kerf": rows}


def cube_row(args, scratch, parts, whole):
    _, report = run_kerf(args, "mesh", scratch / "run", ASSETS / "cube.stl", parts, 1, args.cube_volume)
    nodes = report["totals"]["vertices"]
    interior = sum(part["vertices"] - part["surface_vertices"] for part in report["parts"])
    mesher = sum(part["mesh_seconds"] for part in report["parts"])
    return {
        "parts": parts,
        "nodes": nodes,
        "interface_share": (nodes - interior - report["input"]["vertices"]) / nodes,
        "estimated_share": 3 * nodes ** (-1 / 3) * (parts ** (1 / 3) - 1),
        "gain": parts * (whole / mesher - 1),
        "estimated_gain": parts * (math.log(nodes) / math.log(nodes / parts) - 1),
    }


def print_size(size):
    tets, seconds = size["tetgen"]["tets"], size["tetgen"]["seconds"]
    print(f"\n{'processes':>9} {'parts':>6} {'tets':>12} {'seconds':>9} {'speed-up':>9} {'efficiency':>11}")
    print(f"{'TetGen':>9} {1:>6} {tets:>12,} {seconds:>9.2f} {1:>9.2f} {'':>11}")
    for row in size["kerf"]:
        print(
            f"{row['processes']:>9} {row['parts']:>6} {row['tets']:>12,} {row['seconds']:>9.2f} "
            f"{row['speed_up']:>9.2f} {100 * row['efficiency']:>9.0f} %  {'' if row['measured'] else 'projected'}"
        )


def print_cube(rows):
    print(f"\n{'cube: N':>9} {'nodes':>10} {'interface':>10} {'estimate':>9} {'gain':>7} {'estimate':>9}")
    for row in rows:
        print(
            f"{row['parts']:>9} {row['nodes']:>10,} {100 * row['interface_share']:>8.1f} % "
            f"{100 * row['estimated_share']:>7.1f} % {row['gain']:>7.2f} {row['estimated_gain']:>9.2f}"
        )


def plot(sizes, path):
    """Speed-up over processes, both logarithmic; projected points are open."""
    blocks, curves = [], ["x with lines dashtype 3 linecolor rgb '#888888' title 'linear'"]
    for i, size in enumerate(sizes):
        name = f"$size{i}"
        lines = [f"{row['processes']} {row['speed_up']} {int(row['measured'])}" for row in size["kerf"]]
        blocks.append(f"{name} << END\n" + "\n".join(lines) + "\nEND\n")
        style = f"linewidth 2 linecolor {i + 1}"
        title = f"{size['tetgen']['tets'] / 1e6:.1f} M tetrahedra"
        curves.append(f"{name} using 1:2 with lines {style} title '{title}'")
        for measured, point in ((1, 7), (0, 6)):
            chosen = f"($3 == {measured} ? $2 : NaN)"
            curves.append(f"{name} using 1:{chosen} with points pointtype {point} {style} notitle")
    script = "".join(blocks) + (
        f"set terminal svg size 760,520 font 'sans,14' background 'white'\nset output '{path}'\n"
        "set logscale xy 2\nset grid\nset key top left\n"
        "set xlabel 'processes'\nset ylabel 'speed-up over TetGen on the whole'\n"
        "set title 'Filled points are measured, open ones projected from measured parts' font 'sans,12'\n"
        f"plot {', '.join(curves)}\n"
    )
    subprocess.run(["gnuplot"], input=script, text=True, check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kerf", default="build/kerf", help="program to measure")
    parser.add_argument("--surface", type=pathlib.Path, default=ASSETS / "bearing_cap_52k.stl", help="binary STL")
    parser.add_argument(
        "--max-volume", type=float, nargs="+", default=[0.5, 0.0417, 0.00405], help="4e5, 4e6 and 4e7 tetrahedra"
    )
    parser.add_argument("--processes", type=int, nargs="+", default=[1, 2, 4, 8, 16, 32])
    parser.add_argument("--cores", type=int, default=os.cpu_count(), help="up to which times are measured directly")
    parser.add_argument("--cube", type=int, nargs="*", default=[8, 27, 64], help="numbers of parts; none: no cube study")
    parser.add_argument("--cube-volume", type=float, default=1e-6)
    parser.add_argument("--output", default="build/scaling", help="of .json and .svg")
    args = parser.parse_args()

    load = os.getloadavg()[0]
    vertices, facets = read_binary_stl(args.surface)
    with tempfile.TemporaryDirectory() as name:
        scratch = pathlib.Path(name)
        write_smesh(scratch / "surface.smesh", vertices, facets)
        sizes = []
        for max_volume in args.max_volume:
            sizes.append(measure_size(args, scratch, scratch / "surface.smesh", max_volume))
            print_size(sizes[-1])
        cube = []
        if args.cube:
            _, report = run_kerf(args, "mesh", scratch / "run", ASSETS / "cube.stl", 1, 1, args.cube_volume)
            whole = report["parts"][0]["mesh_seconds"]
            cube = [cube_row(args, scratch, parts, whole) for parts in args.cube]
            print_cube(cube)
    figures = {"surface": args.surface.name, "cores": args.cores, "load_at_start": load, "sizes": sizes, "cube": cube}
    pathlib.Path(f"{args.output}.json").write_text(json.dumps(figures, indent=2) + "\n")
    plot(sizes, f"{args.output}.svg")
    print(f"\n{args.output}.json, {args.output}.svg")


if __name__ == "__main__":
    main()
