"""wheel.py WHEEL BUILD: whether a wheel works by itself: installed without an index into a fresh environment, which is
moved then, with nothing of the build folder in sight. The environment has the system's numpy."""

from __future__ import annotations

import argparse
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

# What the user runs; kerf.libs has what is not of the system. Prints what of the build folder the process has open.
MESHES = """
import sys, kerf, numpy
points = [[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]
triangles = [[0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 1, 3],
             [0, 3, 2], [4, 6, 7], [4, 7, 5]]
mesh = kerf.mesh(kerf.Surface(points, triangles), parts=2, size=0.3)
a, b, c, d = (mesh.points[mesh.tetrahedra[:, i]] for i in range(4))
volume = numpy.einsum("ij,ij->i", numpy.cross(b - a, c - a), d - a).sum() / 6
assert abs(volume - 1) < 1e-12, volume
for line in open("/proc/self/maps"):
    if sys.argv[1] in line: print(line)
print(kerf.__file__)
"""


def run(*command: object, cwd: Path) -> str:
    """With an empty environment but for the system's programs, as `env -i` would. Returns what it prints."""
    done = subprocess.run([str(word) for word in command], cwd=cwd, text=True, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          env={"PATH": "/usr/bin:/bin", "HOME": str(cwd), "OMPI_ALLOW_RUN_AS_ROOT": "1",
                               "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"})
    if done.returncode != 0:
        raise SystemExit(f"wheel.py: {' '.join(map(str, command))} ends with {done.returncode}:\n{done.stdout}")
    return done.stdout


def package_of(environment: Path) -> Path:
    package, = environment.glob("lib/python*/site-packages/kerf")
    return package


def check_libraries(package: Path, build: Path) -> None:
    """Everything is found, and nothing by chance in the build folder."""
    programs = [path for path in package.glob("bin/*") if path.is_file()]
    for file in [*package.glob("*.so"), *programs]:
        for line in run("ldd", file, cwd=package).splitlines():
            if str(build) in line or ("not found" in line and file.name not in ("kerf-solve", "kerf-view")):
                raise SystemExit(f"wheel.py: {file.name} has {line.strip()}")


def check_programs(environment: Path, folder: Path) -> None:
    """The kernel finds each by itself, as where a file is read by one."""
    for program in (path for path in (package_of(environment) / "bin").iterdir() if path.is_file()):
        code = f"from kerf import _kerf; print(_kerf.find_program({program.name!r}))"
        found = run(environment / "bin/python", "-c", code, cwd=folder).strip()
        if found != str(program):
            raise SystemExit(f"wheel.py: {program.name} is found at {found}")


def check_mesh(environment: Path, folder: Path, build: Path) -> None:
    where = run(environment / "bin/python", "-c", MESHES, build, cwd=folder).splitlines()
    if where != [str(package_of(environment) / "__init__.py")]:
        raise SystemExit(f"wheel.py: expected the package of {environment}, not {where}")


def check_picture(environment: Path, folder: Path, surface: Path) -> None:
    picture = folder / "picture.png"
    run(environment / "bin/python", "-m", "kerf", "screenshot", surface, "--resolution", "320x240", "-o", picture,
        cwd=folder)
    if not picture.read_bytes().startswith(b"\x89PNG"):
        raise SystemExit("wheel.py: that is no picture")


def check_solution(environment: Path, folder: Path, assets: Path) -> None:
    run(environment / "bin/python", "-m", "kerf", "solve", assets / "l_bracket.stl", "--case",
        assets / "l_bracket_case.toml", "-o", folder / "bracket", "-n", "2", "-q", cwd=folder)
    if not (folder / "bracket/solution/report.json").is_file():
        raise SystemExit("wheel.py: there is no solution")


def has_all_libraries(program: Path) -> bool:
    return program.is_file() and "not found" not in run("ldd", program, cwd=program.parent)


class Steps:
    """Says what each step has taken."""

    def __init__(self) -> None:
        self._start = time.monotonic()

    def done(self, text: str) -> None:
        now = time.monotonic()
        print(f"wheel.py: {text}, {now - self._start:.1f} s", file=sys.stderr)
        self._start = now


def try_wheel(wheel: Path, build: Path, folder: Path) -> None:
    assets = Path(__file__).resolve().parents[2] / "assets"
    steps = Steps()
    run("/usr/bin/python3", "-m", "venv", "--system-site-packages", folder / "first", cwd=folder)
    run(folder / "first/bin/python", "-m", "pip", "install", "--no-index", "--no-deps", "--disable-pip-version-check",
        wheel, cwd=folder)
    run(folder / "first/bin/kerf", "--version", cwd=folder)
    steps.done("installed")
    environment = (folder / "first").rename(folder / "another place")
    check_libraries(package_of(environment), build)
    check_programs(environment, folder)
    check_mesh(environment, folder, build)
    steps.done("meshes where it was moved to")
    programs = package_of(environment) / "bin"
    if has_all_libraries(programs / "kerf-view"):
        check_picture(environment, folder, assets / "l_bracket.stl")
        steps.done("draws")
    if has_all_libraries(programs / "kerf-solve"):
        check_solution(environment, folder, assets)
        steps.done("solves")
    shutil.move(environment, folder / "moved")
    check_mesh(folder / "moved", folder, build)
    steps.done("meshes where it was moved to again")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("wheel", type=Path)
    parser.add_argument("build", type=Path)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        try_wheel(arguments.wheel.resolve(), arguments.build.resolve(), Path(folder).resolve())


if __name__ == "__main__":
    main()
