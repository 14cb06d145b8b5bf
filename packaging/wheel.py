"""wheel.py WHEEL FOLDER: a copy of the wheel in the folder that has the shared libraries which it needs, as auditwheel
makes one.

They go into kerf.libs beside the package, under names of their own, because the same interpreter may have loaded
another version of one. What a base system has is not taken, nor MPI, which has to be that of the user's mpirun, and
what is built upon that MPI: PETSc. Needs patchelf.
"""

from __future__ import annotations

import argparse
import base64
import hashlib
import os
import re
import shutil
import stat
import subprocess
import tempfile
import zipfile
from pathlib import Path

# As in the manylinux policies, by the names of files without what follows `.so`.
BASE_SYSTEM = {
    "ld-linux-x86-64", "libc", "libdl", "libgcc_s", "libm", "libpthread", "libresolv", "librt", "libstdc++", "libutil",
    "libEGL", "libGL", "libGLX", "libGLdispatch", "libOpenGL", "libICE", "libSM", "libX11", "libXau", "libXdmcp",
    "libXext", "libXrender", "libbsd", "libmd", "libxcb",
}
OF_MPI = {"libmpi", "libpetsc_real", "libpetsc"}
LIBRARIES = "kerf.libs"


def is_elf(path: Path) -> bool:
    with path.open("rb") as file:
        return file.read(4) == b"\x7fELF"


def patchelf(*arguments: str) -> str:
    return subprocess.run(["patchelf", *arguments], check=True, capture_output=True, text=True).stdout


def needed_by(file: Path) -> list[str]:
    """Names of the libraries that a file asks for itself, without those that are left to the system."""
    return [name for name in patchelf("--print-needed", str(file)).split()
            if name.split(".so")[0] not in BASE_SYSTEM | OF_MPI]


def places(file: Path) -> dict[str, Path]:
    """Where the system's loader finds what a file needs, directly or not."""
    found = re.findall(r"(\S+) => (/\S+)", subprocess.run(["ldd", str(file)], check=True, capture_output=True,
                                                         text=True).stdout)
    return {name: Path(path).resolve() for name, path in found}


def own_name(name: str, source: Path) -> str:
    """libfmt.so.9 -> libfmt-0123abcd.so.9, by the file's bytes."""
    stem, ending = name.split(".so", 1)
    return f"{stem}-{hashlib.sha256(source.read_bytes()).hexdigest()[:8]}.so{ending}"


def rename_needed(file: Path, names: dict[str, str]) -> None:
    arguments = [word for name in needed_by(file) if name in names for word in ("--replace-needed", name, names[name])]
    if arguments:
        patchelf(*arguments, str(file))


def bundle(tree: Path) -> list[Path]:
    """Copies the libraries into an unpacked wheel and returns the copies."""
    files = [path for path in sorted((tree / "kerf").rglob("*")) if path.is_file() and is_elf(path)]
    names: dict[str, str] = {}
    copies = []
    # Each file with where its libraries are: those of a library are where its user has found them.
    waiting = [(file, places(file)) for file in files]
    while waiting:
        file, found = waiting.pop()
        for name in needed_by(file):
            if name in names:
                continue
            if name not in found:
                raise SystemExit(f"wheel.py: {name}, which {file} needs, is not installed")
            names[name] = own_name(name, found[name])
            copy = tree / LIBRARIES / names[name]
            copy.parent.mkdir(exist_ok=True)
            shutil.copyfile(found[name], copy)
            copies.append(copy)
            waiting.append((copy, found))
    for file in files + copies:
        rename_needed(file, names)
        if file in copies:
            patchelf("--set-soname", file.name, str(file))
        path = os.path.relpath(tree / LIBRARIES, file.parent)
        patchelf("--force-rpath", "--set-rpath", "$ORIGIN" if path == "." else f"$ORIGIN/{path}", str(file))
        file.chmod(0o755)
    return copies


def record_line(tree: Path, file: Path) -> str:
    content = file.read_bytes()
    digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
    return f"{file.relative_to(tree)},sha256={digest},{len(content)}\n"


def write_record(tree: Path) -> None:
    record, = tree.glob("*.dist-info/RECORD")
    files = [file for file in sorted(tree.rglob("*")) if file.is_file() and file != record]
    record.write_text("".join(record_line(tree, file) for file in files) + f"{record.relative_to(tree)},,\n")


def unpack(wheel: Path, tree: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        for entry in archive.infolist():
            path = Path(archive.extract(entry, tree))
            if path.is_file():
                path.chmod(entry.external_attr >> 16 & 0o777 or 0o644)


def pack(tree: Path, wheel: Path) -> None:
    """The same bytes for the same files."""
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for file in sorted(path for path in tree.rglob("*") if path.is_file()):
            entry = zipfile.ZipInfo(str(file.relative_to(tree)), (1980, 1, 1, 0, 0, 0))
            entry.external_attr = (stat.S_IFREG | stat.S_IMODE(file.stat().st_mode)) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, file.read_bytes())


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("wheel", type=Path)
    parser.add_argument("folder", type=Path)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        tree = Path(folder)
        unpack(arguments.wheel, tree)
        copies = bundle(tree)
        write_record(tree)
        result = arguments.folder / arguments.wheel.name
        pack(tree, result)
        size = sum(copy.stat().st_size for copy in copies)
        print(f"{result}: {result.stat().st_size / 1e6:.1f} MB, with {len(copies)} libraries of {size / 1e6:.1f} MB")


if __name__ == "__main__":
    main()
