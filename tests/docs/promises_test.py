#!/usr/bin/env python3
"""What docs/promises.md and docs/output.md promise is what a run writes: fields of the report and their types, arrays
of the files and theirs, paths, exit codes.

promises_test.py SOURCE KERF; the fields of a solution only where KERF can solve.
"""

import json
import pathlib
import re
import struct
import subprocess
import sys
import tempfile

TYPES = {"number": (int, float), "text": str, "boolean": bool, "list": list, "object": dict}


def rows(text, heading):
    """Of the table below this line: its first cell without quotes, and the second."""
    lines = text[text.index(heading):].split("\n")[2:]
    for line in lines:
        if not line.startswith("|"):
            return
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        yield cells[0].strip("`"), cells[1], cells


def values(value, path):
    """All values at a path such as tree[].cut.plane or quality.*.shape, and of what is not there None."""
    if not path:
        yield value
        return
    step, _, rest = path.partition(".")
    many = step.endswith("[]")
    name = step.removesuffix("[]")
    for inner in value.values() if name == "*" else [value.get(name)]:
        for item in inner if many and inner is not None else [inner]:
            if item is None:
                yield None
            else:
                yield from values(item, rest)


def wrong_fields(text, heading, report):
    count = 0
    for path, kind, _ in rows(text, heading):
        count += 1
        found = list(values(report, path))
        if path.startswith("tree[].cut"):  # leaves have none
            found = [value for value in found if value is not None]
        fits = found and all(
            isinstance(value, TYPES[kind]) and isinstance(value, bool) == (kind == "boolean") for value in found)
        if not fits:
            yield f"the report has no {kind} at {path}"
    if count < 10:
        yield f"the table below '{heading}' is too short"


def arrays(path):
    """{(section, name): type} of a VTK file."""
    header = path.read_bytes().partition(b"<AppendedData")[0].decode()
    found, section = {}, ""
    for tag, attributes in re.findall(r"<(\w+)((?:\s[^>]*)?)/?>", header):
        if tag != "DataArray":
            section = tag
        else:
            words = dict(re.findall(r'(\w+)="([^"]*)"', attributes))
            found[section, words["Name"]] = words["type"]
    return found


def wrong_arrays(text, part, solution):
    sections = {"points": "PointData", "cells": "CellData", "field data": "FieldData"}
    for name, place, cells in rows(text, "| array | of | type |"):
        of_solution = place.endswith(" of solutions")
        if of_solution and solution is None:
            continue
        file = solution if of_solution else part
        kind = file.get((sections[place.removesuffix(" of solutions")], name))
        if f"`{kind}`" not in cells[2]:
            yield f"the array {name} of {place} is {kind}"


def wrong_codes(kerf, text):
    said = subprocess.run([kerf, "--help"], capture_output=True, text=True, timeout=60).stdout
    codes = re.findall(r"\b(\d+) [a-z]", " ".join(said.partition("Exit codes:")[2].split()))
    table = [code for code, _, _ in rows(text, "| exit code | meaning |")]
    if codes != table or len(codes) < 10:
        yield f"kerf --help lists the exit codes {codes}, docs/output.md {table}"


def finds_modes(kerf, folder):
    """Solves for two modes of the run; false where kerf-solve was built without SLEPc."""
    (folder / "modes.toml").write_text('units = "mm"\n[material.steel]\n')
    done = subprocess.run([kerf, "solve", "out", "--case", "modes.toml", "--modes", "2", "-o", "modes", "-q"], cwd=folder,
                          capture_output=True, text=True, timeout=120)
    if done.returncode and "SLEPc" not in done.stderr:
        sys.exit(done.stderr)
    return done.returncode == 0


def write_open(source, target):
    """A binary .stl without its last facet."""
    data = source.read_bytes()
    count = struct.unpack_from("<I", data, 80)[0] - 1
    target.write_bytes(data[:80] + struct.pack("<I", count) + data[84:84 + 50 * count])


def main():
    source, kerf = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
    promises, output = ((source / "docs" / name).read_text() for name in ("promises.md", "output.md"))
    wrong = list(wrong_codes(kerf, output))
    with tempfile.TemporaryDirectory(prefix="kerf_promises_test_") as name:
        folder = pathlib.Path(name)

        def run(*arguments):
            done = subprocess.run([kerf, *arguments], cwd=folder, capture_output=True, text=True, timeout=120)
            if done.returncode:
                sys.exit(done.stderr)
            return done.stdout

        bracket = source / "assets/l_bracket.stl"
        run("mesh", bracket, "-o", "out", "-n", "4", "--format", "vtu,su2", "-q")
        report = json.loads((folder / "out/report.json").read_text())
        wrong += wrong_fields(promises, "| field | type |", report)
        for path, _, _ in rows(promises, "| path |"):
            if not (folder / "out" / path).exists():
                wrong.append(f"a run has no {path}")
        solution = None
        if (kerf.parent / "kerf-solve").exists():
            run("solve", "out", "--case", source / "assets/l_bracket_case.toml", "-o", "solution", "-q")
            solved = json.loads((folder / "solution/report.json").read_text())
            if finds_modes(kerf, folder):
                solved["solve"]["modes"] = json.loads((folder / "modes/report.json").read_text())["solve"]["modes"]
            else:
                promises = "\n".join(line for line in promises.split("\n") if not line.startswith("| `solve.modes"))
            wrong += wrong_fields(promises, "| field of a solution |", solved)
            solution = arrays(folder / "solution/parts/part_0004.vtu")
        write_open(bracket, folder / "open.stl")
        wrong += wrong_fields(promises, "| field of a repair |",
                              json.loads(run("repair", "open.stl", "-o", "mended.obj", "--json")))
        run("mesh", "open.stl", "-o", "mended", "-n", "2", "--repair", "near", "--gap", "20%", "-q")
        wrong += wrong_fields(promises, "| field of a mended surface |",
                              json.loads((folder / "mended/report.json").read_text()))
        part = arrays(folder / "out/parts/part_0004.vtu")
        wrong += wrong_arrays(promises, part, solution)
        written = {array for _, array in part}
        wrong += [f"docs/output.md does not name the array {array}" for array in
                  written - {"Points", "connectivity", "offsets", "types"} if f"`{array}`" not in output]
    if wrong:
        sys.exit("\n".join(wrong))
    print("every promise is kept")


main()
