#include "fill/shell/inside/surface_edges.h"

#include <numeric>

namespace kerf {

// Each edge is taken in the direction in which it ascends; on a closed surface that is once.
SurfaceEdges::SurfaceEdges(const std::vector<Triangle>& triangles, std::size_t vertices) : start_(vertices + 1) {
    const auto for_each_ascending = [&](const auto& visit) {
        for (const Triangle& t : triangles)
            for (int i = 0; i < 3; ++i)
                if (t[i] < t[(i + 1) % 3]) visit(t[i], t[(i + 1) % 3]);
    };
    for_each_ascending([&](std::int32_t a, std::int32_t) { ++start_[a]; });
    std::inclusive_scan(start_.begin(), start_.end(), start_.begin());
    other_.resize(start_.back());
    for_each_ascending([&](std::int32_t a, std::int32_t b) { other_[--start_[a]] = b; });
}

}  // namespace kerf
