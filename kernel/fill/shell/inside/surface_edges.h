// The pairs of vertices that are edges of a surface.
#pragma once

#include <algorithm>
#include <vector>

#include "base/core/types.h"

namespace kerf {

/// The edges of a closed surface whose vertices are numbered from 0 to below `vertices`. 6 bytes a triangle and 4 a
/// vertex.
class SurfaceEdges {
 public:
    SurfaceEdges() = default;
    SurfaceEdges(const std::vector<Triangle>& triangles, std::size_t vertices);

    /// Returns whether the surface has an edge, in either direction. Linear in the number of edges from its smaller
    /// vertex to greater ones.
    bool contains(std::int32_t a, std::int32_t b) const {
        if (a > b) std::swap(a, b);
        if (a < 0 || static_cast<std::size_t>(a) + 1 >= start_.size()) return false;
        return std::find(other_.begin() + start_[a], other_.begin() + start_[a + 1], b) !=
               other_.begin() + start_[a + 1];
    }

 private:
    // The greater ends of all edges, in a list by their smaller ends, and the place in it at which those of a vertex
    // start.
    std::vector<std::int32_t> start_, other_;
};

}  // namespace kerf
