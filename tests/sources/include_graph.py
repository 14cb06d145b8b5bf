"""Which sources see the headers of libraries that are slow to compile, and by which chain of includes."""

import collections
import re

FOLDERS = ("kernel", "solve", "cli", "help", "viewer", "python", "tests")
ROOTS = ("kernel/", "", "tests/")  # where the compiler looks for own headers
DEPTH = {"kernel": 3, "solve": 2, "viewer": 2, "tests": 2}  # folders that name a room; the others are one
LIBRARIES = {
    "CGAL": re.compile(r"CGAL/"),
    "CLI11": re.compile(r"CLI/"),
    "Eigen": re.compile(r"Eigen/(?!(Core|Geometry|StdVector)$)"),  # decompositions
    "OpenMesh": re.compile(r"OpenMesh/"),
    "json": re.compile(r"nlohmann/json\.hpp$"),
    "toml++": re.compile(r"toml\+\+/"),
}
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*["<]([^">\n]+)[">]', re.M)


def room_of(path):
    """kernel/surface/repair of kernel/surface/repair/inside/rims.h, cli of cli/main.cpp."""
    folders = [folder for folder in path.split("/")[:-1] if folder != "inside"]
    return "/".join(folders[:DEPTH.get(folders[0], 1)]) if folders else path


def files_of(root):
    """The own headers and sources, and the names that each includes."""
    found = sorted(path for folder in FOLDERS for path in (root / folder).rglob("*.*") if path.suffix in (".h", ".cpp"))
    return {str(path.relative_to(root)): INCLUDE.findall(path.read_text()) for path in found}


def own_header(name, includer, files):
    """The own file that a name of an include stands for, or None."""
    places = [includer.rpartition("/")[0] + "/", *ROOTS]
    return next((place + name for place in places if place + name in files), None)


def next_steps(files, includers, library):
    """From each file that sees a library the next one of the shortest chain to it, or the header in angle brackets."""
    steps = {}
    for file, names in files.items():
        header = next((name for name in names if library.match(name)), None)
        if header:
            steps[file] = f"<{header}>"
    reached = collections.deque(steps)
    while reached:
        file = reached.popleft()
        for includer in includers[file]:
            if includer not in steps:
                steps[includer] = file
                reached.append(includer)
    return steps


def chain_from(source, steps):
    chain = [source]
    while chain[-1] in steps:
        chain.append(steps[chain[-1]])
    return chain


def chains_by_room(files):
    """(room, library) -> a chain for each source of the room that sees the library."""
    includers = collections.defaultdict(list)
    for file, names in files.items():
        for name in names:
            header = own_header(name, file, files)
            if header:
                includers[header].append(file)
    chains = collections.defaultdict(list)
    for library, pattern in LIBRARIES.items():
        steps = next_steps(files, includers, pattern)
        for source in files:
            if source in steps and source.endswith(".cpp"):
                chains[room_of(source), library].append(chain_from(source, steps))
    return chains


def sources_of_tests(files):
    """Room of tests -> number of its sources."""
    return collections.Counter(room_of(file) for file in files if file.startswith("tests/") and file.endswith(".cpp"))


def told_chains(chains, shown=3):
    """Lines that show by what a room sees a library: some chains for each own file that includes it."""
    by_last = collections.defaultdict(list)
    for chain in chains:
        by_last[chain[-2]].append(chain)
    for last, group in by_last.items():
        yield from ("    " + " -> ".join(chain) for chain in group[:shown])
        if len(group) > shown:
            yield f"    and {len(group) - shown} more through {last}"
