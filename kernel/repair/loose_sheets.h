// Sheets that bound nothing: fins of a body, and what has material on both sides.
#pragma once

#include <vector>

#include "core/types.h"

namespace kerf {

struct LooseSheets {
    std::vector<std::int32_t> fins;       ///< facets of sheets with a free rim
    std::vector<std::int32_t> membranes;  ///< facets with the same cell on both sides
    std::vector<std::int32_t> walls;      ///< facets between two bounded cells of material
};

/// Of pieces that hang together over edges, some of more than two facets. A sheet hangs together over edges of two. In
/// each piece first the fins are found, then, in what is left, membranes and walls; of each kind all, or none where
/// what is left is not closed or is less than half of the area. Walls are looked for `with_walls`. Facets ascending;
/// decided by exact signs. Requires finite coordinates and no facet with a repeated vertex. Cost as find_cells().
LooseSheets find_loose_sheets(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets, bool with_walls);

}  // namespace kerf
