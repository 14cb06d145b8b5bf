"""What solve() has found on the parts of a run."""

from __future__ import annotations

import json
import os
from tempfile import TemporaryDirectory
from typing import Any, Callable, Iterator, NamedTuple, Optional

import numpy as np

from . import _kerf
from .errors import FileError, UsageError
from .notebook import html_of
from .paths import Path


class Extreme(NamedTuple):
    """The largest value, or the least, and the point where it is."""

    value: float
    at: np.ndarray


class Fields:
    """Arrays of a load case, in the units of the case: at points averages over the cells around, of one material."""

    def __init__(self, values: Callable[[str, bool], np.ndarray]) -> None:
        self._values = values

    @property
    def displacement(self) -> np.ndarray:
        """(n, 3) float64, at points."""
        return self._values("Displacement", True)

    @property
    def stress(self) -> np.ndarray:
        """(n, 6) float32, at points: XX, YY, ZZ, XY, YZ, XZ."""
        return self._values("Stress", True)

    @property
    def von_mises(self) -> np.ndarray:
        """(n,) float32, at points."""
        return self._values("VonMises", True)

    @property
    def cell_stress(self) -> np.ndarray:
        """(m, 6) float32, of tetrahedra."""
        return self._values("Stress", False)

    @property
    def cell_von_mises(self) -> np.ndarray:
        """(m,) float32, of tetrahedra."""
        return self._values("VonMises", False)

    @property
    def error_indicator(self) -> np.ndarray:
        """(m,) float32: estimate of the error of each tetrahedron in the energy norm."""
        return self._values("ErrorIndicator", False)


class SolvedPart(Fields):
    """A part of the mesh and what was found there for a load case."""

    def __init__(self, native: _kerf.Part, suffix: str) -> None:
        super().__init__(lambda name, of_points: _array(native, name + suffix, of_points))
        self._native = native
        self._suffix = suffix

    def __reduce__(self) -> tuple[Any, ...]:
        return SolvedPart, (self._native, self._suffix)

    @property
    def number(self) -> int:
        """In the tree of cuts."""
        return self._native.number

    @property
    def points(self) -> np.ndarray:
        """(n, 3) float64."""
        return self._native.points

    @property
    def tetrahedra(self) -> np.ndarray:
        """(m, 4) int32: rows of `points`."""
        return self._native.tetrahedra

    @property
    def global_ids(self) -> np.ndarray:
        """(n,) int64: numbers of the points in the whole mesh."""
        return self._native.global_ids

    def __repr__(self) -> str:
        return f"<kerf.SolvedPart {self.number}: {len(self.points)} points, {len(self.tetrahedra)} tetrahedra>"


class LoadCase(Fields):
    """A load case: arrays over the points and tetrahedra of the whole mesh (Solution.points), and what sums they have.
    At a wall of two materials stresses at points are those of the first part there; parts have their own."""

    def __init__(self, solution: Solution, report: dict[str, Any], suffix: str) -> None:
        super().__init__(lambda name, of_points: solution._whole(name + suffix, of_points))
        self._solution = solution
        self._suffix = suffix
        self.report = report

    def __reduce__(self) -> tuple[Any, ...]:
        return LoadCase, (self._solution, self.report, self._suffix)

    @property
    def name(self) -> str:
        """Empty if it is the only one."""
        return str(self.report["name"])

    @property
    def energy(self) -> float:
        """Of the strain: half of the integral of stress times strain."""
        return float(self.report["energy_norm"]) ** 2 / 2

    @property
    def relative_error(self) -> float:
        """Estimated error in the energy norm beside the norm of the solution."""
        return float(self.report["relative_error"])

    @property
    def load(self) -> np.ndarray:
        """(3,) float64: sum of all loads."""
        return np.array(self.report["load"])

    @property
    def reactions(self) -> dict[str, np.ndarray]:
        """What each support does to the body, by its name: internal forces less loads at what it holds, (3,) float64.
        Supports of the same name are added up."""
        result: dict[str, np.ndarray] = {}
        for each in self.report["reactions"]:
            result[each["support"]] = result.get(each["support"], 0) + np.array(each["reaction"])
        return result

    @property
    def moments(self) -> dict[str, np.ndarray]:
        """Moments of the reactions about the centres of their supports, where reactions are of one support alone:
        (3,) float64."""
        names = [each["support"] for each in self.report["reactions"]]
        return {each["support"]: np.array(each["moment"]) for each in self.report["reactions"]
                if names.count(each["support"]) == 1}

    @property
    def safety_factor(self) -> Optional[Extreme]:
        """The least of yield stress / von Mises stress, where a material has a yield, else None."""
        least = self.report.get("least_safety_factor")
        return None if least is None else _extreme(least)

    @property
    def imbalance(self) -> float:
        """Of loads and reactions, beside the load."""
        return float(self.report["imbalance"])

    @property
    def iterations(self) -> int:
        return int(self.report["iterations"])

    @property
    def residual(self) -> float:
        """True, beside that of the start."""
        return float(self.report["residual"])

    @property
    def max_displacement(self) -> Extreme:
        return _extreme(self.report["max_displacement"])

    @property
    def max_von_mises(self) -> Extreme:
        return _extreme(self.report["max_von_mises"])

    def part(self, number: int) -> SolvedPart:
        """What was found on a part, read from its file: for meshes that are larger than the memory. Raises KeyError for
        a number that no part has, naming those that there are."""
        return self._solution._load(self._solution._row_of(number), self._suffix)

    def __repr__(self) -> str:
        return f"<kerf.LoadCase {self.name!r}: max von Mises {self.max_von_mises.value:.4g}>"


