#!/usr/bin/env python3
"""Comments of headers begin with their subject, long sources open with their method, and names that docs/developing.md
has given up are used nowhere.

words_test.py ROOT; with --self-test in its place comments against each rule must be refused, and good ones must not.

A block that begins with one of BAD_BEGINNINGS can only be read with its neighbours: "Of those that ...".
"""

import pathlib
import re
import sys

FOLDERS = ("kernel", "solve", "cli", "help", "viewer", "python")
BAD_BEGINNINGS = re.compile(r"(What|Of|Where|Which|Whose|Those|The same|As|That|None|Such)\b")
COMMENT = re.compile(r"\s*///?<?\s*(.*)")
LONG = 100  # lines
LEAST_OPENING = 2  # lines of comment


def bad_beginnings(text):
    """(line, first words) of the comment blocks that begin against the rule."""
    in_block = False
    for number, line in enumerate(text.split("\n"), 1):
        found = COMMENT.match(line)
        if found and not in_block and BAD_BEGINNINGS.match(found[1]):
            yield number, " ".join(found[1].split()[:4])
        in_block = bool(found)


def opens_with_method(text):
    lines = text.split("\n")
    opening = next((number for number, line in enumerate(lines) if not line.startswith("//")), len(lines))
    return len(lines) <= LONG or opening >= LEAST_OPENING


def faults_of(file, text):
    if file.endswith(".h"):
        for line, words in bad_beginnings(text):
            yield f'{file}:{line}: "{words} ..." is no sentence that can be read alone: begin with its subject'
    elif not opens_with_method(text):
        yield f"{file}:1: a source above {LONG} lines opens with its method and notation in a few sentences"


def agreed_names(page):
    """(old, new) of the lines "old -> new" of the block `names`."""
    block = re.search(r"^```names\n(.*?)^```$", page, re.M | re.S)
    return [tuple(line.split(" -> ")) for line in block[1].splitlines()] if block else []


def faults_of_names(names, words_of_file):
    """An old name in a file, or a new one in none."""
    for old, new in names:
        for file, words in words_of_file.items():
            if old in words:
                yield f"{file}: {old} is called {new} (docs/developing.md)"
        if not any(new in words for words in words_of_file.values()):
            yield f"docs/developing.md: no source has the name {new}"


def faults_of_tree(root):
    files = sorted(path for folder in FOLDERS for path in (root / folder).rglob("*.*") if path.suffix in (".h", ".cpp"))
    if len(files) < 100:
        sys.exit(f"{root} has {len(files)} sources")
    texts = {str(path.relative_to(root)): path.read_text() for path in files}
    names = agreed_names((root / "docs/developing.md").read_text())
    if len(names) < 20:
        sys.exit(f"docs/developing.md agrees on {len(names)} names")
    words = {file: set(re.findall(r"\w+", text)) for file, text in texts.items()}
    return [fault for file, text in texts.items() for fault in faults_of(file, text)] + [*faults_of_names(names, words)]


def self_test():
    good = "/// Returns the facets of both sides.\n/// Those that touch count.\nint facets();  ///< of both sides\n"
    code = "int line;\n" * LONG
    cases = [("a.h", good, 0), ("a.h", "// As before.\n" + good, 1), ("a.cpp", code, 1), ("a.cpp", "// A.\n" + code, 1),
             ("a.cpp", "// The method is\n// this one.\n" + code, 0), ("a.cpp", "int line;\n", 0)]
    cases += [("a.h", f"int a;\n\n    /// {word} x is.\n", 1) for word in
              ("What", "Of", "Where", "Which", "Whose", "Those", "The same", "As", "That", "None", "Such")]
    cases += [("a.h", f"/// {word}\n", 0) for word in ("Whatever is left.", "Offsets of it.", "Assembles it.")]
    names = agreed_names("```names\nTuple -> Pair\n```\n")
    texts = ({"Pair"}, {"Tuple", "Pair"}, {"Tuples"})
    if [len([*faults_of_names(names, {"a.h": words})]) for words in texts] != [0, 1, 1]:
        sys.exit(f"names {names} are not looked up")
    sys.exit("\n".join(f"{len(list(faults_of(*case[:2])))} faults, not {case[2]}: {case[1][:60]}" for case in cases
                       if len(list(faults_of(*case[:2]))) != case[2]) or 0)


def main():
    if "--self-test" in sys.argv:
        self_test()
    sys.exit("\n".join(faults_of_tree(pathlib.Path(sys.argv[1]))) or 0)


main()
