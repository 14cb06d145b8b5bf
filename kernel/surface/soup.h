// What a surface file said, with nothing repaired.
#pragma once

#include <string>
#include <vector>

#include "core/types.h"

namespace kerf {

/// Triangles with shared vertices and a patch per triangle. No promise about closedness, orientation or manifoldness.
struct Soup {
    std::vector<Vec3> vertices;            ///< #V; units of the file
    std::vector<Triangle> facets;          ///< #F; indices into `vertices`
    std::vector<std::int32_t> patch;       ///< #F; index into `patch_names`
    std::vector<std::string> patch_names;  ///< never empty once a reader has returned
};

/// Merges vertices with exactly equal coordinates (-0 equals 0). The first of equals stays, the order is kept.
/// NaN equals nothing. Returns the number of vertices removed. O(#V), deterministic.
std::int64_t weld_exactly(Soup& soup);

/// Removes vertices that no facet uses; the order of the others is kept. Returns the number removed. O(#V + #F).
std::int64_t drop_unused_vertices(Soup& soup);

}  // namespace kerf
