"""What a verification has found."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Mapping

_other_fields = ("path", "passed", "compared_with_input", "parts", "tets", "vertices", "nodes", "curved_nodes",
                 "volume_rel_error", "volume_rel_bound", "differences", "not_compared")


@dataclass(frozen=True)
class Verification:
    """What `kerf verify` says of a folder. True if `passed`."""

    passed: bool
    """Every law that could be checked holds."""
    compared_with_surface: bool
    """The surface that was meshed was there, and its facets were found one by one."""
    parts: int
    tetrahedra: int
    points: int
    volume_error: float
    """Of the sum of the parts against the volume of the surface, relative."""
    volume_bound: float
    """What rounding explains of that."""
    broken: Mapping[str, int]
    """How often each law does not hold: input_faces_missing, inverted_tets, ..., 0 where it does."""
    differences: list[str]
    """What is not as the run has left it, or does not follow from the mesh."""
    not_compared: str
    """Why the surface was not compared; empty: it was, or was not to be."""
    text: str
    """Lines for people."""

    @classmethod
    def _of(cls, json: Mapping[str, Any], text: str) -> Verification:
        return cls(json["passed"], json["compared_with_input"], json["parts"], json["tets"], json["vertices"],
                   json["volume_rel_error"], json["volume_rel_bound"],
                   {name: count for name, count in json.items() if name not in _other_fields}, json["differences"],
                   json["not_compared"], text)

    def __bool__(self) -> bool:
        return self.passed

    def __str__(self) -> str:
        return self.text
