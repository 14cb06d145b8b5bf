"""What the package promises to editors, type checkers and help()."""

import ast
import importlib.util
import inspect
import re
import subprocess
import sys
from pathlib import Path

import pytest

import kerf
from kerf import _kerf, programs

PACKAGE = Path(kerf.__file__).parent
SOURCES = Path(__file__).resolve().parents[2]


def public_members(of):
    """Functions, methods and properties that it, or a class of Kerf that it inherits, defines, by name."""
    classes = [each for each in reversed(of.__mro__) if each.__module__.startswith("kerf.")]
    members = {name: member for each in classes for name, member in vars(each).items() if not name.startswith("_")}
    return {name: getattr(member, "__func__", member) for name, member in members.items()}


def public_things():
    for name in kerf.__all__:
        thing = getattr(kerf, name)
        if inspect.isclass(thing) or inspect.isfunction(thing):
            yield f"kerf.{name}", thing
        if inspect.isclass(thing) and not hasattr(thing, "_fields"):
            for member, value in public_members(thing).items():
                yield f"kerf.{name}.{member}", value


def unannotated(function):
    signature = inspect.signature(function)
    missing = [name for name, parameter in signature.parameters.items()
               if parameter.annotation is parameter.empty and name not in ("self", "cls")]
    return missing + (["return"] if signature.return_annotation is signature.empty else [])


def test_everything_public_has_its_documentation():
    assert [name for name, thing in public_things()
            if (callable(thing) or isinstance(thing, property)) and not inspect.getdoc(thing)] == []


def test_everything_public_has_its_types():
    functions = {name: thing.fget if isinstance(thing, property) else thing for name, thing in public_things()}
    for name, thing in list(functions.items()):
        if inspect.isclass(thing):
            functions[f"{name}()"] = vars(thing).get("__init__")
    assert {name: unannotated(thing) for name, thing in functions.items()
            if inspect.isfunction(thing) and unannotated(thing)} == {}


def test_the_kernel_finds_the_programs_by_itself():
    assert Path(_kerf.find_program("kerf-worker")).samefile(programs.path("kerf-worker"))


@pytest.mark.parametrize("of", [each for each in vars(_kerf).values()
                                if inspect.isclass(each) and each is not _kerf.Communicator])
def test_an_object_without_a_value_says_so(of):
    """A traceback may show one: where __init__ has failed."""
    empty = of.__new__(of)
    calls = [member.fget for member in vars(of).values() if isinstance(member, property)]
    for call in calls + [each for each in (vars(of).get("__repr__"), vars(of).get("__getstate__")) if each]:
        with pytest.raises((TypeError, RuntimeError), match="no value|non-held"):
            call(empty)


def members_of_stub(body):
    """Names, and of each its parameters, or None, or the same of a class. Those before a `/` have no name in C++."""
    members = {}
    for node in body:
        if isinstance(node, ast.ClassDef):
            members[node.name] = members_of_stub(node.body)
        elif isinstance(node, ast.FunctionDef):
            is_property = any(getattr(each, "id", "") == "property" for each in node.decorator_list)
            unnamed = [each for each in node.args.posonlyargs if each.arg != "self"]
            named = [each.arg for each in node.args.args + node.args.kwonlyargs if each.arg != "self"]
            members[node.name] = None if is_property else [f"arg{i}" for i in range(len(unnamed))] + named
        elif isinstance(node, ast.AnnAssign):
            members[node.target.id] = None
    return members


def parameters_of_native(function):
    """As pybind11 writes them into the first line: f(self: kerf._kerf.X, a: int = 0, **kwargs) -> None."""
    inside = function.__doc__.splitlines()[0].rsplit(" -> ", 1)[0].partition("(")[2]
    return [name for name in re.findall(r"(?:^|, )(\w+)(?=: |,|\)|$)", inside) if name != "self"]


def members_of_native(of):
    members = {}
    for name, member in vars(of).items():
        if name.startswith(("__", "_pybind11")) and name not in ("__version__", "__init__") or inspect.ismodule(member):
            continue
        if inspect.isclass(member):
            members[name] = members_of_native(member)
        elif isinstance(member, (property, str, int)):
            members[name] = None
        else:
            members[name] = parameters_of_native(member)
    if inspect.isclass(of) and not of.__init__.__doc__.startswith("__init__("):
        members.pop("__init__", None)  # what every class has
    return members


def test_the_stub_lists_what_the_module_has():
    stub = members_of_stub(ast.parse((PACKAGE / "_kerf.pyi").read_text()).body)
    stub = {name: members for name, members in stub.items() if not name.startswith("_") or name == "__version__"}
    native = members_of_native(_kerf)
    assert sorted(stub) == sorted(native)
    for name, members in native.items():
        assert stub[name] == members, name


def test_types_are_right(tmp_path):
    if importlib.util.find_spec("mypy") is None:
        pytest.skip("mypy is not installed")
    checked = subprocess.run([sys.executable, "-m", "mypy", "--config-file", SOURCES / "pyproject.toml", "--cache-dir",
                              tmp_path, "-p", "kerf"], cwd=PACKAGE.parent, capture_output=True, text=True)
    assert checked.returncode == 0, checked.stdout + checked.stderr
