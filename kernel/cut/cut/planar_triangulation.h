// The triangulation of a region in a plane, for interfaces and for facets that are divided.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "base/core/cancellation.h"
#include "cut/cut/cut.h"

namespace kerf {

/// An interior point that should become a vertex, and the edge length wanted there.
struct WantedPoint {
    Vec2 position;
    double size;
};

/// The region to be triangulated, and the wanted size of its triangles.
struct PlanarRegion {
    std::vector<Vec2> contour;                       ///< #C
    std::vector<std::array<std::int32_t, 2>> edges;  ///< closed loops over `contour`; the inside is on the left
    std::vector<double> sizes;                       ///< #C; edge lengths wanted at the contour; empty: the lengths of
                                                     ///< `edges`
    std::vector<WantedPoint> wanted;                 ///< inserted where they fit
    std::function<double(const Vec2&)> max_edge;     ///< upper bound of the edge length at a point; none: no bound
    double least_edge = 0;                           ///< shorter contour edges do not make the triangles small
    bool refined = true;                             ///< false: add no interior points
    std::int64_t max_points = 1 << 29;               ///< with more, triangulate() throws Error(memory)
    CancellationCheck check_cancelled;               ///< as CutOptions::check_cancelled
};

/// A conforming triangulation of the region, or the reason why there is none.
struct PlanarTriangulation {
    Refusal refusal = Refusal::none;   ///< crossing_projection or nesting
    std::vector<std::int32_t> failed;  ///< contour vertices at the failure
    std::vector<Vec2> points;          ///< contour points first, then interior points
    std::vector<Triangle> triangles;   ///< counter-clockwise
};

/// Makes a constrained Delaunay triangulation with interior points only: contour edges are shared with the surface and
/// never split. Sizes start from the contour edges and wanted points and grow at rate 0.5 with the distance; where
/// max_edge is shorter than the contour edges, they fall to it at the same rate, so that triangles at these edges are
/// not flat. Triangles that are too large or too flat get their circumcentre unless it lies outside, or too close to a
/// contour edge or a vertex. Guarded smoothing follows. Exact predicates, deterministic. O(n log n).
PlanarTriangulation triangulate(const PlanarRegion& region);

}  // namespace kerf
