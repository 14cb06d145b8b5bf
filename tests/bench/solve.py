#!/usr/bin/env python3
"""How the error of `kerf solve` falls with the size of cells, and what it takes.

First a known field of displacements, sines in a cube, the bending of a beam and a thick sphere under pressure inside, on
meshes that are twice as fine from row to row: the errors in the norms of L2 and of the energy, and their orders between
rows, against the mean size of cells, the cube root of the volume by their number. The estimate of the energy's error stands
beside it. The field is prescribed at all nodes of the surface, and elements of order 2 have all of a bending.

Then the bearing cap under the loads of assets/bearing_cap_case.toml: time of the stages, iterations, and memory of all
ranks by unknown. With --large at 4 million tetrahedra, too. And the whole way from its surface to stresses in one command,
on one rank and two; what 32 ranks would take is projected: stages that ranks share by the number of ranks, from two.

Last the bracket of assets/l_bracket_case.toml, whose inner edge is sharp: meshes that follow the error (--adapt) and meshes
with one size. The true error is that beside the energy of a fine solution of order 2: of the same loads,
energies of displacements differ by the square of the error.
"""

import argparse
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
ERRORS = ("l2", "energy")


def call(command, **options):
    done = subprocess.run([str(word) for word in command], stdin=subprocess.DEVNULL, capture_output=True, text=True, **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(str(word) for word in command)} ended with code {done.returncode}:\n{done.stderr[-2000:]}")
    return done.stdout


def icosphere(levels, radius):
    """Vertices and triangles, seen from outside."""
    t = (1 + math.sqrt(5)) / 2
    points = [(-1, t, 0), (1, t, 0), (-1, -t, 0), (1, -t, 0), (0, -1, t), (0, 1, t), (0, -1, -t), (0, 1, -t), (t, 0, -1),
              (t, 0, 1), (-t, 0, -1), (-t, 0, 1)]
    facets = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6),
              (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7),
              (9, 8, 1)]
    for _ in range(levels):
        middles, finer = {}, []

        def middle(a, b):
            key = (min(a, b), max(a, b))
            if key not in middles:
                middles[key] = len(points)
                points.append(tuple((x + y) / 2 for x, y in zip(points[a], points[b])))
            return middles[key]

        for a, b, c in facets:
            x, y, z = middle(a, b), middle(b, c), middle(c, a)
            finer += [(a, x, z), (x, b, y), (z, y, c), (x, y, z)]
        facets = finer
        points = [tuple(radius * x / math.hypot(*p) for x in p) for p in points]
    return points, facets


def write_thick_sphere(path, levels):
    outer, facets = icosphere(levels, 2)
    inner, _ = icosphere(levels, 1)
    turned = [(a + len(outer), c + len(outer), b + len(outer)) for a, b, c in facets]
    with open(path, "w") as out:
        out.write(f"OFF\n{len(outer) + len(inner)} {2 * len(facets)} 0\n")
        out.writelines(" ".join(repr(x) for x in p) + "\n" for p in outer + inner)
        out.writelines(f"3 {a} {b} {c}\n" for a, b, c in facets + turned)


def errors_of(args, field, meshes):
    print(f"\n{field}\n{'order':>5} {'tets':>9} {'nodes':>9} {'iterations':>10} {'L2':>10} {'order':>6} {'energy':>10} "
          f"{'order':>6} {'estimate':>10}")
    rows = []
    for order in (1, 2):
        before = None
        for folder in meshes[: 3 if order == 1 else 2]:
            found = json.loads(call([args.helper, field, folder, order]))
            falls = {}
            if before:
                finer = math.log(found["tets"] / before["tets"]) / 3
                falls = {name: math.log(before[name] / found[name]) / finer for name in ERRORS}
            text = {name: f"{falls[name]:6.2f}" if falls else " " * 6 for name in ERRORS}
            print(f"{order:>5} {found['tets']:>9,} {found['nodes']:>9,} {found['iterations']:>10} {found['l2']:>10.3e} "
                  f"{text['l2']} {found['energy']:>10.3e} {text['energy']} {found['estimate']:>10.3e}", flush=True)
            rows.append({"field": field, "order": order, **found, **{f"{name}_order": falls.get(name) for name in ERRORS}})
            before = found
    return rows


