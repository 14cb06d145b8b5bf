// The cells of other parts around a part.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "part/part.h"

namespace kerf {

/// A cell of another part that shares a vertex with the part.
struct GhostCell {
    std::int64_t number;  ///< among the cells of all parts, from 0 (MeshOutline::first_tet())
    PartIndex part;
    std::array<std::int64_t, 4> corners;  ///< global numbers
};

/// A vertex of ghost cells that the part itself does not have.
struct GhostVertex {
    std::int64_t id;  ///< global number
    Vec3 point;
};

struct Ghosts {
    std::vector<GhostCell> cells;       ///< ascending by number
    std::vector<GhostVertex> vertices;  ///< ascending by id
};

/// Throws Error(io). Cost: loads every part that shares a vertex with this one, one at a time.
Ghosts ghosts_of(const PartSource& parts, const Part& part);

}  // namespace kerf
