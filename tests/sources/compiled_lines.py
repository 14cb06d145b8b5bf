"""How many lines the compiler has read for the sources of each room, as the dependencies that Ninja keeps tell it.

A folder's sources are compiled as one, so that a header counts once however many of them include it. What a precompiled
header holds is compiled once for all, and the compiler opens of it only what a source includes by itself, to find that
it knows it: these files count for the precompiled header alone, and for objects that do not use it.
"""

import collections
import dataclasses
import functools
import os
import pathlib
import re
import subprocess

from include_graph import room_of

NOT_OF_ALL = ("tests/bench", "tests/fuzz", "tests/install")  # which a build has only where somebody asked for them
ENTRY = re.compile(r"(\S.*): #deps \d+, deps mtime \d+ \(\w+\)$")
OBJECT = re.compile(r"^build (\S+\.o):.*?\s(\S+\.gch)(?=\s|$)", re.M)


@dataclasses.dataclass
class Room:
    """What the compiler has read for a room; a precompiled header is one, too, of one source."""
    sources: set = dataclasses.field(default_factory=set)
    lines: collections.Counter = dataclasses.field(default_factory=collections.Counter)  # of each file that is read

    def lines_a_source(self):
        return round(self.lines.total() / len(self.sources))


def deps_of(build):
    """The text of `ninja -t deps`. As a dry run: else it might tidy its log, which a build may write just now."""
    done = subprocess.run(["ninja", "-C", str(build), "-n", "-t", "deps"], capture_output=True, text=True, timeout=60)
    if done.returncode:
        raise RuntimeError(f"ninja -t deps ended with {done.returncode}: {done.stderr}")
    return done.stdout


def parse_deps(text, build):
    """Object or precompiled header -> the files that it was made of."""
    read, files = {}, None
    for line in text.splitlines():
        entry = ENTRY.match(line)
        if entry:
            files = read.setdefault(os.path.normpath(build / entry[1]), [])
        elif line.startswith("    "):
            files.append(os.path.normpath(build / line.strip()))
    return read


def precompiled_of(build):
    """Object -> the precompiled header that it uses: dependencies do not name it."""
    text = (build / "build.ninja").read_text()
    return {os.path.normpath(build / found[1]): os.path.normpath(build / found[2]) for found in OBJECT.finditer(text)}


@functools.cache
def lines_of(file):
    try:
        return pathlib.Path(file).read_bytes().count(b"\n")
    except OSError:  # gone since
        return 0


def own_sources(root, build, files):
    """Those of the tree, not what CMake has written."""
    prefix, written = f"{root}/", f"{build}/"
    return [file.removeprefix(prefix) for file in files
            if file.startswith(prefix) and not file.startswith(written) and file.endswith(".cpp")]


def room_of_object(made, build, sources):
    """That in whose folder CMake has made it, else that of most of its sources."""
    folder = made.removeprefix(f"{build}/").partition("CMakeFiles/")[0]
    votes = collections.Counter(map(room_of, sources))
    own = room_of(folder + "x.cpp")
    return own if own in votes else votes.most_common(1)[0][0]


def rooms_read(root, build, text):
    """Room -> Room, from the text of `ninja -t deps`; root and build are absolute."""
    read, uses = parse_deps(text, build), precompiled_of(build)
    rooms = collections.defaultdict(Room)
    for made, files in read.items():
        sources = own_sources(root, build, files)
        if made.endswith(".gch"):  # FOLDER/CMakeFiles/TARGET.dir/cmake_pch.hxx.gch
            room, sources = rooms[pathlib.Path(made).parent.stem], [made]
        elif sources:
            room = rooms[room_of_object(made, build, sources)]
        else:
            continue  # made of nothing but what CMake has written
        room.sources.update(sources)
        known = set(read.get(uses.get(made), ()))
        room.lines.update({file: lines_of(file) for file in files if file not in known})
    return {name: room for name, room in rooms.items() if name not in NOT_OF_ALL}


def told_files(room, shown=3):
    """Lines that name the files of which the compiler has read most for a room."""
    return [f"    {count:7} lines of {file}" for file, count in room.lines.most_common(shown)]
