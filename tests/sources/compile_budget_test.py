#!/usr/bin/env python3
"""What makes compiling slow stays within tests/sources/compile_budget.txt, without a clock.

compile_budget_test.py ROOT: how many sources of each room see the headers of slow libraries, and how many sources each
folder of tests has. With --build FOLDER: how many lines the compiler has read there for a source of each room (--deps
FILE: as this text says, which `ninja -t deps` has printed). With --write the file gets the figures of today, those of
lines with 15 % to grow. `compile_budget_test.py --self-test ROOT`: a copy of the tree with heavy includes is refused.
"""

import argparse
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

from compiled_lines import NOT_OF_ALL, deps_of, rooms_read, told_files
from include_graph import FOLDERS, chains_by_room, files_of, room_of, sources_of_tests, told_chains

BOUNDS = "tests/sources/compile_budget.txt"
ROOM_TO_GROW, LEAST_ROOM = 0.15, 300  # for lines; a small room may have a header of the standard library more
WORTH_LOWERING = 0.85
HEAD = """# What may make compiling slow, and how much of it: room, what, bound. What has no line may not be there.
# LIBRARY: sources of the room that see its headers; of Eigen decompositions, of json and toml++ the full header.
# sources: of a folder of tests.
# lines: that the compiler reads for one source, of all as one, without what is precompiled; with 15 % to grow, at least
# 300 lines, and with the libraries of Debian 12. kerf_precompiled and kerf_test_shapes are the precompiled headers.
# tests/sources/compile_budget_test.py ROOT --build BUILD --write has written this; who raises a bound says why.
"""


def read_bounds(root):
    """(room, what) -> number."""
    rows = [line.split() for line in (root / BOUNDS).read_text().splitlines() if line and line[0] != "#"]
    return {(room, what): int(bound) for room, what, bound in rows}


def write_bounds(root, bounds):
    rows = [f"{room} {what} {bound}\n" for (room, what), bound in sorted(bounds.items())]
    (root / BOUNDS).write_text(HEAD + "".join(rows))


class Includes:
    """Part one: what sources see, from their text."""

    def __init__(self, root):
        files = files_of(root)
        self.chains = chains_by_room(files)
        self.figures = {place: len(chains) for place, chains in self.chains.items()}
        self.figures |= {(room, "sources"): count for room, count in sources_of_tests(files).items()}

    @staticmethod
    def has(what):
        return what != "lines"

    def bounds(self):
        return self.figures

    def least_worth_telling(self, bound):
        return bound

    def told(self, place, bound):
        room, what = place
        if what == "sources":
            return [f"{room}: {self.figures[place]} sources, the bound is {bound}"]
        return [f"{room}: {self.figures[place]} of its sources see {what}, the bound is {bound}:",
                *told_chains(self.chains[place])]


class Lines:
    """Part two: what the compiler has read."""

    def __init__(self, root, build, deps):
        self.rooms = rooms_read(root, build, deps)
        self.figures = {(name, "lines"): room.lines_a_source() for name, room in self.rooms.items()}
        if not any(source.endswith(".cpp") for room in self.rooms.values() for source in room.sources):
            sys.exit(f"{build} has no dependencies of sources: nothing is built there")
        self.tell_what_was_not_built(root)

    def tell_what_was_not_built(self, root):
        in_tree = {}
        for file in files_of(root):
            if file.endswith(".cpp") and room_of(file) not in NOT_OF_ALL:
                in_tree.setdefault(room_of(file), set()).add(file)
        for name, sources in sorted(in_tree.items()):
            missing = len(sources - {file for room in self.rooms.values() for file in room.sources})
            if missing:
                print(f"{name}: {missing} of {len(sources)} sources are not built here and not counted")

    @staticmethod
    def has(what):
        return what == "lines"

    def bounds(self):
        return {place: 100 * math.ceil((lines + max(ROOM_TO_GROW * lines, LEAST_ROOM)) / 100)
                for place, lines in self.figures.items()}

    def least_worth_telling(self, bound):
        return WORTH_LOWERING * bound

    def told(self, place, bound):
        return [f"{place[0]}: {self.figures[place]} lines are read for a source, the bound is {bound}. Most of them:",
                *told_files(self.rooms[place[0]])]


def check(part, bounds):
    """What is above its bound, as lines of text; it prints which bounds could be lower."""
    wrong = []
    for place, figure in sorted(part.figures.items()):
        if figure > bounds.get(place, 0):
            wrong += part.told(place, bounds.get(place, 0))
    lower = part.bounds()
    for place, bound in sorted(bounds.items()):
        is_counted = place in part.figures or place[1] != "lines"  # else it may only not be built
        if part.has(place[1]) and is_counted and lower.get(place, 0) < part.least_worth_telling(bound):
            print(f"{BOUNDS}: {place[0]} {place[1]} {bound} could be {lower.get(place, 0)}")
    return wrong


def write(root, part):
    """What was not counted keeps its bound: lines of what is not built, and those of the other part."""
    old = read_bounds(root) if (root / BOUNDS).exists() else {}
    kept = {place: bound for place, bound in old.items() if place[1] == "lines" or not part.has(place[1])}
    write_bounds(root, kept | part.bounds())


