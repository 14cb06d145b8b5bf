"""What was repaired of a surface, or wrapped."""

from __future__ import annotations

import json
from dataclasses import dataclass, field

import numpy as np


@dataclass(frozen=True, eq=False)
class Repair:
    """One thing that a step of a repair has done, or refused to do. str() of it is a line.

    step             "weld", "stitch", "holes", ...: docs/options.md has all
    what             what there was so often: "holes filled"
    count            how often
    done             False: it was left as it is
    refused_because  why it was left; empty if it was not
    points           (k, 3) float64: where, for the first thousand
    facets           of each of these places: (f,) int64 numbers of triangles or of faces of the file, from 0
    measure          what `values` are: "edges", "apart"; empty: nothing
    values           (k,) float64: of each place
    """

    step: str
    what: str
    count: int
    done: bool = True
    refused_because: str = ""
    points: np.ndarray = field(default_factory=lambda: np.empty((0, 3)))
    facets: list[np.ndarray] = field(default_factory=list)
    measure: str = ""
    values: np.ndarray = field(default_factory=lambda: np.empty(0))

    def __str__(self) -> str:
        return f"{self.step}: {self.count} {self.what}" + (f"; left: {self.refused_because}" if not self.done else "")


@dataclass(frozen=True)
class Wrapping:
    """What a wrap is, and how far from what it was put around. Lengths are in units of the points.

    gap                          openings narrower than this are closed
    offset                       sheets became walls of up to twice this thickness
    facets_before                of what was wrapped
    facets_left_out              of these, because they have no area or no finite coordinates
    facets_visible               of these, that nothing covers on at least one of their sides
    facets                       of the wrap
    distance_to_input            nothing of the wrap is farther from what was wrapped; proven
    distance_from_visible_input  nothing of the visible facets is farther from the wrap; proven
    """

    gap: float
    offset: float
    facets_before: int
    facets_left_out: int
    facets_visible: int
    facets: int
    distance_to_input: float
    distance_from_visible_input: float


def repairs_of(text: str) -> list[Repair]:
    """Of the report of a ladder as JSON."""
    repairs = []
    for step in json.loads(text)["steps"]:
        for action in step["actions"]:
            places = action["places"]
            repairs.append(Repair(
                step["step"], action["what"], action["count"], action["done"], action.get("refused_because", ""),
                np.array([place["where"] for place in places], float).reshape(-1, 3),
                [np.array(place["facets"], np.int64) for place in places], action.get("measure", ""),
                np.array([place.get("value", 0) for place in places], float)))
    return repairs
