"""How good the cells of a mesh are."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Mapping, Optional

import numpy as np


@dataclass(frozen=True)
class Distribution:
    """The values that cells have of one measure. Percentiles between min and max are exact to a 1440th of its range.
    A value that is infinite is math.inf; of no cells all are 0."""

    min: float
    p0_1: float
    p1: float
    p5: float
    median: float
    p95: float
    max: float
    edges: Optional[np.ndarray] = None
    """(37,) float64: of the bins; None for regions, which have no histograms."""
    counts: Optional[np.ndarray] = None
    """(36,) int64: cells in each bin; the first and the last one count what lies beyond, too."""

    @classmethod
    def _of(cls, json: Mapping[str, Any]) -> Distribution:
        values = {name: math.inf if value is None else value for name, value in json.items() if name != "histogram"}
        histogram = json.get("histogram")
        if histogram:
            values.update(edges=np.array(histogram["edges"], float), counts=np.array(histogram["counts"], np.int64))
        return cls(**values)


Measures = Mapping[str, Distribution]


def _measures(json: Mapping[str, Any]) -> Measures:
    return {name: Distribution._of(values) for name, values in json.items()}


@dataclass(frozen=True)
class RegionQuality:
    """The cells of one of several regions."""

    name: str
    cells: int
    volume: float
    measures: Measures


class Quality:
    """How good the cells of a mesh are, as `kerf quality --json` has it.

    Measures are min_dihedral_deg, max_dihedral_deg (degrees), radius_edge, aspect, shape (1: regular), volume,
    min_edge and max_edge (in units of the mesh): quality.measures["min_dihedral_deg"].p1
    """

    def __init__(self, json: Mapping[str, Any], text: str = "") -> None:
        """`json`: the object of `kerf quality --json`; `text`: its tables."""
        self.json = json
        self.text = text

    @property
    def points(self) -> int:
        """How many there are."""
        return self.json["vertices"]

    @property
    def cells(self) -> int:
        """Tetrahedra."""
        return self.json["tets"]

    @property
    def turned(self) -> int:
        """Tetrahedra of a file that had negative orientation there, and were measured the other way round."""
        return self.json["turned_tets"]

    @property
    def notes(self) -> list[str]:
        """What a file held besides."""
        return self.json["notes"]

    @property
    def measures(self) -> Measures:
        """Of all cells, by the name of the measure."""
        return _measures(self.json["quality"]["all"])

    @property
    def interface(self) -> Measures:
        """Of the cells with a point on an interface between parts."""
        return _measures(self.json["quality"]["interface"])

    @property
    def interior(self) -> Measures:
        """Of the other cells."""
        return _measures(self.json["quality"]["interior"])

    @property
    def boundary(self) -> Measures:
        """Of the triangles on the surface: their angles in degrees."""
        return _measures(self.json["boundary"])

    @property
    def forced_cells(self) -> int:
        """Cells with a small angle that the surface itself has."""
        return self.json["forced"]["tets"]

    @property
    def regions(self) -> list[RegionQuality]:
        """In the order of their numbers; empty if there is one region."""
        return [RegionQuality(each["name"], each["tets"], each["volume"], _measures(each["quality"]))
                for each in self.json.get("regions", [])]

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        angle = self.measures["min_dihedral_deg"]
        return f"<kerf.Quality: {self.cells} cells, smallest angle {angle.min:.3g} deg, median {angle.median:.3g} deg>"
