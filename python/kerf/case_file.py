"""Cases of solve() as the TOML that kerf-solve reads."""

from __future__ import annotations

import json
import math
from typing import Mapping

from .errors import UsageError


def case_text(case: Mapping[str, object]) -> str:
    """A line for each key of the case; what is below is written inside of it."""
    return "".join(f"{_key(key)} = {_value(value, str(key))}\n" for key, value in case.items())


def _key(key: object) -> str:
    return json.dumps(str(key))


def _value(value: object, where: str) -> str:
    if hasattr(value, "tolist"):  # of numpy
        value = value.tolist()
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_key(k)} = {_value(v, f'{where}.{k}')}" for k, v in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_value(each, f"{where}[{i}]") for i, each in enumerate(value)) + "]"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int) or isinstance(value, float) and math.isfinite(value):
        return repr(value)
    if isinstance(value, str):
        return json.dumps(value)
    raise UsageError(f"{where} of the case is {value!r}, but must be a finite number, text, True or False, "
                     "or a list or dict of these.")
