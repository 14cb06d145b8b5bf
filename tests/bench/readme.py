#!/usr/bin/env python3
"""Measures meshers beside each other, in one run, and writes README's table of them.

usage: readme.py [--json FILE] [--from FILE]

The bearing cap with 3.5 million tetrahedra, as meshers.py measures it, under the names and versions of what was
measured. The table takes the place of what lies between README's lines BEGIN and END. With --from the figures of an
earlier run are written again.
"""

import argparse
import datetime
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
README = ROOT / "README.md"
BEGIN, END = "<!-- figures: ./run bench readme -->\n", "<!-- end of figures -->\n"
CASE = "bearing_cap_52k 3.5 M"
COLUMNS = {  # of its meshers: the program, and how it is named
    "auto": ("Kerf", "Kerf"),
    "tetgen": ("TetGen", "TetGen"),
    "gmsh": ("gmsh", "gmsh"),
    "HXT raw": ("gmsh", "gmsh HXT"),
    "HXT optimised": ("gmsh", "HXT, optimised"),
}
RELEASED = {"TetGen 1.5.0": 2013, "gmsh 4.8.4": 2021}  # those of Debian 12
ROWS = {
    "tetrahedra": lambda result: f"{result['tets'] / 1e6:.2f} M",
    "meshing, one core": lambda result: f"{result['seconds']:.1f} s",
    "memory": lambda result: f"{result['peak_bytes'] / 1e6:,.0f} MB",
    "smallest dihedral angle": lambda result: f"{result['dihedral_0']:.1f}°",
    "1 % of the angles are below": lambda result: f"{result['dihedral_1']:.1f}°",
}


def line_of(cells):
    return f"| {' | '.join(cells)} |"


def title_of(mesher, versions):
    """The version stands where the name is that of the program: the columns of its other meshers are beside it."""
    program, title = COLUMNS[mesher]
    if title != program or program not in versions:
        return title
    name = f"{program} {versions[program]}"
    return f"{name} ({RELEASED[name]})" if name in RELEASED else name


def table_of(measured):
    case = next(case for case in measured["cases"] if case["case"] == CASE)
    results = {row["mesher"]: row for row in case["rows"]}
    titles = [title_of(mesher, measured["versions"]) for mesher in COLUMNS]
    lines = [line_of([f"bearing cap, {case['facets']:,} facets", *titles]), "|---|" + "---:|" * len(COLUMNS)]
    for name, value in ROWS.items():
        found = [results.get(mesher, {"failure": "not run"}) for mesher in COLUMNS]
        lines.append(line_of([name, *(each.get("failure") or value(each) for each in found)]))
    lines += ["", f"Medians of {measured['repetitions']} on {measured['date']}, {measured['processor']}; one call where "
              f"it took more than {measured['long']:g} s.", ""]
    return "\n".join(lines)


def with_table(readme, table):
    before, begin, rest = readme.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not end:
        sys.exit(f"{README}: no lines {BEGIN.strip()!r} and {END.strip()!r}, between which the table belongs")
    return before + begin + table + end + after


def measure(file):
    subprocess.run([sys.executable, ROOT / "tests/bench/meshers.py", "--only", CASE, "--limit", "3600", "--json", file],
                   check=True)
    measured = json.loads(file.read_text()) | {"date": datetime.date.today().isoformat()}
    file.write_text(json.dumps(measured, indent=2) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--json", type=pathlib.Path, default=ROOT / "build/readme.json", help="file for the results")
    parser.add_argument("--from", dest="earlier", type=pathlib.Path, help="results of an earlier run")
    args = parser.parse_args()
    if not args.earlier:
        measure(args.json)
    README.write_text(with_table(README.read_text(), table_of(json.loads((args.earlier or args.json).read_text()))))


if __name__ == "__main__":
    main()
