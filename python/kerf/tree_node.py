"""Nodes of a tree of cuts: the plane, contour, interface and refused attempts of each cut."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Optional

import numpy as np

from . import _kerf

if TYPE_CHECKING:
    from .tree import Tree


class Plane(NamedTuple):
    """A plane; `normal` has the length 1 and points to the half above."""

    point: np.ndarray
    normal: np.ndarray


class Interface(NamedTuple):
    """Triangles between two halves, as their parts have them: counter-clockwise seen from the half above."""

    points: np.ndarray
    triangles: np.ndarray


class CutTry:
    """One attempt at a cut."""

    def __init__(self, native: _kerf.CutTry) -> None:
        self._native = native

    @property
    def plane(self) -> Plane:
        return Plane(self._native.point, self._native.normal)

    @property
    def method(self) -> str:
        """By which its contour was sought: "min-cut", "edges" or "straight"."""
        return self._native.method

    @property
    def refusal(self) -> str:
        """Why it was refused: "none" if it was accepted; "soft": valid, but an angle or gap is below its threshold;
        else "empty-side", "flow-limit", "pinched-contour", "crossing-projection", "nesting", "chord", "intersection",
        "not-manifold", "misplaced-shell" or "coincident-vertices"."""
        return self._native.refusal

    @property
    def axis(self) -> int:
        """Rank of the direction, 0 is tried first; of a straight cut the coordinate axis."""
        return self._native.axis

    @property
    def step(self) -> int:
        """Along the axis, 0 where the load is shared as wanted; of a straight cut the rank of the plane."""
        return self._native.step

    @property
    def repair(self) -> int:
        """Round of local repair on the same plane."""
        return self._native.repair

    @property
    def places(self) -> np.ndarray:
        """(n, 3) float64: where it failed."""
        return self._native.places

    @property
    def contour(self) -> np.ndarray:
        """(n, 2, 3) float64: ends of the edges of its contour, the half below on their left."""
        return self._native.contour

    def __repr__(self) -> str:
        return f"<kerf.CutTry: {self.method}, refusal {self.refusal}>"


class TreeNode:
    """A node of the tree: a closed surface, and how it was divided. Lengths, areas and volumes are in units of the
    points, angles in degrees. Where no cut was made (`was_cut`), `plane`, `interface` and the measures of the cut are
    None, and `contour` is empty."""

    def __init__(self, tree: Tree, native: _kerf.TreeNode) -> None:
        self._tree = tree
        self._native = native
        self._cut = tree._native.cut(native.id)

    @property
    def id(self) -> int:
        """1 is the whole; the halves below and above the cut of i are 2 i and 2 i + 1."""
        return self._native.id

    @property
    def level(self) -> int:
        """0 of the whole."""
        return self.id.bit_length() - 1

    @property
    def parent(self) -> Optional[TreeNode]:
        """None of the whole."""
        return self._tree[self.id // 2] if self.id > 1 else None

    @property
    def children(self) -> list[TreeNode]:
        """Below and above the cut; none of a part."""
        return [self._tree[2 * self.id + side] for side in (0, 1)] if self._native.is_divided else []

    @property
    def is_part(self) -> bool:
        return not self._native.is_divided

    @property
    def was_cut(self) -> bool:
        """False of parts, and of nodes that hold several regions, which are divided without a cut."""
        return self._native.cut_made

    @property
    def regions(self) -> int:
        """How many are in it."""
        return self._native.regions

    @property
    def region(self) -> Optional[int]:
        """Row of Tree.region_names, 0 if there is one region; None if there are several in it."""
        return self._native.region if self.regions == 1 else None

    @property
    def points(self) -> int:
        """Number of points of its surface."""
        return self._native.vertices

    @property
    def triangles(self) -> int:
        """Number of triangles of its surface."""
        return self._native.facets

    @property
    def volume(self) -> float:
        return self._native.volume

    @property
    def area(self) -> float:
        return self._native.area

    @property
    def centroid(self) -> np.ndarray:
        """(3,) float64: of the points of the surface, each with the mass 1; 0 where several regions are in it."""
        return self._native.centroid

    @property
    def inertia(self) -> np.ndarray:
        """(3, 3) float64: of the same points about their centroid, by which planes are chosen."""
        return self._native.inertia

    @property
    def principal_moments(self) -> np.ndarray:
        """(3,) float64: eigenvalues of `inertia`, ascending: the first axis is the long direction."""
        return self._native.principal_moments

    @property
    def principal_axes(self) -> np.ndarray:
        """(3, 3) float64: their unit vectors as columns."""
        return self._native.principal_axes

    @property
    def plane(self) -> Optional[Plane]:
        """Of the cut."""
        return Plane(self._native.point, self._native.normal) if self.was_cut else None

    @property
    def contour(self) -> list[np.ndarray]:
        """Closed loops on the surface along which it was cut, (n, 3) float64 each: the half below is on the left."""
        return self._cut.contour if self._cut else []

    @property
    def interface(self) -> Optional[Interface]:
        """The triangulated cap. Cost: that of all triangles of the parts below."""
        return self._tree._interface_of(self.id) if self.was_cut else None

    @property
    def stages(self) -> dict[str, np.ndarray]:
        """The contour at each stage of its making: crossed_edges, hanging_edges_removed, closed_loops,
        multiple_paths_removed and smoothed, as (n, 2, 3) float64: ends of edges. Empty of straight cuts."""
        return self._cut.stages if self._cut and self.was_cut and self.method != "straight" else {}

    @property
    def tries(self) -> list[CutTry]:
        """All attempts, the accepted one last: what the others were refused for says why a cut is soft or straight."""
        return [CutTry(each) for each in self._cut.tries] if self._cut else []

    @property
    def method(self) -> Optional[str]:
        """How the contour was found: "min-cut": minimum cut of the facet graph in a band around the plane, "edges":
        majority of the corners, "straight": facets were split at a coordinate plane."""
        return self._native.method if self.was_cut else None

    @property
    def strategy(self) -> Optional[str]:
        """By which the cut was accepted: "first-try", "local-repair", "plane-step", "other-axis", "soft", "straight";
        "whole": none was, so that a part stayed whole; None if none was tried."""
        return self._native.strategy if self._cut else None

    @property
    def load_fraction(self) -> Optional[float]:
        """Share of the predicted work below the first plane."""
        return self._native.load_fraction if self.was_cut else None

    @property
    def axis(self) -> Optional[int]:
        """Rank of the direction of the first plane in the order of preference."""
        return self._native.axis if self.was_cut else None

    @property
    def section_gain(self) -> Optional[float]:
        """Share of the section's area that this place saves against halves across the first direction; estimate."""
        return self._native.section_gain if self.was_cut else None

    @property
    def section_area(self) -> Optional[float]:
        """Of the surface with the plane."""
        return self._native.section_area if self.was_cut else None

    @property
    def interface_area(self) -> Optional[float]:
        return self._native.interface_area if self.was_cut else None

    @property
    def contour_length(self) -> Optional[float]:
        return self._native.contour_length if self.was_cut else None

    @property
    def max_deviation(self) -> Optional[float]:
        """Largest distance of a point of the contour from the plane."""
        return self._native.max_deviation if self.was_cut else None

    @property
    def min_angle(self) -> Optional[float]:
        """Smallest angle of a triangle of the interface."""
        return self._native.min_angle_deg if self.was_cut else None

    @property
    def min_dihedral(self) -> Optional[float]:
        """Smallest angle between interface and surface along the contour."""
        return self._native.min_dihedral_deg if self.was_cut else None

    @property
    def min_gap(self) -> Optional[float]:
        """Smallest distance between interface and surface off the contour, beside the edges there."""
        return self._native.min_gap_rel if self.was_cut else None

    @property
    def seconds(self) -> Optional[float]:
        """Wall clock of the cut: the only number here that differs between runs."""
        return self._native.seconds if self.was_cut else None

    def __repr__(self) -> str:
        kind = "part" if self.is_part else f"{self.strategy} cut" if self.was_cut else f"{self.regions} regions"
        return f"<kerf.TreeNode {self.id}: {kind}, {self.triangles} triangles>"