def solve_cap(args, work, size):
    mesh = work / f"cap{size}"
    options = ["--size", size] if size else []
    call([args.kerf, "mesh", ROOT / "assets/bearing_cap_52k.stl", "-o", mesh, "-n", 8, "--feature-angle", 40, "-q", *options])
    rows = []
    for ranks in (1, 2):
        mpirun(ranks, [args.kerf, "solve", mesh, "--case", ROOT / "assets/bearing_cap_case.toml", "-o", work / "solution", "-q"])
        report = json.loads((work / "solution/report.json").read_text())
        seconds, solved = report["seconds"], report["solve"]
        unknowns = 3 * solved["nodes"]
        row = {"tets": report["totals"]["tets"], "unknowns": unknowns, "ranks": ranks,
               "iterations": solved["cases"][0]["iterations"], "residual": solved["cases"][0]["residual"],
               "imbalance": solved["cases"][0]["imbalance"], "seconds": seconds,
               "kB_by_unknown": report["peak_rss_bytes"] / unknowns / 1000}
        rows.append(row)
        equations = seconds["assemble"] + seconds["setup"] + seconds["solve"]
        print(f"{row['tets']:>10,} {unknowns:>10,} {ranks:>5} {row['iterations']:>10} {seconds['read'] + seconds['number']:>6.2f} "
              f"{seconds['assemble']:>8.2f} {seconds['setup']:>7.2f} {seconds['solve']:>7.2f} {seconds['recover']:>7.2f} "
              f"{seconds['write']:>6.2f} {100 * seconds['assemble'] / equations:>8.1f} {row['kB_by_unknown']:>6.2f}", flush=True)
    return rows


def known_fields(args, work):
    cubes, spheres = [], []
    for i in range(3):
        cubes.append(work / f"cube{i}")
        call([args.kerf, "mesh", ROOT / "assets/cube.stl", "-o", cubes[-1], "-n", 4, "--surface", "remesh", "--size", 0.12 / 2**i,
              "-q"])
        write_thick_sphere(work / "sphere.off", 3 + i)
        spheres.append(work / f"sphere{i}")
        call([args.kerf, "mesh", work / "sphere.off", "-o", spheres[-1], "-n", 4, "--size", 0.26 / 2**i, "-q"])
    return errors_of(args, "sine", cubes) + errors_of(args, "bending", cubes) + errors_of(args, "sphere", spheres)


def caps(args, work):
    print(f"\n{'tets':>10} {'unknowns':>10} {'ranks':>5} {'iterations':>10} {'read':>6} {'assemble':>8} {'setup':>7} {'solve':>7} "
          f"{'recover':>7} {'write':>6} {'assemble %':>8} {'kB':>6}")
    return [row for size in (0, 1.13, *([0.7] if args.large else [])) for row in solve_cap(args, work, size)]


def mpirun(ranks, command):
    environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    call(["mpirun", "--bind-to", "none", "--oversubscribe", "-n", ranks, *command], env=environment)


def whole_way(args, work):
    """From the surface to stresses; both programs' stages by their reports."""
    rows = []
    print(f"\n{'ranks':>5} {'tets':>9} {'cut':>6} {'mesh':>6} {'write':>6} {'read, number':>12} {'equations':>9} {'solve':>6} "
          f"{'stresses':>8} {'write':>6} {'sum':>6}")
    for ranks in (1, 2):
        out = work / "whole"
        mpirun(ranks, [args.kerf, "solve", ROOT / "assets/bearing_cap_52k.stl", "--feature-angle", 40, "--size", 1.13, "-n", 32,
                       "--workers", 1, "--case", ROOT / "assets/bearing_cap_case.toml", "-o", out, "-q"])
        mesh = json.loads((out / "mesh/report.json").read_text())["totals"]
        solution = json.loads((out / "solution/report.json").read_text())
        s = solution["seconds"]
        cut = mesh["read_seconds"] + mesh["decompose_seconds"] + mesh["prepare_seconds"]
        stages = [cut, mesh["mesh_seconds"], mesh["write_seconds"], s["read"] + s["number"] + s["conditions"],
                  s["assemble"] + s["setup"], s["solve"], s["recover"], s["write"]]
        rows.append({"ranks": ranks, "tets": solution["totals"]["tets"], "stages": stages})
    # All read the surface, and the first cuts are made by all alike: none of that is shared.
    rows.append({"ranks": 32, "tets": rows[-1]["tets"], "projected": True,
                 "stages": [rows[-1]["stages"][0]] + [2 / 32 * seconds for seconds in rows[-1]["stages"][1:]]})
    for row in rows:
        print(f"{row['ranks']:>5} {row['tets']:>9,} " + " ".join(f"{seconds:>{width}.2f}" for seconds, width in
              zip(row["stages"], (6, 6, 6, 12, 9, 6, 8, 6))) + f" {sum(row['stages']):>6.2f}"
              + (" projected" if "projected" in row else ""), flush=True)
    return rows


