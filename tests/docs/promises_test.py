#!/usr/bin/env python3
"""What docs/output.md and docs/report.schema.json promise is what runs write: fields of reports, arrays of files and
their types, paths, exit codes.

promises_test.py SOURCE KERF; the fields of a solution only where KERF can solve.
"""

import json
import pathlib
import re
import struct
import subprocess
import sys
import tempfile

from json_schema import Schema


def rows(text, heading):
    """Of the table below this line: its first cell without quotes, the second, and all."""
    lines = text[text.index(heading):].split("\n")[2:]
    for line in lines:
        if not line.startswith("|"):
            return
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        yield cells[0].strip("`"), cells[1], cells


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
    table = list(rows(text, "| array | of | type |"))
    if len(table) < 14:
        yield "the table of arrays is too short"
    for name, place, cells in table:
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


def required_places(schema, rule, value, steps=()):
    """Of a value that fits: the way to each field that the rule requires in it, of lists in the first item alone."""
    while "$ref" in rule:
        rule = schema.at(rule["$ref"])
    if isinstance(value, dict):
        for name, inner in rule.get("properties", {}).items():
            if name in value:
                if name in rule["required"]:
                    yield (*steps, name)
                yield from required_places(schema, inner, value[name], (*steps, name))
    if isinstance(value, list) and value and "items" in rule:
        yield from required_places(schema, rule["items"], value[0], (*steps, 0))


def holder(report, steps):
    for step in steps[:-1]:
        report = report[step]
    return report


def is_noticed(schema, rule, report, steps, change):
    """Whether the report fits no longer when the field at these steps is changed."""
    fields, name = holder(report, steps), steps[-1]
    kept = dict(fields)
    change(fields, name)
    noticed = any(Schema(schema.document).errors(report, rule))
    fields.clear()
    fields.update(kept)
    return noticed


def wrong_report(schema, form, report, tried):
    """The report fits to this form, and no longer where a required field has gone or is something else. `tried`: fields
    of earlier reports, which are not tried again."""
    rule = schema.document["$defs"][form]
    yield from schema.errors(report, rule)
    for steps in list(required_places(schema, rule, report)):
        if (form, steps) in tried:
            continue
        tried.add((form, steps))
        for change in (lambda fields, name: fields.pop(name), lambda fields, name: fields.update({name: [{}]})):
            if not is_noticed(schema, rule, report, steps, change):
                yield f"{form}: nobody would notice a change of {steps}"


def write_open(source, target):
    """A binary .stl without its last facet."""
    data = source.read_bytes()
    count = struct.unpack_from("<I", data, 80)[0] - 1
    target.write_bytes(data[:80] + struct.pack("<I", count) + data[84:84 + 50 * count])


def write_wedge(target):
    """A .obj with an edge of 1.7 degrees."""
    ends = [f"v {x} {y} {z}" for z in (0, 0.2) for x, y in ((-50, 0), (-49, 0), (-49, 0.03))]
    facets = ("1 3 2", "4 5 6", "1 2 5", "1 5 4", "2 3 6", "2 6 5", "3 1 4", "3 4 6")
    target.write_text("\n".join([*ends, *(f"f {corners}" for corners in facets)]) + "\n")


class Runs:
    """Runs of all kinds in a folder: their reports, each with the form in the schema that it has."""

    def __init__(self, kerf, source, folder):
        self.kerf, self.folder, self.reports = kerf, folder, []
        self.solves = (kerf.parent / "kerf-solve").exists()
        bracket, assets = source / "assets/l_bracket.stl", source / "assets"
        write_open(bracket, folder / "open.stl")
        self.run("mesh", bracket, "-o", "out", "-n", "4", "--format", "vtu,su2", "-q")
        self.run("decompose", bracket, "-o", "cut", "-n", "4", "-q")
        self.run("mesh", assets / "bone.stl", assets / "cement.stl", "-o", "regions", "-n", "3", "-q")
        self.run("mesh", "open.stl", "-o", "mended", "-n", "2", "--repair", "near", "--gap", "20%", "-q")
        self.run("mesh", assets / "cube.stl", "-o", "failed", "-n", "2", "--size", "0.03", "--mesher", "tetgen",
                 "--attempts", "1", "--timeout", "0.001", "-q", code=4)
        self.run("mesh", bracket, "-o", "air", "-n", "2", "--box", "1,1,1", "--wake", "30", "-q")
        write_wedge(folder / "wedge.obj")
        self.run("mesh", "wedge.obj", "open.stl", "-o", "sharp", "-n", "2", "--surface", "keep", "--repair", "near", "-q")
        for name in ("out", "cut", "regions", "mended", "failed", "air", "sharp"):
            self.keep("run", name)
        for steps in ("near", "near,no-holes,caps"):
            text = self.run("repair", "open.stl", "-o", "mended.obj", "--repair", steps, "--json",
                            code=3 if "," in steps else 0)
            self.reports.append(("repair", json.loads(text)))
        if self.solves:
            self.run("solve", "out", "--case", source / "assets/l_bracket_case.toml", "-o", "solution", "-q")
            self.keep("solution", "solution")
            self.find_modes()

    def run(self, *arguments, code=0):
        done = subprocess.run([self.kerf, *arguments], cwd=self.folder, capture_output=True, text=True, timeout=120)
        if done.returncode != code:
            sys.exit(f"{arguments} ends with {done.returncode}, not {code}:\n{done.stderr}")
        return done.stdout

    def keep(self, form, name):
        self.reports.append((form, json.loads((self.folder / name / "report.json").read_text())))

    def find_modes(self):
        (self.folder / "modes.toml").write_text('units = "mm"\n[material.steel]\n')
        self.run("solve", "out", "--case", "modes.toml", "--modes", "2", "-o", "modes", "-q")
        self.keep("solution", "modes")

    def missed(self, place):
        """A field that none of these runs can have."""
        of_solution = re.match(r"#/\$defs/(solution|solve|case|place)/", place)
        return (of_solution or "/modes" in place) and not self.solves


def wrong_reports(schema, runs):
    tried = set()
    for form, report in runs.reports:
        yield from wrong_report(schema, form, report, tried)
        yield from schema.errors(report)  # and to no other form
    if len(tried) < 150:
        yield f"only {len(tried)} fields are required"
    for place in schema.properties():
        if place not in schema.seen and not runs.missed(place):
            yield f"no run has the field {place}"


def main():
    source, kerf = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
    output = (source / "docs/output.md").read_text()
    schema = Schema(json.loads((source / "docs/report.schema.json").read_text()))
    wrong = list(wrong_codes(kerf, output))
    with tempfile.TemporaryDirectory(prefix="kerf_promises_test_") as name:
        folder = pathlib.Path(name)
        runs = Runs(kerf, source, folder)
        wrong += wrong_reports(schema, runs)
        wrong += [f"a run has no {path}" for path, _, _ in rows(output, "| path |")
                  if not (folder / "out" / path).exists()]
        part = arrays(folder / "out/parts/part_0004.vtu")
        wrong += wrong_arrays(output, part, arrays(folder / "solution/parts/part_0004.vtu") if runs.solves else None)
        written = {array for _, array in part} | {array for _, array in arrays(folder / "regions/parts/part_0003.vtu")}
        wrong += [f"docs/output.md does not name the array {array}" for array in
                  sorted(written - {"Points", "connectivity", "offsets", "types"}) if f"`{array}`" not in output]
    if wrong:
        sys.exit("\n".join(wrong))
    print(f"every promise is kept by {len(runs.reports)} reports")


main()