class Solution:
    """A folder of solve(), opened. Files are read when arrays are asked for; those of the whole mesh are kept.

    folder     that solve() or `kerf solve` has written; the run that it stands on must be where it was

    Arrays and sums are those of the first load case: `cases` has all. Raises FileError for what is no solution.
    """

    def __init__(self, folder: Path, _owner: Optional[TemporaryDirectory] = None) -> None:
        self._owner = _owner
        self._arrays: dict[object, np.ndarray] = {}
        self._run = _kerf.Run(os.fspath(folder))
        found = self._run._solution
        if not found:
            raise FileError(f"{os.fspath(folder)} is no folder of kerf solve, but a run without a solution. Give the "
                            "folder that solve() has written.")
        #: of the solution
        self.folder = found
        #: of the run that it stands on
        self.mesh_folder = self._run.mesh_folder
        with open(os.path.join(found, "report.json"), encoding="utf-8") as file:
            #: report.json, as docs/output.md has it
            self.report: dict[str, Any] = json.load(file)

    def __reduce__(self) -> tuple[Any, ...]:
        if self._owner is not None:
            raise UsageError("This solution is in a temporary folder, which goes when it does. Give solve() an output, "
                             "or pickle its arrays.")
        return Solution, (os.path.abspath(self.folder),)

    def __deepcopy__(self, memo: dict[int, Any]) -> Solution:
        return self  # nothing changes it

    @property
    def cases(self) -> list[LoadCase]:
        """All of them, in the order of the case file."""
        reports = self.report["solve"]["cases"]
        return [LoadCase(self, each, f" {each['name']}" if len(reports) > 1 else "") for each in reports]

    def case(self, name: str) -> LoadCase:
        """A load case by its name. Raises KeyError, naming those that there are."""
        for each in self.cases:
            if each.name == name:
                return each
        raise KeyError(f"There is no load case {name!r}, but {', '.join(repr(each.name) for each in self.cases)}.")

    @property
    def part_numbers(self) -> list[int]:
        """Of the parts in the tree of cuts, in their order."""
        return [int(number) for number in self._run._numbers]

    @property
    def points(self) -> np.ndarray:
        """(n, 3) float64, of the whole mesh."""
        return self._kept("points", self._gather_points)

    @property
    def tetrahedra(self) -> np.ndarray:
        """(m, 4) int64: rows of `points`."""
        return self._kept("tetrahedra", lambda: np.concatenate(
            [part.global_ids[part.tetrahedra] for part in self._each_part()]))

    @property
    def displacement(self) -> np.ndarray:
        """(n, 3) float64, at points."""
        return self.cases[0].displacement

    @property
    def stress(self) -> np.ndarray:
        """(n, 6) float32, at points: XX, YY, ZZ, XY, YZ, XZ."""
        return self.cases[0].stress

    @property
    def von_mises(self) -> np.ndarray:
        """(n,) float32, at points."""
        return self.cases[0].von_mises

    @property
    def energy(self) -> float:
        """Of the strain."""
        return self.cases[0].energy

    @property
    def reactions(self) -> dict[str, np.ndarray]:
        """What each support does to the body, by its name."""
        return self.cases[0].reactions

    def part(self, number: int) -> SolvedPart:
        """What was found on a part, read from its file."""
        return self.cases[0].part(number)

    def _row_of(self, number: int) -> int:
        if number not in self.part_numbers:
            raise KeyError(f"There is no part {number}; the numbers are {', '.join(map(str, self.part_numbers))}.")
        return self.part_numbers.index(number)

    def _load(self, index: int, suffix: str) -> SolvedPart:
        return SolvedPart(self._run._load(index), suffix)

    def _each_part(self) -> Iterator[SolvedPart]:
        return (self._load(i, "") for i in range(len(self.part_numbers)))

    def _kept(self, key: object, make: Callable[[], np.ndarray]) -> np.ndarray:
        if key not in self._arrays:
            self._arrays[key] = make()
            self._arrays[key].flags.writeable = False
        return self._arrays[key]

    def _whole(self, name: str, of_points: bool) -> np.ndarray:
        def values_of(part: SolvedPart) -> np.ndarray:
            return _array(part._native, name, of_points)

        return self._kept((name, of_points), lambda: self._at_points(values_of) if of_points else np.concatenate(
            [values_of(part) for part in self._each_part()]))

    def _gather_points(self) -> np.ndarray:
        return self._at_points(lambda part: part.points)

    def _at_points(self, values_of: Callable[[SolvedPart], np.ndarray]) -> np.ndarray:
        last = len(self.part_numbers) - 1
        whole = np.empty(0)
        for index in range(last, -1, -1):  # the first part has the last word
            part = self._load(index, "")
            values = values_of(part)
            if index == last:
                whole = np.empty((self._run.points_count, *values.shape[1:]), values.dtype)
            whole[part.global_ids] = values
        return whole

    def __repr__(self) -> str:
        return f"<kerf.Solution: {self._run.points_count} points, {len(self.part_numbers)} parts, {self.folder}>"

    def _repr_html_(self) -> str:
        totals, first = self.report["totals"], self.cases[0]
        rows = {"points": totals["vertices"], "tetrahedra": totals["tets"], "parts": totals["parts"],
                "load cases": len(self.cases), "max displacement": first.max_displacement.value,
                "max von Mises": first.max_von_mises.value, "energy": first.energy}
        return html_of(self.folder, "kerf.Solution", rows, totals["tets"], color="von-mises")


def _extreme(report: dict[str, Any]) -> Extreme:
    return Extreme(report["value"], np.array(report["at"]))


def _array(part: _kerf.Part, name: str, of_points: bool) -> np.ndarray:
    arrays = part.point_data if of_points else part.cell_data
    if name not in arrays:
        raise FileError(f"The files of the solution have no array {name}. Solve again.")
    return arrays[name]