def bracket(args, work):
    surface, case = ROOT / "assets/l_bracket.stl", ROOT / "assets/l_bracket_case.toml"
    fine = work / "fine.toml"
    fine.write_text("[solver]\norder = 2\n" + case.read_text())

    def solution_of(folder):
        solved = json.loads((folder / "solution/report.json").read_text())
        found = solved["solve"]["cases"][0]
        return {"tets": solved["totals"]["tets"], "nodes": solved["solve"]["nodes"], "estimate": found["relative_error"],
                "energy": found["energy_norm"], "error": found["error_norm"]}

    call([args.kerf, "solve", surface, "--case", fine, "-o", work / "fine", "-n", 4, "--adapt", 3, "-q"])
    reference = solution_of(work / "fine/step_4")
    energy = math.hypot(reference["energy"], reference["error"])
    call([args.kerf, "solve", surface, "--case", case, "-o", work / "adapted", "-n", 4, "--adapt", 4, "-q"])
    runs = {"following the error": [solution_of(work / f"adapted/step_{i + 1}") for i in range(5)], "one size": []}
    for size in (7.5, 5, 3.4, 2.3):
        call([args.kerf, "solve", surface, "--case", case, "-o", work / f"size{size}", "-n", 4, "--surface", "remesh", "--size",
              size, "-q"])
        runs["one size"].append(solution_of(work / f"size{size}"))
    print(f"\nbracket{'tets':>17} {'nodes':>9} {'estimate %':>10} {'error %':>8} {'order by nodes':>14}")
    for name, rows in runs.items():
        before = None
        for row in rows:
            row["true"] = math.sqrt(energy**2 - row["energy"]**2) / energy
            order = math.log(before["true"] / row["true"]) / math.log(row["nodes"] / before["nodes"]) if before else None
            row["order"] = order
            print(f"{name if not before else '':<14} {row['tets']:>9,} {row['nodes']:>9,} {100 * row['estimate']:>10.2f} "
                  f"{100 * row['true']:>8.2f} {'' if order is None else format(order, '.3f'):>14}", flush=True)
            before = row
        over_all = math.log(rows[0]["true"] / rows[-1]["true"]) / math.log(rows[-1]["nodes"] / rows[0]["nodes"])
        print(f"{'over all':<14} {'':>9} {'':>9} {'':>10} {'':>8} {over_all:>14.3f}")
    return runs


SECTIONS = ("errors", "cap", "whole", "bracket")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kerf", default=ROOT / "build/kerf")
    parser.add_argument("--helper", default=ROOT / "build/solve_bench")
    parser.add_argument("--large", action="store_true")
    parser.add_argument("--only", nargs="*", choices=SECTIONS, default=SECTIONS)
    parser.add_argument("--json", type=pathlib.Path, help="file for the results")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        work = pathlib.Path(scratch)
        results = {}
        if "errors" in args.only:
            results["errors"] = known_fields(args, work)
        if "cap" in args.only:
            results["cap"] = caps(args, work)
        if "whole" in args.only:
            results["whole"] = whole_way(args, work)
        if "bracket" in args.only:
            results["bracket"] = bracket(args, work)
    if args.json:
        args.json.write_text(json.dumps(results, indent=2) + "\n")


if __name__ == "__main__":
    main()
