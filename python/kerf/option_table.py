"""The table of options of the command line, and texts of the command line in the words of Python."""

from __future__ import annotations

import functools
import keyword
import re
from dataclasses import dataclass

from . import _kerf


@dataclass(frozen=True)
class Option:
    """An option of `kerf mesh`.

    name          as a keyword argument: max_volume for --max-volume
    flag          on the command line: "--max-volume"
    group         under which the help lists it: "Input", "Cuts", "Sizes", "Meshing", "Output", "Running", "Expert"
    kind          "flag", "whole number", "number", "length" (with % of the diagonal, too), "memory" (as "2G"),
                  "count" (as "50k"), "text", "choice" or "list"
    form          of a value, as "NAME=H"; empty for flags and choices
    help          one sentence, in the words of the command line
    default       its value, as text, where it is not given; empty: none
    choices       of a choice
    is_of_surface whether it belongs to kerf.Surface() and kerf.read(), and not to the mesh
    """

    name: str
    flag: str
    group: str
    kind: str
    form: str
    help: str
    default: str
    choices: tuple[str, ...]
    is_of_surface: bool


def options() -> list[Option]:
    """All options of `kerf mesh`, in the order of its table. kerf.mesh() takes them as keyword arguments.

    A flag is True or False; a length is a number or a text such as "2%"; a list is a list, a tuple, a single value or,
    where its form has a =, a dict: size_region={"bone": 0.1}, region={"bone": (0, 1, 0)}, size_near={"top": (0.1, 2)}.
    Paths may be os.PathLike. None is as if the option was not given.
    """
    return list(table().values())


@functools.lru_cache(maxsize=None)
def table() -> dict[str, Option]:
    """By the names on the command line, without dashes."""
    table = {}
    for row in _kerf.option_rows():
        flag = row.pop("name")
        name = flag.replace("-", "_")
        table[flag] = Option(name=name + "_" if keyword.iskeyword(name) else name, flag="--" + flag,
                             choices=tuple(row.pop("choices")), **row)
    return table


#: What the kernel calls the arrays.
_ARRAYS = {"facets": "triangles", "vertices": "points", "patch": "patches"}


def in_python(text: str) -> str:
    """A text of the command line as Python has it: --max-volume is max_volume, --voids parity is voids="parity",
    -n 3 is parts=3. Of what is written, Python has the path."""
    text = re.sub(r"(?<!\S)-n\b(?: (\d+))?", lambda found: f"parts={found[1]}" if found[1] else "parts", text)
    text = text.replace("--output is ", "The path is ").replace("--output", "path")
    text = re.sub(r"--repair ([a-z]+(?:=[\w%]+)?(?:,[a-z]+(?:=[\w%]+)?)*)", r'repair="\1"', text)
    text = re.sub(r"--([a-z]+(?:-[a-z]+)*)(?: ([a-z]+(?:-[a-z]+)*|\d+))?", _name_in_python, text)
    return re.sub(r"\b(facets|vertices|patch)\[", lambda found: _ARRAYS[found[1]] + "[", text)


def _name_in_python(found: re.Match[str]) -> str:
    option, value = table().get(found[1]), found[2]
    if found[1] == "needle-angle":
        return found[0][2:].replace("-", "_", 1)
    if option is None:
        return found[0]
    if value in option.choices:
        return f'{option.name}="{value}"'
    if value and value.isdigit():
        return f"{option.name}={value}"
    return option.name + (f" {value}" if value else "")
