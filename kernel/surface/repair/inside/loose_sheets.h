// Sheets that bound nothing, as fins of a body, and walls inside of it.
#pragma once

#include <vector>

#include "base/core/types.h"

namespace kerf {

/// Facets of loose sheets, each list ascending.
struct LooseSheets {
    std::vector<std::int32_t> fins;       ///< facets of sheets with a free rim
    std::vector<std::int32_t> membranes;  ///< facets with the same cell on both sides
    std::vector<std::int32_t> walls;      ///< facets between two bounded cells of material
};

/// Finds the loose sheets of all pieces that hang together over edges and have edges of more than two facets. A sheet
/// hangs together over edges of two facets. In each piece fins are found first, then, among the rest, membranes and, if
/// `with_walls`, walls. Of a kind all are returned, or none where the rest of the piece would not be closed or would
/// have less than half of the area. Decided by exact signs. Requires finite coordinates and no facet with a repeated
/// vertex. Cost as find_cells().
LooseSheets find_loose_sheets(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets, bool with_walls);

}  // namespace kerf
