"""deb.py BUILD [PACKAGE]: whether a package of Debian has what its users expect, and works where it was unpacked, with
nothing of the build folder in sight. Without PACKAGE one is made of BUILD, uncompressed and without dpkg-shlibdeps."""

from __future__ import annotations

import argparse
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
from pathlib import Path
from xml.etree import ElementTree

ROOT = Path(__file__).resolve().parents[2]
NOT_RUN = 77  # for ctest
TIME = 1700000000  # of all files of a package that is made here
# What the types of Debian 12 have without us; not OBJ, which they take for something else.
KNOWN_TYPES = {"model/stl": "stl", "model/3mf": "3mf", "model/iges": "iges"}


def run(*command: object, **environment: str) -> str:
    """With an empty environment but for the system's programs."""
    done = subprocess.run([str(word) for word in command], text=True, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, env={"PATH": "/usr/bin:/bin", "LC_ALL": "C.UTF-8"} | environment)
    if done.returncode != 0:
        raise SystemExit(f"deb.py: {' '.join(map(str, command))} ends with {done.returncode}:\n{done.stdout}")
    return done.stdout


def make(build: Path, folder: Path) -> Path:
    command = [sys.executable, "-B", ROOT / "packaging/deb.py", build, folder]
    return Path(run(*command, "--compression", "none", "--depends", "libc6", SOURCE_DATE_EPOCH=str(TIME),
                    DEBEMAIL="kerf@example.org").splitlines()[-1])


def expect(condition: bool, what: object) -> None:
    if not condition:
        raise SystemExit(f"deb.py: {what}")


def check_entries(package: Path) -> None:
    """All are of root and of one time, which is what the same bytes need; and nobody else may write."""
    with subprocess.Popen(["dpkg-deb", "--fsys-tarfile", package], stdout=subprocess.PIPE) as process:
        entries = list(tarfile.open(fileobj=process.stdout, mode="r|"))
    expect(len({entry.mtime for entry in entries}) == 1, "files of several times")
    for entry in entries:
        expect(entry.uid == entry.gid == 0, f"{entry.name} is of {entry.uid}")
        expect(entry.mode in (0o644, 0o755), f"{entry.name} has the mode {entry.mode:o}")


def check_commands(tree: Path) -> None:
    """Users see kerf alone; each command has a page, and completion knows it."""
    expect([file.name for file in (tree / "usr/bin").iterdir()] == ["kerf"], "programs beside kerf are in /usr/bin")
    completion = (tree / "usr/share/bash-completion/completions/kerf").read_text()
    listed = run(tree / "usr/bin/kerf", "--help").partition("Commands:")[2]
    commands = re.findall(r"^  ([a-z]+) +\w", listed, re.MULTILINE)
    expect("mesh" in commands and "view" in commands, commands)
    for command in commands:
        expect((tree / f"usr/share/man/man1/kerf-{command}.1.gz").is_file(), f"kerf {command} has no page")
        expect(f"_kerf_words['kerf {command}']" in completion, f"kerf {command} has no completion")


def formats_of(kerf: Path, folder: Path) -> set[str]:
    """The endings of what can be opened, as the refusal of anything else names them."""
    (folder / "unknown").write_text("?\n")
    said = subprocess.run([kerf, "check", folder / "unknown"], stdout=subprocess.PIPE, text=True).stdout
    names = re.findall(r"([.]?\b\w+)(?!\w|')", said.partition("Give ")[2].partition("plain")[0])
    return {name.lstrip(".").lower() for name in names if name.startswith(".") or name.isupper()}


def check_desktop(tree: Path, folder: Path) -> None:
    """The viewer is offered for all that Kerf reads, and for nothing else."""
    entry = (tree / "usr/share/applications/kerf.desktop").read_text()
    types = re.search(r"^MimeType=(.*);$", entry, re.MULTILINE)[1].split(";")
    endings = {ending: name for name, ending in KNOWN_TYPES.items()}
    of_kind = "{http://www.freedesktop.org/standards/shared-mime-info}"
    for kind in ElementTree.parse(tree / "usr/share/mime/packages/kerf.xml").getroot():
        endings |= {glob.get("pattern")[2:]: kind.get("type") for glob in kind.iter(of_kind + "glob")}
    expect(set(types) == set(endings.values()), f"types of the desktop {set(types) ^ set(endings.values())}")
    formats = formats_of(tree / "usr/bin/kerf", folder)
    expect(len(formats) > 10 and formats == set(endings) - {"stp"}, f"formats {formats ^ (set(endings) - {'stp'})}")
    expect((tree / "usr/share/icons/hicolor/scalable/apps/kerf.svg").is_file(), "no icon")


def check_programs(tree: Path, folder: Path) -> None:
    """Each finds the others and what it draws with."""
    kerf, surface = tree / "usr/bin/kerf", ROOT / "assets/cube.stl"
    home = {"HOME": str(folder), "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    run(kerf, "mesh", surface, "-o", folder / "run", "-n", "2", "--workers", "1", "-q", **home)
    run(kerf, "screenshot", surface, "--resolution", "64x64", "-o", folder / "cube.png", **home)
    code = ("import kerf, sys; kerf.mesh(sys.argv[1], parts=2); print(kerf.__file__)\n"
            "for name in sys.argv[2:]: print(kerf.programs.path(name))")
    helpers = sorted((tree / "usr/libexec/kerf").iterdir())
    said = run("/usr/bin/python3", "-B", "-c", code, surface, *(file.name for file in helpers),
               PYTHONPATH=str(tree / "usr/lib/python3/dist-packages"), **home)
    expected = [tree / "usr/lib/python3/dist-packages/kerf/__init__.py", *helpers]
    expect(said.splitlines() == [str(path) for path in expected], said)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=Path)
    parser.add_argument("package", type=Path, nargs="?")
    arguments = parser.parse_args()
    if not shutil.which("dpkg-deb"):
        print("deb.py: not a Debian system")
        sys.exit(NOT_RUN)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name).resolve()
        package = arguments.package or make(arguments.build, folder)
        tree = folder / "tree"
        run("dpkg-deb", "--extract", package, tree)
        check_entries(package)
        check_commands(tree)
        check_desktop(tree, folder)
        check_programs(tree, folder)


if __name__ == "__main__":
    main()
