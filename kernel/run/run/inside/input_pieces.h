// The boundary triangles of parts, compared with the facets of the input that they come from.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <tuple>

#include "run/prepare/oriented_triangle.h"
#include "surface/complex/complex.h"

namespace kerf {

/// A boundary triangle that lies on a facet of the input: the facet itself, or a piece of it, seen from outside of the
/// region. Vertices are global numbers.
struct InputPiece {
    std::int32_t facet;
    RegionIndex region;
    std::int32_t patch;
    NamedTriangle vertices;
    bool operator<(const InputPiece& o) const {
        return std::tie(facet, region, vertices) < std::tie(o.facet, o.region, o.vertices);
    }
};

/// Counts the sides of a facet of the input that no pieces are or cover, and the pieces of regions that the facet does
/// not bound. `pieces`: all pieces of the facet, ascending. `point_of`: the place of a vertex that is none of the
/// input.
std::int64_t count_missing_sides(const Complex& input, std::int32_t facet, std::span<const InputPiece> pieces,
                                 const std::function<Vec3(std::int64_t vertex)>& point_of);

}  // namespace kerf
