// The part of a surface around a plane, where a contour may run.
#pragma once

#include <vector>

#include "cut/cut.h"

namespace kerf {

/// Facets that meet the plane or whose centroid is nearer than three crossing edges. All other facets lie on one side.
struct Band {
    Plane plane;
    double edge_length = 0;              ///< mean length of the edges that cross the plane, h; 0: none does
    double section_area = 0;             ///< of the body with the plane
    std::vector<double> distance;        ///< per vertex of the surface, signed
    std::vector<std::int32_t> facets;    ///< ascending
    std::vector<std::int32_t> index_of;  ///< per facet of the surface: its index in `facets`, or -1
    std::vector<std::array<std::int32_t, 3>> half_edges;  ///< per band facet

    /// Mean of the distances of the facet's vertices.
    double facet_distance(const Surface& surface, std::int32_t facet) const {
        const Triangle t = surface.vertices(facet);
        return (distance[t[0]] + distance[t[1]] + distance[t[2]]) / 3;
    }
};

/// O(#V + #F).
Band make_band(const Surface& surface, const Plane& plane);

/// Mean length of the edges that cross a plane, 0 if none does. O(#V + #F).
double crossing_edge_length(const Surface& surface, const Plane& plane);

/// Edges with one end below and one end above the plane, oriented from below to above.
std::vector<SurfaceEdge> crossed_edges(const Surface& surface, const Band& band);

}  // namespace kerf
