"""deb.py BUILD FOLDER: a package of Debian of what was built in BUILD, in the folder, of the installed tree without the
library for C++. Its path is printed.

Users call kerf alone, so that the other programs go to libexec. What the package says of itself is in packaging/deb;
what it depends on is what its programs were linked with, by dpkg-shlibdeps, which dpkg-dev has. The same build gives
the same bytes: every time is that of the last commit, or of SOURCE_DATE_EPOCH in the environment. The address of the
maintainers is that of the last commit, or DEBEMAIL.
"""

from __future__ import annotations

import argparse
import email.utils
import gzip
import hashlib
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
TEXTS = ROOT / "packaging/deb"
# Below what a package of Debian would have, if there is one.
REVISION = "0kerf1"
# Where Debian wants something else than what a prefix has.
MOVES = {
    "usr/share/zsh/site-functions": "usr/share/zsh/vendor-completions",
    f"usr/lib/python{sys.version_info[0]}.{sys.version_info[1]}": "usr/lib/python3",
}
DESKTOP = {
    "kerf.desktop": "usr/share/applications",
    "kerf.xml": "usr/share/mime/packages",
    "kerf.svg": "usr/share/icons/hicolor/scalable/apps",
}
DOCUMENTS = "usr/share/doc/kerf"


def output_of(*command: object, **keywords: object) -> str:
    done = subprocess.run([str(word) for word in command], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True,
                          **keywords)
    if done.returncode != 0:
        raise SystemExit(f"deb.py: {command[0]} has failed")
    return done.stdout.strip()


def of_last_commit(form: str, variable: str) -> str:
    """What the environment says, or else the last commit."""
    if os.environ.get(variable):
        return os.environ[variable]
    try:
        return subprocess.run(["git", "-C", ROOT, "log", "-1", f"--format={form}"], check=True, text=True,
                              capture_output=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        raise SystemExit(f"deb.py: without a history of git, set {variable}") from None


def version() -> str:
    return re.search(r"project\(Kerf VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1] + f"-{REVISION}"


def maintainer() -> str:
    return f"The Kerf developers <{of_last_commit('%ae', 'DEBEMAIL')}>"


def compress(file: Path, text: bytes) -> None:
    """As gzip -9n does."""
    file.parent.mkdir(parents=True, exist_ok=True)
    with file.open("wb") as raw, gzip.GzipFile("", "wb", 9, raw, 0) as out:
        out.write(text)


def move(source: Path, target: Path) -> None:
    target.parent.mkdir(parents=True, exist_ok=True)
    source.rename(target)


def install(build: Path, tree: Path) -> None:
    output_of("cmake", "--install", build, "--prefix", "/usr", "--component", "Unspecified", "--strip",
              env={**os.environ, "DESTDIR": str(tree)})
    for program in (tree / "usr/bin").iterdir():
        if program.name != "kerf":
            move(program, tree / "usr/libexec/kerf" / program.name)
    for source, target in MOVES.items():
        move(tree / source, tree / target)


def add_documents(tree: Path, seconds: int) -> None:
    """In the forms that Debian asks for."""
    documents = tree / DOCUMENTS
    for page in sorted((tree / "usr/share/man/man1").iterdir()):
        compress(page.with_name(page.name + ".gz"), page.read_bytes())
        page.unlink()
    changes = documents / "CHANGELOG.md"
    compress(documents / "changelog.gz", changes.read_bytes())
    changes.unlink()
    entry = (f"kerf ({version()}) bookworm; urgency=medium\n\n  * What has changed is in changelog.gz.\n\n"
             f" -- {maintainer()}  {email.utils.formatdate(seconds)}\n")
    compress(documents / "changelog.Debian.gz", entry.encode())
    licence = documents / "LICENSE"
    text = "".join(f" {line.strip() or '.'}\n" for line in licence.read_text().splitlines())
    (documents / "copyright").write_text((TEXTS / "copyright").read_text() + text)
    licence.unlink()


def add_desktop(tree: Path) -> None:
    for name, folder in DESKTOP.items():
        (tree / folder).mkdir(parents=True, exist_ok=True)
        shutil.copyfile(TEXTS / name, tree / folder / name)


def is_elf(file: Path) -> bool:
    with file.open("rb") as opened:
        return opened.read(4) == b"\x7fELF"


def files_of(tree: Path) -> list[Path]:
    return sorted(path for path in tree.rglob("*") if path.is_file() and "DEBIAN" not in path.parts)


def libraries(tree: Path) -> str:
    """The packages of the libraries that the programs need."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "debian").mkdir()
        (Path(folder) / "debian/control").write_text("Source: kerf\n\nPackage: kerf\nArchitecture: any\n")
        # The module of Python calls the interpreter that loads it.
        return output_of("dpkg-shlibdeps", "-O", *(file for file in files_of(tree) if is_elf(file)), cwd=folder,
                         stderr=subprocess.DEVNULL).removeprefix("shlibs:Depends=")


def interpreter() -> str:
    """The one that the module of Python was built for."""
    major, minor = sys.version_info[:2]
    return f"python3 (>= {major}.{minor}~), python3 (<< {major}.{minor + 1})"


def add_control(tree: Path, depends: str) -> None:
    folder = tree / "DEBIAN"
    folder.mkdir()
    files = files_of(tree)
    size = sum(-(-file.stat().st_size // 1024) for file in files)
    fields = {"version": version(), "architecture": output_of("dpkg", "--print-architecture"), "size": size,
              "maintainer": maintainer(), "depends": depends, "python": interpreter()}
    (folder / "control").write_text((TEXTS / "control").read_text().format(**fields))
    (folder / "md5sums").write_text("".join(f"{hashlib.md5(file.read_bytes()).hexdigest()}  {file.relative_to(tree)}\n"
                                            for file in files))
    for script in ("postinst", "prerm"):
        shutil.copyfile(TEXTS / script, folder / script)


def is_program(tree: Path, file: Path) -> bool:
    return str(file.relative_to(tree)).startswith(("usr/bin/", "usr/libexec/", "DEBIAN/p"))


def set_modes_and_times(tree: Path, seconds: int) -> None:
    for path in [tree, *tree.rglob("*")]:
        path.chmod(0o755 if path.is_dir() or is_program(tree, path) else 0o644)
        os.utime(path, (seconds, seconds))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=Path)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--compression", default="xz", help="none is quicker")
    parser.add_argument("--depends", help="instead of what dpkg-shlibdeps says")
    arguments = parser.parse_args()
    seconds = int(of_last_commit("%ct", "SOURCE_DATE_EPOCH"))
    arguments.folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        tree = Path(folder) / "tree"
        install(arguments.build, tree)
        add_documents(tree, seconds)
        add_desktop(tree)
        add_control(tree, arguments.depends or libraries(tree))
        set_modes_and_times(tree, seconds)
        output_of("dpkg-deb", "--root-owner-group", f"-Z{arguments.compression}", "-z1", "--build", tree,
                  arguments.folder, env={**os.environ, "SOURCE_DATE_EPOCH": str(seconds)})
    print(arguments.folder / f"kerf_{version()}_{output_of('dpkg', '--print-architecture')}.deb")


if __name__ == "__main__":
    main()
