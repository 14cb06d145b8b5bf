// The cells of other parts around a part.
#pragma once

#include <cstdint>
#include <vector>

#include "export/whole_mesh.h"
#include "part/part.h"

namespace kerf {

/// A cell of another part that shares a vertex with the part.
struct GhostCell {
    std::int64_t number;  ///< among the cells of all parts, from 0 (MeshOutline::first_tet())
    PartIndex part;
    CellNodes nodes;
};

/// A node of ghost cells that the part itself does not have.
struct GhostNode {
    std::int64_t id;  ///< global number
    Vec3 point;
};

struct Ghosts {
    std::vector<GhostCell> cells;  ///< ascending by number
    std::vector<GhostNode> nodes;  ///< ascending by id
};

/// Throws Error(io). Cost: loads every part that shares a vertex with this one, one at a time.
Ghosts ghosts_of(const PartSource& parts, const Part& part);

}  // namespace kerf
