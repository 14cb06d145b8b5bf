// The goal of flips.
#pragma once

#include <cstdint>
#include <span>

#include "fill/delaunay/spatial_triangulation.h"

namespace kerf {

/// An edge or a triangle that a triangulation is to get: no face or edge that is made on the way may cross it.
class Goal {
 public:
    /// Makes an empty goal, which allows everything.
    Goal() = default;
    static Goal edge(std::int32_t a, std::int32_t b) { return {{a, b, SpatialTriangulation::none}, 2}; }
    static Goal triangle(const Triangle& corners) { return {corners, 3}; }

    bool is_edge() const { return count_ == 2; }
    /// Returns the corners: two of an edge, three of a triangle.
    std::span<const std::int32_t> corners() const { return {corners_.data(), count_}; }

    /// Returns whether a face may be made: it must not cross the edge. Faces with the ghost may be. Exact.
    bool allows_face(const SpatialTriangulation& triangulation, const Triangle& face) const;
    /// Returns whether an edge may be made: it must not cross the triangle. Edges to the ghost may be. Exact.
    bool allows_edge(const SpatialTriangulation& triangulation, std::int32_t p, std::int32_t q) const;

 private:
    Goal(const Triangle& corners, std::size_t count) : corners_(corners), count_(count) {}

    Triangle corners_ = {SpatialTriangulation::none, SpatialTriangulation::none, SpatialTriangulation::none};
    std::size_t count_ = 0;
};

}  // namespace kerf
