// The part of a surface around a plane, where a contour may run.
#pragma once

#include <algorithm>
#include <vector>

#include "cut/cut.h"

namespace kerf {

/// Facets that meet the plane or whose centroid is nearer than three crossing edges. All other facets lie on one side.
struct Band {
    Plane plane;
    double edge_length = 0;              ///< mean length of the edges that cross the plane, h; 0: none does
    double section_area = 0;             ///< of the body with the plane
    double half_width = 0;               ///< three crossing edges
    std::vector<double> distance;        ///< per vertex of the surface, signed
    std::vector<std::int32_t> facets;    ///< ascending
    std::vector<std::int32_t> index_of;  ///< per facet of the surface: its index in `facets`, or -1
    std::vector<std::array<std::int32_t, 3>> half_edges;  ///< per band facet
    std::vector<std::int32_t> slab_facets;  ///< that reach into |distance| <= half_width, ascending; all of the band do

    /// Mean of the distances of the facet's vertices.
    double facet_distance(const Surface& surface, std::int32_t facet) const {
        const Triangle t = surface.vertices(facet);
        return (distance[t[0]] + distance[t[1]] + distance[t[2]]) / 3;
    }
    /// Calls visit(facet, its lowest, its highest distance) for the facets that reach into [low, high], ascending.
    /// O(#slab facets) within the half width, else O(#F).
    template <class Visit>
    void for_each_facet_between(const Surface& surface, double low, double high, Visit visit) const {
        const auto visit_if_between = [&](std::int32_t facet) {
            const Triangle t = surface.vertices(facet);
            const auto [lowest, highest] = std::minmax({distance[t[0]], distance[t[1]], distance[t[2]]});
            if (lowest <= high && highest >= low) visit(facet, lowest, highest);
        };
        if (low >= -half_width && high <= half_width)
            for (std::int32_t facet : slab_facets) visit_if_between(facet);
        else
            for (std::int32_t facet = 0; facet < surface.facet_count(); ++facet) visit_if_between(facet);
    }
};

/// O(#V + #F).
Band make_band(const Surface& surface, const Plane& plane);

/// Mean length of the edges that cross a plane, 0 if none does. O(#V + #F).
double crossing_edge_length(const Surface& surface, const Plane& plane);

/// Edges with one end below and one end above the plane, oriented from below to above.
std::vector<SurfaceEdge> crossed_edges(const Surface& surface, const Band& band);

}  // namespace kerf
