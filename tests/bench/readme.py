#!/usr/bin/env python3
"""Measures meshers beside each other, in one run, and writes README's table of them.

usage: readme.py [--json FILE] [--from FILE]

The bearing cap with 3.5 million tetrahedra, as meshers.py measures it. The table takes the place of that below the
line `<!-- figures: ./run bench readme -->`. With --from the figures of an earlier run are written again.
"""

import argparse
import datetime
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
README = ROOT / "README.md"
MARK = "<!-- figures: ./run bench readme -->\n"
CASE = "bearing_cap_52k 3.5 M"
NAMES = {"auto": "Kerf", "tetgen": "TetGen", "HXT raw": "gmsh HXT", "HXT optimised": "gmsh HXT, optimised"}


def row_of(result):
    name = NAMES[result["mesher"]]
    if "failure" in result:
        return f"| {name} | {result['failure']} | | | | |"
    return (f"| {name} | {result['tets'] / 1e6:.2f} M | {result['seconds']:.1f} s | {result['peak_bytes'] / 1e6:,.0f} MB "
            f"| {result['dihedral_0']:.1f}° | {result['dihedral_1']:.1f}° |")


def table_of(measured):
    case = next(case for case in measured["cases"] if case["case"] == CASE)
    lines = ["| one core, one surface | tetrahedra | meshing | memory | smallest angle | 1 % are below |",
             "|---|---|---|---|---|---|", *map(row_of, case["rows"])]
    return "\n".join(lines) + f"\n\nMeasured on {measured['date']}, medians of {measured['repetitions']}."


def with_table(readme, table):
    """README with another table: it ends with the paragraph behind it, which says when it was measured."""
    before, mark, rest = readme.partition(MARK)
    if not mark:
        sys.exit(f"{README}: no line {MARK.strip()!r}, below which the table belongs")
    paragraphs = rest.split("\n\n")
    if paragraphs[0].startswith("|"):
        paragraphs = paragraphs[2:]
    return before + mark + "\n\n".join([table, *paragraphs]).replace("\n\n\n", "\n\n")


def measure(file):
    subprocess.run([sys.executable, ROOT / "tests/bench/meshers.py", "--only", CASE, "--json", file], check=True)
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
