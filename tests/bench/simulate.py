#!/usr/bin/env python3
"""What runs on 32 to 1,024 ranks would take: costs of stages as they are measured here, put together by the order of a
run on a machine that is assumed (cluster_model.py says both, and every assumption is printed). Costs are those of two
runs that do the same, with one worker and with two, on this machine; the share of a stage that runs on threads follows
from the two by Amdahl's law. Nothing here is measured on more than one host.
"""

import argparse
import dataclasses
import json
import pathlib
import sys
import tempfile

from cluster_model import Machine, costs_of_runs, efficiency
from divided_surface import write_divided
from speed_up import ASSETS, timed

# Facets of the bearing cap times 4 by level, cells, ranks.
RUNS = [(0, 4.1e6, 32), (0, 41e6, 32), (0, 41e6, 64), (2, 100e6, 128), (0, 1e9, 256), (0, 1e9, 1024), (2, 1e9, 1024),
        (4, 1e9, 1024)]
FACETS = 51840


def run_kerf(args, folder, surface, workers):
    options = ["-n", f"{args.parts}", "--workers", f"{workers}", "--max-volume", f"{args.max_volume:g}", "--surface",
               "split"]
    timed([args.kerf, "mesh", str(surface), "-o", str(folder), "-q", *options])
    return json.loads((folder / "report.json").read_text())


def measured_costs(args):
    """Medians would need more runs: the faster of two each counts."""
    with tempfile.TemporaryDirectory() as name:
        scratch = pathlib.Path(name)
        surface = scratch / "surface.stl"
        write_divided(args.surface, args.level, surface)
        fastest = []
        for workers in (1, 2):
            reports = [run_kerf(args, scratch / "run", surface, workers) for _ in range(2)]
            fastest.append(min(reports, key=lambda report: report["totals"]["wall_seconds"]))
        return costs_of_runs(*fastest)


def print_table(costs, machine, rows):
    print("measured, seconds of one core:")
    for field in dataclasses.fields(costs):
        value = getattr(costs, field.name)
        print(f"  {field.name:<18} {f'{min(value):.2f} to {max(value):.2f}' if isinstance(value, tuple) else f'{value:.3g}'}")
    print("assumed:")
    for field in dataclasses.fields(machine):
        print(f"  {field.name:<18} {getattr(machine, field.name):g}")
    terms = list(rows[0]["terms"])
    print(f"\nprojected, seconds:\n{'facets':>12} {'cells':>14} {'ranks':>6} {'efficiency':>11} "
          + " ".join(f"{term:>8}" for term in terms))
    for row in rows:
        print(f"{row['facets']:>12,} {row['cells']:>14,} {row['ranks']:>6} {100 * row['efficiency']:>9.0f} % "
              + " ".join(f"{row['terms'][term]:>{max(8, len(term))}.2f}" for term in terms))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kerf", default="build/kerf", help="program to measure")
    parser.add_argument("--surface", type=pathlib.Path, default=ASSETS / "bearing_cap_52k.stl", help="binary STL")
    parser.add_argument("--level", type=int, default=2, help="how often each facet is divided where costs are measured")
    parser.add_argument("--max-volume", type=float, default=0.02, help="of the cells where costs are measured")
    parser.add_argument("--parts", type=int, default=64)
    for field in dataclasses.fields(Machine):
        parser.add_argument("--" + field.name.replace("_", "-"), type=type(field.default), default=field.default)
    parser.add_argument("--json", type=pathlib.Path, help="where the figures go, too")
    args = parser.parse_args()

    machine = Machine(**{field.name: getattr(args, field.name) for field in dataclasses.fields(Machine)})
    costs = measured_costs(args)
    rows = []
    for level, cells, ranks in RUNS:
        share, terms = efficiency(costs, machine, FACETS * 4**level, cells, ranks)
        rows.append({"facets": FACETS * 4**level, "cells": int(cells), "ranks": ranks, "efficiency": share,
                     "terms": terms})
    print_table(costs, machine, rows)
    if args.json:
        figures = {"costs": dataclasses.asdict(costs), "machine": dataclasses.asdict(machine), "rows": rows}
        args.json.write_text(json.dumps(figures, indent=2) + "\n")


if __name__ == "__main__":
    sys.exit(main())
