"""The modules of the package import each other in one direction."""

import ast
from pathlib import Path

import kerf


def imported(name, source, modules):
    """The modules of the package that one imports anywhere: for type checkers alone, and inside of functions, too."""
    found = set()
    for node in ast.walk(ast.parse(source)):
        names = []
        if isinstance(node, ast.ImportFrom) and node.level == 1:
            names = [node.module] if node.module else [each.name for each in node.names]
        elif isinstance(node, ast.ImportFrom) and node.level == 0 and node.module.split(".")[0] == "kerf":
            names = node.module.split(".")[1:] or [each.name for each in node.names]
        elif isinstance(node, ast.Import):
            names = [each.name.split(".")[1] for each in node.names if each.name.startswith("kerf.")]
        found.update(each.split(".")[0] for each in names)
    return (found & modules) - {name}


def circle_of(imports):
    """Modules each of which imports the next, and the last the first; empty: there are none."""
    left = {name: set(others) for name, others in imports.items()}
    while ends := [name for name, others in left.items() if not others & left.keys()]:
        for name in ends:
            del left[name]
    path = sorted(left)[:1]
    while path and path.count(path[-1]) == 1:
        path.append(min(left[path[-1]] & left.keys()))
    return path[path.index(path[-1]):] if path else []


def test_a_circle_is_found():
    assert circle_of({"a": {"b"}, "b": {"c"}, "c": set()}) == []
    assert circle_of({"a": {"b"}, "b": {"c"}, "c": {"d"}, "d": {"b"}, "e": {"a"}}) == ["b", "c", "d", "b"]
    modules = {"a", "b", "c", "d", "e"}
    source = ("import os\nfrom . import a, os\ndef f():\n    from .b import x\n"
              "if x:\n    import kerf.c\n    from kerf import d\n")
    assert imported("e", source, modules) == {"a", "b", "c", "d"}


def test_modules_import_each_other_without_a_circle():
    sources = {path.stem: path.read_text() for path in Path(kerf.__file__).parent.glob("*.py")}
    assert len(sources) > 20
    assert circle_of({name: imported(name, source, set(sources)) for name, source in sources.items()}) == []
