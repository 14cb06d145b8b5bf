"""How a surface was cut into parts."""

from __future__ import annotations

from typing import Iterator, Union

import numpy as np

from . import _kerf, programs
from .mesh import surface_and_options
from .part_surface import PartSurface
from .progress import Progress, caller
from .sizes import Size, split_size
from .surface import Path, Surface
from .tree_node import Interface, TreeNode


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
        return self.surface._native.region

    @property
    def volume(self) -> float:
        return self.node.volume

    def __repr__(self) -> str:
        return f"<kerf.TreePart {self.id}: {len(self.surface.triangles)} triangles>"


class Tree:
    """What decompose() returns. `tree[id]` is the node with a number, and `for node in tree` goes through `nodes`."""

    def __init__(self, native: _kerf.Tree) -> None:
        self._native = native
        self._by_id = {each.id: TreeNode(self, each) for each in native.nodes}
        self._nodes = sorted(self._by_id.values(), key=lambda node: format(node.id, "b"))
        self._parts = [TreePart(self._by_id[each.id], each) for each in native.parts]

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

    @property
    def patch_names(self) -> list[str]:
        """Names of the patches of the surface, in the order of their numbers."""
        return self._native.patch_names

    @property
    def region_names(self) -> list[str]:
        """Empty if there is one region."""
        return self._native.region_names

    def to_text(self, every_node: bool = False) -> str:
        """The table that `kerf decompose` prints: a line for each node, or above 32 parts, unless `every_node` is True,
        for each level."""
        return self._native.text(every_node)

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


def decompose(surface: Union[Surface, Path], /, parts: int = 8, size: Size = 0, progress: Progress = None,
              **options: object) -> Tree:
    """The tree of cuts of a surface, or of a file: the parts that mesh() fills, and how each cut was found.

    surface    a Surface, or the path of a file
    parts      into which the surface is cut; 0: as many as are of use here
    size       wanted edge length, as of mesh(): cuts share the work that it makes, interfaces get triangles of it
    progress   True: a line on standard error; or called with (stage, done, total): returning False ends the work
    options    those of `kerf decompose`, with underscores: surface, cut, axis, contour, balance, trace, ...

        tree = kerf.decompose("pump.stl", parts=8)
        print(tree.to_text())
        for node in tree:
            if node.was_cut:
                print(node.id, node.strategy, node.plane.normal, [len(loop) for loop in node.contour])
        tree.parts[0].surface.points, tree.parts[0].surface.triangles

    The result depends on the surface and the options alone, and is what `kerf decompose` writes with the same. Raises
    UsageError, InputError, FileError, Cancelled. Cost: n log(parts) for n triangles; memory: the surfaces of the parts.
    """
    surface, options = surface_and_options(surface, options)
    sizes, length = split_size(size, surface)
    return Tree(_kerf.decompose(surface._native, sizes, caller(progress), programs.folder(), parts=parts, size=length,
                                **options))