def part_of(args):
    if not args.build:
        return Includes(args.root)
    if not (args.build / "build.ninja").exists() or not args.deps and not shutil.which("ninja"):
        print(f"{args.build} is not built by Ninja, which tells what the compiler has read")
        sys.exit(77)
    if "/joined/" not in (args.build / "build.ninja").read_text():
        print(f"{args.build} compiles each source for itself; bounds are for those of a folder as one, as ./run does")
        sys.exit(77)
    return Lines(args.root, args.build, args.deps.read_text() if args.deps else deps_of(args.build))


class Trial:
    """A copy of the sources, in which something is done that must be refused."""

    def __init__(self, root, folder):
        self.root = folder
        for name in FOLDERS:
            shutil.copytree(root / name, folder / name, ignore=self.other_files)
        (folder / BOUNDS).parent.mkdir(exist_ok=True)
        self.expect([], "--write")
        self.expect([])

    @staticmethod
    def other_files(folder, names):
        return [name for name in names if not name.endswith((".h", ".cpp")) and not os.path.isdir(f"{folder}/{name}")]

    def expect(self, words, *arguments):
        """It is refused with all these words; without words it is not."""
        command = [sys.executable, "-B", __file__, str(self.root), *map(str, arguments)]
        done = subprocess.run(command, capture_output=True, text=True, timeout=50)
        text = done.stdout + done.stderr
        if bool(done.returncode) != bool(words) or not all(word in text for word in words):
            sys.exit(f"It ended with {done.returncode}, expected is {words or 'success'}:\n{text}")

    def expect_with_include(self, file, include, words):
        path = self.root / file
        text = path.read_text()
        path.write_text(f"#include {include}\n{text}")
        self.expect(words)
        path.write_text(text)
        self.expect([])


def try_includes(trial):
    source = min((trial.root / "kernel/files/io").glob("*.cpp")).relative_to(trial.root)
    trial.expect_with_include(source, "<CGAL/Surface_mesh.h>", [
        "kernel/files/io: 1 of its sources see CGAL, the bound is 0", f"{source} -> <CGAL/Surface_mesh.h>"])
    trial.expect_with_include("kernel/kerf/kerf.h", "<nlohmann/json.hpp>", [
        "of its sources see json, the bound is", ".cpp -> kernel/kerf/kerf.h -> <nlohmann/json.hpp>"])
    more = trial.root / "tests/unit/one_more_test.cpp"
    more.touch()
    trial.expect(["tests/unit: ", " sources, the bound is"])
    more.unlink()


class FakeBuild:
    """A build folder with two sources of kernel/files/io that use a precompiled header, as far as Ninja tells it."""
    MADE, PRECOMPILED = "kernel/files/io/kerf_io.dir/joined/kerf_io.cpp.o", "kerf_precompiled.dir/cmake_pch.hxx.gch"

    def __init__(self, root):
        self.folder, self.deps = root / "build", root / "deps.txt"
        self.folder.mkdir()
        rule = f"build {self.MADE}: CXX kerf_io.cpp | {self.folder / self.PRECOMPILED} || order\n"
        (self.folder / "build.ninja").write_text(rule)
        self.sources = sorted((root / "kernel/files/io").glob("*.cpp"))[:2]

    def arguments(self, precompiled, headers):
        read = {self.PRECOMPILED: precompiled, self.MADE: [*self.sources, *headers]}
        self.deps.write_text("".join(f"{made}: #deps {len(files)}, deps mtime 1 (VALID)\n" +
                                     "".join(f"    {file}\n" for file in files) + "\n" for made, files in read.items()))
        return self.no_arguments()

    def no_arguments(self):
        return "--build", self.folder, "--deps", self.deps


def try_lines(trial):
    known, heavy = trial.root / "known.h", trial.root / "heavy.h"
    for header in (known, heavy):
        header.write_text("\n" * 100_000)
    build = FakeBuild(trial.root)
    usual = build.arguments([known], ["../known.h"])
    trial.expect([], *usual, "--write")
    trial.expect([], *usual)
    bound = read_bounds(trial.root)["kernel/files/io", "lines"]
    if bound > 10_000:
        sys.exit(f"The bound of kernel/files/io is {bound}: what is precompiled counts for it")
    trial.expect(["kernel/files/io: ", f"lines of {heavy}"], *build.arguments([known], [known, heavy]))
    trial.expect(["kerf_precompiled: ", f"lines of {heavy}"], *build.arguments([known, heavy], [known]))
    build.deps.write_text("")
    trial.expect(["nothing is built there"], *build.no_arguments())


def self_test(root):
    with tempfile.TemporaryDirectory(prefix="kerf_compile_budget_") as folder:
        trial = Trial(root, pathlib.Path(folder).resolve())
        try_includes(trial)
        try_lines(trial)


def absolute(path):
    """As CMake spells it, by links where it does."""
    return pathlib.Path(os.path.abspath(path))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("root", type=absolute)
    parser.add_argument("--build", type=absolute)
    parser.add_argument("--deps", type=pathlib.Path)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--self-test", action="store_true")
    args = parser.parse_args()
    if args.self_test:
        return self_test(args.root)
    part = part_of(args)
    if args.write:
        return write(args.root, part)
    wrong = check(part, read_bounds(args.root))
    if wrong:
        wrong.append("Take it to where it is needed, by a header that only declares or a source of its own; or raise "
                     f"the bound in {BOUNDS} (--write).")
    return "\n".join(wrong) or None


if __name__ == "__main__":
    sys.exit(main())
