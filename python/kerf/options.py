"""The options of the command line as keyword arguments."""

from __future__ import annotations

import numbers
import os
import re
from collections.abc import Mapping
from typing import Any, Optional

import numpy as np

from . import _kerf
from .errors import UsageError
from .option_table import Option, table

#: Options of `kerf mesh` that a mesh in memory has no use for, and why.
NOT_IN_MEMORY = {
    "format": "says which files are written",
    "fields": "says what the files of parts hold",
    "patch_type": "is for a case of OpenFOAM",
    "split_regions": "is for a case of OpenFOAM",
    "stl": "writes files of the parts' surfaces",
    "reference": "writes a comparison of two meshes",
    "events": "writes what the program tells, as progress does here",
}


def find(name: str) -> Option:
    """The option with this keyword. Raises UsageError, with what it may have been meant to be, if there is none."""
    option = table().get(name.rstrip("_").replace("_", "-"))
    if option is None:
        raise UsageError(f"{name} is no option.{_meant(name)} kerf.options() lists them all.")
    return option


#: What other meshers call options of Kerf.
_SYNONYMS = {"n": "parts", "n_parts": "parts", "num_parts": "parts", "nparts": "parts", "h": "size", "maxh": "size",
             "max_size": "size", "mesh_size": "size", "edge_length": "size", "target_size": "size",
             "n_workers": "workers", "threads": "workers", "n_threads": "workers", "jobs": "workers",
             "n_jobs": "workers"}


def _meant(name: str) -> str:
    if name in ("seed", "random_seed", "random_state"):
        return " Nothing is random: the same call makes the same mesh."
    if name in _SYNONYMS:
        return f" Did you mean {_SYNONYMS[name]}?"
    return _kerf.did_you_mean(name, [each.name for each in table().values()])


def require_of_surface(given: Mapping[str, Any]) -> None:
    """Raises UsageError for options that a surface has no use for."""
    for name, value in given.items():
        is_wrap = find(name).name == "surface" and value == "wrap"
        if not find(name).is_of_surface and not is_wrap:
            raise UsageError(f"{name} is no option of a surface: give it to kerf.mesh().")


def split(given: Mapping[str, Any]) -> tuple[dict[str, Any], dict[str, Any]]:
    """Those of the surface, and the others."""
    of_surface = {name: value for name, value in given.items() if find(name).is_of_surface}
    return of_surface, {name: value for name, value in given.items() if name not in of_surface}


def refuse_in_memory(given: Mapping[str, Any]) -> None:
    """Raises UsageError for options of NOT_IN_MEMORY."""
    for name, value in given.items():
        reason = NOT_IN_MEMORY.get(find(name).name)
        if reason and value is not None and value is not False:
            raise UsageError(f"{name} {reason}: leave it out for a mesh in memory.")


def texts(given: Mapping[str, Any]) -> list[tuple[str, bytes]]:
    """Names and values as the command line has them; what is None is left out."""
    result = []
    for name, value in given.items():
        option = find(name)
        text = _text(option, value)
        if text is not None:
            if "\0" in text:
                raise UsageError(f"{option.name} has a character NUL in it.")
            result.append((option.flag[2:], os.fsencode(text)))
    return result


def _text(option: Option, value: Any) -> Optional[str]:
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if value is None:
        return None
    if isinstance(value, Mapping):
        if option.kind != "list" or "=" not in option.form:
            raise UsageError(f"{option.name} takes no dict.")
        value = [f"{_word(option, key)}={_joined(option, each)}" for key, each in value.items()]
    is_several = isinstance(value, (list, tuple))
    if option.kind == "list":
        items = [_item(option, each) for each in (value if is_several else [value])]
        return ";".join(re.sub(r"([;\\])", r"\\\1", item) for item in items)
    if not is_several:
        return _word(option, value)
    if option.form != "LIST":
        raise UsageError(f"{option.name} takes one value, but {short(value)} has several.")
    return ",".join(_word(option, each) for each in value)


def _item(option: Option, value: Any) -> str:
    """A value of a list, which may be a pair of what stands before the = and behind it."""
    if isinstance(value, tuple) and len(value) == 2 and "=" in option.form:
        return f"{_word(option, value[0])}={_joined(option, value[1])}"
    return _word(option, value)


def _joined(option: Option, value: Any) -> str:
    """What follows the = of a form such as NAME=H:D or NAME=x,y,z."""
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if not isinstance(value, (list, tuple)):
        return _word(option, value)
    return (":" if ":" in option.form.rpartition("=")[2] else ",").join(_word(option, each) for each in value)


def _word(option: Option, value: Any) -> str:
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, str):
        return value
    if isinstance(value, os.PathLike):
        return os.fsdecode(value)
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real) or type(value).__name__ == "Decimal":
        number = float(value)
        return str(int(number)) if number.is_integer() and abs(number) < 2**53 else repr(number)
    wanted = f"a {option.kind}" if option.kind != "list" else "a list of " + option.form
    if "=" in option.form:
        before, _, behind = option.form.partition("=")
        wanted += f", or a dict {{{before}: {behind}}}"
    raise UsageError(f"{option.name} is {short(value)}, but it must be {wanted}.")


def short(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "..."
