"""How a surface was cut into parts."""

from __future__ import annotations

from typing import Iterator, NamedTuple, Optional, Union

import numpy as np

from . import _kerf, programs
from .paths import Path
from .progress import Progress, caller
from .sizes import Size, split_size
from .surface import Surface, surface_and_options


class Interface(NamedTuple):
    """Triangles between two halves, as their parts have them: counter-clockwise seen from the half above."""

    points: np.ndarray
    triangles: np.ndarray


class TreeNode(_kerf.TreeNode):
    """A node of the tree: a closed surface, and how it was divided. Lengths, areas and volumes are in units of the
    points, angles in degrees. Where no cut was made (`was_cut`), `plane`, `interface` and the measures of the cut are
    None, and `contour` is empty."""

    def __init__(self, tree: Tree, native: _kerf.TreeNode) -> None:
        """Of one that decompose() has made."""
        super().__init__(native)
        self._tree = tree

    @property
    def parent(self) -> Optional[TreeNode]:
        """None of the whole."""
        return self._tree[self.id // 2] if self.id > 1 else None

    @property
    def children(self) -> list[TreeNode]:
        """Below and above the cut; none of a part."""
        return [] if self.is_part else [self._tree[2 * self.id + side] for side in (0, 1)]

    @property
    def interface(self) -> Optional[Interface]:
        """The triangulated cap. Cost: that of all triangles of the parts below."""
        return self._tree._interface_of(self.id) if self.was_cut else None

    def __repr__(self) -> str:
        kind = "part" if self.is_part else f"{self.strategy} cut" if self.was_cut else f"{self.regions} regions"
        return f"<kerf.TreeNode {self.id}: {kind}, {self.triangles} triangles>"


class PartSurface(_kerf.PartSurface):
    """The closed surface of a part: what is left of the surface that was cut, and its sides of interfaces.

    Arrays are read-only views.
    """

    def __copy__(self) -> PartSurface:
        return PartSurface(self)

    @property
    def cuts(self) -> np.ndarray:
        """(m,) int64: the node of the tree whose cut made the triangle, 0: it is one of the surface that was cut."""
        cuts: np.ndarray = self._facet_keys >> 32
        return cuts

    @property
    def is_interface(self) -> np.ndarray:
        """(m,) bool: whether a cut made the triangle."""
        is_interface: np.ndarray = self.cuts != 0
        return is_interface

    def to_surface(self) -> Surface:
        """As a Surface, to be meshed or saved by itself: checked, with a patch interface_P towards each part P."""
        neighbours, towards = np.unique(self.neighbours[self.is_interface], return_inverse=True)
        patches = self.patches.copy()
        patches[self.is_interface] = len(self.names) + towards
        return Surface(self.points, self.triangles, patches, self.names + [f"interface_{part}" for part in neighbours])

    def __repr__(self) -> str:
        return (f"<kerf.PartSurface: {len(self.points)} points, {len(self.triangles)} triangles, "
                f"{np.count_nonzero(self.is_interface)} on interfaces>")


class TreePart:
    """A part: its node in the tree, and its closed surface."""

    def __init__(self, node: TreeNode, native: _kerf.PartSurface) -> None:
        self.node = node
        self.surface = PartSurface(native)

    @property
    def id(self) -> int:
        """Number of its node, by which a mesh and its files name the part."""
        return self.node.id

    @property
    def region(self) -> int:
        """Row of Tree.region_names, 0 if there is one region."""
        return self.surface._region

    @property
    def volume(self) -> float:
        return self.node.volume

    def __repr__(self) -> str:
        return f"<kerf.TreePart {self.id}: {len(self.surface.triangles)} triangles>"


class Tree(_kerf.Tree):
    """What decompose() returns. `tree[id]` is the node with a number, and `for node in tree` goes through `nodes`."""

    def __init__(self, native: _kerf.Tree) -> None:
        """Of one that decompose() has made."""
        super().__init__(native)
        self._by_id = {each.id: TreeNode(self, each) for each in self._all_nodes}
        self._nodes = sorted(self._by_id.values(), key=lambda node: format(node.id, "b"))
        self._parts = [TreePart(self._by_id[each._id], each) for each in self._part_surfaces]

    @property
    def nodes(self) -> list[TreeNode]:
        """All, depth first: each before its halves, the half below first."""
        return list(self._nodes)

    @property
    def parts(self) -> list[TreePart]:
        """In the order of the tree; perhaps fewer than wanted, where no cut was possible."""
        return list(self._parts)

    @property
    def root(self) -> TreeNode:
        """The whole."""
        return self._by_id[1]

    def to_text(self, every_node: bool = False) -> str:
        """The table that `kerf decompose` prints: a line for each node, or above 32 parts, unless `every_node` is True,
        for each level."""
        return self._text(every_node)

    def _interface_of(self, cut: int) -> Interface:
        corners, points, numbers = [], [], []
        for part in self._parts:
            if not format(part.id, "b").startswith(format(2 * cut, "b")):
                continue
            surface = part.surface
            chosen = surface.triangles[surface.cuts == cut]
            corners.append(surface.global_ids[chosen])
            points.append(surface.points[np.unique(chosen)])
            numbers.append(surface.global_ids[np.unique(chosen)])
        unique, first = np.unique(np.concatenate(numbers), return_index=True)
        triangles = np.searchsorted(unique, np.concatenate(corners)).astype(np.int32)
        return Interface(np.concatenate(points)[first], triangles)

    def __getitem__(self, node: int) -> TreeNode:
        return self._by_id[node]

    def __iter__(self) -> Iterator[TreeNode]:
        return iter(self._nodes)

    def __len__(self) -> int:
        return len(self._nodes)

    def __repr__(self) -> str:
        return f"<kerf.Tree: {len(self._parts)} parts, {len(self._nodes)} nodes>"


def decompose(surface: Union[Surface, Path], /, parts: int = 8, size: Size = None, progress: Progress = None,
              **options: object) -> Tree:
    """The tree of cuts of a surface, or of a file: the parts that mesh() fills, and how each cut was found.

    surface    a Surface, or the path of a file
    parts      into which the surface is cut; 0: as many as are of use here
    size       wanted edge length, as of mesh(): cuts share the work that it makes, interfaces get triangles of it
    progress   as of kerf.mesh()
    options    those of `kerf decompose`, with underscores: surface, cut, axis, contour, balance, trace, ...

        tree = kerf.decompose("pump.stl", parts=8)
        print(tree.to_text())
        for node in tree:
            if node.was_cut:
                print(node.id, node.strategy, node.plane.normal, [len(loop) for loop in node.contour])
        tree.parts[0].surface.points, tree.parts[0].surface.triangles

    The result depends on the surface and the options alone, with parts=0 on the processors, too, and is what `kerf decompose` writes with the same. Raises
    UsageError, InputError, FileError, Cancelled. Cost: n log(parts) for n triangles; memory: the surfaces of the parts.
    """
    surface, options = surface_and_options(surface, options)
    sizes, length = split_size(size, surface)
    return Tree(_kerf.decompose(surface, sizes, caller(progress), programs.folder(), parts=parts, size=length,
                                **options))
