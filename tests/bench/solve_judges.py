#!/usr/bin/env python3
"""Kerf, CalculiX and DOLFINx solve one case on one mesh, in one run.

The bearing cap of cast iron, held at its block and pressed by the shaft, elements of order 1. CalculiX 2.20 with SPOOLES,
its direct solver, on one thread; DOLFINx with the preconditioner and the tolerance of `kerf solve`, conjugate gradients with
GAMG and rigid motions, on the same PETSc. Times are those of whole programs, on one process, without meshing; of DOLFINx the
stages, too. Displacements of the three have to agree. Debian: calculix-ccx python3-dolfinx python3-meshio.
"""

import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/oracles"))
import compare_with_calculix as calculix  # noqa: E402

YOUNG, POISSON, PRESSURE, RTOL = 110e3, 0.26, 130.0, 1e-8
HELD, PRESSED = ("face_4", "face_6"), ("face_5", "face_12", "face_14")
CASE = f"""[material.cast_iron]
young = {YOUNG}
poisson = {POISSON}
[[support]]
patch = {list(HELD)}
fixed = true
[[load]]
patch = {list(PRESSED)}
pressure = {PRESSURE}
[solver]
rtol = {RTOL}
"""
DOLFINX = pathlib.Path(__file__).with_name("solve_with_dolfinx.py")


def timed(command, folder):
    environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                   "OMP_NUM_THREADS": "1", "CCX_NPROC_EQUATION_SOLVER": "1"}
    start = time.monotonic()
    done = subprocess.run([str(word) for word in command], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True,
                          text=True, env=environment, timeout=3600)
    seconds = time.monotonic() - start
    if done.returncode != 0:
        sys.exit(f"{command[0]} ended with code {done.returncode}:\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return seconds


def write_deck(mesh, held, forces, path):
    calculix.write_deck(mesh.points, mesh.tets, held, forces)
    text = pathlib.Path("job.inp").read_text().replace("210000., 0.3", f"{YOUNG}, {POISSON}")
    path.write_text(text.replace("*EL PRINT, ELSET=EALL\nS\n", ""))


def judge(args, work, size):
    folder = work / f"mesh{size}"
    subprocess.run([args.kerf, "mesh", ROOT / "assets/bearing_cap_52k.stl", "-o", folder, "-n", "2", "--feature-angle", "40",
                    "-q", *(["--size", str(size)] if size else [])], check=True)
    (work / "case.toml").write_text(CASE)
    seconds = {"kerf": timed([args.kerf, "solve", folder, "--case", "case.toml", "-o", "solution", "-q"], work)}
    report = json.loads((work / "solution/report.json").read_text())
    seconds["kerf on 2 ranks"] = timed(
        ["mpirun", "--bind-to", "none", "--oversubscribe", "-n", "2", args.kerf, "solve", folder, "--case", "case.toml", "-o",
         "solution2", "-q"], work)
    mesh = calculix.Solution(work / "solution")
    listed = subprocess.run([args.kerf, "solve", folder, "--list-patches"], capture_output=True, text=True, check=True)
    names = [line.split()[-1] for line in listed.stdout.splitlines()[1:]]
    chosen = [np.isin(mesh.patch, [names.index(name) for name in which]) for which in (HELD, PRESSED)]
    held = np.unique(mesh.triangles[chosen[0]])
    forces = np.zeros_like(mesh.points)
    a, b, c = (mesh.points[mesh.triangles[chosen[1]][:, k]] for k in range(3))
    share = -PRESSURE / 6 * np.cross(b - a, c - a)
    for k in range(3):
        np.add.at(forces, mesh.triangles[chosen[1]][:, k], share)

    def difference(moved):
        return np.abs(moved - mesh.displacement).max() / np.abs(mesh.displacement).max()

    np.savez(work / "mesh.npz", points=mesh.points, tets=mesh.tets, held=held, forces=forces,
             material=[YOUNG, POISSON], rtol=RTOL)
    seconds["DOLFINx"] = timed(["/usr/bin/python3", DOLFINX, "mesh.npz", "moved.npz"], work)
    found = np.load(work / "moved.npz")
    rows = [("kerf", report["solve"]["cases"][0]["iterations"], ""),
            ("kerf on 2 ranks", json.loads((work / "solution2/report.json").read_text())["solve"]["cases"][0]["iterations"], ""),
            ("DOLFINx", int(found["iterations"]), f"{difference(found['displacement']):.0e}")]
    if len(mesh.tets) < args.most_for_direct:
        os.chdir(work)
        write_deck(mesh, held, forces, work / "job.inp")
        seconds["CalculiX"] = timed(["ccx", "job"], work)
        moved = calculix.rows_of((work / "job.dat").read_text(), "displacements", 4)[:, 1:]
        rows.append(("CalculiX", 0, f"{difference(moved):.0e}"))
    s = report["seconds"]
    print(f"\n{len(mesh.tets):,} tetrahedra, {3 * len(mesh.points):,} unknowns; kerf: assemble {s['assemble']:.2f}, setup "
          f"{s['setup']:.2f}, solve {s['solve']:.2f} s; DOLFINx: mesh {found['mesh']:.2f}, assemble {found['assemble']:.2f}, setup "
          f"{found['setup']:.2f}, solve {found['solve']:.2f} s")
    print(f"{'program':<16} {'seconds':>8} {'iterations':>10} {'differs by':>10}")
    for name, iterations, differs in rows:
        print(f"{name:<16} {seconds[name]:>8.2f} {iterations or 'direct':>10} {differs:>10}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kerf", default=ROOT / "build/kerf")
    parser.add_argument("--most-for-direct", type=int, default=300_000, help="tetrahedra of a mesh for CalculiX")
    parser.add_argument("--sizes", type=float, nargs="*", default=[0, 1.13], help="edge lengths; 0: as the surface")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        for size in args.sizes:
            judge(args, pathlib.Path(scratch), size)


if __name__ == "__main__":
    main()
