// The cells of the whole mesh in groups: tetrahedra by material, then triangles by patch.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "files/export/inside/word_names.h"
#include "files/export/whole_mesh.h"
#include "files/part/part.h"

namespace kerf {

/// Tetrahedra of a material, or triangles on a patch, which follow each other in the numbering of all cells.
struct CellGroup {
    std::string name;                   ///< a word (files/export/inside/word_names.h), no two of a mesh the same
    std::int64_t first = 0, count = 0;  ///< numbers of cells from 0: all tetrahedra, then all triangles
};

struct CellGroups {
    std::vector<CellGroup>
        materials;  ///< files/export/inside/materials.h; bodies are "volume", or "body_1", "body_2", ...
    std::vector<CellGroup> patches;  ///< some may have no triangles
};

/// Returns the groups of the mesh, whose names follow these rules. Names of patches are those of word_names() for them
/// alone. Loads all surfaces, and where there are several regions, all cells. Throws Error(io).
CellGroups cell_groups(const PartSource& parts, WordRules rules = {});

/// A cell in the form that for_each_by_patch() takes.
struct GroupCell {
    std::int32_t patch;  ///< or material
    CellNodes nodes;
};

/// Takes some cells of a group that follow each other, the first of which has the number `first`.
using TakeCells = std::function<void(const CellGroup& group, std::int64_t first, std::span<const GroupCell> cells)>;

/// Call take() with the tetrahedra, or the triangles on patches, in the order of their numbers: some of one group at a
/// time, in the order of the tree within a group. Hold at most 32 MB beside a part, and load the
/// parts again where a mesh of several large groups is more.
void for_each_tet_by_material(const PartSource& parts, const CellGroups& groups, const TakeCells& take);
void for_each_triangle_by_patch(const PartSource& parts, const CellGroups& groups, const TakeCells& take);

}  // namespace kerf
