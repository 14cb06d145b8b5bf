// Polygons as fans of triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/core/types.h"

namespace kerf {

/// A fan of triangles that all begin at one corner of a polygon.
struct PolygonFan {
    std::size_t apex = 0;            ///< number of the common corner in the polygon
    const char* obstacle = nullptr;  ///< reason why no fan is the polygon, to end a sentence ("is not planar"); or null
};

/// Finds a corner whose fan covers a polygon of four or more corners exactly once, without degenerate triangles: the
/// first such of its first 32 corners.
///
/// The polygon must be planar within rounding: six digits of its largest coordinate, as most programs write them.
/// Convex polygons have such a corner, also where some of their corners lie on straight sides; some others that can be
/// seen from one corner have one, too. A polygon with a coordinate that is not finite gets the fan of its first corner,
/// because there is no shape to get wrong. `corners` are indices into `vertices`. O(corners), deterministic.
PolygonFan find_fan(const std::vector<Vec3>& vertices, std::span<const std::int64_t> corners);

}  // namespace kerf
