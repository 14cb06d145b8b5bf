// The filling of small holes in an open surface.
#pragma once

#include "surface/soup/soup.h"

namespace kerf {

struct HoleFilling {
    std::int64_t holes = 0;   ///< filled
    std::int64_t facets = 0;  ///< added, at the end, in a patch named "filled"
};

/// Spans every closed open-edge loop of at most `most_edges` edges with triangles of its own vertices, by CGAL's search
/// for the flattest triangulation (Liepa 2003, liepa2003). Changes the geometry. Loops that it cannot span stay.
/// Deterministic.
HoleFilling fill_holes(Soup& soup, std::int32_t most_edges);

}  // namespace kerf
